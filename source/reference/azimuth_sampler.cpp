#include "reference/azimuth_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace steradian::reference {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

Vec3d across_at(double azimuth) { return {std::cos(azimuth), std::sin(azimuth), 0}; }

// Intersection of the side's great circle with the half plane of z and `across`; its normal's z is positive.
Vec3d meet(Vec3d normal, Vec3d across) { return normalized(across * normal.z - Vec3d{0, 0, dot(normal, across)}); }

}  // namespace

void AzimuthSampler::prepare(const SphericalRegion& region, SphericalMeasure measure) {
  measure_ = measure;
  total_ = 0;
  sides_.clear();
  slices_.clear();
  pieces_.clear();
  ends_.clear();
  if (region.arcs.empty()) return;

  // Azimuths start at a vertex, so that a small light lies near 0 and 2 pi and retains its digits on at least one side.
  zero_azimuth_ = std::atan2(region.arcs[0].a.y, region.arcs[0].a.x);
  for (const Arc& arc : region.arcs) {
    if (arc.normal.z > 0)
      add_side(arc.a, arc.b, arc.normal, 1);
    else if (arc.normal.z < 0)
      add_side(arc.b, arc.a, -arc.normal, -1);  // an arc towards or away from z spans no sector
  }
  for (const Side& side : sides_) {
    ends_.push_back(side.begin);
    ends_.push_back(side.end);
  }
  std::sort(ends_.begin(), ends_.end());
  Vec3d next_across = ends_.empty() ? Vec3d{} : across_at(ends_[0] + zero_azimuth_);
  for (std::size_t i = 0; i + 1 < ends_.size(); ++i) {
    if (!(ends_[i + 1] > ends_[i])) continue;
    Slice slice{ends_[i], ends_[i + 1], 0, pieces_.size(), 0};
    const Vec3d across = next_across;
    next_across = across_at(slice.end + zero_azimuth_);
    for (const Side& side : sides_)
      if (side.begin <= slice.begin && side.end >= slice.end) {
        const Vec3d begin = side.begin < slice.begin ? meet(side.normal, across) : side.a;
        pieces_.push_back({begin, side.normal, cross(side.normal, begin), side.sign});
      }
    slice.last = pieces_.size();
    if (slice.first == slice.last) continue;
    total_ += std::max(sweep(slice, next_across).measure, 0.0);
    slice.share = total_;
    slices_.push_back(slice);
  }
}

// Adds the arc from a to b by growing azimuth, less than half a turn; it is cut where azimuths start again.
void AzimuthSampler::add_side(Vec3d a, Vec3d b, Vec3d normal, double sign) {
  const auto azimuth_of = [&](Vec3d w) {
    double azimuth = std::atan2(w.y, w.x) - zero_azimuth_;
    if (azimuth < 0) azimuth += kTurn;
    return azimuth >= kTurn ? 0.0 : azimuth;
  };
  const bool a_at_z = a.x == 0 && a.y == 0, b_at_z = b.x == 0 && b.y == 0;
  if (a_at_z || b_at_z) return;
  const double begin = azimuth_of(a), end = azimuth_of(b);
  if (begin <= end && end - begin <= std::numbers::pi) {
    if (end > begin) sides_.push_back({a, normal, begin, end, sign});
    return;
  }
  if (begin - end < std::numbers::pi) return;  // backwards by rounding: an arc that nearly points to z
  if (kTurn > begin) sides_.push_back({a, normal, begin, kTurn, sign});
  if (end > 0) sides_.push_back({meet(normal, across_at(zero_azimuth_)), normal, 0, end, sign});
}

double AzimuthSampler::extent(const Piece& piece, Vec3d across) const {
  const double along = dot(piece.normal, across);
  const double sine2 = piece.normal.z * piece.normal.z / (piece.normal.z * piece.normal.z + along * along);
  if (measure_ == SphericalMeasure::projected_solid_angle) return 0.5 * sine2;
  const double cosine = std::max(-along, 0.0) / std::hypot(piece.normal.z, along);
  return sine2 / (1 + cosine);
}

// Newton's steps spend their time here: one arctangent a piece, and q, the piece's point at the azimuth, not normalised.
AzimuthSampler::Sweep AzimuthSampler::sweep(const Slice& slice, Vec3d across) const {
  Sweep sum;
  for (std::size_t i = slice.first; i < slice.last; ++i) {
    const auto& [begin, normal, turned, sign] = pieces_[i];
    const double along = normal.x * across.x + normal.y * across.y;
    const Vec3d q = {across.x * normal.z, across.y * normal.z, -along};
    const double length2 = normal.z * normal.z + along * along;
    const double sine2 = normal.z * normal.z / length2;
    double sector, extent;
    if (measure_ == SphericalMeasure::projected_solid_angle) {
      sector = 0.5 * normal.z * std::atan2(dot(turned, q), dot(begin, q));
      extent = 0.5 * sine2;
    } else {
      // Van Oosterom, Strackee 1983, eq. 8, of the triangle z, begin, q.
      const double length = std::sqrt(length2);
      sector = 2 * std::atan2(begin.x * q.y - begin.y * q.x, length * (1 + begin.z) + q.z + dot(begin, q));
      extent = sine2 / (1 + std::max(-along, 0.0) / length);
    }
    sum.measure += sign * sector;
    sum.magnitude += std::fabs(sector);
    sum.density += sign * extent;
  }
  return sum;
}

Vec3d AzimuthSampler::sample(double u, double v) const {
  if (!(total_ > 0)) return {};
  const double share = u * total_;
  auto slice =
      std::upper_bound(slices_.begin(), slices_.end(), share, [](double s, const Slice& candidate) { return s < candidate.share; });
  if (slice == slices_.end()) --slice;
  const double before = slice == slices_.begin() ? 0 : std::prev(slice)->share;

  // Newton's steps within a shrinking bracket; a step that would leave it is replaced by its middle.
  const double target = share - before;
  double low = slice->begin, high = slice->end;
  double azimuth = low + (high - low) * std::clamp(target / (slice->share - before), 0.0, 1.0);
  for (int i = 0; i < 60; ++i) {
    const Sweep at = sweep(*slice, across_at(azimuth + zero_azimuth_));
    const double error = at.measure - target;
    if (std::fabs(error) <= std::numeric_limits<double>::epsilon() * at.magnitude) break;  // the rest is rounding
    (error > 0 ? high : low) = azimuth;
    double next = azimuth - error / at.density;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double step = std::fabs(next - azimuth);
    azimuth = next;
    if (step <= 4e-16 * kTurn) break;
  }

  // From the outside in, an interval counts if the sides further out wind around it.
  const Vec3d across = across_at(azimuth + zero_azimuth_);
  struct Crossing {
    double extent, sign;
  };
  constexpr std::size_t kFew = 32;
  std::array<Crossing, kFew> few;
  std::vector<Crossing> many;
  const std::size_t count = slice->last - slice->first;
  Crossing* crossings = few.data();
  if (count > kFew) {
    many.resize(count);
    crossings = many.data();
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Piece& piece = pieces_[slice->first + i];
    crossings[i] = {extent(piece, across), piece.sign};
  }
  std::sort(crossings, crossings + count, [](const Crossing& a, const Crossing& b) { return a.extent > b.extent; });
  const auto walk = [&](double stop) {  // returns the extent at which the lengths of the intervals sum to `stop`
    double winding = 0, length = 0;
    for (std::size_t i = 0; i < count; ++i) {
      winding += crossings[i].sign;
      const double inner = i + 1 < count ? crossings[i + 1].extent : 0;
      const double step = winding > 0.5 ? crossings[i].extent - inner : 0;
      if (length + step > stop) return crossings[i].extent - (stop - length);
      length += step;
    }
    return -length;  // not reached: minus the sum of all lengths
  };
  const double length = -walk(2 * kTurn);
  const double e = std::max(walk(v * length), 0.0);
  // The extent is sin^2/2, or 1 - cos.
  if (measure_ == SphericalMeasure::projected_solid_angle) {
    const double sine2 = std::min(2 * e, 1.0);
    return across * std::sqrt(sine2) + Vec3d{0, 0, std::sqrt(1 - sine2)};
  }
  return across * std::sqrt(std::max(e * (2 - e), 0.0)) + Vec3d{0, 0, 1 - e};
}

bool AzimuthSampler::contains(Vec3d l) const {
  double winding = 0, azimuth = std::atan2(l.y, l.x) - zero_azimuth_;
  if (azimuth < 0) azimuth += kTurn;
  for (const Side& side : sides_) {
    // A point is inside of the side if det(a, b, l) > 0.
    if (azimuth >= side.begin && azimuth < side.end && dot(side.normal, l) > 0) winding += side.sign;
  }
  return winding > 0.5;
}

double AzimuthSampler::pdf_within(Vec3d l) const {
  if (!(total_ > 0) || !(l.z > 0)) return 0;
  return (measure_ == SphericalMeasure::projected_solid_angle ? l.z : 1.0) / total_;
}

}  // namespace steradian::reference
