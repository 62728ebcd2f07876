// Tables for custom lobes. A lobe is a function, or measured. Its table of linearly transformed cosines is written to a file that `render
// --table`, `eval` and engines read. Needs the layer `fit` (steradian::fit).
//
//   LobeFamily cloth;
//   cloth.name = "cloth";
//   cloth.at = [](double roughness, double cosine) {
//     LobeFunction lobe;
//     lobe.view = {std::sqrt(1 - cosine * cosine), 0, cosine};
//     lobe.evaluate = [=](Vec3d l) { return l.z > 0 ? my_brdf(roughness, lobe.view, l) * l.z : 0.0; };
//     return lobe;
//   };
//   fit_lobe_table(cloth, "cloth.json");
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "steradian/limits.h"
#include "steradian/vector.h"

namespace steradian {

// BRDF times the cosine of the light, for one view, in double. In its frame, z is the surface normal and the view is (sin, 0, cos) in the
// plane of x and z. The lobe is symmetric in y.
struct LobeFunction {
  Vec3d view;
  // BRDF without Fresnel times l_z for a unit l; 0 below the horizon.
  std::function<double(Vec3d l)> evaluate;
  // A direction for a point of the unit square [0, 1)^2. The map is smooth, its azimuth grows with b, and sample(a, 1 - b) is sample(a, b)
  // mirrored in y. It may point below the horizon. If empty, the cosine is sampled, which suffices for broad lobes; a narrow one would get
  // next to no samples.
  std::function<Vec3d(double a, double b)> sample;
  // Density of sample per solid angle, for all its directions, including those below the horizon. Empty with sample.
  std::function<double(Vec3d l)> pdf;
};

// The frame in which a fitted matrix varies slowly with roughness and view: about the mirror direction of the view for
// a glossy lobe, about the normal for a diffuse one.
enum class LobeFrame { mirror, normal };

// The lobes of one reflection model over perceptual roughness in [0, 1] and the view's cosine.
struct LobeFamily {
  std::string name;  // letters, digits and -: part of names in headers
  LobeFrame frame = LobeFrame::mirror;
  std::function<LobeFunction(double roughness, double cos_theta)> at;
  // Roughness of a lobe that is the same for every roughness: that of the GGX lobe about as wide. A table then repeats one column.
  std::optional<double> fixed_roughness{};
};

// Error of the fit over the table's nodes: integral of |lobe - fit| over the lobe's albedo; 2 is no overlap.
struct LobeFit {
  double mean_error = 0, largest_error = 0;
};

struct LobeFitOptions {
  int size = 64;                    // nodes along roughness and along sqrt(1 - cos theta): 2 to 1024
  int threads = 0;                  // 0: all
  std::function<void()> cell_done;  // called after every node, from any thread
};

// Fits a table and writes it in the format of the path's ending: .json (for `render --table`), .h, .glsl, .dds, .exr; docs/theory/ltc.md.
// The bytes are the same on any number of threads. Throws Error for other endings and if the file cannot be written.
LobeFit fit_lobe_table(const LobeFamily& family, const std::string& path, const LobeFitOptions& options = {});

// A measured BRDF; values are luminances of f [1/sr].
struct LobeSamples {
  LobeFamily family;  // whole BRDF, diffuse and glossy, including Fresnel
  Vec3d albedo;       // by channel, for a view along the normal
};

// Reads MERL's binary or a table of angles and values; the contents decide which.
//
// MERL's: three 32-bit sizes (90 of the half vector's angle, 90 of the difference angle, 180 of the difference azimuth), then doubles,
// channel by channel, in units of 1/1500, 1.15/1500 and 1.66/1500; negative where nothing was measured. Source: Matusik et al., "A
// data-driven reflectance model", 2003.
//
// A table has lines of `theta_view theta_light azimuth value` or `... red green blue`. Angles are in degrees: from the normal, and between
// the azimuths of view and light (0: on one side; 180: opposite, as a mirror reflects). Values are f [1/sr]. Every combination of the
// angles that occur is needed, in any order; # begins a comment. Values are linear between the angles, constant beyond the last.
//
// Throws Error with the file, its line, and the problem.
LobeSamples read_lobe_samples(const std::string& path, const Limits& limits = {});

}  // namespace steradian
