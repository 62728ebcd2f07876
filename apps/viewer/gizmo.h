// The handles around the selected object: arrows to move it along the axes of the world, rings to turn it, boxes to scale it.
//
// A drag is computed from its start, not from the last position. So moving the pointer back restores the scene.
#pragma once

#include <optional>

#include "document/node_pose.h"
#include "view_camera.h"

namespace steradian::view {

enum class GizmoMode { move, turn, scale };
// free: in the plane of the picture; for scale, all axes alike.
enum class Handle { none, x, y, z, free };

struct Gizmo {
  GizmoMode mode = GizmoMode::move;
  Vec3d origin;
  double size = 1;                                    // length of an arrow
  Vec3d axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  // unit; for scale the node's axes
};

// A gizmo of the same size in every picture: a seventh of the picture's height.
Gizmo gizmo_at(GizmoMode mode, const Affine& world, const Camera& camera);

// The handle under the pointer, within `reach` pixels.
Handle handle_at(const Gizmo& gizmo, const Camera& camera, Vec2d pointer, double width, double height, double reach = 8);

// The point where a ray meets a plane that it does not graze.
std::optional<Vec3d> meets_plane(Vec3d origin, Vec3d normal, const Ray& ray);

// The result of a drag of a handle from one ray to another. Empty if a ray does not meet the handle's line or plane.
std::optional<Vec3d> drag_move(const Gizmo& gizmo, Handle handle, const Camera& camera, const Ray& from, const Ray& to);
struct Turn {
  Vec3d axis;
  double angle = 0;
};
std::optional<Turn> drag_turn(const Gizmo& gizmo, Handle handle, const Camera& camera, const Ray& from, const Ray& to);
std::optional<Vec3d> drag_scale(const Gizmo& gizmo, Handle handle, const Camera& camera, const Ray& from, const Ray& to);

}  // namespace steradian::view
