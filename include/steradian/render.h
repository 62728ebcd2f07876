// render: a scene to a picture, on the CPU or on a Vulkan device.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "steradian/indirect.h"
#include "steradian/method.h"
#include "steradian/picture.h"
#include "steradian/scene.h"

namespace steradian {

// Of direct light. on: exact from flat lights, from round ones by polygons of 24 corners, and by rays where a point sees more than
// 512 edges before a light (RenderStats::shadow_fallback says how often). exact: never by rays.
enum class Shadows { off, on, exact };

// Where curved surfaces turn away from a light. strict: as their triangles stand, facets included. smooth: as the surface that the
// vertices' normals describe; points are lit from there, and no triangle hides what lies below its own horizon.
enum class Terminator { strict, smooth };

// How area lights add up. all: each by itself at every pixel. tree: the diffuse light of those far from a group of neighbouring pixels
// together, within a bound; see docs/manylights.md. automatic: tree from 64 lights on.
enum class LightSum { automatic, all, tree };

// vulkan: the same picture; direct light of metallic-roughness surfaces where nothing blocks it on a device, the rest on the host
// (docs/vulkan.md). The bounce is a UsageError there, a device that is not there an Error.
enum class Backend { cpu, vulkan };

struct RenderOptions {
  int width = 1280;
  int height = 720;
  std::string camera;                 // name; empty: the first
  std::string method = "auto";        // of the specular lobe: a name of `render --help`
  std::string table;                  // of method ltc: a file of fit's in place of the shipped table of GGX; empty: the shipped one
  Quality quality = Quality::normal;  // see method.h
  Shadows shadows = Shadows::off;
  Terminator terminator = Terminator::strict;  // of shadows; without them it has no effect
  LightSum lights = LightSum::automatic;
  double light_error = 1e-2;   // of tree: of each light, as a share of what it sends to a surface that faces it as nearly as possible
  bool background = true;      // the camera sees the scene's environment; false: black
  int aa = 1;                  // primary samples a pixel, at the same places in every pixel
  int spp = 16;                // of `sampled`: light and lobe sample pairs per light and primary sample
  double target_error = 0.01;  // of `reference`: rms of the standard error over rms of the picture; 0: `spp` pairs in every pixel
  IndirectOptions indirect;    // one bounce, at the first primary sample of each pixel; see indirect.h
  std::uint64_t seed = 1;
  Backend backend = Backend::cpu;
  std::string device;  // of vulkan: part of its name, or its number in `steradian info`; empty: the first
  int threads = 0;     // 0: all
  std::function<void(std::uint64_t done, std::uint64_t total)> progress;  // called from any thread
  const std::atomic<bool>* stop = nullptr;                                // once true, render returns soon with what it has
};

// What a render that was stopped has done, and where another goes on.
struct RenderState {
  Picture picture;                 // of the tiles that are done, without the bounce; black elsewhere
  std::vector<std::uint8_t> done;  // by tile of 32 pixels a side, row by row; empty: nothing is done
  bool complete = false;           // what render returned is the whole picture
};

struct PassTime {
  std::string name;
  double ms = 0;  // thread time over threads
};

struct RenderStats {
  std::vector<PassTime> passes;
  double total_ms = 0;
  int threads = 0;
  std::string method;  // what `auto` became
  std::string device = "cpu";
  std::size_t lights = 0;
  std::size_t triangles = 0;
  double environment_spots = 0;       // share of the environment's light that polygon lights carry
  double diffuse_residual = 0;        // bound of the rms error of the rest's irradiance over its mean
  bool light_tree = false;            // many lights were added up together; the layer "light_bound" says how far each pixel may be off
  double light_elements = 0;          // lights that were one or four elements at a point by themselves, on average over diffuse points
  double light_outlines = 0;          // and that were walked around
  double light_bound_max = 0;         // the layer's largest value ...
  double light_bound_mean = 0;        // ... and its mean, over pixels and channels
  double shadow_fallback = 0;         // share of pairs of a surface and a light whose shadows rays have estimated
  double shadow_on_host = 0;          // of a device's pairs that see a part of the light: share of which the host found that part
  std::vector<std::string> warnings;  // what the method leaves out, a sentence each
};

// Throws Error for a camera that is not there and for a method that does not serve a lobe of the scene.
// The same scene, options and seed give the same bytes at any number of threads.
// state: tiles that are done are taken from it, and what is done when options.stop becomes true is left there; gone on with later, the same
// scene and options give the same bytes as in one go. Throws Error for a state of another size.
Picture render(const Scene& scene, const RenderOptions& options, RenderStats* stats = nullptr, RenderState* state = nullptr);

}  // namespace steradian
