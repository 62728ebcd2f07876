// A lamp of 10,000 lm that shines alike in all directions hangs in the middle of a closed room of 4 x 4 x 4 m.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/studies/cie171_cases.h"
#include "steradian/polygon_light.h"
#include "steradian/render.h"
#include "support/boxes.h"

namespace steradian::cie171 {
namespace {

using std::numbers::pi;

constexpr double kFlux = 10000;
constexpr int kSide = 4;  // metres, and elements of 1 m
constexpr double kReflectances[] = {0.05, 0.3, 0.5, 0.8, 0.95};

// The sides absorb what the lamp sends: (1 - rho) area x mean = flux. What is left without the direct mean is the indirect mean.
double indirect_of(double rho) { return kFlux * rho / (6.0 * kSide * kSide * (1 - rho)); }

// Elements of 1 x 1 m exchange their light by view factors until nothing is left.
void add_by_view_factors(std::vector<Comparison>& out) {
  std::vector<ViewFactorFace> faces;
  const Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const auto add = [&](Vec3d corner, Vec3d a, Vec3d b) {
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j) faces.push_back(rectangle(corner + a * double(i) + b * double(j), a, b));
  };
  const double size = kSide;
  add({}, x, y), add(z * size, y, x), add({}, y, z), add(x * size, z, y), add({}, z, x), add(y * size, x, z);
  ViewFactorOptions options;
  options.eps = kEps;
  const ViewFactors factors = view_factors(faces, options);
  const std::size_t n = faces.size();
  double row_error = 0;
  for (std::size_t i = 0; i < n; ++i) row_error = std::max(row_error, factors.row_errors[i]);
  std::vector<double> direct(n);
  for (std::size_t i = 0; i < n; ++i) {
    PolygonLight element;
    element.vertices = faces[i].outline;
    direct[i] = kFlux / (4 * pi) * polygon_solid_angle(prepare_polygon(element), {size / 2, size / 2, size / 2});
  }
  for (const double rho : kReflectances) {
    std::vector<double> received(n, 0.0);  // indirect illuminance
    for (double change = 1; change > 1e-12;) {
      std::vector<double> next(n, 0.0);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          if (i != j) next[i] += rho * (direct[j] + received[j]) * factors.between(i, j) / factors.areas[i];
      change = 0;
      for (std::size_t i = 0; i < n; ++i) change = std::max(change, std::fabs(next[i] - received[i]) / next[i]);
      received = next;
    }
    double mean = 0;
    for (const double e : received) mean += e / double(n);
    // Rows that are off by their error act as a reflectance that is off by as much; the iterations leave 1e-12 / (1 - rho).
    const double bound = (row_error + 2e-12) / (1 - rho);
    out.push_back({"5.8", fmt::format("reflectance {}", rho), "`viewfactor`", indirect_of(rho), mean, bound, " lx"});
  }
}

// A picture of one side from the middle of the room. Its pixels have equal areas, and all sides receive the same.
void add_by_render(std::vector<Comparison>& out) {
  for (const double rho : kReflectances) {
    Scene room = scene::closed_box(static_cast<float>(rho), false);  // of half side 1
    for (Mesh& mesh : room.meshes)
      for (Vec3f& p : mesh.positions) p = p * (0.5f * kSide);
    room.bounds_min = room.bounds_min * (0.5 * kSide), room.bounds_max = room.bounds_max * (0.5 * kSide);
    PunctualLight lamp;
    lamp.intensity = Vec3d{1, 1, 1} * (kFlux / (4 * pi));
    room.punctual_lights = {lamp};
    room.cameras = {scene::camera_at({0, 0, 0}, {0, 0, -1}, pi / 2)};
    RenderOptions options;
    options.width = options.height = 64;
    options.shadows = Shadows::on;
    options.bounces = kAllBounces;
    const Picture picture = render(room, options);
    double mean = 0, squares = 0, left_out = 0;
    const double count = static_cast<double>(picture.pixels.size());
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
      mean += static_cast<double>(picture.layers.at("indirect")[i].x) / count;
      squares += std::pow(static_cast<double>(picture.layers.at("bounce_error")[i].x), 2) / count;
      left_out = std::max(left_out, static_cast<double>(picture.layers.at("bounce_bound")[i].x));
    }
    out.push_back({"5.8", fmt::format("reflectance {}", rho), "`render --bounces all`", indirect_of(rho), mean * pi / rho,
                   (std::sqrt(squares) + left_out) / mean, " lx", true});
  }
}

}  // namespace

void add_closed_room(std::vector<Comparison>& out) {
  add_by_view_factors(out);
  add_by_render(out);
}

}  // namespace steradian::cie171
