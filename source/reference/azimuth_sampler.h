// AzimuthSampler: directions within a polygon of any outline, with holes, of exactly uniform density, without triangulation or rejection.
// Uniform means by solid angle, or by solid angle times cosine (projected).
//
// About the normal z, each arc and z span a sector; the region is the signed sum of the sectors. The fraction of the region up to an
// azimuth is monotone and has a closed form. It is Girard's excess of a triangle, or, in the projected disk, half an arc's angle times its
// normal's z. Newton's method within a bracket inverts it and gives the azimuth. On that azimuth, the remaining coordinate is uniform
// within the intervals between the arcs.
//
// Prepare it once per light and shading point; a reused object keeps its memory.
#pragma once

#include <vector>

#include "reference/spherical_region.h"

namespace steradian::reference {

enum class SphericalMeasure { solid_angle, projected_solid_angle };

class AzimuthSampler {
 public:
  // The region within the hemisphere z >= 0.
  void prepare(const SphericalRegion& region, SphericalMeasure measure);

  // Measure of the region; 0: nothing to sample.
  double measure() const { return total_; }

  // A direction for u, v in [0, 1); the zero vector if there is nothing to sample.
  Vec3d sample(double u, double v) const;

  // Density per solid angle. A direction that sample() returned needs no test: pdf_within.
  double pdf(Vec3d l) const { return contains(l) ? pdf_within(l) : 0; }
  double pdf_within(Vec3d l) const;
  bool contains(Vec3d l) const;

 private:
  // An arc by growing azimuth, and the sign of its sector. Azimuths are counted from zero_azimuth_, in [0, 2 pi].
  struct Side {
    Vec3d a, normal;
    double begin, end, sign;
  };
  struct Slice {               // between two neighbouring ends of sides
    double begin, end, share;  // share: fraction of all slices up to this one's end
    std::size_t first, last;   // its pieces in pieces_
  };
  struct Piece {  // a side's part within a slice
    Vec3d begin, normal;
    Vec3d turned;  // begin, a quarter turn on along the side
    double sign;
  };
  struct Sweep {  // from a slice's begin to an azimuth
    double measure = 0;
    double magnitude = 0;  // sum of the absolute values of the measure's terms: the scale of its rounding
    double density = 0;    // the measure per azimuth there
  };

  void add_side(Vec3d a, Vec3d b, Vec3d normal, double sign);
  double extent(const Piece& piece, Vec3d across) const;  // the measure per azimuth
  Sweep sweep(const Slice& slice, Vec3d across) const;

  SphericalMeasure measure_ = SphericalMeasure::solid_angle;
  double total_ = 0;
  double zero_azimuth_ = 0;
  std::vector<Side> sides_;
  std::vector<Slice> slices_;
  std::vector<Piece> pieces_;
  std::vector<double> ends_;
};

}  // namespace steradian::reference
