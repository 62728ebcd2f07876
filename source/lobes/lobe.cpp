#include "lobes/lobe.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace steradian::lobes {
namespace {

constexpr std::size_t kKinds = std::variant_size_v<Lobe::Kind> - 1;  // with a name; Fitted has none
template <std::size_t I>
using KindAt = std::variant_alternative_t<I, Lobe::Kind>;

// The kinds must be listed in the order of their enumerators.
template <std::size_t... I>
constexpr bool in_order(std::index_sequence<I...>) {
  return ((static_cast<std::size_t>(KindAt<I>::kBrdf) == I) && ...);
}
static_assert(in_order(std::make_index_sequence<kKinds>()));

template <std::size_t... I>
Lobe::Kind seen(const Material& material, Vec3d view, std::index_sequence<I...>) {
  using Make = Lobe::Kind (*)(const Material&, Vec3d);
  static constexpr Make kMake[] = {[](const Material& m, Vec3d v) { return Lobe::Kind(std::in_place_index<I>, m, v); }...};
  return kMake[static_cast<std::size_t>(material.brdf)](material, view);
}

template <std::size_t... I>
std::span<const LobeRow> rows(std::index_sequence<I...>) {
  static constexpr LobeRow kRows[] = {{KindAt<I>::kName, KindAt<I>::kBrdf, KindAt<I>::kKeys}...};
  return kRows;
}

template <std::size_t... I>
LobeAxis axis_and_width(const Material& material, const ShadingPoint& at, std::index_sequence<I...>) {
  using Axis = LobeAxis (*)(const Material&, const ShadingPoint&);
  static constexpr Axis kAxis[] = {&KindAt<I>::axis_and_width...};
  return kAxis[static_cast<std::size_t>(material.brdf)](material, at);
}

bool is_fitted(const Material& material) { return material.brdf == Brdf::ggx && material.fitted != nullptr; }

double largest_component(Vec3d v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }

}  // namespace

Lobe::Lobe(const Material& material, Vec3d view)
    : kind_(is_fitted(material) ? Kind(std::in_place_type<Fitted>, material, view)
                                : seen(material, view, std::make_index_sequence<kKinds>())),
      view_(view),
      colours_(std::visit([](const auto& kind) { return kind.colours; }, kind_)) {}

LobeValue Lobe::evaluate(Vec3d l) const {
  if (!(l.z > 0) || !above_surface()) return {};
  return std::visit([&](const auto& kind) { return kind.evaluate(l); }, kind_);
}

Vec3d Lobe::sample(double u, double v) const {
  return std::visit([&](const auto& kind) { return kind.sample(u, v); }, kind_);
}

double Lobe::pdf(Vec3d l) const {
  return std::visit([&](const auto& kind) { return kind.pdf(l); }, kind_);
}

LobeValue Lobe::largest_factors() const { return {largest_component(colours_.plain), largest_component(colours_.fresnel)}; }

LobeShape Lobe::shape() const {
  return std::visit([](const auto& kind) { return kind.shape(); }, kind_);
}

double Lobe::sensitivity() const {
  return std::visit([](const auto& kind) { return kind.sensitivity(); }, kind_);
}

std::array<Vec3d, 2> Lobe::ending_planes() const {
  return std::visit([](const auto& kind) { return kind.ending_planes(); }, kind_);
}

Material in_frame(const Material& material, const Frame& frame) {
  Material local = material;
  local.tangent = frame.to_local(material.tangent);
  local.axis = frame.to_local(material.axis);
  for (AxisPower& f : local.factors) f.axis = frame.to_local(f.axis);
  return local;
}

std::span<const LobeRow> lobe_rows() { return rows(std::make_index_sequence<kKinds>()); }
const LobeRow& row_of(Brdf brdf) { return lobe_rows()[static_cast<std::size_t>(brdf)]; }

std::optional<WidthProblem> check_width(const Draft& d) {
  if (!has_key(row_of(d.material.brdf).keys, "alpha")) return {};
  if (d.alpha_x != d.alpha_y) return WidthProblem{d.alpha_x ? "alpha_y" : "alpha_x", "missing", {}};
  const int ways = d.roughness + d.alpha + d.alpha_x;
  const bool anisotropic = has_key(row_of(d.material.brdf).keys, "alpha_x");
  if (ways == 0) return WidthProblem{"alpha", "missing", anisotropic ? "or give roughness, or alpha_x and alpha_y" : "or give roughness"};
  if (ways > 1)
    return WidthProblem{"alpha", "the width is given twice",
                        anisotropic ? "one of: roughness; alpha; alpha_x and alpha_y" : "one of: roughness; alpha"};
  return {};
}

}  // namespace steradian::lobes

namespace steradian {

const char* name_of(Brdf brdf) { return lobes::row_of(brdf).name; }

LobeAxis lobe_axis(const Material& material, const ShadingPoint& at) {
  if (lobes::is_fitted(material)) return lobes::Fitted::axis_and_width(material, at);
  return lobes::axis_and_width(material, at, std::make_index_sequence<lobes::kKinds>());
}

}  // namespace steradian
