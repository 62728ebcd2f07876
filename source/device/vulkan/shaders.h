// The shaders of shaders/, compiled at build time and part of the program.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace steradian::vulkan {

// Direct light: the diffuse lobe, GGX by each family of methods, sheen.
std::span<const std::uint32_t> diffuse_shader();
std::span<const std::uint32_t> ltc_shader();
std::span<const std::uint32_t> closed_form_shader();
std::span<const std::uint32_t> representative_point_shader();
std::span<const std::uint32_t> sheen_shader();
std::span<const std::uint32_t> ltc_clipless_shader();
std::span<const std::uint32_t> half_vector_shader();
// Means of textured lights, for lobes.
std::span<const std::uint32_t> texture_means_shader();
// Lobes of extras.steradian.
std::span<const std::uint32_t> phong_lobe_shader();
// Visible parts of lights behind edges, and the test that the way there is free.
std::vector<std::span<const std::uint32_t>> shadow_shaders();
// Light of partly occluded round lights.
std::span<const std::uint32_t> shadow_shares_shader();

// The bounce: first hits of the shadow map's rays; lobes of virtual lights; boxes, culling, lighting, filter, resolve.
std::span<const std::uint32_t> bounce_rays_shader();
std::span<const std::uint32_t> bounce_lobes_shader();
std::vector<std::span<const std::uint32_t>> bounce_shaders();
std::span<const std::uint32_t> visibility_vertex_shader();
std::span<const std::uint32_t> visibility_fragment_shader();
std::span<const std::uint32_t> resolve_shader();

}  // namespace steradian::vulkan
