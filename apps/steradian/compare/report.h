// What `compare` found, as report.json and as a page that needs nothing else.
#pragma once

#include <string>
#include <vector>

#include "steradian/compare.h"
#include "steradian/picture.h"
#include "steradian/render.h"

namespace steradian::app {

// A method at one setting.
struct Run {
  std::string method, setting;  // setting: "normal", "64 spp"
  double ms = 0;
  Difference difference;
};

struct Compared {
  Run run;
  Picture picture;
  std::vector<PassTime> passes;
  double flip = 0;                // mean
  std::vector<float> flip_error;  // of each pixel
};

struct Report {
  std::string scene, command;
  std::string reference_words;  // what the reference is, for people
  Picture reference;
  double reference_ms = 0;
  double reference_error = 0;  // its own, as relative L2; 0: none worth naming
  float exposure = 0;
  double white = 0;  // what all but a thousandth of the reference's channels stay below
  std::vector<Compared> methods;
  std::vector<Run> over_time;  // each method's settings, those of `methods` among them
};

std::string report_json(const Report& report);
std::string report_page(const Report& report);

}  // namespace steradian::app
