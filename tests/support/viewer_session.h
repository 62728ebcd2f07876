// Helpers for the tests of a session: a small room and simulated input.
#pragma once

#include <string>

#include "paths.h"
#include "session.h"

namespace steradian::view {

inline RenderOptions small() {
  RenderOptions options;
  options.width = 160;
  options.height = 90;
  options.shadows = Shadows::on;
  return options;
}

inline std::string room() { return test::kSourceDir + "/scenes/diffuse_floor.glb"; }

inline Vec2d pixel_of(Session& s, Vec3d point) { return *project(s.camera().camera(), point, s.options().width, s.options().height); }

inline void drag(Session& s, Vec2d from, Vec2d to) {
  s.press(PointerButton::left, false, from);
  for (int i = 1; i <= 4; ++i) {
    s.drag(from + (to - from) * (i / 4.0));
    s.update();
  }
  s.release(to);
}

}  // namespace steradian::view
