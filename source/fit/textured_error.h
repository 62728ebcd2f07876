// Error of the look-up of a textured light against the integral of texture times lobe: the table of docs/theory/ltc.md.
#pragma once

#include <string>
#include <vector>

#include "steradian/texture.h"

namespace steradian::fit {

// gradient: one ramp. checker: 8 x 8 squares. noise: power falls as 1/frequency^2, as photographs' does.
struct NamedImage {
  std::string name;
  Image image;
};
const std::vector<NamedImage>& test_textures();

struct TexturedErrorRow {
  double roughness = 0;       // of GGX with F = 1; 0: a diffuse surface
  double distance = 0;        // of the light's centre, in its sides
  std::vector<double> error;  // relative L2 of the radiance over all setups, by texture
  std::vector<double> mean;   // error of the light's mean radiance instead of the look-up
  std::vector<double> level;  // error of the published look-up: one round Gaussian, whose width follows the distance under M^-1
  std::vector<double> bias;   // ratio of the sums, minus 1
};

struct TexturedErrorOptions {
  int setups = 64;    // per row: square lights of random place, tilt and turn about the mirror direction
  int samples = 128;  // a side, of the lobe and of the light each
  int distances = 3;
};

std::vector<TexturedErrorRow> measure_textured_error(const TexturedErrorOptions& options);

// Formats the rows as Markdown.
std::string textured_error_text(const std::vector<TexturedErrorRow>& rows);

}  // namespace steradian::fit
