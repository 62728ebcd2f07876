// The ten families of random scenes on which methods of the plane are compared, and the error of a method on each.
#pragma once

#include <string>
#include <vector>

#include "steradian/plane.h"

namespace steradian::plane {

inline constexpr int kPlaneFamilies = 10;
const char* plane_family_name(int family);  // 1 to 10

// One scene in the unit square. The same numbers give the same scene on every machine.
PlaneScene make_plane_family(int family, std::uint64_t seed);

// Points outside all bodies, uniform in the unit square.
std::vector<Vec2d> points_outside(const PlaneWorld& world, int count, std::uint64_t seed);

struct FamilyError {
  double mean_percent = 0;  // mean absolute error, percent of the mean radiance; of the largest radiance, if the truth is 0
  double off_percent = 0;   // percent of points with an error above 1 %
  int points = 0;
};

// The error of `method` relative to `exact`.
FamilyError measure_family(int family, PlaneMethod method, int scenes, int points_per_scene, const PlaneSampling& sampling = {});

// The table of docs/measured/plane.md, as Markdown.
std::string plane_error_table(int scenes, int points_per_scene);

}  // namespace steradian::plane
