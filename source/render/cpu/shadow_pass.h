// What of a light reaches the surfaces of a tile: nothing, all of it, or the pieces that triangles leave.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "render/cpu/light_list.h"
#include "render/cpu/ray_scene.h"
#include "render/cpu/shadow_groups.h"
#include "render/cpu/tile.h"
#include "shadow/edge_arrays.h"
#include "shadow/lanes.h"
#include "shadow/visible.h"
#include "steradian/render.h"

namespace steradian {

// The surface points of a tile as shadows see them.
struct TilePoints {
  std::vector<shadow::Viewpoint> points;  // by slot
  PointGroups groups;
};
TilePoints points_for_shadows(const SurfaceTile& tile, Terminator terminator);

// How one light reaches a tile.
struct TileShadow {
  // dark: the surface looks away from all of the light, which sends nothing past its horizon, whatever stands between.
  enum class Seen : std::uint8_t { dark, none, whole, part, share };
  // Edges, and where it is small the elements that stand for it, relative to the point.
  struct Outline {
    std::size_t first = 0, count = 0;
    std::optional<LightQuarters> elements;
    Vec3d area{};  // of the elements, towards the point
  };
  // A slot that sees a part of the light, found by itself.
  struct Part {
    std::uint32_t slot = 0;
    Outline visible;   // edges in no order
    Outline all;       // round and textured lights: the polygon of which `visible` is the part, in walk order
    float passes = 1;  // share that cut-outs let through
  };
  struct Edge {
    Vec3f a, b;  // relative to the point, in the world's frame
  };
  // Slots that see a part, side by side, for packs: not more than a tile has.
  struct Batch {
    std::vector<std::uint32_t> slots;  // kNoSlot: none
    std::vector<float> passes;         // shares that cut-outs let through
    packed::Pieces visible, all;

    void clear();
  };
  std::array<Seen, kTilePixels> seen;
  std::array<float, kTilePixels> share;  // of Seen::share: by rays
  std::vector<Part> parts;
  std::vector<Edge> edges;
  std::vector<Batch> batches;  // of these, batch_count; the others are memory
  std::size_t batch_count = 0;

  void clear();
  // Whether it is as if nothing stood between.
  bool is_plain() const;
  // Where the next sixteen slots go.
  Batch& batch_with_room();
  // Moves the parts into batches, those of about one length side by side.
  void batch_parts();
};

// Counts of all tiles, for --stats.
struct ShadowCounts {
  std::uint64_t points = 0;    // pairs of a surface and a light that were asked for
  std::uint64_t parts = 0;     // of these, in a penumbra
  std::uint64_t fallback = 0;  // of these, by rays
};

class ShadowPass {
 public:
  // Keeps references.
  ShadowPass(const Scene& scene, const std::vector<PackLight>& lights, const RayScene& rays, Shadows mode);

  void find(const SurfaceTile& tile, const TilePoints& points, const PackLight& light, TileShadow& result, ShadowCounts& counts) const;

 private:
  // One side of a flat light, made ready.
  struct Side {
    int side = 1;  // -1: behind it
    shadow::LightFrame frame;
    std::shared_ptr<const std::vector<shadow::Segment>> outline;
    std::vector<std::uint32_t> crossing;  // triangles
    std::optional<Vec3d> middle;          // a place of the light, if one is at hand
  };
  struct Flat {
    PreparedPolygon polygon;          // no vertices: it is not flat
    std::optional<Side> sides[2];     // the lit one, the other
    std::vector<std::uint32_t> near;  // of a round light: triangles that may reach into the planes that stand for it
  };
  struct Work;
  static Side side_of(const PreparedPolygon& polygon, int side);
  std::optional<Side> side_of_round(const PackLight& light, Vec3d position) const;
  void find_flat(const SurfaceTile& tile, const PointGroups& groups, const PackLight& light, const Flat& flat, Work& work) const;
  void find_round(const SurfaceTile& tile, const PointGroups& groups, const PackLight& light, const Flat& flat, Work& work) const;
  void find_punctual(const SurfaceTile& tile, const PackLight& light, Work& work) const;
  template <class SideAt>
  void find_group(const std::vector<std::uint32_t>& slots, SideAt side_at, Work& work) const;
  bool gather_round(const PackLight& light, const Flat& flat, const std::vector<Vec3d>& positions, Work& work) const;
  void find_round_group(const PackLight& light, const Flat& flat, const std::vector<std::uint32_t>& slots, bool together, Work& work) const;
  void find_lanes(const Side* const* sides, const std::uint32_t* slots, std::size_t count, Work& work) const;
  void add_lanes(const Side* const* sides, const std::uint32_t* slots, std::size_t count, std::uint32_t lanes, Work& work) const;
  void find_point(const Side& side, std::uint32_t slot, Work& work) const;
  void find_in_segments(const Side& side, std::uint32_t slot, Work& work) const;
  void take_rays(const Side& side, std::uint32_t slot, Work& work) const;
  bool is_cut(const shadow::LightFrame& frame, const shadow::Viewpoint& at) const;
  float share_by_rays(const Side& side, const shadow::Viewpoint& at) const;
  bool meets_cut_outs(const shadow::Shaft& shaft) const;
  void pass_cut_outs(const Side& side, std::uint32_t slot, Work& work) const;

  const shadow::ShadowTable& packs_;
  const shadow::LaneTable& lanes_;
  const RayScene& rays_;
  const Shadows mode_;
  const std::vector<PackLight>& lights_;
  shadow::EdgeMesh mesh_;
  shadow::EdgeTree tree_;
  struct Box {
    Vec3d low, high;
  };
  std::vector<Box> cut_outs_;                                    // of meshes whose material has holes
  std::shared_ptr<const std::vector<shadow::Segment>> ellipse_;  // outline of the polygons that stand for ellipsoids
  std::vector<Flat> flats_;                                      // one a light; without frames where it is not flat
};

}  // namespace steradian
