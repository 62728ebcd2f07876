#include "exchange/obstacles/point_factors.h"

#include <algorithm>
#include <cmath>

#include "exchange/obstacles/hidden_part.h"

namespace steradian::exchange {

PointFactor point_factor(const Sensor& sensor, const PlaneElement& element, const Obstacles& obstacles) {
  const double height = dot(sensor.position - element.centroid, element.normal);
  if (!(height > 1e-12 * element.radius)) return {};
  const PlaneElement above = cut_element(element, sensor.position, sensor.normal, 1);
  if (above.is_empty()) return {};
  const shadow::EdgeMesh mesh = obstacles.mesh_of(obstacles.before(sensor.position, sensor.normal, above));
  HiddenPart finder(above, mesh);
  PointFactor result;
  result.value = finder.whole_factor(sensor.position, sensor.normal);
  if (!mesh.triangles.empty()) {
    result.value = std::max(result.value - finder.hidden_factor(sensor.position, sensor.normal), 0.0);
    result.is_proven = finder.is_proven();
  }
  return result;
}

SensorFactors sensor_factors(const Sensor& sensor, const std::vector<PlaneElement>& elements, const Obstacles& obstacles) {
  SensorFactors result;
  double sum = 0;
  for (const PlaneElement& e : elements) {
    const PointFactor front = point_factor(sensor, e, obstacles);
    result.fronts.push_back(front.value);
    result.is_proven = result.is_proven && front.is_proven;
    sum += front.value;
    // A point sees a front or a back, or neither.
    if (dot(sensor.position - e.centroid, e.normal) >= 0) continue;
    const PointFactor back = point_factor(sensor, turned_over(e), obstacles);
    result.is_proven = result.is_proven && back.is_proven;
    result.backs += back.value;
  }
  result.sky = std::clamp(1 - sum - result.backs, 0.0, 1.0);
  return result;
}

}  // namespace steradian::exchange
