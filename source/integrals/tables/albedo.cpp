#include "steradian/albedo.h"

#include <algorithm>
#include <cmath>

#include "integrals/tables/ggx_tables.h"
#include "lobes/lobe.h"
#include "steradian/kernels.h"

namespace steradian {
namespace {

constexpr double kGrazing = 0.02;  // cosine of the view below which samples of the lobe carry no information

double table_albedo(const CompactTable& table, double roughness, double cosine) {
  const LtcValue value = table.look_up(roughness, cosine);
  return std::clamp(value.n_a * ltc_above_horizon(value.inverse), 0.0, 1.0);
}

// A Fibonacci lattice, mapped to half vectors that are visible from the view: the remaining ratio of the lobe is smooth.
double anisotropic_albedo(const Material& material, const ShadingPoint& at) {
  constexpr int kNodes = 128;
  const Frame frame = Frame::from_normal_and_tangent(at.normal, material.tangent);
  const Vec3d view = frame.to_local(at.view);
  const lobes::Lobe lobe(material, normalized(Vec3d{view.x, view.y, std::max(view.z, kGrazing)}));
  double sum = 0;
  for (int i = 0; i < kNodes; ++i) {
    const double b = i * 0.6180339887498949;
    const Vec3d l = lobe.sample(b - std::floor(b), (i + 0.5) / kNodes);
    const double pdf = lobe.pdf(l);
    if (l.z > 0 && pdf > 0) sum += lobe.evaluate(l).plain / pdf;
  }
  return std::clamp(sum / kNodes, 0.0, 1.0);
}

}  // namespace

double ggx_albedo(const Material& material, const ShadingPoint& at) {
  Material plain = material;
  plain.multiple_scattering = false;
  const ShadingPoint unit = {at.position, normalized(at.normal), normalized(at.view)};
  if (material.alpha_x != material.alpha_y || !material.shadowing) return anisotropic_albedo(plain, unit);
  return table_albedo(ggx_compact_table(), std::sqrt(material.alpha_x), dot(unit.normal, unit.view));
}

double charlie_albedo(double alpha, double cosine) { return table_albedo(charlie_compact_table(), std::sqrt(alpha), cosine); }

Material with_multiple_scattering(const Material& material, const ShadingPoint& at) {
  if (!material.multiple_scattering || material.brdf != Brdf::ggx) return material;
  Kernels<double> k;
  const double albedo = ggx_albedo(material, at);
  const auto factor = [&](double f0) { return k.ltc_multiple_scattering(f0, albedo).v; };
  const Vec3d grown = {factor(material.f0.x), factor(material.f0.y), factor(material.f0.z)};
  Material result = material;
  result.f0 = material.f0 * grown;
  result.f90 = material.f90 * grown;
  result.multiple_scattering = false;
  return result;
}

}  // namespace steradian
