// Number of bounces of light from surface to surface.
#pragma once

namespace steradian {

inline constexpr int kAllBounces = -1;  // every bounce

}  // namespace steradian
