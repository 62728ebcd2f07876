#include "render/surface/ray_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <tbb/parallel_invoke.h>

#include "render/surface/surface.h"
#include "shadow/edges/bodies.h"
#include "steradian/error.h"

namespace steradian {
namespace {

constexpr unsigned kSeenByCamera = 1;
constexpr unsigned kCastsShadow = 2;
constexpr unsigned kHasEdges = 4;
constexpr unsigned kCutOut = 8;
constexpr unsigned kClear = 16;
constexpr unsigned kLight = 32;  // shows a light, and shadow rays pass it

void* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t item, std::size_t count) {
  void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, item, count);
  if (buffer == nullptr) throw Error("", "out of memory for " + std::to_string(count) + " triangles or vertices");
  return buffer;
}

const char* text_of(RTCError error) {
  switch (error) {
    case RTC_ERROR_INVALID_ARGUMENT: return "an argument that it does not take";
    case RTC_ERROR_INVALID_OPERATION: return "an operation that it does not take";
    case RTC_ERROR_OUT_OF_MEMORY: return "out of memory";
    case RTC_ERROR_UNSUPPORTED_CPU: return "it does not run on this processor";
    case RTC_ERROR_CANCELLED: return "cancelled";
    default: return "an unknown error";
  }
}

// Throws the error that Embree has noted on this thread since the last query; for a null device, the reason why there is none.
void throw_noted_error(RTCDevice device, const char* doing) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE && device != nullptr) return;
  throw Error("", std::string(doing) + ", Embree reports: " + text_of(error),
              error == RTC_ERROR_OUT_OF_MEMORY ? "give it more memory, or fewer triangles" : "");
}

}  // namespace

float unit_of_size(float size) {
  const auto steps = [&] { return std::clamp(static_cast<int>(std::lround(std::ilogb(size) / 16.0)), -7, 7); };  // 2^128 exceeds float
  return size > 0 ? std::ldexp(1.0f, -16 * steps()) : 1.0f;
}

void RayScene::Release::operator()(RTCDevice device) const { rtcReleaseDevice(device); }
void RayScene::Release::operator()(RTCScene scene) const { rtcReleaseScene(scene); }

// Cut-out materials: discards hits whose alpha is below the cutoff.
struct RayScene::AlphaTest {
  const Scene* scene;
  const Mesh* mesh;

  static void filter(const RTCFilterFunctionNArguments* args) {
    const auto& self = *static_cast<const AlphaTest*>(args->geometryUserPtr);
    for (unsigned i = 0; i < args->N; ++i) {
      if (args->valid[i] == 0) continue;
      const float u = RTCHitN_u(args->hit, args->N, i), v = RTCHitN_v(args->hit, args->N, i);
      const unsigned triangle = RTCHitN_primID(args->hit, args->N, i);
      const SurfaceMaterial& material = self.scene->materials[static_cast<std::size_t>(self.mesh->material)];
      if (base_color_at(*self.scene, *self.mesh, triangle, u, v).w < material.alpha_cutoff) args->valid[i] = 0;
    }
  }
};

namespace {

unsigned mask_of(const Mesh& mesh, const Scene& scene) {
  if (mesh.is_light_shape || !mesh.casts_shadow) return kSeenByCamera | (light_passes(scene, mesh) ? kClear : kLight);
  const bool cut_out = scene.materials[static_cast<std::size_t>(mesh.material)].alpha_mode == AlphaMode::mask;
  return kSeenByCamera | kCastsShadow | (cut_out ? kCutOut : kHasEdges);
}

unsigned mask_of(Casters casters) {
  switch (casters) {
    case Casters::with_edges: return kHasEdges;
    case Casters::cut_outs: return kCutOut;
    case Casters::and_lights: return kCastsShadow | kLight;
    case Casters::clear: return kClear;
    case Casters::all: break;
  }
  return kCastsShadow;
}

bool holds(RTCGeometry geometry, const std::vector<std::uint32_t>& indices) {
  return std::memcmp(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_INDEX, 0), indices.data(),
                     indices.size() * sizeof(std::uint32_t)) == 0;
}

float reach_of(const Scene& scene) {
  float reach = 0;
  for (const Mesh& mesh : scene.meshes)
    for (const Vec3f& p : mesh.positions) reach = std::max({reach, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  return reach;
}

// Multiplies arrays of sixteen rays.
void multiply(std::initializer_list<float*> numbers, float by) {
  if (by == 1) return;
  for (float* sixteen : numbers)
    for (std::size_t i = 0; i < 16; ++i) sixteen[i] *= by;
}

// Gives an unused lane finite numbers and an empty interval. If the processor has no packets of sixteen, Embree splits them, and its halves
// must be valid rays in every lane.
void disable(RTCRay16& rays, std::size_t lane) {
  rays.org_x[lane] = rays.org_y[lane] = rays.org_z[lane] = rays.dir_x[lane] = rays.dir_y[lane] = rays.time[lane] = 0;
  rays.dir_z[lane] = rays.tnear[lane] = 1;
  rays.tfar[lane] = 0;
  rays.mask[lane] = rays.id[lane] = rays.flags[lane] = 0;
}

}  // namespace

RayScene::RayScene(const Scene& scene, Lasts lasts) : device_(rtcNewDevice("")) {
  throw_noted_error(device_.get(), "starting");
  rtc_.reset(rtcNewScene(device_.get()));
  // Robust: without it, one in seven of the paths through sides and corners of a closed mesh leaves the mesh.
  rtcSetSceneFlags(rtc_.get(), lasts == Lasts::many_scenes ? RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC : RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(rtc_.get(), RTC_BUILD_QUALITY_MEDIUM);
  follow(scene);
}

void RayScene::put_vertices(RTCGeometry geometry, const Mesh& mesh) const {
  auto* vertices = static_cast<Vec3f*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0));
  std::transform(mesh.positions.begin(), mesh.positions.end(), vertices, [&](Vec3f p) { return p * unit_; });
}

bool RayScene::has_vertices(RTCGeometry geometry, const Mesh& mesh) const {
  return std::equal(mesh.positions.begin(), mesh.positions.end(),
                    static_cast<const Vec3f*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0)),
                    [&](Vec3f p, Vec3f q) { return p * unit_ == q; });
}

void RayScene::make(unsigned number, const Mesh& mesh) {
  Part& part = parts_[number];
  const std::unique_ptr<RTCGeometryTy, decltype(&rtcReleaseGeometry)> owned(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE),
                                                                            &rtcReleaseGeometry);
  throw_noted_error(device_.get(), "making a mesh");
  new_buffer(owned.get(), RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, sizeof(Vec3f), mesh.positions.size());
  put_vertices(owned.get(), mesh);
  std::memcpy(new_buffer(owned.get(), RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh.triangle_count()),
              mesh.indices.data(), mesh.indices.size() * sizeof(std::uint32_t));
  rtcAttachGeometryByID(rtc_.get(), owned.get(), number);
  part.geometry = owned.get();
  part.vertices = mesh.positions.size();
  part.triangles = mesh.triangle_count();
}

bool RayScene::put(unsigned number, const Mesh& mesh, const Scene& scene) {
  Part& part = parts_[number];
  const unsigned mask = mesh.indices.empty() ? 0 : mask_of(mesh, scene);
  const bool same_corners = part.geometry != nullptr && part.vertices == mesh.positions.size() && part.triangles == mesh.triangle_count() &&
                            holds(part.geometry, mesh.indices);
  bool changed = part.mask != mask;
  if (part.geometry != nullptr && !same_corners) {
    rtcDetachGeometry(rtc_.get(), number);
    part = {};
    changed = true;
  }
  if (mask != 0 && part.geometry == nullptr) {
    make(number, mesh);
    changed = true;
  } else if (mask != 0 && !has_vertices(part.geometry, mesh)) {
    put_vertices(part.geometry, mesh);
    rtcUpdateGeometryBuffer(part.geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    changed = true;
  }
  part.mask = mask;
  if ((mask & kCutOut) != 0) {
    // Another scene has its materials elsewhere, even if the triangles are the same.
    if (part.alpha == nullptr) {
      part.alpha = std::make_unique<AlphaTest>();
      rtcSetGeometryIntersectFilterFunction(part.geometry, AlphaTest::filter);
      rtcSetGeometryOccludedFilterFunction(part.geometry, AlphaTest::filter);
      rtcSetGeometryUserData(part.geometry, part.alpha.get());
    }
    *part.alpha = {&scene, &mesh};
  } else if (part.alpha != nullptr) {
    rtcSetGeometryIntersectFilterFunction(part.geometry, nullptr);
    rtcSetGeometryOccludedFilterFunction(part.geometry, nullptr);
    part.alpha.reset();
  }
  if (changed && part.geometry != nullptr) {
    rtcSetGeometryMask(part.geometry, mask);
    rtcCommitGeometry(part.geometry);
  }
  return changed;
}

bool RayScene::follow(const Scene& scene) {
  bool any = parts_.empty(), edges = false;
  reach_ = reach_of(scene);
  unit_ = unit_of_size(reach_);
  parts_.resize(std::max(parts_.size(), scene.meshes.size()));
  const Mesh nothing;
  for (unsigned i = 0; i < parts_.size(); ++i) {
    const unsigned before = parts_[i].mask;
    if (!put(i, i < scene.meshes.size() ? scene.meshes[i] : nothing, scene)) continue;
    any = true;
    edges |= ((before | parts_[i].mask) & kHasEdges) != 0;
  }
  parts_.resize(scene.meshes.size());
  if (any) rtcCommitScene(rtc_.get());
  throw_noted_error(device_.get(), "ordering the triangles");
  return edges;
}

RayScene::~RayScene() = default;

void RayScene::intersect(const int valid[16], RTCRayHit16& rays, Order order) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = order == Order::scattered ? RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT : RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  RTCRay16& r = rays.ray;
  const auto numbers = {r.org_x, r.org_y, r.org_z, r.tnear, r.tfar};
  multiply(numbers, unit_);
  alignas(64) float ends[16];
  std::copy_n(r.tfar, 16, ends);
  for (std::size_t i = 0; i < 16; ++i)
    if (valid[i] == 0) r.tfar[i] = -1;  // an empty interval, as in disable()
  rtcIntersect16(valid, rtc_.get(), &context, &rays);
  for (std::size_t i = 0; i < 16; ++i)
    if (valid[i] == 0) r.tfar[i] = ends[i];
  multiply(numbers, 1 / unit_);
}

bool RayScene::intersect(Vec3f origin, Vec3f direction, RTCRayHit& hit) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  origin = origin * unit_;
  hit.ray = {origin.x,      origin.y, origin.z, 0.0f, direction.x, direction.y, direction.z, 0.0f, std::numeric_limits<float>::infinity(),
             kSeenByCamera, 0,        0};
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(rtc_.get(), &context, &hit);
  hit.ray.tfar /= unit_;
  return hit.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

bool RayScene::blocked(Vec3f from, Vec3f direction, float near, float far, unsigned mask) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = {from.x, from.y, from.z, near, direction.x, direction.y, direction.z, 0.0f, far, mask, 0, 0};
  rtcOccluded1(rtc_.get(), &context, &ray);
  return ray.tfar < 0;  // Embree's sign for a hit
}

bool RayScene::occluded(Vec3f from, Vec3f to) const {
  const Vec3f d = to - from;
  const float distance = length(d);
  const auto offset = [&](Vec3f p) { return static_cast<float>(offset_from_surface(static_cast<Vec3d>(p))); };
  const float near = offset(from) + 1e-4f * std::min(distance, 0.1f * reach_), far = distance * (1.0f - 1e-4f) - offset(to);
  if (!(far > near)) return false;
  return blocked(from * unit_, d / distance, near * unit_, far * unit_, kCastsShadow);
}

bool RayScene::between(Vec3d from, Vec3d to, Casters casters) const {
  return blocked(static_cast<Vec3f>(from) * unit_, static_cast<Vec3f>(to - from) * unit_, 0, 1, mask_of(casters));
}

void RayScene::Sixteen::set(std::size_t i, Vec3d from, Vec3d along) {
  const auto origin = static_cast<Vec3f>(from), direction = static_cast<Vec3f>(along);
  rays.org_x[i] = origin.x;
  rays.org_y[i] = origin.y;
  rays.org_z[i] = origin.z;
  rays.dir_x[i] = direction.x;
  rays.dir_y[i] = direction.y;
  rays.dir_z[i] = direction.z;
}

std::uint32_t RayScene::blocked_among(Sixteen& sixteen, std::uint32_t asked, Casters casters) const {
  if (asked == 0) return 0;
  alignas(64) int valid[16];
  RTCRay16& rays = sixteen.rays;
  for (unsigned i = 0; i < 16; ++i) {
    valid[i] = (asked >> i & 1) != 0 ? -1 : 0;
    rays.tnear[i] = rays.time[i] = 0;
    rays.tfar[i] = 1;
    rays.mask[i] = mask_of(casters);
    rays.id[i] = rays.flags[i] = 0;
    if (valid[i] == 0) disable(rays, i);
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  const auto numbers = {rays.org_x, rays.org_y, rays.org_z, rays.dir_x, rays.dir_y, rays.dir_z};
  multiply(numbers, unit_);
  rtcOccluded16(valid, rtc_.get(), &context, &rays);
  multiply(numbers, 1 / unit_);
  std::uint32_t result = 0;
  for (unsigned i = 0; i < 16; ++i)
    if (valid[i] != 0 && rays.tfar[i] < 0) result |= 1u << i;
  return result;
}

bool RayScene::blocked_towards(Vec3d from, Vec3d direction) const {
  return blocked(static_cast<Vec3f>(from) * unit_, static_cast<Vec3f>(direction), 0, std::numeric_limits<float>::infinity(), kCastsShadow);
}

bool ShadowEdges::suit(const std::vector<AreaLight>& lights) const {
  const std::vector<Body> now = shadow::bodies_of(lights);
  if (now == bodies) return true;
  const bool cut = std::any_of(mesh.inside.begin(), mesh.inside.end(), [](const auto& list) { return !list.empty(); });
  return !cut && !shadow::may_enter(mesh, now);
}

ShadowEdges::Trees::Trees(const shadow::EdgeMesh& mesh) {
  tbb::parallel_invoke([&] { edges.emplace(mesh); }, [&] { triangles.emplace(mesh); });
}

SceneParts SceneParts::of(const Scene& scene, Sorted sorted) {
  return {std::make_shared<const RayScene>(scene),
          sorted == Sorted::for_rays_and_edges ? std::make_shared<const ShadowEdges>(scene) : nullptr,
          std::make_shared<const MipMaps>(scene.images)};
}

SceneParts RenderCache::Parts::follow(const Scene& scene, Sorted sorted) {
  if (rays == nullptr) {
    rays = std::make_shared<RayScene>(scene, RayScene::Lasts::many_scenes);
  } else {
    try {
      if (shadows != nullptr && !shadows->suit(scene.area_lights)) shadows.reset();
      if (rays->follow(scene)) {
        shadows.reset();
        device_rays.reset();
      }
    } catch (...) {  // a half-finished state is of no use
      rays.reset();
      shadows.reset();
      device_rays.reset();
      throw;
    }
  }
  if (sorted == Sorted::for_rays_and_edges && shadows == nullptr) shadows = std::make_shared<const ShadowEdges>(scene);
  return {rays, sorted == Sorted::for_rays_and_edges ? shadows : nullptr, std::make_shared<const MipMaps>(scene.images, pyramids)};
}

RenderCache::RenderCache() : parts_(std::make_unique<Parts>()) {}
RenderCache::~RenderCache() = default;
RenderCache::RenderCache(RenderCache&&) noexcept = default;
RenderCache& RenderCache::operator=(RenderCache&&) noexcept = default;

}  // namespace steradian
