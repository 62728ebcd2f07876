// The shadow pass for a single point.
#include <algorithm>

#include "render/shadow/shares.h"
#include "render/shadow/work.h"
#include "shapes/area_moments.h"

namespace steradian {
namespace {

constexpr std::size_t kMostSegments = 2048;  // a point that sees more takes rays, unless exact is asked for
constexpr double kLift = 1e-6;               // integrals are computed in float

}  // namespace

using shadow::Viewpoint;
using Seen = TileShadow::Seen;

void ShadowPass::take_rays(const LightSide& side, std::uint32_t slot, Work& work) const {
  ++work.counts->fallback;
  work.result->seen[slot] = Seen::share;
  work.result->share[slot] = static_cast<float>(share_by_rays(rays_, side, work.at(slot)));
}

// Finds the visible part; work.scratch holds the point's segments.
void ShadowPass::find_in_segments(const LightSide& side, std::uint32_t slot, Work& work) const {
  const Viewpoint& at = work.at(slot);
  find_visible_on_packs(packs_, side.frame, at.position, RayBlockers(rays_), work.scratch, work.region);
  if (work.region.boundary.empty()) return;
  if (work.scratch.set.occluders == 0 && !is_cut(side.frame, at)) {
    work.result->seen[slot] = Seen::whole;
    return;
  }
  ++work.counts->parts;
  work.result->seen[slot] = Seen::part;
  TileShadow::Part part;
  part.slot = slot;
  const Vec3d eye = side.frame.to_local(at.position);
  // Makes an outline of edges between places in the light's plane. Its edges are relative to the point.
  const auto outline_of = [&](auto each_edge) {
    TileShadow::Outline outline;
    std::vector<TileShadow::Edge>& edges = work.result->edges;
    outline.first = edges.size();
    AreaMoments moments;
    each_edge([&](double ax, double ay, double bx, double by) {
      moments.add(ax, ay, bx, by);
      const auto corner = [&](double x, double y) { return static_cast<Vec3f>(side.frame.axes.to_world({x - eye.x, y - eye.y, -eye.z})); };
      edges.push_back({corner(ax, ay), corner(bx, by)});
    });
    outline.count = edges.size() - outline.first;
    const double extent2 = side.frame.half_x * side.frame.half_x + side.frame.half_y * side.frame.half_y;
    if (moments.area > 0 && dot(eye, eye) > kNeverSmall * extent2) {
      outline.elements = quarters_of(moments, side.frame.origin - at.position, side.frame.axes.x, side.frame.axes.y);
      outline.area = side.frame.axes.z * -moments.area;
    }
    return outline;
  };
  part.visible = outline_of([&](auto edge) {
    const double x = side.frame.box_x / shadow::kCells, y = side.frame.box_y / shadow::kCells;
    for (const shadow::Boundary& b : work.region.boundary) edge(b.ax * x, b.ay * y, b.bx * x, b.by * y);
  });
  // Edges are lifted to the horizon, so that no rounding puts one below it.
  for (std::size_t i = part.visible.first; i < part.visible.first + part.visible.count; ++i)
    for (Vec3f* v : {&work.result->edges[i].a, &work.result->edges[i].b}) {
      const auto d = static_cast<Vec3d>(*v);
      const double least = kLift * length(d), height = dot(d, at.normal);
      if (height < least) *v = static_cast<Vec3f>(d + at.normal * (least - height));
    }
  if (work.whole_outline)
    part.all = outline_of([&](auto edge) {
      for (const auto& c : with_contours(side.frame).contours)
        for (std::size_t i = 0, j = c.size() - 1; i < c.size(); j = i++) edge(c[j].x, c[j].y, c[i].x, c[i].y);
    });
  work.result->parts.push_back(part);
}

void ShadowPass::find_point(const LightSide& side, std::uint32_t slot, Work& work) const {
  const Viewpoint& at = work.at(slot);
  ++work.counts->points;
  shadow::SegmentSet& set = work.scratch.set;
  if (work.turned)
    work.group.see_turned(packs_, work.base, side.frame, at, *side.outline, set);
  else
    work.group.see(packs_, side.frame, at, *side.outline, set);
  if (set.occluders > kMostSegments && mode_ != Shadows::exact) {
    take_rays(side, slot, work);
    return;
  }
  // Without segments to arrange, one ray to any place of the light above the horizons decides.
  const auto sees = [&](Vec3d normal) { return dot(*side.middle - at.position, normal) > 0; };
  if (set.occluders == 0 && side.middle && sees(at.normal) && !is_cut(side.frame, at)) {
    const double z = -side.frame.to_local(at.position).z;
    const Vec3d to = (*side.middle - at.position) * std::max((z - side.frame.eta) / z, 0.0);
    if (!rays_.between(at.position, at.position + to)) work.result->seen[slot] = Seen::whole;
  } else {
    if (set.occluders == 0) shadow::add_surroundings(side.frame, at, *side.outline, set);
    find_in_segments(side, slot, work);
  }
  if (work.cut_outs && work.result->seen[slot] != Seen::none) pass_cut_outs(side, slot, work);
}

// Applies the fraction that cut-outs let through of the light that a slot sees. For a part, work still holds its levels.
void ShadowPass::pass_cut_outs(const LightSide& side, std::uint32_t slot, Work& work) const {
  const Viewpoint& at = work.at(slot);
  const bool part = work.result->seen[slot] == Seen::part;
  const double share = part ? share_past_cut_outs(rays_, side, at, work.scratch.set, work.region) : share_past_cut_outs(rays_, side, at);
  if (share == 1) return;
  if (part) {
    work.result->parts.back().passes = static_cast<float>(share);
  } else {
    work.result->seen[slot] = Seen::share;
    work.result->share[slot] = static_cast<float>(share);
  }
}

}  // namespace steradian
