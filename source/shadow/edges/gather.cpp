#include "shadow/edges/gather.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace steradian::shadow {

double Shaft::enclose(const std::vector<Vec3d>& points, const Frame& axes) {
  Box3d box;
  for (const Vec3d& p : points) box.add(axes.to_local(p));
  const Vec3d half = box.half();
  center_ = axes.to_world(box.center());
  half_[0] = axes.x * half.x;
  half_[1] = axes.y * half.y;
  half_[2] = axes.z * half.z;
  return box.low.z;
}

Shaft::Shaft(const LightFrame& frame, const std::vector<Vec3d>& points, Vec3d up, Sections sections)
    : sections_(sections), origin_(frame.origin) {
  const bool has_up = dot(up, up) > 0;
  const Frame around = has_up ? Frame::from_normal(normalized(up)) : frame.axes;
  const double lowest = enclose(points, around);
  double deep = 0;
  // Slanted sides through the light's box at z = 0: the least slopes that leave all points inside.
  double slopes[4] = {-INFINITY, -INFINITY, -INFINITY, -INFINITY};
  for (const Vec3d& p : points) {
    const Vec3d local = frame.to_local(p);
    const double below = std::max(-local.z, 1e-12), x = std::fabs(local.x), y = std::fabs(local.y);
    deep = std::max(deep, below);
    far_ = std::max({far_, x, y, below});
    const double beyond[4] = {local.x - frame.box_x, -local.x - frame.box_x, local.y - frame.box_y, -local.y - frame.box_y};
    for (int i = 0; i < 4; ++i) slopes[i] = std::max(slopes[i], beyond[i] / below);
  }
  const auto bound = [&](Vec3d normal, double offset) {
    const Vec3d n = frame.axes.to_world(normal);
    return bound_of(n, offset + dot(n, frame.origin));
  };
  const Bound plane = bound({0, 0, 1}, -frame.eta);
  // The light's box may reach lower than the points.
  const double box = dot(around.z, frame.origin) - std::fabs(dot(around.z, frame.axes.x)) * frame.box_x -
                     std::fabs(dot(around.z, frame.axes.y)) * frame.box_y;
  bounds_ = {bound({0, 0, -1}, deep),
             plane,
             bound({1, 0, slopes[0]}, frame.box_x),
             bound({-1, 0, slopes[1]}, frame.box_x),
             bound({0, 1, slopes[2]}, frame.box_y),
             bound({0, -1, slopes[3]}, frame.box_y),
             has_up ? bound_of(-around.z, -std::min(lowest, box)) : plane};
}

Shaft::Shaft(Vec3d light, double half_side, const std::vector<Vec3d>& points, Vec3d up) : sections_(Sections::anywhere), origin_(light) {
  const Vec3d half{half_side, half_side, half_side};
  Box3d all{light - half, light + half};
  for (const Vec3d& p : points) {
    all.add(p);
    far_ = std::max(far_, length(p - light));
  }
  bounds_ = {bound_of({0, 0, -1}, -all.low.z), bound_of({0, 0, 1}, all.high.z), bound_of({1, 0, 0}, all.high.x),
             bound_of({-1, 0, 0}, -all.low.x), bound_of({0, 1, 0}, all.high.y), bound_of({0, -1, 0}, -all.low.y),
             bound_of({0, 0, 1}, all.high.z)};
  const Frame around = dot(up, up) > 0 ? Frame::from_normal(normalized(up)) : Frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const double lowest = enclose(points, around), of_light = dot(around.z, light) - std::sqrt(3.0) * half_side;
  bounds_[6] = bound_of(-around.z, -std::min(lowest, of_light));
}

double Shaft::rounding(Vec3d p) const {
  const Vec3d d = p - origin_;
  return 2e-6 * (std::fabs(d.x) + std::fabs(d.y) + std::fabs(d.z) + far_) + 1e-12 * length(origin_);
}

bool Shaft::may_meet(const Box3d& box) const {
  const Vec3d c = box.center(), h = box.half();
  const double margin = rounding(c) + 2e-6 * (h.x + h.y + h.z);
  return std::none_of(bounds_.begin(), bounds_.end(), [&](const Bound& b) {
    return dot(b.normal, c) - (std::fabs(b.normal.x) * h.x + std::fabs(b.normal.y) * h.y + std::fabs(b.normal.z) * h.z) >
           b.offset + margin * b.length;
  });
}

bool Shaft::may_meet(const Vec3d* corners, int count) const {
  return std::none_of(bounds_.begin(), bounds_.end(), [&](const Bound& b) {
    return std::all_of(corners, corners + count, [&](const Vec3d& c) { return dot(b.normal, c) > b.offset + rounding(c) * b.length; });
  });
}

bool Shaft::may_meet_segment(Vec3d a, Vec3d b) const {
  double t0 = 0, t1 = 1;
  for (const Bound& bound : bounds_) {
    const double da = dot(bound.normal, a) - bound.offset - rounding(a) * bound.length,
                 db = dot(bound.normal, b) - bound.offset - rounding(b) * bound.length;
    if (da > 0 && db > 0) return false;
    if (da > 0) t0 = std::max(t0, da / (da - db));
    if (db > 0) t1 = std::min(t1, da / (da - db));
  }
  return t0 <= t1;
}

bool Shaft::needs_triangle(const EdgeMesh& mesh, std::uint32_t triangle) const {
  const auto& t = mesh.triangles[triangle];
  const Vec3d corners[3] = {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
  if (!may_meet(corners, 3)) return false;
  if (sections_ == Sections::anywhere) return true;
  // A large triangle may cross the plane far from the light.
  const Bound& plane = bounds_[1];
  Vec3d ends[3];
  int count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d a = corners[i], b = corners[(i + 1) % 3];
    const double ha = dot(plane.normal, a) - plane.offset, hb = dot(plane.normal, b) - plane.offset;
    if ((ha < 0) != (hb < 0)) ends[count++] = a + (b - a) * (ha / (ha - hb));
  }
  return count != 2 || may_meet_segment(ends[0], ends[1]);
}

ShaftView Shaft::view_from(const Frame& axes, Vec3d anchor) const {
  ShaftView view{};
  const auto put = [](float to[3], Vec3d v) {
    to[0] = static_cast<float>(v.x);
    to[1] = static_cast<float>(v.y);
    to[2] = static_cast<float>(v.z);
  };
  for (std::size_t i = 0; i < kShaftSides; ++i) {
    put(view.normal[i], axes.to_local(bounds_[i].normal));
    const double offset = bounds_[i].offset - dot(bounds_[i].normal, anchor);
    view.offset[i] = static_cast<float>(offset + 1e-6 * std::fabs(offset));
  }
  put(view.middle, axes.to_local(center_ - anchor));
  for (int i = 0; i < 3; ++i) put(view.half[i], axes.to_local(half_[i]) * (1 + 1e-6));
  view.reach = static_cast<float>(length(origin_ - anchor) + 2 * far_);
  return view;
}

EdgeTree::EdgeTree(const EdgeMesh& mesh) {
  const auto count = static_cast<std::uint32_t>(mesh.edges.size());
  if (count == 0) return;
  Box3d all;
  for (const MeshEdge& e : mesh.edges)
    for (const std::uint32_t v : {e.v0, e.v1}) all.add(mesh.vertices[v]);
  middle_ = all.center();
  for (std::uint32_t begin = 0; begin < count; begin += kLeafEdges)
    leaves_.push_back(leaf_of(mesh, begin, std::min(begin + kLeafEdges, count)));
  const auto box_of = [&](std::uint32_t leaf) {
    Box3f box;
    for (int i = 0; i < std::popcount(leaves_[leaf].valid); ++i)
      for (const auto& end : {leaves_[leaf].a, leaves_[leaf].b}) box.add(Vec3f{end[0][i], end[1][i], end[2][i]});
    return box;
  };
  // The leaves stay in their order.
  tree_ = BoxTree<Box3f>(leaves_.size(), box_of, [](auto leaves) { return leaves.size() > 1 ? (leaves.size() + 1) / 2 : 0; });
}

EdgeLeaf EdgeTree::leaf_of(const EdgeMesh& mesh, std::uint32_t begin, std::uint32_t end) const {
  static_assert(kLeafEdges == kPadding);
  EdgeLeaf leaf{};
  const auto put = [](float to[3][kPadding], std::size_t i, Vec3d v) {
    to[0][i] = static_cast<float>(v.x);
    to[1][i] = static_cast<float>(v.y);
    to[2][i] = static_cast<float>(v.z);
  };
  for (std::uint32_t number = begin; number < end; ++number) {
    const MeshEdge& e = mesh.edges[number];
    const std::size_t i = number - begin;
    leaf.valid |= 1u << i;
    put(leaf.a, i, mesh.vertices[e.v0] - middle_);
    put(leaf.b, i, mesh.vertices[e.v1] - middle_);
    // Not all triangles of an edge at a body block every light.
    const bool many = e.count > 2 || e.at_body;
    if (many) leaf.many |= 1u << i;
    for (std::uint32_t k = 0; k < e.count && !many; ++k) {
      const EdgeTriangle& t = mesh.edge_triangles[e.first + k];
      const Plane& plane = mesh.planes[t.triangle];
      // Normals have unit length here: those of small triangles would leave the range of floats.
      const double size = length(plane.normal), scale = size > 0 ? 1 / size : 0;
      put(k == 0 ? leaf.normal0 : leaf.normal1, i, plane.normal * scale);
      (k == 0 ? leaf.offset0 : leaf.offset1)[i] = static_cast<float>((plane.offset - dot(plane.normal, middle_)) * scale);
      (k == 0 ? leaf.walks0 : leaf.walks1)[i] = static_cast<float>(t.walks);
    }
  }
  return leaf;
}

void EdgeTree::gather(const ShadowTable& packs, const Shaft& shaft, std::vector<std::uint32_t>& edges) const {
  edges.clear();
  const ShaftView view = shaft.view_from({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, middle_);
  // The margins are those of edges, for the whole box.
  const auto meets = [&view](const BoxTree<Box3f>::Node& node) {
    const Vec3f c = node.volume.center(), h = node.volume.half();
    const float margin = 4e-6f * (std::fabs(c.x) + std::fabs(c.y) + std::fabs(c.z) + h.x + h.y + h.z + view.reach);
    for (std::size_t s = 0; s < kShaftSides; ++s) {
      const float* n = view.normal[s];
      const float x = std::fabs(n[0]), y = std::fabs(n[1]), z = std::fabs(n[2]);
      if (n[0] * c.x + n[1] * c.y + n[2] * c.z - (x * h.x + y * h.y + z * h.z) > view.offset[s] + margin * (x + y + z)) return false;
    }
    return true;
  };
  tree_.any_leaf(meets, [&](std::uint32_t leaf, std::uint32_t) {
    for (std::uint32_t bits = packs.needed(leaves_[leaf], view); bits != 0; bits &= bits - 1)
      edges.push_back(leaf * kLeafEdges + static_cast<std::uint32_t>(std::countr_zero(bits)));
    return false;
  });
}

}  // namespace steradian::shadow
