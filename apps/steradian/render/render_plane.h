// render SCENE.svg: renders a picture of the plane.
#pragma once

#include <map>
#include <string>

#include "part.h"
#include "steradian/plane_bounce.h"
#include "steradian/tone.h"

namespace steradian::app {

struct PlaneRender {
  std::string scene, output, method, stats;  // method "auto" means exact
  PlaneFrameOptions frame;
  float exposure = 0;
  ToneCurve tone = ToneCurve::neutral;
  int bounces = 0;          // kAllBounces: all
  double lattice = 0;       // PlaneFrameOptions::bounce_lattice
  std::string normal_map;   // a picture of this normal map is lit instead; empty: none
  double lamp_height = 45;  // height of the lamp over the normal map, in degrees
  std::string frames;       // A..B; empty: one picture
  Part part;                // renders every part.count-th frame
  std::string edits;        // JSON file of edits, for frames
  double fps = 24;          // frames per second of an animated drawing
  bool force = false;       // for frames: renders existing frames again
  bool vulkan = false;
  std::string device;  // device for vulkan
  Limits limits;
};

bool is_plane_scene(const std::string& path);  // by its ending, .svg
void render_plane_scene(const PlaneRender& job);

}  // namespace steradian::app
