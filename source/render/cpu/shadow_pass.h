// What of a light reaches the surfaces of a tile: nothing, all of it, or the pieces that triangles leave.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/cpu/light_list.h"
#include "render/cpu/ray_scene.h"
#include "render/cpu/tile.h"
#include "shadow/gather.h"
#include "shadow/visible.h"
#include "steradian/render.h"

namespace steradian {

// How one light reaches a tile.
struct TileShadow {
  enum class Seen : std::uint8_t { none, whole, part, share };
  // A slot that sees a part of the light.
  struct Part {
    std::size_t slot = 0;
    Vec3d position;           // moved off the surface
    PreparedPolygon visible;  // edges in no order, see shadow/visible_part.h
    PreparedPolygon all;      // round lights: the polygon of which `visible` is the part; else no vertices
    float passes = 1;         // share that cut-outs let through
  };
  std::array<Seen, kTilePixels> seen;
  std::array<float, kTilePixels> share;  // of Seen::share: by rays
  std::vector<Part> parts;
  std::size_t wholes = 0;  // slots that are whole
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

  void find(const SurfaceTile& tile, const PackLight& light, TileShadow& result, ShadowCounts& counts) const;

 private:
  // A light made ready.
  struct Flat {
    PreparedPolygon polygon;  // no vertices: it is not flat
    struct Side {
      shadow::LightFrame frame;
      std::vector<std::uint32_t> crossing;  // triangles
    };
    std::optional<Side> sides[2];     // the lit one, the other
    std::vector<std::uint32_t> near;  // of a round light: triangles that may reach into the planes that stand for it
  };
  struct Work;
  void find_flat(const SurfaceTile& tile, const PackLight& light, const Flat& flat, Work& work) const;
  void find_round(const SurfaceTile& tile, const PackLight& light, Work& work) const;
  void find_punctual(const SurfaceTile& tile, const PackLight& light, Work& work) const;
  void find_group(const PackLight& light, const Flat& flat, int side, const std::vector<std::uint32_t>& edges,
                  const std::vector<std::uint32_t>& slots, Work& work) const;
  void find_round_group(const PackLight& light, const std::vector<std::uint32_t>& slots, Work& work) const;
  void find_point(const PreparedPolygon& polygon, const shadow::LightFrame& frame, int side, std::uint32_t slot, bool round,
                  Work& work) const;
  bool is_cut(const shadow::LightFrame& frame, const shadow::Viewpoint& at) const;
  float share_by_rays(const shadow::LightFrame& frame, const shadow::Viewpoint& at) const;
  bool meets_cut_outs(const shadow::Shaft& shaft) const;
  void pass_cut_outs(const shadow::LightFrame& frame, std::uint32_t slot, Work& work) const;

  const RayScene& rays_;
  const Shadows mode_;
  const std::vector<PackLight>& lights_;
  shadow::EdgeMesh mesh_;
  shadow::EdgeTree tree_;
  struct Box {
    Vec3d low, high;
  };
  std::vector<Box> cut_outs_;  // of meshes whose material has holes
  std::vector<Flat> flats_;    // one a light; without frames where it is not flat
};

}  // namespace steradian
