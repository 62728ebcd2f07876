#include "shadow/edges/bodies.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "core/box_tree.h"
#include "shapes/triangulate.h"

namespace steradian::shadow {
namespace {

// A cut this near to an edge's end, as a fraction of the edge, is the end.
constexpr double kEnd = 1e-9;
// New triangles at most. Lights beyond them find triangles whole: what is inside such a light blocks it.
constexpr std::size_t kMostParts = 200'000;

class Cutter {
 public:
  Cutter(EdgeMesh& mesh, const Body& body, std::vector<std::uint32_t>& inside, std::vector<std::vector<std::uint32_t>>& of_others)
      : mesh_(mesh), body_(body), inside_(inside), of_others_(of_others) {}

  // Cuts a triangle, if it enters the body; the numbers of new triangles are appended to `added`.
  void cut(std::uint32_t t, std::vector<std::uint32_t>& added) {
    if (!box_of(mesh_, t).meets(body_.box())) return;
    const std::size_t before = mesh_.triangles.size();
    cut(t);
    for (std::size_t i = before; i < mesh_.triangles.size(); ++i) added.push_back(static_cast<std::uint32_t>(i));
  }

 private:
  using Loop = std::vector<std::uint32_t>;

  std::uint32_t add_vertex(Vec3d p) {
    mesh_.vertices.push_back(p);
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }

  // The vertices where the edge crosses the surface, from v0 to v1, v0 < v1. Both triangles of the edge get the same.
  const Loop& crossings(std::uint32_t v0, std::uint32_t v1) {
    const auto [place, is_new] = crossings_.try_emplace({v0, v1});
    if (!is_new) return place->second;
    const Vec3d a = mesh_.vertices[v0], along = mesh_.vertices[v1] - a;
    const std::optional<Body::Span> span = body_.span(a, along);
    if (!span) return place->second;
    const auto is_within = [](double t) { return t > kEnd && t < 1 - kEnd; };
    const bool enters = is_within(span->enters), leaves = is_within(span->leaves);
    if (enters && leaves && span->leaves - span->enters < kEnd) return place->second;
    if (enters) place->second.push_back(add_vertex(a + along * span->enters));
    if (leaves) place->second.push_back(add_vertex(a + along * span->leaves));
    return place->second;
  }

  // The outline of a triangle with all crossings.
  Loop outline_of(const std::array<std::uint32_t, 3>& corners) {
    Loop loop;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t from = corners[c], to = corners[(c + 1) % 3];
      loop.push_back(from);
      const Loop& cuts = crossings(std::min(from, to), std::max(from, to));
      if (from < to)
        loop.insert(loop.end(), cuts.begin(), cuts.end());
      else
        loop.insert(loop.end(), cuts.rbegin(), cuts.rend());
    }
    return loop;
  }

  // Coordinates in the plane of a triangle, counter-clockwise from its front.
  struct Flat {
    int x, y;
    explicit Flat(Vec3d normal) {
      const int axis = longest_axis(Vec3d{std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)});
      x = (axis + 1) % 3;
      y = (axis + 2) % 3;
      if (coordinate(normal, axis) < 0) std::swap(x, y);
    }
    Vec2d operator()(Vec3d v) const { return {coordinate(v, x), coordinate(v, y)}; }
  };

  void cut(std::uint32_t t) {
    const std::array<std::uint32_t, 3> corners = mesh_.triangles[t];
    const Plane plane = mesh_.planes[t];
    const Loop outline = outline_of(corners);
    const auto is_inside = [&](std::size_t i) {  // the piece of the outline that begins there
      return body_.contains((mesh_.vertices[outline[i]] + mesh_.vertices[outline[(i + 1) % outline.size()]]) * 0.5);
    };
    std::vector<bool> piece_inside(outline.size());
    for (std::size_t i = 0; i < outline.size(); ++i) piece_inside[i] = is_inside(i);
    if (std::all_of(piece_inside.begin(), piece_inside.end(), [](bool b) { return b; })) {
      inside_.push_back(t);
      return;
    }
    if (!(dot(plane.normal, plane.normal) > 0)) return;

    // The corners of the part inside: those of the outline, and those of the section that lie in the triangle.
    const Flat flat(plane.normal);
    Vec2d triangle[3];
    for (std::size_t c = 0; c < 3; ++c) triangle[c] = flat(mesh_.vertices[corners[c]]);
    Loop part;
    for (std::size_t i = 0; i < outline.size(); ++i)
      if (piece_inside[i] || piece_inside[(i + outline.size() - 1) % outline.size()]) part.push_back(outline[i]);
    const std::size_t on_outline = part.size();
    for (const Vec3d& p : body_.section(plane.normal, plane.offset)) {
      const Vec2d q = flat(p);
      const auto is_left = [&](std::size_t c) { return cross(triangle[(c + 1) % 3] - triangle[c], q - triangle[c]) > 0; };
      if (is_left(0) && is_left(1) && is_left(2)) part.push_back(add_vertex(p));
    }
    if (part.size() < 3) return;
    Vec2d middle{};
    for (const std::uint32_t v : part) middle = middle + flat(mesh_.vertices[v]) * (1.0 / static_cast<double>(part.size()));
    std::vector<std::pair<double, std::uint32_t>> around;
    for (const std::uint32_t v : part) {
      const Vec2d d = flat(mesh_.vertices[v]) - middle;
      around.push_back({std::atan2(d.y, d.x), v});
    }
    std::sort(around.begin(), around.end());
    for (std::size_t i = 0; i < part.size(); ++i) part[i] = around[i].second;

    // The parts outside. Each runs along the outline while that is outside, and back along the part inside.
    std::vector<std::vector<Loop>> outside;
    if (on_outline == 0) {
      outside.push_back({{corners.begin(), corners.end()}, {part.rbegin(), part.rend()}});
    } else {
      for (std::size_t i = 0; i < outline.size(); ++i) {
        if (piece_inside[i] || !piece_inside[(i + outline.size() - 1) % outline.size()]) continue;
        Loop loop;
        std::size_t k = i;
        for (; !piece_inside[k % outline.size()]; ++k) loop.push_back(outline[k % outline.size()]);
        const std::uint32_t first = loop.front(), last = outline[k % outline.size()];
        loop.push_back(last);
        Loop back;
        const auto begin = static_cast<std::size_t>(std::find(part.begin(), part.end(), first) - part.begin());
        for (std::size_t j = begin + 1; j < begin + part.size() && part[j % part.size()] != last; ++j)
          back.push_back(part[j % part.size()]);
        loop.insert(loop.end(), back.rbegin(), back.rend());
        outside.push_back({std::move(loop)});
      }
    }
    std::vector<std::array<std::uint32_t, 3>> out, in;
    for (const std::vector<Loop>& loops : outside)
      if (!triangulate(loops, flat, out)) return;
    if (!triangulate({part}, flat, in)) return;
    replace(t, out, in);
  }

  bool triangulate(const std::vector<Loop>& loops, const Flat& flat, std::vector<std::array<std::uint32_t, 3>>& to) const {
    Contours contours;
    Loop all;
    for (const Loop& loop : loops) {
      contours.emplace_back();
      for (const std::uint32_t v : loop) contours.back().push_back(flat(mesh_.vertices[v]));
      all.insert(all.end(), loop.begin(), loop.end());
    }
    const auto triangles = triangles_of(contours);
    if (!triangles) return false;
    for (const auto& c : *triangles) to.push_back({all[c[0]], all[c[1]], all[c[2]]});
    return true;
  }

  // Puts the parts in place of the triangle.
  void replace(std::uint32_t t, const std::vector<std::array<std::uint32_t, 3>>& out, const std::vector<std::array<std::uint32_t, 3>>& in) {
    const Plane plane = mesh_.planes[t];
    bool first = true;
    const auto put = [&](const std::array<std::uint32_t, 3>& corners) {
      std::uint32_t number = t;
      if (first) {
        mesh_.triangles[t] = corners;
      } else {
        number = static_cast<std::uint32_t>(mesh_.triangles.size());
        mesh_.triangles.push_back(corners);
        mesh_.planes.push_back(plane);
        for (auto& list : of_others_)
          if (&list != &inside_ && std::find(list.begin(), list.end(), t) != list.end()) list.push_back(number);
      }
      first = false;
      return number;
    };
    for (const auto& corners : out) put(corners);
    for (const auto& corners : in) inside_.push_back(put(corners));
  }

  EdgeMesh& mesh_;
  const Body& body_;
  std::vector<std::uint32_t>& inside_;
  std::vector<std::vector<std::uint32_t>>& of_others_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Loop> crossings_;
};

}  // namespace

void cut_by_bodies(EdgeMesh& mesh, std::span<const Body> bodies) {
  mesh.inside.assign(bodies.size(), {});
  if (bodies.empty()) return;
  const std::size_t most = mesh.triangles.size() + kMostParts;
  const BoxTree<Box3d> tree(
      mesh.triangles.size(), [&](std::uint32_t t) { return box_of(mesh, t); }, Halving{4});
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> parts;  // of the triangles that have been cut
  for (std::size_t b = 0; b < bodies.size() && mesh.triangles.size() < most; ++b) {
    std::vector<std::uint32_t> near = near_box(tree, bodies[b].box());
    std::sort(near.begin(), near.end());
    Cutter cutter(mesh, bodies[b], mesh.inside[b], mesh.inside);
    for (const std::uint32_t t : near) {
      const auto before = parts.find(t);
      std::vector<std::uint32_t> all{t}, added;
      if (before != parts.end()) all.insert(all.end(), before->second.begin(), before->second.end());
      for (const std::uint32_t part : all) cutter.cut(part, added);
      if (added.empty()) continue;
      std::vector<std::uint32_t>& list = parts[t];
      list.insert(list.end(), added.begin(), added.end());
    }
  }
  for (std::vector<std::uint32_t>& list : mesh.inside) std::sort(list.begin(), list.end());
}

bool may_enter(const EdgeMesh& mesh, std::span<const Body> bodies) {
  return std::any_of(bodies.begin(), bodies.end(), [&](const Body& body) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      if (box_of(mesh, t).meets(body.box())) return true;
    return false;
  });
}

}  // namespace steradian::shadow
