// Tables for lobes of one's own: a lobe is a function, or measured; its table, of linearly transformed cosines, goes into a file that
// `render
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

// BRDF times the cosine of the light, for one view, in double. Frame: z the surface normal, the view (sin, 0, cos) in the plane of x and z.
// Symmetric in y.
struct LobeFunction {
  Vec3d view;
  // BRDF without Fresnel times l_z for a unit l; 0 below the horizon.
  std::function<double(Vec3d l)> evaluate;
  // A direction for a point of the unit square [0, 1)^2. The map is smooth, its azimuth grows with b, and
  // sample(a, 1 - b) is sample(a, b) mirrored in y. May point below the horizon. Empty: by the cosine, which does for
  // broad lobes; of a narrow one, next to no sample would be where the lobe is.
  std::function<Vec3d(double a, double b)> sample;
  // Density of sample per solid angle, wherever sample may point, below the horizon included. Empty with sample.
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
  // Of a lobe that is the same for every roughness: that of the GGX lobe about as wide. A table then repeats one column.
  std::optional<double> fixed_roughness{};
};

// What the fit came to, over the table's nodes: integral of |lobe - fit| over the lobe's albedo; 2 is no overlap.
struct LobeFit {
  double mean_error = 0, largest_error = 0;
};

struct LobeFitOptions {
  int size = 64;                    // nodes along roughness and along sqrt(1 - cos theta): 2 to 1024
  int threads = 0;                  // 0: all
  std::function<void()> cell_done;  // called after every node, from any thread
};

// Fits a table and writes it, by the path's ending: .json (what `render --table` reads), .h, .glsl, .dds, .exr; docs/ltc.md.
// The same bytes on any number of threads. Throws Error for other endings and where the file cannot be written.
LobeFit fit_lobe_table(const LobeFamily& family, const std::string& path, const LobeFitOptions& options = {});

// A measured BRDF; values are luminances of f [1/sr].
struct LobeSamples {
  LobeFamily family;  // whole BRDF, diffuse and glossy, Fresnel in it
  Vec3d albedo;       // by channel, for a view along the normal
};

// Reads MERL's binary or a table of angles and values; which, is told from the contents.
//
// MERL's: three 32-bit sizes (90 of the half vector's angle, 90 of the difference angle, 180 of the difference azimuth), then doubles,
// channel by channel, in units of 1/1500, 1.15/1500 and 1.66/1500; negative where nothing was measured. Source: Matusik et al., "A
// data-driven reflectance model", 2003.
//
// A table: lines of `theta_view theta_light azimuth value` or `... red green blue`. Angles in degrees: from the normal, and between the
// azimuths of view and light (0: on one side; 180: opposite, where a mirror would send it). Values f [1/sr]. Every combination of the
// angles that occur, in any order; # begins a comment. Linear between the angles, constant beyond the last.
//
// Throws Error with the file, its line, and what is wrong.
LobeSamples read_lobe_samples(const std::string& path, const Limits& limits = {});

}  // namespace steradian
