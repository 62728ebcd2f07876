#include "steradian/polygon_derivatives.h"

#include "steradian/dual.h"

namespace steradian {
namespace {

// Which stored vertex each vertex of the prepared light is: contours lose repeated vertices and may be turned around.
std::vector<std::size_t> stored_vertices(const PolygonLight& light, const PreparedPolygon& prepared) {
  std::vector<std::size_t> result;
  std::size_t offset = 0;
  const auto add = [&](const std::vector<Vec3d>& contour) {
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < contour.size(); ++i)
      if (kept.empty() || !(contour[i] == contour[kept.back()])) kept.push_back(i);
    while (kept.size() > 1 && contour[kept.front()] == contour[kept.back()]) kept.pop_back();
    if (kept.size() >= 3 && result.size() < prepared.vertices.size()) {
      const bool turned = !(prepared.vertices[result.size()] == contour[kept.front()]);
      for (std::size_t i = 0; i < kept.size(); ++i)
        result.push_back(offset + kept[turned ? kept.size() - 1 - i : i]);
    }
    offset += contour.size();
  };
  add(light.vertices);
  for (const auto& hole : light.holes) add(hole);
  return result;
}

std::size_t stored_count(const PolygonLight& light) {
  std::size_t count = light.vertices.size();
  for (const auto& hole : light.holes) count += hole.size();
  return count;
}

// By the vertices in walk order, relative to the point.
using VertexDerivatives = std::vector<Vec3d>;

// Each edge depends on its two ends alone: six directions an edge, however many vertices there are. Irradiance is the sum
// of the edges' z and of half the angle of the product of their horizon factors, so of half the sum of their angles.
VertexDerivatives irradiance_by_vertices(const PreparedPolygon& light, Vec3d position, const Frame& frame) {
  using S = Dual<6>;
  using R = Real<S>;
  Kernels<S> k;
  const auto seeded = [](Vec3d v, std::size_t first) {
    Vec3<R> r(v.x, v.y, v.z);
    r.x.v.d[first] = r.y.v.d[first + 1] = r.z.v.d[first + 2] = 1.0;
    return r;
  };
  VertexDerivatives result(light.vertices.size());
  for (std::size_t c = 0; c + 1 < light.contours.size(); ++c) {
    std::size_t a = light.contours[c + 1] - 1;
    for (std::size_t b = light.contours[c]; b < light.contours[c + 1]; a = b++) {
      const auto from = k.polygon_direction(seeded(frame.to_local(light.vertices[a] - position), 0));
      const auto to = k.polygon_direction(seeded(frame.to_local(light.vertices[b] - position), 3));
      const auto walk = k.polygon_add_edge(k.polygon_begin(), from, to);
      R term = walk.edges.z;
      if (walk.horizon.x.v.v < 1.0) term += 0.5 * k.trig_atan2(walk.horizon.y, walk.horizon.x);
      const auto& d = term.v.d;
      result[a] += frame.to_world({d[0], d[1], d[2]});
      result[b] += frame.to_world({d[3], d[4], d[5]});
    }
  }
  return result;
}

VertexDerivatives solid_angle_by_vertices(const PreparedPolygon& light, Vec3d position, bool reversed) {
  std::vector<double> x;
  for (const Vec3d& v : light.vertices) x.insert(x.end(), {v.x - position.x, v.y - position.y, v.z - position.z});
  const Gradient g = gradient(x, [&]<class S>(const std::vector<Real<S>>& coordinates) {
    Kernels<S> k;
    const auto direction = [&](std::size_t i) {
      return k.polygon_direction({coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]});
    };
    auto walk = k.solid_angle_begin(direction(0));
    for (std::size_t c = 0; c + 1 < light.contours.size(); ++c) {
      std::size_t a = light.contours[c + 1] - 1;
      for (std::size_t b = light.contours[c]; b < light.contours[c + 1]; a = b++)
        walk = k.solid_angle_add_edge(walk, direction(a), direction(b));
    }
    return k.solid_angle_finish(walk, Mask<S>(reversed));
  });
  VertexDerivatives result;
  for (std::size_t i = 0; i < light.vertices.size(); ++i)
    result.push_back({g.derivative[3 * i], g.derivative[3 * i + 1], g.derivative[3 * i + 2]});
  return result;
}

// Point and normal move as the vertices do the other way: the integral sees only vertices relative to the point, turned
// into the normal's frame. `back` is -1 where the walk ran the wrong way round.
LightDerivatives gather(const PolygonLight& stored, const PreparedPolygon& light, Vec3d position, Vec3d normal, double value,
                        const VertexDerivatives& by_vertex, double back) {
  LightDerivatives result;
  result.value = value;
  result.vertices.resize(stored_count(stored));
  const std::vector<std::size_t> stored_index = stored_vertices(stored, light);
  Vec3d moment{};
  for (std::size_t i = 0; i < by_vertex.size(); ++i) {
    const Vec3d derivative = by_vertex[i] * back;
    result.vertices[stored_index[i]] = derivative;
    result.position += -derivative;
    moment += cross(light.vertices[i] - position, derivative);
  }
  result.normal = cross(normal, moment);
  return result;
}

// +1 or -1 as the light is seen from the front or the back, 0 where it gives no light.
int lit_side(const PreparedPolygon& light, Vec3d position) {
  const int side = light.side_of(position);
  return side < 0 && !light.two_sided ? 0 : side;
}

LightDerivatives no_light(const PolygonLight& light) {
  LightDerivatives result;
  result.vertices.resize(stored_count(light));
  return result;
}

}  // namespace

LightDerivatives polygon_irradiance_derivatives(const PolygonLight& stored, Vec3d position, Vec3d normal) {
  const PreparedPolygon light = prepare_polygon(stored);
  const int side = lit_side(light, position);
  if (side == 0) return no_light(stored);
  return gather(stored, light, position, normal, polygon_irradiance(light, position, normal),
                irradiance_by_vertices(light, position, Frame::from_normal(normal)), side);
}

LightDerivatives polygon_solid_angle_derivatives(const PolygonLight& stored, Vec3d position) {
  const PreparedPolygon light = prepare_polygon(stored);
  const int side = lit_side(light, position);
  if (side == 0) return no_light(stored);
  return gather(stored, light, position, {}, polygon_solid_angle(light, position),
                solid_angle_by_vertices(light, position, side < 0), 1);
}

}  // namespace steradian
