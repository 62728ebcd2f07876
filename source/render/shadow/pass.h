// Exact soft shadows for pictures: visibility of a scene's lights from the surfaces of a tile. docs/shadows.md.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "render/lights/light_list.h"
#include "render/shadow/open_lights.h"
#include "render/shadow/side.h"
#include "render/shadow/taker.h"
#include "render/shadow/tile.h"
#include "render/shadow/viewpoints.h"
#include "render/surface/ray_scene.h"
#include "shadow/edges/edge_arrays.h"
#include "shadow/edges/solid_light.h"
#include "shadow/lanes/lanes.h"

namespace steradian {

// Counts over all tiles, for --stats.
struct ShadowCounts {
  std::uint64_t points = 0;     // pairs of a surface and a light that were tested
  std::uint64_t parts = 0;      // pairs in a penumbra
  std::uint64_t fallback = 0;   // pairs estimated by rays
  std::uint64_t estimated = 0;  // pairs of dim lights, within RenderOptions::shadow_error; not among `points`
};

class ShadowPass {
 public:
  // Keeps references to its arguments.
  ShadowPass(const Scene& scene, const std::vector<PackLight>& lights, const SceneParts& parts, Shadows mode);

  // Finds lights that nothing occludes for all of a tile. They are wholly visible, and find() would tell no more.
  void find_open(const TilePoints& points, const std::vector<const PackLight*>& lights, OpenLights::Work& work) const {
    open_.find(points, lights, work);
  }
  // taker: if not null, it may take over some groups.
  void find(const SurfaceTile& tile, const TilePoints& points, const PackLight& light, TileShadow& result, ShadowCounts& counts,
            ShadowTaker* taker = nullptr) const;
  // The same for some points in their slots, under an area light.
  void find_at(const TilePoints& points, const PackLight& light, TileShadow& result, ShadowCounts& counts) const;

 private:
  struct Flat {
    PreparedPolygon polygon;            // no vertices: the light is not flat
    std::optional<LightSide> sides[2];  // the lit side, the other side
    // A round light has triangles that may reach into the planes that stand for it, and those inside it, which do not block it.
    std::optional<Body> body;
    std::vector<std::uint32_t> near, inside;
  };
  // A closed mesh that shines evenly, and its faces for points that do not see it as a whole.
  struct Solid {
    const shadow::SolidLight* light = nullptr;
    std::vector<bool> own;  // by triangle: true for the light's
    std::vector<Flat> faces;
  };
  struct Work;
  Flat flat_of(const PreparedPolygon& polygon) const;
  Work& begin(const TilePoints& points, TileShadow& result, ShadowCounts& counts, ShadowTaker* taker) const;
  void find_area(const PointGroups& groups, const PackLight& light, Work& work) const;
  void find_flat(const PointGroups& groups, const PackLight& light, const Flat& flat, Work& work) const;
  void find_side(const std::vector<const std::vector<std::uint32_t>*>& groups, const PreparedPolygon& polygon, const LightSide& side,
                 Work& work) const;
  void find_round(const PointGroups& groups, const PackLight& light, const Flat& flat, Work& work) const;
  std::optional<LightSide> gather_solid(const Solid& solid, Work& work) const;
  void find_solid(const PointGroups& groups, const Solid& solid, Work& work) const;
  std::vector<std::uint32_t> find_solid_alone(const std::vector<std::uint32_t>& slots, const Solid& solid, Work& work) const;
  void find_solid_group(const std::vector<std::uint32_t>& all, const shadow::SolidLight& light, const LightSide& side, Work& work) const;
  void find_punctual(const SurfaceTile& tile, const PackLight& light, Work& work) const;
  using SideAt = ShadowTaker::SideAt;
  // Returns true if the taker takes a group. crossing: triangles that may cross the light's plane.
  bool is_taken(const std::vector<std::uint32_t>& slots, const shadow::LightFrame& frame, const void* key, const shadow::Shaft& shaft,
                const std::vector<std::uint32_t>& crossing, const SideAt& side_at, Work& work) const;
  // work.group holds the data that the group needs.
  void find_group(const std::vector<std::uint32_t>& slots, const SideAt& side_at, Work& work) const;
  void gather_round(const Flat& flat, const shadow::Shaft& shaft, Work& work) const;
  // together: the shaft of all groups with an edge list in common, or null. It is gathered when a group first needs it.
  void find_round_group(const PackLight& light, const Flat& flat, const std::vector<std::uint32_t>& slots, const shadow::Shaft* together,
                        Work& work) const;
  void find_lanes(const LightSide* const* sides, const std::uint32_t* slots, std::size_t count, Work& work) const;
  void add_lanes(const LightSide* const* sides, const std::uint32_t* slots, std::size_t count, std::uint32_t lanes, Work& work) const;
  void find_point(const LightSide& side, std::uint32_t slot, Work& work) const;
  void find_in_tube(const LightSide& side, const std::vector<LightSide>& parts, std::uint32_t slot, Work& work) const;
  void find_in_segments(const LightSide& side, std::uint32_t slot, Work& work) const;
  void add_part(const LightSide& side, std::uint32_t slot, Work& work) const;
  void take_rays(const LightSide& side, std::uint32_t slot, Work& work) const;
  bool meets_cut_outs(const shadow::Shaft& shaft) const;
  void pass_cut_outs(const LightSide& side, std::uint32_t slot, Work& work) const;

  const shadow::ShadowTable& packs_;
  const shadow::LaneTable& lanes_;
  const std::shared_ptr<const ShadowEdges> edges_;
  const RayScene& rays_;
  const Shadows mode_;
  const std::vector<PackLight>& lights_;
  const shadow::EdgeMesh& mesh_;
  const shadow::EdgeTree& tree_;
  std::vector<Box3d> cut_outs_;                                  // boxes of meshes whose material has holes
  std::shared_ptr<const std::vector<shadow::Segment>> ellipse_;  // outline of the polygons that stand for ellipsoids
  std::vector<Flat> flats_;                                      // one per light; without sides if the light is not flat
  std::vector<Solid> solids_;                                    // one per light; without faces if the light is not solid
  std::shared_ptr<const std::vector<shadow::Segment>> nothing_;  // an empty outline
  OpenLights open_;
};

}  // namespace steradian
