#include <map>
#include <tuple>

#include "bake/charts/welded.h"
#include "bake/fit_space.h"

namespace steradian::bake {
namespace {

constexpr std::uint32_t kNoUnknown = UINT32_MAX;

}  // namespace

VertexSpace::VertexSpace(const Mesh& mesh, const std::vector<Chart>& charts, const std::vector<std::uint32_t>& group, CornerLight& light)
    : mesh_(mesh), light_(light), unknowns_(mesh.indices.size(), kNoUnknown) {
  WeldedPoints positions, normals;
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> numbers;
  for (const std::uint32_t c : group)
    for (const ChartTriangle& t : charts[c].triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t corner = 3 * std::size_t{t.triangle} + k;
        const std::uint32_t vertex = mesh.indices[corner], part = charts[c].cut_from == Chart::kWhole ? Chart::kWhole : c;
        const auto [it, fresh] =
            numbers.try_emplace({positions.number_of(mesh.positions[vertex]), normals.number_of(mesh.normals[vertex]), part},
                                static_cast<std::uint32_t>(count_));
        count_ += fresh;
        unknowns_[corner] = it->second;
      }
}

std::array<Hat, 4> VertexSpace::at(std::uint32_t, const Sample& sample) const {
  const std::uint32_t* of = unknowns_.data() + 3 * std::size_t{sample.triangle};
  const double u = static_cast<double>(sample.u), v = static_cast<double>(sample.v);
  return {{{of[0], 1 - u - v}, {of[1], u}, {of[2], v}, {of[0], 0}}};
}

void VertexSpace::add_conditions(HatFit& fit) const {
  for (std::uint32_t t = 0; t < mesh_.triangle_count(); ++t) {
    const std::uint32_t* of = unknowns_.data() + 3 * std::size_t{t};
    if (of[0] == kNoUnknown) continue;
    const double area = length(across(mesh_, t)) / 2;
    for (std::size_t k = 0; k < 3; ++k) {
      const Hat pair[2] = {{of[k], 1}, {of[(k + 1) % 3], -1}};
      fit.add_zero(pair, kSmooth * area);
    }
  }
}

void VertexSpace::store(const std::vector<Vec3d>& values, const std::vector<Vec3d>& errors) const {
  light_.irradiance.resize(unknowns_.size());
  light_.error.resize(unknowns_.size());
  for (std::size_t i = 0; i < unknowns_.size(); ++i)
    if (unknowns_[i] != kNoUnknown) {
      light_.irradiance[i] = static_cast<Vec3f>(values[unknowns_[i]]);
      light_.error[i] = static_cast<Vec3f>(errors[unknowns_[i]]);
    }
}

}  // namespace steradian::bake
