// render: a scene to a picture, on the CPU or on a Vulkan device.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "steradian/bounces.h"
#include "steradian/indirect.h"
#include "steradian/method.h"
#include "steradian/picture.h"
#include "steradian/scene.h"

namespace steradian {

// Shadows of direct light. on: exact for flat lights, for round ones by polygons of 24 corners. A point with more than 2,048 segments
// before a light takes rays (RenderStats::shadow_fallback says how often). exact: never by rays.
enum class Shadows { off, on, exact };

// Horizon of curved surfaces that turn away from a light. strict: that of their triangles, facets included. smooth: that of the surface
// that the vertices' normals describe. Points are lit from there, and no triangle occludes what lies below its own horizon.
enum class Terminator { strict, smooth };

// Summation of area lights. all: each separately at every pixel. tree: the diffuse light of lights far from a group of neighbouring pixels
// is summed together, within a bound; see docs/manylights.md. automatic: tree from 64 lights on.
enum class LightSum { automatic, all, tree };

// vulkan: the same picture. The device renders all of it, or the CPU does and RenderStats::warnings names the reason (docs/vulkan.md).
// A missing device is an Error.
enum class Backend { cpu, vulkan };

// One of several parts of a picture: every `count`-th of its squares of 128 x 128 pixels, row by row.
struct PicturePart {
  static constexpr int kSide = 128;
  int number = 1;  // from 1 on
  int count = 1;

  bool holds(int x, int y, int width) const {
    const std::int64_t across = (width + kSide - 1) / kSide;
    return (y / kSide * across + x / kSide) % count == number - 1;
  }
};

struct RenderOptions {
  int width = 1280;
  int height = 720;
  std::string camera;                   // name; empty: the first
  std::string method = "auto";          // for the specular lobe: a name of `render --help`
  std::string table;                    // for methods ltc, sampled, reference: a file of fit's in the place of GGX; empty: GGX
  Quality quality = Quality::normal;    // see method.h
  PeakForm peak_form = PeakForm::best;  // as RadianceOptions, and so is early_stop
  double early_stop = 0;
  Shadows shadows = Shadows::off;
  Terminator terminator = Terminator::smooth;  // of shadows; without them it has no effect
  // Shadows of a tile's dimmest area lights may be estimated by a few rays, if together they send at most this fraction of each pixel's
  // light. The layer "shadow_bound" gives the possible error. 0: all shadows are exact. With `on` only, and from eight area lights on.
  double shadow_error = 1e-3;
  LightSum lights = LightSum::automatic;
  double light_error = 1e-2;   // for tree: for each light, as a fraction of its light on a surface that faces it as nearly as possible
  bool background = true;      // the camera sees the scene's environment; false: black
  int aa = 1;                  // primary samples a pixel, at the same places in every pixel
  int spp = 16;                // for `sampled`: light and lobe sample pairs per light and primary sample
  double target_error = 0.01;  // for `reference`: rms of the standard error over rms of the picture; 0: `spp` pairs in every pixel
  // Seconds from the start of render; 0: no limit. It has no effect with bounces. With a limit, a few rays estimate the shadows first.
  // Tiles then become exact, the least certain first, until the time is over. The layer "shadow_bound" gives each pixel's possible error
  // (docs/time-limit.md).
  double time_limit = 0;
  // Light that other surfaces send, after this number of bounces at most (kAllBounces: any number). Excludes `indirect`.
  int bounces = 0;
  double bounce_error = 0;     // with bounces: standard error of a pixel over the scene's mean light, as far as 16 times the rays reach
  bool bounce_strict = false;  // with bounces: each pixel gathers by itself, in 16 times the directions
  // With bounces: the layers "lower" and "upper" enclose the picture by a proof, and "bounce_bound" is how far it may be from either. For
  // scenes of flat diffuse surfaces and polygon lights only; others are an Error (docs/bounds.md).
  bool bound = false;
  int reflections = 2;          // with bounces: number of mirrors in a row that show what they face
  bool bounce_preview = false;  // with bounces: few patches and directions, for pictures that are shown for a moment (docs/view.md)
  PicturePart part;          // the rest of the picture stays black; on the CPU, without `indirect`, mirrors of bounces and a limit of time
  IndirectOptions indirect;  // one bounce, at the first primary sample of each pixel; see indirect.h
  std::uint64_t seed = 1;
  Backend backend = Backend::cpu;
  std::string device;  // for vulkan: part of its name, or its number in `steradian info`; empty: the first
  int threads = 0;     // 0: all
  std::function<void(std::uint64_t done, std::uint64_t total)> progress;  // called from any thread
  const std::atomic<bool>* stop = nullptr;                                // once true, render soon returns its partial result
};

// Result of a stopped render, from which another can continue.
struct RenderState {
  Picture picture;                 // the finished tiles, without the bounce; black elsewhere
  std::vector<std::uint8_t> done;  // by tile of 32 pixels a side, row by row; empty: nothing is done
  bool complete = false;           // true if render returned the whole picture
};

struct PassTime {
  std::string name;
  double ms = 0;  // thread time over threads
};

struct RenderStats {
  std::vector<PassTime> passes;
  double total_ms = 0;
  int threads = 0;
  std::string method;  // the method that `auto` selected
  std::string device = "cpu";
  std::size_t lights = 0;
  std::size_t triangles = 0;
  double environment_spots = 0;  // fraction of the environment's light that polygon lights carry
  double diffuse_residual = 0;   // bound of the rms error of the rest's irradiance over its mean
  double specular_residual = 0;  // rms error of the rest's light on rough metal over the mean of all the map's (docs/environments.md)
  double environment_shadow_error = 0;  // rms error of the shadows of the rest's light over its mean; 0 where no ray is blocked
  std::size_t patches = 0;              // that carry light from surface to surface (docs/bounces.md)
  int bounce_iterations = 0;            // over all patches
  std::uint64_t patch_rays = 0;         // traced from patch to patch; a RenderCache keeps most of them when only lights change
  double bounce_glossy = 0;             // fraction of the light between surfaces that glossy lobes send on
  double bounce_glossy_evenly = 0;      // fraction that they send evenly to all directions: right in its power, not in its places
  double bounce_left_out = 0;           // bound of the radiance that further bounces would add; negative: none is known
  double bounce_error = 0;              // estimated rms error of the light between surfaces over the picture's mean
  std::size_t bound_elements = 0;       // that carry the bounds of RenderOptions::bound; 0: there are none
  double bound_mean = 0;                // half the mean distance between the bounds over the picture's mean light
  double bound_inside = 1;              // fraction of the pixels that lie between them
  bool light_tree = false;              // many lights were summed together; the layer "light_bound" gives each pixel's possible error
  double light_elements = 0;            // lights that were one or four elements at a point by themselves, on average over diffuse points
  double light_outlines = 0;            // and lights whose outline was walked
  double light_bound_max = 0;           // the layer's largest value ...
  double light_bound_mean = 0;          // ... and its mean, over pixels and channels
  double shadow_fallback = 0;           // fraction of pairs of a surface and a light whose shadows rays have estimated
  double shadows_estimated = 0;         // fraction of such pairs of dim lights, within RenderOptions::shadow_error
  double exact_tiles = 1;               // fraction of the tiles that are exact, where time was limited
  double estimated_shadow_error = 0;    // estimated rms error of the others over the picture's mean light
  double shadow_on_host = 0;            // fraction of a device's pairs that see a part of the light for which the host found that part
  // A device's pairs of a surface and a light whose edges it has searched: pairs without a segment, then pairs in each space of segments.
  std::vector<std::uint64_t> shadow_pairs;
  std::uint64_t shadow_looks = 0;                  // number of edges that these pairs have looked at
  std::array<std::uint64_t, 2> shadow_gathered{};  // nodes and leaves of edges that groups of pixels met
  // Sums of each space on a software device: edges, segments, pairs of segments whose boxes meet, those of them that floats leave open, all
  // pairs of segments (a segment with itself as well), and turns of 64 lanes that look at eight segments each.
  std::vector<std::vector<std::uint64_t>> shadow_work;
  std::uint64_t submissions = 0;      // of work to the device
  std::vector<std::string> warnings;  // omissions of the method, a sentence each
};

// Renders a scene. Throws Error for a missing camera and for a method that does not serve a lobe of the scene. The same scene, options and
// seed give the same bytes at any number of threads. state: finished tiles are taken from it. When options.stop becomes true, the finished
// tiles are stored there. If the render is continued later, the same scene and options give the same bytes as in one go. Throws Error for a
// state of another size.
Picture render(const Scene& scene, const RenderOptions& options, RenderStats* stats = nullptr, RenderState* state = nullptr);

}  // namespace steradian
