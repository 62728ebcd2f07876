// vulkan/kernel/METHOD/{quad,star,triangle}/n=N: a Phong plane under one light, 1280 x 720 pixels on a Vulkan device. One item is one edge
// of one point. The passes are the device's own time for all edges and for one.
#include "bench/phong_on_device.h"

#include <algorithm>

#include "bench/benches.h"
#include "bench/phong_methods.h"
#include "device/direct/own_lobes.h"
#include "device/vulkan/compute_program.h"
#include "steradian/error.h"

namespace steradian::bench {
namespace {

using vulkan::Buffer;
using vulkan::BufferUse;
using vulkan::ComputeProgram;

// Written by glslc: cmake/shaders.cmake.
constexpr std::uint32_t kShader[] =
#include "phong.comp.inc"
    ;

constexpr std::uint32_t kGroup = 64, kAcross = 32768;

const std::vector<vulkan::ShaderCode>& shaders() {
  static const std::vector<vulkan::ShaderCode> all = {{"phong.comp", {{{}, kShader}}}};
  return all;
}

constexpr std::size_t kBuffers = 3;

std::vector<std::int32_t> constants_of(const PhongOptions& options, int exponent, std::size_t edges) {
  // The best variant of each fit: docs/theory/moments.md.
  const bool x = options.method == Method::lorentzian || options.method == Method::pearson;
  return {vulkan::phong_method(options), exponent, x ? 1 : 0, static_cast<std::int32_t>(edges)};
}

std::vector<float> points_of(const moment::PhongPlane& plane) {
  std::vector<float> points;
  for (std::size_t i = 0; i < plane.count; ++i)
    for (float x : {plane.x[i], plane.y[i], plane.z[i], 0.0f, plane.nx[i], plane.ny[i], plane.nz[i], 0.0f, plane.vx[i], plane.vy[i],
                    plane.vz[i], 0.0f})
      points.push_back(x);
  return points;
}

// The corners in walk order, then the normal. The order is counter-clockwise about a direction in the light, which is clockwise from the
// emitting side.
std::vector<float> corners_of(const moment::NamedLight& light) {
  std::vector<float> corners;
  Vec3d area;
  for (std::size_t i = light.corners.size(); i-- > 0;) {
    const Vec3d v = light.corners[i], next = light.corners[(i + 1) % light.corners.size()];
    for (double x : {v.x, v.y, v.z, 0.0}) corners.push_back(static_cast<float>(x));
    area = area + cross(v - light.corners[0], next - light.corners[0]);
  }
  const Vec3d n = normalized(area);
  for (double x : {n.x, n.y, n.z, 0.0}) corners.push_back(static_cast<float>(x));
  return corners;
}

}  // namespace

struct PhongOnDevice::Parts {
  Parts(const moment::PhongPlane& plane, const moment::NamedLight& light, int exponent, const PhongOptions& options,
        const std::string& name)
      : device({name, false}), program(device, shaders(), kBuffers), count(plane.count) {
    const std::vector<float> p = points_of(plane), c = corners_of(light);
    points = std::make_unique<Buffer>(device, p.size() * sizeof(float), BufferUse::host_writes);
    points->write(p.data(), p.size() * sizeof(float));
    corners = std::make_unique<Buffer>(device, c.size() * sizeof(float), BufferUse::host_writes);
    corners->write(c.data(), c.size() * sizeof(float));
    results = std::make_unique<Buffer>(device, count * sizeof(float), BufferUse::host_reads);
    dispatch.pipeline = program.pipeline(0, constants_of(options, exponent, light.corners.size()));
    const auto groups = static_cast<std::uint32_t>((count + kGroup - 1) / kGroup);
    dispatch.groups_x = std::min(groups, kAcross);
    dispatch.groups_y = (groups + kAcross - 1) / kAcross;
    dispatch.push = static_cast<std::uint32_t>(count);
  }

  vulkan::Device device;
  ComputeProgram program;
  std::size_t count;
  std::unique_ptr<Buffer> points, corners, results;
  ComputeProgram::Dispatch dispatch;
  double ms = 0;
};

PhongOnDevice::PhongOnDevice(const moment::PhongPlane& plane, const moment::NamedLight& light, int exponent, const PhongOptions& options,
                             const std::string& device)
    : parts_(std::make_unique<Parts>(plane, light, exponent, options, device)) {}
PhongOnDevice::~PhongOnDevice() = default;

void PhongOnDevice::run() {
  const std::vector<double> ms =
      parts_->program.run({parts_->points.get(), parts_->corners.get(), parts_->results.get()}, {parts_->dispatch});
  parts_->ms = ms.empty() ? 0 : ms.front();
}

std::vector<float> PhongOnDevice::radiance() const {
  std::vector<float> result(parts_->count);
  parts_->results->read(result.data(), result.size() * sizeof(float));
  return result;
}

double PhongOnDevice::device_ms() const { return parts_->ms; }

std::vector<vulkan::PipelineReport> compile_phong(const std::string& name) {
  const vulkan::Device device({name, false, true});
  ComputeProgram program(device, shaders(), kBuffers);
  for (const PhongVariant& v : phong_variants())
    for (const int n : kPhongExponents) program.pipeline(0, constants_of(v.options, n, 4));
  return device.pipelines();
}

namespace {

Bench phong_on_device_on_device(const std::string& name, const std::string& light_name, const PhongOptions& options, int n,
                                const std::string& device) {
  const moment::PhongPlane plane = moment::make_phong_plane(1280, 720);
  const std::vector<moment::NamedLight> lights = moment::comparison_lights();
  const auto light = std::find_if(lights.begin(), lights.end(), [&](const moment::NamedLight& l) { return l.name == light_name; });
  auto work = std::make_shared<PhongOnDevice>(plane, *light, n, options, device);
  const auto edges = static_cast<double>(light->edges);
  return {name,
          plane.count * light->edges,
          name_of(active_simd()),
          [work] { work->run(); },
          false,
          [work, edges] {
            return std::vector<BenchPass>{{"device", work->device_ms()}, {"an edge", work->device_ms() / edges}};
          }};
}

}  // namespace

void add_phong_on_device(BenchList& list, const std::string& device) {
  for (const PhongVariant& v : phong_variants())
    for (const char* light : {"quad", "star", "triangle"})
      for (const int n : kPhongExponents) {
        const std::string name = "vulkan/kernel/" + v.name + "/" + light + "/n=" + std::to_string(n);
        list.add(name, [=](const BenchOptions&) { return phong_on_device_on_device(name, light, v.options, n, device); });
      }
}

}  // namespace steradian::bench
