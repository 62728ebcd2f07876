// The closed form for GGX on packs: a light's outline is clipped, its edges are prepared and kept for the second walk.
#pragma once

#include <vector>

#include "render/cpu/light_list.h"
#include "render/cpu/polygon_pack.h"
#include "steradian/closed_form.h"

STERADIAN_BEGIN_ISA

// Surface points and their lobes. What is not `lit` (behind the light, or seen from below) gives 0.
struct GgxPackPoint {
  PackVec3 position;
  PackKernels::mat3 frame;  // x along the tangent, z along the normal
  PackKernels::GgxView view;
  PackReal smith;   // 1 with shadowing, 0 without
  PackReal facing;  // 1; -1 where the light is seen from behind
  PackKernels::mask lit;
};

// Memory of the walks; one object serves a thread for all its lights.
struct GgxPackWalks {
  struct Arc {
    PackVec3 start, end;
  };
  std::vector<Arc> arcs;
  std::vector<PackKernels::ConicArc> edges;
};

// Radiance of a polygon for radiance 1 with F = 1, and with F = (1 - v.h)^5, for ggx_radiance.
STERADIAN_INLINE PackKernels::vec2 ggx_closed_form(const SeenLight& seen, const GgxPackPoint& at, Quality quality,
                                                   GgxPackWalks& walks) {
  PackKernels k;
  // Lanes without light walk edges of no length, so that they never keep the others waiting.
  const PackVec3 nowhere(0.0, 0.0, 0.0);
  auto& arcs = walks.arcs;
  arcs.clear();
  auto clip = k.horizon_clip_begin();
  PackVec3 previous;
  const PackVec3& view = at.view.v;
  const PackLobe lobe = {PackVec3(-view.x, -view.y, view.z), PackReal(2.0) * max(at.view.ax, at.view.ay),
                         quality == Quality::high ? 16 : 12};
  seen.walk(
      at.frame, at.position, lobe, [&](const PackVec3& v) { previous = select(at.lit, v, nowhere); },
      [&](const PackVec3& v) {
        const PackVec3 next = select(at.lit, v, nowhere);
        clip = k.horizon_clip_edge(clip, previous, next);
        arcs.push_back({clip.start, clip.end});
        if (any_lane(clip.closes)) arcs.push_back({clip.arc_start, clip.arc_end});
        previous = next;
      });
  clip = k.horizon_clip_finish(clip);
  if (any_lane(clip.closes)) arcs.push_back({clip.arc_start, clip.arc_end});

  auto& edges = walks.edges;
  edges.clear();
  PackVec3 e = nowhere;
  for (const auto& arc : arcs) {
    const auto edge = k.ggx_edge(at.view, arc.start, arc.end);
    if (!any_lane(edge.end > edge.begin)) continue;
    e = e + k.conic_vector(edge);
    if (quality != Quality::draft) edges.push_back(edge);
  }
  if (quality == Quality::draft) return select(at.lit, k.ggx_draft(at.view, e, at.smith, at.facing), {0.0, 0.0});

  auto c = k.ggx_cubature_begin(at.view, e, at.smith, at.facing);
  const int extra_nodes = quality == Quality::high ? 2 : 0;
  for (const auto& edge : edges) c = k.ggx_cubature_edge(c, edge, extra_nodes);
  return select(at.lit, k.ggx_cubature_finish(c), {0.0, 0.0});
}

STERADIAN_END_ISA
