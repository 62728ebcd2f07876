#include "device/plane/shaders.h"

namespace steradian::plane {
namespace {

// Written by glslc: cmake/shaders.cmake.
constexpr std::uint32_t kDisks[] =
#include "plane_disks.comp.inc"
    ;
constexpr std::uint32_t kCuts[] =
#include "plane_cuts.comp.inc"
    ;
constexpr std::uint32_t kArcs[] =
#include "plane_arcs.comp.inc"
    ;
constexpr std::uint32_t kListed[] =
#include "plane_listed.comp.inc"
    ;
constexpr std::uint32_t kLists[] =
#include "plane_lists.comp.inc"
    ;

}  // namespace

std::vector<std::span<const std::uint32_t>> plane_shaders() { return {kDisks, kCuts, kArcs, kListed, kLists}; }

}  // namespace steradian::plane
