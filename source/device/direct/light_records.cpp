#include "device/direct/light_records.h"

#include <cmath>

#include "integrals/textured/profiled_light.h"

namespace steradian::vulkan {
namespace {

#include "shaders/layout.glsl"

using Record = std::array<Vec4Floats, static_cast<std::size_t>(kRecord)>;

Vec4Floats with(Vec3f v, float w = 0) { return {v.x, v.y, v.z, w}; }

struct Writer {
  Record& r;
  LightRecord& light;
  std::vector<Vec4Floats>& vertices;

  void operator()(const packed::Polygon& p) const {
    light.kind = kPolygon;
    const std::size_t first = vertices.size();
    for (std::size_t c = 0; c + 1 < p.contours.size(); ++c) {
      if (p.contours[c] == p.contours[c + 1]) continue;
      vertices.push_back(with(p.vertices[p.contours[c + 1] - 1], 0));
      for (std::size_t i = p.contours[c]; i < p.contours[c + 1]; ++i) vertices.push_back(with(p.vertices[i], 1));
    }
    // An arc in two parts closes each pair of crossings, and there is one more at the end.
    light.edges = 2 * static_cast<int>(p.vertices.size()) + 2;
    light.middle = p.middle;
    light.deviation2 = p.deviation2;
    r[0][3] = static_cast<float>(first);
    r[1] = with(p.normal, p.two_sided ? 1 : 0);
    r[2] = with(p.point, static_cast<float>(vertices.size() - first));
    r[3] = with(p.middle, p.deviation2);
    r[4] = with(p.reach_a);
    r[5] = with(p.reach_b);
    r[6] = with(p.area);
  }
  void operator()(const packed::Disk& d) const {
    light.kind = kDisk;
    light.middle = d.point;
    light.deviation2 = (dot(d.x, d.x) + dot(d.y, d.y)) / 4;
    light.near_distance2 = 2.25f * (dot(d.x, d.x) + dot(d.y, d.y));  // kernels/outline/ellipse.glsl, ellipse_fan_near
    r[1] = with(d.normal, d.two_sided ? 1 : 0);
    r[2] = with(d.point);
    r[3] = with(d.x);
    r[4] = with(d.y);
  }
  void operator()(const packed::Ellipsoid& e) const {
    light.kind = kEllipsoid;
    light.ball = e.ball.radius > 0;
    light.middle = e.center;
    light.deviation2 = dot(e.x, e.x) + dot(e.y, e.y) + dot(e.z, e.z);
    // Like that of a disk, for the outline that the point sees. For a ball, this solves D^2 - r^2 < 4.5 r^2. Centres of other outlines lie
    // within the light. Their half axes are no longer than all half axes of the light together.
    const float reach = std::sqrt(light.deviation2), far = (1 + 1.5f * std::sqrt(2.0f)) * reach;
    light.near_distance2 = light.ball ? 5.51f * e.ball.radius * e.ball.radius : far * far;
    r[2] = with(e.center, e.ball.radius);
    r[3] = with(e.x);
    r[4] = with(e.y);
    r[5] = with(e.z);
    r[6] = with(e.inverse_x);
    r[7] = with(e.inverse_y);
    r[8] = with(e.inverse_z);
  }
  void operator()(const packed::Capsule& c) const {
    light.kind = kCapsule;
    light.middle = (c.end_a + c.end_b) * 0.5f;
    light.deviation2 = dot(c.half_axis, c.half_axis) + c.radius * c.radius;
    r[2] = with(c.end_a, c.radius);
    r[3] = with(c.end_b);
    r[4] = with(c.half_axis);
  }
  void operator()(const packed::Punctual& p) const {
    light.kind = kPunctual;
    r[1][3] = p.kind == PunctualKind::directional ? 1 : 0;
    r[2] = with(static_cast<Vec3f>(p.position), static_cast<float>(p.inverse_range2));
    r[3] = with(static_cast<Vec3f>(p.direction), static_cast<float>(p.spot_scale));
    r[4][3] = static_cast<float>(p.spot_offset);
    r[5] = with(static_cast<Vec3f>(p.axes.x));
    r[6] = with(static_cast<Vec3f>(p.axes.y));
    r[7] = with(static_cast<Vec3f>(p.axes.aim));
  }
  void operator()(const packed::Pieces&) const {}  // only in the CPU's shadows
};

}  // namespace

std::uint32_t LightRecords::add(const PackLight& light, std::ptrdiff_t details) {
  Record r{};
  LightRecord record;
  r[0] = with(light.radiance);
  std::visit(Writer{r, record, vertices}, light.shape);
  record.mean = light.textured != nullptr ? kTextureMean : light.profiled != nullptr ? kProfileMean : 0;
  if (light.profiled != nullptr) {
    const LightEmission& emission = light.profiled->emission();
    r[8] = with(static_cast<Vec3f>(emission.intensity * (1 / emission.area)));
  }
  record.profiled = record.kind == kPunctual && details != kNoDetails;
  if (details != kNoDetails) r[kWhereDetails][3] = static_cast<float>(details);
  lights.push_back(record);
  values.insert(values.end(), r.begin(), r.end());
  return static_cast<std::uint32_t>(lights.size() - 1);
}

void LightRecords::keep(std::size_t light_count, std::size_t vertex_count) {
  lights.resize(light_count);
  values.resize(light_count * static_cast<std::size_t>(kRecord));
  vertices.resize(vertex_count);
}

}  // namespace steradian::vulkan
