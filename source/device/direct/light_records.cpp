#include "device/direct/light_records.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "integrals/textured/textured_light.h"

namespace steradian::vulkan {
namespace {

#include "shaders/layout.glsl"

using Record = std::array<Vec4Floats, static_cast<std::size_t>(kRecord)>;

Vec4Floats with(Vec3f v, float w = 0) { return {v.x, v.y, v.z, w}; }

struct RecordWriter {
  Record& r;
  LightRecord& light;
  std::vector<Vec4Floats>& vertices;

  void operator()(const packed::FloatPolygon& p) const {
    light.kind = kPolygon;
    const std::size_t first = vertices.size();
    for (std::size_t c = 0; c + 1 < p.contours.size(); ++c) {
      if (p.contours[c] == p.contours[c + 1]) continue;
      vertices.push_back(with(p.vertices[p.contours[c + 1] - 1], 0));
      for (std::size_t i = p.contours[c]; i < p.contours[c + 1]; ++i) vertices.push_back(with(p.vertices[i], 1));
    }
    // An arc in two parts closes each pair of crossings, and there is one more at the end.
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
  void operator()(const packed::FloatDisk& d) const {
    light.kind = kDisk;
    light.middle = d.point;
    light.deviation2 = (dot(d.x, d.x) + dot(d.y, d.y)) / 4;
    light.near_distance2 = 2.25f * (dot(d.x, d.x) + dot(d.y, d.y));  // kernels/outline/ellipse.glsl, ellipse_fan_near
    r[1] = with(d.normal, d.two_sided ? 1 : 0);
    r[2] = with(d.point);
    r[3] = with(d.x);
    r[4] = with(d.y);
  }
  void operator()(const packed::FloatEllipsoid& e) const {
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
  void operator()(const packed::FloatCapsule& c) const {
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
  std::visit(RecordWriter{r, record, vertices}, light.shape);
  record.textured = light.textured != nullptr;
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

namespace {

constexpr std::size_t kHead = static_cast<std::size_t>(kTextureHead), kLevel = static_cast<std::size_t>(kTextureLevel),
                      kCell = static_cast<std::size_t>(kTextureCell);
constexpr std::size_t kMostNumbers = std::size_t{1} << 24;  // largest count that a float holds

float number(double x) { return static_cast<float>(x); }
float number(std::size_t n) { return static_cast<float>(n); }
Vec4Floats vector_with(Vec3d v, double w) { return {number(v.x), number(v.y), number(v.z), number(w)}; }

std::size_t texels_of(const FilteredTexture& texture) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < texture.level_count(); ++k) count += texture.level(k).texels.size();
  return count;
}

std::size_t vectors_of(const TexturedLight& light) {
  const FilteredTexture& texture = light.texture();
  return kHead + kLevel * texture.level_count() + texels_of(texture) + kCell * light.tree().cells().size();
}

void add_cells(const std::vector<TextureCell>& cells, std::vector<Vec4Floats>& to) {
  // Successor of a cell and its subtree: for a first child the second one, for a second child its parent's successor.
  std::vector<double> next(cells.size(), -1);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].children == 0) continue;
    const auto child = static_cast<std::size_t>(cells[i].children);
    next[child] = static_cast<double>(child + 1);
    next[child + 1] = next[i];
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const TextureCell& c = cells[i];
    to.insert(to.end(), {Vec4Floats{number(c.center[0]), number(c.center[1]), number(c.axis_a[0]), number(c.axis_a[1])},
                         Vec4Floats{number(c.axis_b[0]), number(c.axis_b[1]), number(c.area), number(c.radius)},
                         vector_with(c.mean, c.deviation), vector_with(c.along_a, c.children), vector_with(c.along_b, next[i])});
  }
}

void add_texture(const TexturedLight& light, std::vector<Vec4Floats>& to) {
  const FilteredTexture& texture = light.texture();
  const TextureTree& tree = light.tree();
  const std::size_t first_texel = to.size() + kHead + kLevel * texture.level_count(), first_cell = first_texel + texels_of(texture);
  const auto [left, right, bottom, top] = tree.bounds();
  to.insert(
      to.end(),
      {vector_with(texture.origin(), tree.finest()), vector_with(texture.axis_x(), static_cast<double>(texture.level_count())),
       vector_with(texture.axis_y(), static_cast<double>(first_cell)), Vec4Floats{number(left), number(right), number(bottom), number(top)},
       vector_with(static_cast<Vec3d>(texture.mean()), 0), vector_with({texture.centroid()[0], texture.centroid()[1], 0}, 0),
       vector_with({texture.covariance()[0], texture.covariance()[1], texture.covariance()[2]}, 0)});
  std::size_t texel = first_texel;
  for (std::size_t k = 0; k < texture.level_count(); ++k) {
    const PlaneTexels level = texture.level(k);
    to.push_back({number(level.left), number(level.bottom), number(level.spacing), number(texture.sigma(k))});
    to.push_back({static_cast<float>(level.width), static_cast<float>(level.height), number(texel), 0});
    texel += level.texels.size();
  }
  for (std::size_t k = 0; k < texture.level_count(); ++k) {
    const auto& texels = texture.level(k).texels;
    to.insert(to.end(), texels.begin(), texels.end());
  }
  add_cells(tree.cells(), to);
}

// A head, then all numbers of the profile, four per vector.
std::size_t vectors_of(const LightProfile& profile) {
  return 1 + (profile.vertical.size() + profile.horizontal.size() + profile.candela.size() + 3) / 4;
}

void add_profile(const LightProfile& profile, std::vector<Vec4Floats>& to) {
  to.push_back(
      {profile.type == LightProfile::Type::b ? 1.0f : 0.0f, number(profile.vertical.size()), number(profile.horizontal.size()), 0});
  std::size_t k = 0;
  for (const std::vector<double>* numbers : {&profile.vertical, &profile.horizontal, &profile.candela})
    for (const double x : *numbers) {
      if (k % 4 == 0) to.emplace_back();
      to.back()[k++ % 4] = number(x);
    }
}

const LightProfile* profile_of(const PackLight& light) {
  const auto* punctual = std::get_if<packed::Punctual>(&light.shape);
  return punctual != nullptr ? punctual->profile : nullptr;
}

const void* key_of(const PackLight& light) {
  return light.textured != nullptr ? static_cast<const void*>(light.textured.get()) : profile_of(light);
}

}  // namespace

LightDetails::LightDetails(const std::vector<PackLight>& lights, std::size_t most_vectors) {
  most_vectors = std::min(most_vectors, kMostNumbers);
  for (const PackLight& light : lights) {
    const void* key = key_of(light);
    if (key == nullptr || firsts_.contains(key)) continue;
    const LightProfile* profile = profile_of(light);
    if (values_.size() + (profile != nullptr ? vectors_of(*profile) : vectors_of(*light.textured)) > most_vectors) continue;
    firsts_[key] = values_.size();
    if (profile != nullptr)
      add_profile(*profile, values_);
    else
      add_texture(*light.textured, values_);
  }
}

bool LightDetails::has(const PackLight& light) const {
  if (light.profiled != nullptr) return false;
  const void* key = key_of(light);
  return key == nullptr || firsts_.contains(key);
}

std::ptrdiff_t LightDetails::first_of(const PackLight& light) const {
  const auto at = firsts_.find(key_of(light));
  return at == firsts_.end() ? kNoDetails : static_cast<std::ptrdiff_t>(at->second);
}

}  // namespace steradian::vulkan
