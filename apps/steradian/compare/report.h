// The results of `compare`, written as report.json and as a self-contained page.
#pragma once

#include <string>
#include <vector>

#include "steradian/compare.h"
#include "steradian/picture.h"
#include "steradian/render.h"

namespace steradian::app {

// One method at one setting.
struct Run {
  std::string method, setting;  // setting: "normal", "64 spp"
  double ms = 0;
  Difference difference;
};

struct ComparedPicture {
  Run run;
  Picture picture;
  std::vector<PassTime> passes;
  double flip = 0;                // mean
  std::vector<float> flip_error;  // one value per pixel
};

struct ComparisonReport {
  std::string scene, command;
  std::string reference_words;  // description of the reference for people
  Picture reference;
  double reference_ms = 0;
  double reference_error = 0;  // error of the reference itself, as relative L2; 0: negligible
  float exposure = 0;
  double white = 0;  // upper bound of all but a thousandth of the reference's channels
  std::vector<ComparedPicture> methods;
  double time_limit = 0;                 // seconds; 0: none
  std::vector<std::string> did_not_fit;  // methods that have no picture, and "METHOD at SETTING"
  std::vector<Run> over_time;            // each method's settings, including those of `methods`
};

std::string report_json(const ComparisonReport& report);
std::string report_page(const ComparisonReport& report);

}  // namespace steradian::app
