#include <algorithm>
#include <vector>

#include "scene/photometry/readers.h"

namespace steradian::scene {
namespace {

// Planes in the order of their angle, each with the number of the measured plane that it equals.
struct Planes {
  std::vector<double> angles;
  std::vector<std::size_t> like;
  void add(double angle, std::size_t plane) {
    angles.push_back(angle);
    like.push_back(plane);
  }
};

}  // namespace

bool goes_round(const std::vector<double>& planes) {
  const double first = planes.front(), last = planes.back();
  if (planes.size() == 1) return true;
  if (first == 0) return last == 90 || last >= 180;
  // The plane of 90 and 270 degrees mirrors the others, so without a plane of 180 there is no plane of 0.
  return first == 90 && last == 270 && std::find(planes.begin(), planes.end(), 180.0) != planes.end();
}

void complete_circle(LightProfile& profile) {
  const std::vector<double> given = std::move(profile.horizontal);
  Planes planes;
  const std::size_t n = given.size();
  const double first = given.front(), last = given.back();
  if (n == 1) {
    planes.add(0, 0);
  } else if (first == 0 && (last == 90 || last == 180)) {
    for (std::size_t i = 0; i < n; ++i) planes.add(given[i], i);
    if (last == 90)
      for (std::size_t i = n - 1; i-- > 0;) planes.add(180 - given[i], i);
    const std::size_t half = planes.angles.size();
    for (std::size_t i = half - 1; i-- > 0;) planes.add(360 - planes.angles[i], planes.like[i]);
  } else if (first == 90 && last == 270) {
    // The plane of 180 also serves as that of 0.
    for (std::size_t i = n; i-- > 0;)
      if (given[i] <= 180) planes.add(180 - given[i], i);
    for (std::size_t i = 1; i < n; ++i) planes.add(given[i], i);
    for (std::size_t i = n - 1; i-- > 0;)
      if (given[i] >= 180) planes.add(540 - given[i], i);
  } else {
    for (std::size_t i = 0; i < n; ++i) planes.add(given[i], i);
    if (last < 360) planes.add(360, 0);
  }
  const std::size_t angles = profile.vertical.size();
  std::vector<double> candela;
  for (const std::size_t plane : planes.like)
    for (std::size_t v = 0; v < angles; ++v) candela.push_back(profile.candela[plane * angles + v]);
  profile.horizontal = std::move(planes.angles);
  profile.candela = std::move(candela);
}

}  // namespace steradian::scene
