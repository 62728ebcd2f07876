#include "bench/studies/shadow_comparison.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>

#include "bench/studies/shadow_clipping.h"
#include "render/surface/ray_scene.h"
#include "shadow/edges/edge_arrays.h"
#include "shadow/region/visible_part.h"
#include "steradian/ltc.h"
#include "steradian/polygon_derivatives.h"
#include "support/rays_integral.h"
#include "support/shadow_families.h"

namespace steradian::studies {
namespace {

using namespace shadow;
using reference::Random;
using Clock = std::chrono::steady_clock;

class EmbreeBlockers : public Blockers {
 public:
  explicit EmbreeBlockers(const RayScene& rays) : rays_(rays) {}
  bool between(Vec3d from, Vec3d to) const override { return rays_.between(from, to); }

 private:
  const RayScene& rays_;
};

// Rounds the positions to float, as in a file, so that rays and edges use the same triangles.
families::Triangles rounded(families::Triangles t) {
  for (Vec3d& p : t.positions) p = static_cast<Vec3d>(static_cast<Vec3f>(p));
  return t;
}

Scene scene_of(const families::Triangles& triangles) {
  Scene scene;
  scene.materials.emplace_back();
  Mesh mesh;
  for (const Vec3d p : triangles.positions) mesh.positions.push_back(static_cast<Vec3f>(p));
  mesh.normals.resize(mesh.positions.size());
  mesh.indices = triangles.indices;
  scene.meshes.push_back(std::move(mesh));
  return scene;
}

struct Lobes {
  double lambert = 0, ltc = 0;
};

// A view to the side, so that the lobe points at the light's part of the sky.
ShadingPoint shading_of(const Viewpoint& at, const PreparedPolygon& light) {
  const Vec3d to_light = normalized(light.centroid - at.position);
  const Vec3d mirrored = at.normal * (2 * dot(at.normal, to_light)) - to_light;
  return {at.position, at.normal, dot(mirrored, at.normal) > 0.05 ? mirrored : at.normal};
}

Material glossy() {
  Material ggx;
  ggx.brdf = Brdf::ggx;
  ggx.alpha_x = ggx.alpha_y = 0.3;
  return ggx;
}

Lobes integrals_over(const PreparedPolygon& part, const ShadingPoint& at) {
  if (part.vertices.empty()) return {};
  return {polygon_irradiance(part, at.position, at.normal), ltc_radiance(LtcMethod::classic, part, at, glossy()).x};
}

struct ComparisonStage {
  explicit ComparisonStage(const families::Family& f)
      : triangles(rounded(f.triangles)),
        scene(scene_of(triangles)),
        rays(scene),
        blockers(rays),
        light(prepare_polygon(f.light)),
        occluders(build_edges(triangles.positions, triangles.indices)),
        tree(occluders.mesh) {
    for (const int side : {1, -1}) {
      const std::size_t i = side > 0 ? 0 : 1;
      frames[i] = light_frame(light, side);
      outlines[i] = outline_segments(frames[i]);
      crossing[i] = crossing_triangles(occluders.mesh, frames[i]);
    }
  }
  int side_of(const Viewpoint& at) const { return light.side_of(at.position); }
  std::size_t index_of(const Viewpoint& at) const { return side_of(at) > 0 ? 0 : 1; }
  const LightFrame& frame_of(const Viewpoint& at) const { return frames[index_of(at)]; }

  // Collects the segments that the point sees, for this point alone.
  void see(const Viewpoint& at, SegmentSet& set) const {
    thread_local std::vector<std::uint32_t> edges, triangles_across;
    thread_local EdgeArrays arrays;
    const std::size_t i = index_of(at);
    const Shaft shaft(frames[i], {at.position});
    tree.gather(packs, shaft, edges);
    triangles_across.clear();
    for (const std::uint32_t t : crossing[i])
      if (shaft.needs_triangle(occluders.mesh, t)) triangles_across.push_back(t);
    arrays.assign(occluders.mesh, frames[i], edges, triangles_across);
    arrays.see(packs, frames[i], at, outlines[i], set);
    if (set.occluders == 0) add_surroundings(frames[i], at, outlines[i], set);
  }

  const families::Triangles triangles;
  const Scene scene;
  const RayScene rays;
  const EmbreeBlockers blockers;
  const PreparedPolygon light;
  const Occluders occluders;
  const EdgeTree tree;
  const ShadowTable& packs = shadow_table_for(active_simd());
  LightFrame frames[2];
  std::vector<Segment> outlines[2];
  std::vector<std::uint32_t> crossing[2];
};

// A point and the values known for it.
struct LobePoint {
  Viewpoint at;
  ShadingPoint shading;
  LobeDensity lobe;  // the transformed cosine
  Lobes open, truth;
};

// Points that see between 1 % and 99 % of the light.
std::vector<LobePoint> places_in(const ComparisonStage& stage, const families::Family& family, int count) {
  std::vector<LobePoint> result;
  Random random(5, 3);
  while (result.size() < static_cast<std::size_t>(count)) {
    LobePoint place;
    place.at = families::random_point(family, stage.occluders.mesh, stage.light, random).at;
    place.shading = shading_of(place.at, stage.light);
    place.lobe = ltc_lobe_density(LtcMethod::classic, place.shading, glossy());
    place.open = integrals_over(stage.light, place.shading);
    if (!(place.open.lambert > 1e-3) || !(place.open.ltc > 1e-3)) continue;
    place.truth = integrals_over(visible_part(stage.light, stage.occluders, place.at, 1e-9), place.shading);
    const double share = place.truth.lambert / place.open.lambert;
    if (share > 0.01 && share < 0.99) result.push_back(place);
  }
  return result;
}

Lobes by_pieces(const ComparisonStage& stage, const LobePoint& place) {
  thread_local Scratch scratch;
  thread_local VisibleRegion region;
  stage.see(place.at, scratch.set);
  const LightFrame& frame = stage.frame_of(place.at);
  find_visible_on_packs(stage.packs, frame, place.at.position, stage.blockers, scratch, region);
  return integrals_over(light_of(region, stage.light, frame, stage.side_of(place.at), place.at, 1e-9), place.shading);
}

// The visible fraction of a light by visible and occluded places, weighted by both lobes, times the unoccluded value.
class Shares {
 public:
  Shares(const ComparisonStage& stage, const LobePoint& place) : frame_(stage.frame_of(place.at)), place_(place) {}
  // True if the place counts at all, before occlusion.
  bool weigh(double x, double y) {
    for (const auto& c : frame_.contours)
      for (std::size_t i = 0, j = c.size() - 1; i < c.size(); j = i++)
        if ((c[i].x - c[j].x) * (y - c[j].y) < (c[i].y - c[j].y) * (x - c[j].x)) return false;  // the five scenes' lights are convex
    to_ = frame_.to_world({x, y, 0}) - place_.at.position;
    const double d2 = dot(to_, to_), cosine = dot(to_, place_.at.normal) / std::sqrt(d2);
    if (!(cosine > 0)) return false;
    const double area = -frame_.to_local(place_.at.position).z / (d2 * std::sqrt(d2));
    weight_ = {cosine * area, area * place_.lobe(to_ / std::sqrt(d2)).x};
    all_ = {all_.lambert + weight_.lambert, all_.ltc + weight_.ltc};
    return true;
  }
  Vec3d to() const { return to_; }
  void arrives() { arrives_ = {arrives_.lambert + weight_.lambert, arrives_.ltc + weight_.ltc}; }
  Lobes value() const {
    const auto share = [](double part, double all) { return all > 0 ? part / all : 1; };
    return {place_.open.lambert * share(arrives_.lambert, all_.lambert), place_.open.ltc * share(arrives_.ltc, all_.ltc)};
  }

 private:
  const LightFrame& frame_;
  const LobePoint& place_;
  Vec3d to_{};
  Lobes weight_, all_, arrives_;
};

// Laine's count of the same segments, at fixed places of the light. One ray tests the place with the lowest count.
Lobes by_counts(const ComparisonStage& stage, const LobePoint& place, int side) {
  thread_local SegmentSet set;
  thread_local SegmentArrays arrays;
  thread_local std::vector<std::pair<double, double>> places;
  thread_local std::vector<std::int32_t> counts;
  stage.see(place.at, set);
  arrays.assign(set);
  const SegmentView view = arrays.view();
  const LightFrame& frame = stage.frame_of(place.at);
  places.clear();
  counts.clear();
  std::int32_t least = kHidden / 2;
  std::size_t lowest = 0;
  for (int i = 0; i < side * side; ++i) {
    const double x = (2 * (i % side + 0.5) / side - 1) * frame.half_x, y = (2 * (i / side + 0.5) / side - 1) * frame.half_y;
    const double cx = x / frame.box_x * kCells, cy = y / frame.box_y * kCells;
    std::int32_t count = stage.packs.count_at(view, static_cast<float>(cx), static_cast<float>(cy));
    if (count == kUncertain)
      count = count_at(set, cx, cy);
    else {
      count += set.base;
      for (const LeftEvent& event : set.events)
        if (event.y < cy) count += event.weight;
    }
    if (count < least) {
      least = count;
      lowest = places.size();
    }
    places.emplace_back(x, y);
    counts.push_back(count);
  }
  Shares shares(stage, place);
  bool free = false;
  if (least < kHidden / 2) {
    const Vec3d to = frame.to_world({places[lowest].first, places[lowest].second, 0}) - place.at.position;
    const double height = -frame.to_local(place.at.position).z;
    free = !stage.rays.between(place.at.position, place.at.position + to * ((height - frame.eta) / height));
  }
  for (std::size_t i = 0; i < places.size(); ++i)
    if (shares.weigh(places[i].first, places[i].second) && free && counts[i] <= least) shares.arrives();
  return shares.value();
}

// The ratio estimator of Heitz, Hill and McGuire, 2018: stratified rays.
Lobes by_rays(const ComparisonStage& stage, const LobePoint& place, int side, Random& random) {
  const LightFrame& frame = stage.frame_of(place.at);
  const double height = -frame.to_local(place.at.position).z;
  Shares shares(stage, place);
  for (int i = 0; i < side * side; ++i) {
    const double u = random.uniform(), v = random.uniform();
    if (!shares.weigh((2 * (i % side + u) / side - 1) * frame.half_x, (2 * (i / side + v) / side - 1) * frame.half_y)) continue;
    if (place.at.geometric_normal && !(dot(shares.to(), *place.at.geometric_normal) > 0)) continue;
    if (!stage.rays.between(place.at.position, place.at.position + shares.to() * ((height - frame.eta) / height))) shares.arrives();
  }
  return shares.value();
}

Lobes by_clipping(const ComparisonStage& stage, const LobePoint& place, CountedTriangles facing, Degenerate degenerate, Random& random) {
  return integrals_over(clipped_light(stage.light, stage.occluders.mesh, place.at, facing, degenerate, random), place.shading);
}

// Evaluates all points once, then repeats until the time is long enough to measure. The errors are those of the first pass.
ShadowRow shadow_comparison_measure(const std::string& method, const std::vector<LobePoint>& places,
                                    const std::function<Lobes(const LobePoint&)>& value) {
  constexpr double kLongEnough = 0.1;  // seconds
  ShadowRow row;
  row.method = method;
  for (const LobePoint& place : places) {
    const Lobes v = value(place);
    const double error = (v.lambert - place.truth.lambert) / place.open.lambert, error_ltc = (v.ltc - place.truth.ltc) / place.open.ltc;
    row.rms += error * error;
    row.rms_ltc += error_ltc * error_ltc;
    row.off_by_1 += std::fabs(error) > 0.01;
  }
  const auto count = static_cast<double>(places.size());
  row.rms = std::sqrt(row.rms / count);
  row.rms_ltc = std::sqrt(row.rms_ltc / count);
  row.off_by_1 /= count;
  double best = 1e30, spent = 0;
  while (spent < kLongEnough) {
    const auto start = Clock::now();
    for (const LobePoint& place : places) value(place);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    best = std::min(best, seconds);
    spent += seconds;
  }
  row.microseconds = best / count * 1e6;
  return row;
}

double ray_time(const ComparisonStage& stage, const std::vector<LobePoint>& places) {
  constexpr int kRays = 200;
  double best = INFINITY;
  for (int repeat = 0; repeat < 5; ++repeat) {
    Random random(7);
    const auto start = Clock::now();
    for (const LobePoint& place : places) {
      const LightFrame& frame = stage.frame_of(place.at);
      for (int i = 0; i < kRays; ++i)
        stage.rays.between(place.at.position,
                           frame.to_world({random.uniform(-1, 1) * frame.half_x, random.uniform(-1, 1) * frame.half_y, -frame.eta}));
    }
    best = std::min(best, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return best / (kRays * static_cast<double>(places.size())) * 1e6;
}

// The error of the truth at the first points, against rays with cells refined along every border.
double truth_against_rays(const ComparisonStage& stage, const std::vector<LobePoint>& places) {
  constexpr std::size_t kPoints = 5;
  double squares = 0;
  for (std::size_t i = 0; i < kPoints; ++i) {
    const LobePoint& place = places[i];
    const auto cosine = [](Vec3d l) { return std::array<double, 1>{l.z}; };
    RaysIntegral<1, decltype(cosine)> rays(stage.frame_of(place.at), place.at, stage.occluders.rays, Frame::from_normal(place.at.normal),
                                           cosine);
    const double error = (place.truth.lambert - rays.run(96, 4)[0]) / place.open.lambert;
    squares += error * error;
  }
  return std::sqrt(squares / kPoints);
}

ShadowScene scene_by_all(const families::Family& family, int points, bool growing) {
  const ComparisonStage stage(family);
  const std::vector<LobePoint> places = places_in(stage, family, points);
  ShadowScene scene;
  scene.name = family.name;
  scene.triangles = stage.occluders.mesh.triangles.size();
  SegmentSet set;
  for (const LobePoint& place : places) {
    stage.see(place.at, set);
    scene.segments += static_cast<double>(set.occluders) / static_cast<double>(places.size());
  }
  if (!growing) scene.truth = truth_against_rays(stage, places);
  scene.ray_microseconds = ray_time(stage, places);
  const auto add = [&](const std::string& name, const std::function<Lobes(const LobePoint&)>& value) {
    scene.rows.push_back(shadow_comparison_measure(name, places, value));
  };
  add("pieces", [&](const LobePoint& p) { return by_pieces(stage, p); });
  // The shade's cone is open, so both sides of its triangles are visible.
  const CountedTriangles facing = family.name == "lamp shade" ? CountedTriangles::any : CountedTriangles::front;
  Random scaling(11), as_they_are(12);
  add("clipping, scaled", [&](const LobePoint& p) { return by_clipping(stage, p, facing, Degenerate::scaled, scaling); });
  if (!growing)
    add("clipping, not scaled", [&](const LobePoint& p) { return by_clipping(stage, p, facing, Degenerate::as_they_are, as_they_are); });
  for (const int side : {16, 32})
    if (side == 16 || !growing)
      add("counts, " + std::to_string(side * side), [&, side](const LobePoint& p) { return by_counts(stage, p, side); });
  for (const int side : {4, 8, 32}) {
    if (side != 8 && growing) continue;
    Random random(13);
    add("rays, " + std::to_string(side * side), [&, side](const LobePoint& p) { return by_rays(stage, p, side, random); });
  }
  return scene;
}

}  // namespace

std::vector<ShadowScene> compare_shadows(int points) {
  std::vector<ShadowScene> result;
  for (const families::Family& family : families::all())
    for (const char* name : {"box", "sphere", "12 boxes", "linked tori", "lamp shade"})
      if (family.name == name) result.push_back(scene_by_all(family, points, false));
  return result;
}

std::vector<ShadowScene> grow_shadows(int points) {
  std::vector<ShadowScene> result;
  for (const int rows : {16, 50, 158}) {
    families::Family family{"sphere", {}, families::ceiling_light()};
    family.triangles.sphere({0.1, 0.9, 0}, 0.45, 2 * rows, rows);
    result.push_back(scene_by_all(family, points, true));
  }
  return result;
}

}  // namespace steradian::studies
