// Adaptive cubature of a lobe over a fan of triangles: tensor products of Gauss-Kronrod rules, one queue for all.
#include "steradian/reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "lobes/lobe.h"
#include "reference/fan.h"
#include "reference/gauss_kronrod.h"
#include "reference/spherical_region.h"

namespace steradian {
namespace reference {
namespace {

using lobes::Lobe;
using lobes::LobeValue;

struct Cell {
  std::size_t triangle;
  double u0, u1, v0, v1;
  LobeValue value;
  double error_u = 0, error_v = 0;  // weighted sum over the two scalars
  double magnitude = 0;             // integral of the absolute value, weighted
  double boundary = 0;              // integral of the lobe along the light's outline

  double error() const { return error_u + error_v; }
  friend bool operator<(const Cell& a, const Cell& b) { return a.error() < b.error(); }
};

class Cubature {
 public:
  Cubature(const SphericalRegion& region, const Lobe& lobe)
      : lobe_(lobe), factors_(lobe.largest_factors()), fan_(region, lobe.shape()), region_(region) {}

  // Refines until the bound is below the larger of the two, which are errors of the radiance for a light of radiance 1.
  void run(double relative, double absolute, int max_evaluations) {
    for (std::size_t i = 0; i < fan_.triangles().size(); ++i) {
      const RegionFan::Triangle& t = fan_.triangles()[i];
      const int pieces = fan_.is_stretched() ? 4 : 1;  // one cell's nodes may all miss a ridge
      for (int k = 0; k < pieces; ++k) {
        const double width = (t.u_end - t.u_begin) / pieces;
        push(evaluated({i, t.u_begin + k * width, k + 1 == pieces ? t.u_end : t.u_begin + (k + 1) * width, 0, 1, {}}));
      }
    }
    resum();
    while (!heap_.empty() && evaluations_ < max_evaluations) {
      if (error_ <= std::max(absolute, relative * weighted(value_))) {
        resum();  // running sums carry the rounding of all terms that were removed
        if (error_ <= std::max(absolute, relative * weighted(value_))) break;
      }
      split_worst();
    }
    resum();
  }

  LobeValue value() const { return value_; }

  double bound() const {
    // Adds rounding: that of the lobe's arithmetic in every term, and that of the light's vertices along its outline.
    const double ulp = std::numeric_limits<double>::epsilon();
    // The part of a value below 0 was missed elsewhere.
    const double missed = std::max(-(value_.plain * factors_.plain), 0.0);
    return error_ + missed + ulp * (4 * (8 + lobe_.sensitivity()) * magnitude_ + 4 * region_.magnification * boundary_);
  }

 private:
  double weighted(LobeValue v) const { return std::fabs(v.plain) * factors_.plain + std::fabs(v.fresnel) * factors_.fresnel; }

  void push(const Cell& cell) {
    heap_.push_back(cell);
    std::push_heap(heap_.begin(), heap_.end());
    value_ += cell.value;
    error_ += cell.error();
  }

  void split_worst() {
    std::pop_heap(heap_.begin(), heap_.end());
    const Cell cell = heap_.back();
    heap_.pop_back();
    value_ = value_ - cell.value;
    error_ -= cell.error();
    Cell first = cell, second = cell;
    if (cell.error_u > cell.error_v)
      first.u1 = second.u0 = 0.5 * (cell.u0 + cell.u1);
    else
      first.v1 = second.v0 = 0.5 * (cell.v0 + cell.v1);
    push(evaluated(first));
    push(evaluated(second));
  }

  void resum() {
    value_ = {};
    error_ = magnitude_ = boundary_ = 0;
    for (const Cell& cell : heap_) {
      value_ += cell.value;
      error_ += cell.error();
      magnitude_ += cell.magnitude;
      boundary_ += cell.boundary;
    }
  }

  Cell evaluated(Cell cell) {
    const RegionFan::Triangle& triangle = fan_.triangles()[cell.triangle];
    const double u_mid = 0.5 * (cell.u0 + cell.u1), u_half = 0.5 * (cell.u1 - cell.u0);
    const double v_mid = 0.5 * (cell.v0 + cell.v1), v_half = 0.5 * (cell.v1 - cell.v0);
    std::array<LobeValue, kKronrodPoints * kKronrodPoints> values;
    LobeValue kronrod, gauss_u, gauss_v;
    cell.boundary = 0;
    std::size_t index = 0;
    for (const KronrodNode& nu : kKronrodNodes) {
      const RegionFan::Ray ray = fan_.ray(triangle, u_mid + u_half * nu.x);
      LobeValue row_kronrod, row_gauss, last;
      for (const KronrodNode& nv : kKronrodNodes) {
        const RegionFan::Point p = fan_.at(ray, v_mid + v_half * nv.x);
        last = lobe_.evaluate(p.direction);
        const LobeValue f = last * p.measure;
        values[index++] = f;
        row_kronrod += f * nv.kronrod;
        row_gauss += f * nv.gauss;
      }
      kronrod += row_kronrod * nu.kronrod;
      gauss_u += row_kronrod * nu.gauss;
      gauss_v += row_gauss * nu.kronrod;
      if (cell.v1 == 1.0) cell.boundary += weighted(last) * std::fabs(ray.arc_speed) * nu.kronrod * u_half;
    }
    evaluations_ += kKronrodPoints * kKronrodPoints;

    const double area = u_half * v_half;
    const LobeValue mean = kronrod * 0.25;  // the weights of the square [-1, 1]^2 sum to 4
    LobeValue variation, magnitude;
    index = 0;
    for (const KronrodNode& nu : kKronrodNodes)
      for (const KronrodNode& nv : kKronrodNodes) {
        const LobeValue f = values[index++];
        const double w = nu.kronrod * nv.kronrod * area;
        variation += LobeValue{std::fabs(f.plain - mean.plain), std::fabs(f.fresnel - mean.fresnel)} * w;
        magnitude += LobeValue{std::fabs(f.plain), std::fabs(f.fresnel)} * w;
      }
    cell.value = kronrod * area;
    const auto weighted_error = [&](LobeValue other) {
      const LobeValue d = (kronrod - other) * area;
      return weighted({error_estimate(std::fabs(d.plain), variation.plain), error_estimate(std::fabs(d.fresnel), variation.fresnel)});
    };
    cell.error_u = weighted_error(gauss_u);
    cell.error_v = weighted_error(gauss_v);
    cell.magnitude = weighted(magnitude);
    return cell;
  }

  const Lobe& lobe_;
  const LobeValue factors_;
  const RegionFan fan_;
  const SphericalRegion& region_;
  std::vector<Cell> heap_;
  LobeValue value_;
  double error_ = 0, magnitude_ = 0, boundary_ = 0;
  int evaluations_ = 0;
};

}  // namespace
}  // namespace reference

ReferenceResult reference_radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& material,
                                   const ReferenceOptions& options) {
  using namespace reference;
  const Frame frame = Frame::from_normal_and_tangent(at.normal, material.tangent);
  const lobes::Lobe lobe(lobes::in_frame(material, frame), frame.to_local(at.view));
  if (!lobe.above_surface()) return {};
  Vec3d planes[3] = {{0, 0, 1}};
  int plane_count = 1;
  for (const Vec3d& plane : lobe.ending_planes())
    if (!(plane == Vec3d{})) planes[plane_count++] = plane;
  SphericalRegion region;
  region.assign(light, at.position, frame, planes, plane_count);
  if (region.arcs.empty()) return {};

  Cubature cubature(region, lobe);
  cubature.run(options.relative_error, options.absolute_error, options.max_evaluations);
  const Vec3d brightness = light.radiance;
  const double scale = std::max({std::fabs(brightness.x), std::fabs(brightness.y), std::fabs(brightness.z)});
  return {lobe.radiance(cubature.value()) * brightness, cubature.bound() * scale};
}

}  // namespace steradian
