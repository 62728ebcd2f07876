#include "device/shadow/scene_rays.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "device/shadow/ray_hierarchy.h"
#include "device/vulkan/shaders.h"

namespace steradian::vulkan {
namespace {

bool casts(const Mesh& mesh) { return !mesh.is_light_shape && mesh.casts_shadow && !mesh.indices.empty(); }
bool is_cut_out(const Scene& scene, const Mesh& mesh) {
  return scene.materials[static_cast<std::size_t>(mesh.material)].alpha_mode == AlphaMode::mask;
}
bool is_finite(const Vec3d& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

SceneRays::SceneRays(std::shared_ptr<const Device> device, std::size_t bytes, std::vector<Triangle> triangles)
    : device_(std::move(device)), hierarchy_(*device_, bytes, BufferUse::host_writes), triangles_(std::move(triangles)) {}

std::shared_ptr<const SceneRays> SceneRays::of(std::shared_ptr<const Device> device, const Scene& scene) {
  std::vector<RayTriangle> sorted;
  std::vector<Triangle> triangles;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    if (!casts(mesh) || is_cut_out(scene, mesh)) continue;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      RayTriangle triangle{{}, static_cast<std::uint32_t>(triangles.size())};
      for (std::size_t c = 0; c < 3; ++c) triangle.corners[c] = static_cast<Vec3d>(mesh.positions[mesh.indices[3 * t + c]]);
      if (!std::all_of(triangle.corners.begin(), triangle.corners.end(), is_finite)) continue;
      sorted.push_back(triangle);
      triangles.push_back({static_cast<std::uint32_t>(m), static_cast<std::uint32_t>(t)});
    }
  }
  const std::size_t most = std::min<std::size_t>(kGuaranteedBuffer, device->info().storage_buffer);
  if (least_of_hierarchy(sorted.size()) > most / (4 * sizeof(std::uint32_t))) return nullptr;
  const auto vectors = ray_hierarchy(std::move(sorted));
  const std::size_t bytes = vectors.size() * sizeof vectors[0];
  if (bytes > most) return nullptr;
  std::shared_ptr<SceneRays> rays(new SceneRays(std::move(device), bytes, std::move(triangles)));
  rays->hierarchy_.write(vectors.data(), bytes);
  return rays;
}

bool all_cast_exactly(const Scene& scene) {
  return std::none_of(scene.meshes.begin(), scene.meshes.end(), [&](const Mesh& mesh) { return casts(mesh) && is_cut_out(scene, mesh); });
}

namespace {

#include "shaders/shadow/ray_layout.glsl"

constexpr std::size_t kThreads = 64;  // work group size of shaders/bounce/bounce_rays.comp

static_assert(sizeof(indirect::MapRay) == static_cast<std::size_t>(kMapRay) * 4 * sizeof(float));

}  // namespace

DeviceFirstHits::DeviceFirstHits(std::shared_ptr<const SceneRays> scene)
    : scene_(std::move(scene)),
      program_(scene_->device(), {shader("bounce_rays.comp")}, 3),
      rays_(scene_->device()),
      met_(scene_->device(), BufferUse::host_reads) {}

std::size_t DeviceFirstHits::most() const { return std::size_t{1} << 20; }  // 32 MiB; in one row of work groups

indirect::MapRay* DeviceFirstHits::rays(std::size_t count) {
  Buffer& met = met_.fit_with_room(count * sizeof(std::uint32_t), "triangles that a shadow map meets");
  if (scene_->device().only_compiles())  // no answer comes
    std::fill_n(static_cast<std::uint32_t*>(met.mapped()), count, static_cast<std::uint32_t>(kHostFinds));
  return static_cast<indirect::MapRay*>(rays_.fit_with_room(count * sizeof(indirect::MapRay), "rays of a shadow map").mapped());
}

void DeviceFirstHits::find(std::size_t count) {
  const auto groups = static_cast<std::uint32_t>((count + kThreads - 1) / kThreads);
  const auto ms = program_.run({&rays_.get(), &met_.get(), &scene_->hierarchy()},
                               {{program_.pipeline(), groups, 1, static_cast<std::uint32_t>(count)}});
  if (!ms.empty()) time_ += ms.front();
}

indirect::FirstHit DeviceFirstHits::hit(std::size_t ray) const {
  const std::uint32_t met = static_cast<const std::uint32_t*>(met_.get().mapped())[ray];
  if (met == static_cast<std::uint32_t>(kMeetsNothing)) return {};
  if (met == static_cast<std::uint32_t>(kHostFinds)) return {indirect::FirstHit::kUnknown, 0};
  const SceneRays::Triangle triangle = scene_->triangle(met - 1);
  return {triangle.mesh, triangle.triangle};
}

}  // namespace steradian::vulkan
