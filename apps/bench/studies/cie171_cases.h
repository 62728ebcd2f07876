// The groups of cases, and calls that they share.
#pragma once

#include "bench/studies/cie171.h"
#include "exchange/obstacles/point_factors.h"
#include "steradian/view_factors.h"

namespace steradian::cie171 {

// Case 5.8: a closed room.
void add_closed_room(std::vector<Comparison>& out);

// Cases 5.9, 5.11, 5.13 and 5.14: the sky through openings.
void add_daylight(std::vector<Comparison>& out);

ViewFactorFace rectangle(Vec3d corner, Vec3d a, Vec3d b);

// As `viewfactor points` computes them.
exchange::SensorFactors factors_at(Vec3d position, Vec3d normal, const std::vector<ViewFactorFace>& faces);

// Four edges have terms below 1/2, each off by three roundings: 6.7e-16 of factors above 1e-3.
inline constexpr double kRounding = 1e-12;
inline constexpr double kEps = 1e-10;  // of view factors

}  // namespace steradian::cie171
