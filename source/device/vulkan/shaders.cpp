#include "device/vulkan/shaders.h"

namespace steradian::vulkan {
namespace {

// Written by glslc: cmake/shaders.cmake.
constexpr std::uint32_t kDiffuse[] =
#include "diffuse.comp.inc"
    ;
constexpr std::uint32_t kLtc[] =
#include "ltc.comp.inc"
    ;
constexpr std::uint32_t kClosedForm[] =
#include "closed_form.comp.inc"
    ;
constexpr std::uint32_t kRepresentativePoint[] =
#include "representative_point.comp.inc"
    ;
constexpr std::uint32_t kSheen[] =
#include "sheen.comp.inc"
    ;
constexpr std::uint32_t kLtcClipless[] =
#include "ltc_clipless.comp.inc"
    ;
constexpr std::uint32_t kHalfVector[] =
#include "half_vector.comp.inc"
    ;
constexpr std::uint32_t kTextureMeans[] =
#include "texture_means.comp.inc"
    ;
constexpr std::uint32_t kPhongLobe[] =
#include "phong_lobe.comp.inc"
    ;
constexpr std::uint32_t kShadowParts[] =
#include "shadow_parts.comp.inc"
    ;
constexpr std::uint32_t kShadowRays[] =
#include "shadow_rays.comp.inc"
    ;
constexpr std::uint32_t kShadowShares[] =
#include "shadow_shares.comp.inc"
    ;
constexpr std::uint32_t kBounceRays[] =
#include "bounce_rays.comp.inc"
    ;
constexpr std::uint32_t kBounceLobes[] =
#include "bounce_lobes.comp.inc"
    ;
constexpr std::uint32_t kBounceBoxes[] =
#include "bounce_boxes.comp.inc"
    ;
constexpr std::uint32_t kBounceCull[] =
#include "bounce_cull.comp.inc"
    ;
constexpr std::uint32_t kBounceLight[] =
#include "bounce_light.comp.inc"
    ;
constexpr std::uint32_t kBounceFilter[] =
#include "bounce_filter.comp.inc"
    ;
constexpr std::uint32_t kBounceResolve[] =
#include "bounce_resolve.comp.inc"
    ;

constexpr std::uint32_t kVisibilityVertex[] =
#include "visibility.vert.inc"
    ;
constexpr std::uint32_t kVisibilityFragment[] =
#include "visibility.frag.inc"
    ;
constexpr std::uint32_t kResolve[] =
#include "resolve.comp.inc"
    ;

}  // namespace

std::span<const std::uint32_t> diffuse_shader() { return kDiffuse; }
std::span<const std::uint32_t> ltc_shader() { return kLtc; }
std::span<const std::uint32_t> closed_form_shader() { return kClosedForm; }
std::span<const std::uint32_t> representative_point_shader() { return kRepresentativePoint; }
std::span<const std::uint32_t> sheen_shader() { return kSheen; }
std::span<const std::uint32_t> ltc_clipless_shader() { return kLtcClipless; }
std::span<const std::uint32_t> half_vector_shader() { return kHalfVector; }
std::span<const std::uint32_t> texture_means_shader() { return kTextureMeans; }
std::span<const std::uint32_t> phong_lobe_shader() { return kPhongLobe; }
std::vector<std::span<const std::uint32_t>> shadow_shaders() { return {kShadowParts, kShadowRays}; }
std::span<const std::uint32_t> shadow_shares_shader() { return kShadowShares; }
std::span<const std::uint32_t> bounce_rays_shader() { return kBounceRays; }
std::span<const std::uint32_t> bounce_lobes_shader() { return kBounceLobes; }
std::vector<std::span<const std::uint32_t>> bounce_shaders() {
  return {kBounceBoxes, kBounceCull, kBounceLight, kBounceFilter, kBounceResolve};
}
std::span<const std::uint32_t> visibility_vertex_shader() { return kVisibilityVertex; }
std::span<const std::uint32_t> visibility_fragment_shader() { return kVisibilityFragment; }
std::span<const std::uint32_t> resolve_shader() { return kResolve; }

}  // namespace steradian::vulkan
