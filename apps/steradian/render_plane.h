// render SCENE.svg: a picture of the plane.
#pragma once

#include <map>
#include <string>

#include "steradian/plane_bounce.h"
#include "steradian/tone.h"

namespace steradian::app {

struct PlaneRender {
  std::string scene, output, method, stats;  // method "auto" is exact
  PlaneFrameOptions frame;
  float exposure = 0;
  ToneCurve tone = ToneCurve::neutral;
  int bounces = 0;          // kAllBounces: all
  double lattice = 0;       // PlaneFrameOptions::bounce_lattice
  std::string normal_map;   // a picture of it is lit instead; empty: none
  double lamp_height = 45;  // of it, in degrees
  std::string frames;       // A..B; empty: one picture
  std::string edits;        // of frames
  double fps = 24;          // of frames: of a drawing that moves
  bool force = false;       // of frames: those that are there already, too
  bool vulkan = false;
  std::string device;  // of vulkan
  Limits limits;
};

bool is_plane_scene(const std::string& path);  // by its ending, .svg
void render_plane_scene(const PlaneRender& job);

}  // namespace steradian::app
