#include "accumulation.h"

#include <cmath>

namespace steradian::view {

void Accumulation::add(const Picture& pass, int pairs) {
  const double n = pairs;
  width_ = pass.width;
  height_ = pass.height;
  sum_.resize(pass.pixels.size());
  variance_.resize(pass.pixels.size());
  const std::vector<Vec3f>& variance = pass.layers.at("variance");
  for (std::size_t i = 0; i < sum_.size(); ++i) {
    sum_[i] += static_cast<Vec3d>(pass.pixels[i]) * n;
    variance_[i] += static_cast<Vec3d>(variance[i]) * (n * n);
  }
  pairs_ += static_cast<std::uint64_t>(pairs);
}

Picture Accumulation::picture() const {
  Picture picture(width_, height_);
  if (pairs_ == 0) return picture;
  std::vector<Vec3f>& variance = picture.layers["variance"];
  variance.resize(sum_.size());
  const double n = static_cast<double>(pairs_);
  for (std::size_t i = 0; i < sum_.size(); ++i) {
    picture.pixels[i] = static_cast<Vec3f>(sum_[i] / n);
    variance[i] = static_cast<Vec3f>(variance_[i] / (n * n));
  }
  return picture;
}

double Accumulation::relative_error() const {
  double squares = 0, variance = 0;
  for (std::size_t i = 0; i < sum_.size(); ++i) {
    squares += dot(sum_[i], sum_[i]);
    variance += variance_[i].x + variance_[i].y + variance_[i].z;
  }
  return squares > 0 ? std::sqrt(variance / squares) : 0;
}

}  // namespace steradian::view
