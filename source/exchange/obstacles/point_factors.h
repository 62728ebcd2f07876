// View factors of points: what a sensor with a normal receives from each face, exactly, behind obstacles.
#pragma once

#include <vector>

#include "exchange/obstacles/obstructed.h"

namespace steradian::exchange {

struct Sensor {
  Vec3d position, normal;  // the normal is unit
};

// The configuration factor of the visible part of an element above the sensor's horizon. 0 behind the element.
struct PointFactor {
  double value = 0;
  bool is_proven = true;  // false: a decision of the visible part failed, the value may be wrong
};
PointFactor point_factor(const Sensor& sensor, const PlaneElement& element, const Obstacles& obstacles);

// Factors to all elements; what their backs block, and what is left for the sky. A closed scene leaves the sky nothing but rounding.
struct SensorFactors {
  std::vector<double> fronts;  // by element
  double backs = 0, sky = 0;
  bool is_proven = true;
};
SensorFactors sensor_factors(const Sensor& sensor, const std::vector<PlaneElement>& elements, const Obstacles& obstacles);

}  // namespace steradian::exchange
