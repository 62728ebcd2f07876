// The functions that JavaScript calls. A plane is a scene with its stage, its world and its bounces, each made when it is first needed.
//
// Every function that may fail returns null or -1 then; plane_problem says why: place, problem, hint, a line each. What is returned stays
// until the next call.
#include <emscripten.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "body_numbers.h"
#include "gl_lists.h"
#include "steradian/error.h"
#include "steradian/plane.h"
#include "steradian/plane_bounce.h"
#include "steradian/plane_stage.h"

namespace steradian::plane {
namespace {

// A page's memory ends at 4 GB, and its user waits.
constexpr Limits kLimits{2'000'000'000, 2'000'000'000};

std::string problem;

template <class Job, class Failed>
auto guarded(Failed failed, const Job& job) -> decltype(job()) {
  try {
    return job();
  } catch (const Error& e) {
    problem = e.place() + "\n" + e.problem() + "\n" + e.hint();
  } catch (const std::bad_alloc&) {
    problem = "plane\nthe page's memory is full\nmake the picture smaller, or the scene";
  } catch (const std::exception& e) {
    problem = std::string("plane\n") + e.what() + "\n";
  }
  return failed;
}

}  // namespace

struct Plane {
  PlaneScene scene;
  std::string ignored, text;
  std::unique_ptr<PlaneStage> stage;      // of the last size that was drawn without bounces
  std::unique_ptr<PlaneWorld> world;      // of the scene as it is
  std::unique_ptr<PlaneBounces> bounces;  // of the world
  int bounce_count = 0;
  int stage_width = 0, stage_height = 0;
  Picture picture;
  GlLists gl;
  std::vector<double> numbers;
  std::vector<float> values;
  double tiles = 0, drawn = 0, error = 0;

  void changed() {
    bounces.reset();
    world.reset();
  }
  const PlaneWorld& ready() {
    if (!world) world = std::make_unique<PlaneWorld>(scene, kLimits);
    return *world;
  }
  const PlaneBounces& bounced(int count) {
    if (!bounces || bounce_count != count) {
      PlaneBounceOptions options;
      options.bounces = count;
      options.limits = kLimits;
      bounces = std::make_unique<PlaneBounces>(ready(), options);
      bounce_count = count;
    }
    return *bounces;
  }
  std::size_t checked(int body) const {
    if (body < 0 || static_cast<std::size_t>(body) >= scene.bodies.size()) throw Error("body", "is not in the scene any more");
    return static_cast<std::size_t>(body);
  }
};

namespace {

PlaneFrameOptions frame_options(int width, int height) {
  PlaneFrameOptions options;
  options.width = width;
  options.height = height;
  options.limits = kLimits;
  return options;
}

// The values of a picture: three a pixel, and three more for each layer that is asked for and there.
float* values_of(Plane& plane, const Picture& picture) {
  std::vector<float>& out = plane.values;
  out.clear();
  const auto put = [&](const std::vector<Vec3f>& layer) {
    for (const Vec3f& v : layer) out.insert(out.end(), {v.x, v.y, v.z});
  };
  out.reserve(3 * picture.pixels.size() * (1 + picture.layers.size()));
  put(picture.pixels);
  for (const char* name : {"moment_x", "moment_y", "alpha"})
    if (const auto found = picture.layers.find(name); found != picture.layers.end()) put(found->second);
  return out.data();
}

}  // namespace
}  // namespace steradian::plane

using namespace steradian;
using steradian::plane::guarded;
using steradian::plane::Plane;

extern "C" {

EMSCRIPTEN_KEEPALIVE const char* plane_problem() { return plane::problem.c_str(); }

EMSCRIPTEN_KEEPALIVE Plane* plane_from_svg(const char* svg, const char* name) {
  return guarded(nullptr, [&] {
    PlaneSvg read = load_plane_scene_from_text(svg, name, plane::kLimits);
    auto made = std::make_unique<Plane>();
    made->scene = std::move(read.scene);
    for (const std::string& what : read.ignored) made->ignored += what + "\n";
    for (const PlaneLeftOut& shapes : read.left_out)
      if (shapes.is_backdrop()) made->ignored += std::string("a backdrop, which ") + words_of(shapes.why) + "\n";
    for (const std::string& warning : read.warnings) made->ignored += warning + "\n";
    return made.release();
  });
}

EMSCRIPTEN_KEEPALIVE Plane* plane_empty(double x, double y, double width, double height) {
  return guarded(nullptr, [&] {
    if (!(width > 0 && height > 0 && std::isfinite(width) && std::isfinite(height) && std::isfinite(x) && std::isfinite(y)))
      throw Error("scene", "its width and height are no positive numbers", "give { width, height }, in units of the plane");
    auto made = std::make_unique<Plane>();
    made->scene.origin = {x, y};
    made->scene.width = width;
    made->scene.height = height;
    return made.release();
  });
}

EMSCRIPTEN_KEEPALIVE void plane_delete(Plane* p) { delete p; }
EMSCRIPTEN_KEEPALIVE const char* plane_ignored(Plane* p) { return p->ignored.c_str(); }

// Origin, width and height of the picture in the plane; of the last picture its tiles, those that were drawn, its error; then how pictures
// of another shape are filled: PlaneFit, and where the scene stands in them.
EMSCRIPTEN_KEEPALIVE const double* plane_facts(Plane* p) {
  p->numbers = {p->scene.origin.x, p->scene.origin.y, p->scene.width, p->scene.height,
                p->tiles,          p->drawn,          p->error,       static_cast<double>(p->scene.fit),
                p->scene.align.x,  p->scene.align.y};
  return p->numbers.data();
}

EMSCRIPTEN_KEEPALIVE int plane_count(Plane* p) { return static_cast<int>(p->scene.bodies.size()); }

EMSCRIPTEN_KEEPALIVE const char* plane_body_name(Plane* p, int body) {
  return guarded(nullptr, [&] { return p->scene.bodies[p->checked(body)].name.c_str(); });
}

// A body as body_numbers.h says, its length before it.
EMSCRIPTEN_KEEPALIVE const double* plane_body(Plane* p, int body) {
  return guarded(static_cast<const double*>(nullptr), [&] {
    p->numbers = plane::numbers_of(p->scene.bodies[p->checked(body)]);
    p->numbers.insert(p->numbers.begin(), static_cast<double>(p->numbers.size()));
    return static_cast<const double*>(p->numbers.data());
  });
}

// The new body's index, on top of all others.
EMSCRIPTEN_KEEPALIVE int plane_add(Plane* p, const double* numbers, int count, const char* name) {
  return guarded(-1, [&] {
    PlaneBody body = plane::body_of(numbers, static_cast<std::size_t>(count));
    body.name = name;
    p->changed();
    if (p->stage) p->stage->add(body);
    p->scene.bodies.push_back(std::move(body));
    return static_cast<int>(p->scene.bodies.size()) - 1;
  });
}

EMSCRIPTEN_KEEPALIVE int plane_replace(Plane* p, int at, const double* numbers, int count) {
  return guarded(-1, [&] {
    const std::size_t i = p->checked(at);
    PlaneBody body = plane::body_of(numbers, static_cast<std::size_t>(count));
    const PlaneBody& old = p->scene.bodies[i];
    body.name = old.name;
    // The list of numbers does not tell a pane: a pane that is moved stays a pane.
    if (!body.light) body.transmittance = old.transmittance, body.mirror = old.mirror, body.light_depth = old.light_depth;
    p->changed();
    if (p->stage) p->stage->replace(i, body);
    p->scene.bodies[i] = std::move(body);
    return at;
  });
}

// The bodies behind it move up by one.
EMSCRIPTEN_KEEPALIVE int plane_remove(Plane* p, int at) {
  return guarded(-1, [&] {
    const std::size_t i = p->checked(at);
    p->changed();
    if (p->stage) p->stage->remove(i);
    p->scene.bodies.erase(p->scene.bodies.begin() + at);
    return at;
  });
}

// Radiance, moment x, moment y of a point, in double. rays: 0 exact, else so many.
EMSCRIPTEN_KEEPALIVE const double* plane_query(Plane* p, double x, double y, int bounces, int rays) {
  return guarded(static_cast<const double*>(nullptr), [&] {
    if (!std::isfinite(x) || !std::isfinite(y)) throw Error("query", "the point is not finite", "give two numbers");
    PlaneSampling sampling;
    sampling.spp = std::clamp(rays, 1, 1'000'000);
    const PlaneMethod method = rays > 0 ? PlaneMethod::sampled : PlaneMethod::exact;
    PlaneLight light = p->ready().query({x, y}, method, sampling);
    if (bounces != 0) {
      const PlaneLight more = p->bounced(bounces).query({x, y});
      light.radiance = light.radiance + more.radiance;
    }
    p->numbers = {light.radiance.x, light.radiance.y, light.radiance.z, light.moment_x.x, light.moment_x.y,
                  light.moment_x.z, light.moment_y.x, light.moment_y.y, light.moment_y.z};
    return static_cast<const double*>(p->numbers.data());
  });
}

// The picture of the scene as it is; without bounces and rays, only tiles that may have changed are drawn again.
EMSCRIPTEN_KEEPALIVE const float* plane_draw(Plane* p, int width, int height, int bounces, int rays) {
  return guarded(static_cast<const float*>(nullptr), [&] {
    PlaneFrameOptions options = plane::frame_options(width, height);
    p->error = 2e-5;
    if (bounces == 0 && rays == 0) {
      if (!p->stage || p->stage_width != width || p->stage_height != height) {
        p->stage = std::make_unique<PlaneStage>(p->scene, options);
        p->stage_width = width;
        p->stage_height = height;
      }
      const Picture& drawn = p->stage->draw();
      p->tiles = static_cast<double>(p->stage->stats().tiles);
      p->drawn = static_cast<double>(p->stage->stats().drawn);
      return reinterpret_cast<const float*>(drawn.pixels.data());
    }
    if (bounces != 0) {
      options.bounces = &p->bounced(bounces);
      p->error = std::max(p->error, options.bounces->stats().error);
    }
    if (rays > 0) {
      options.method = PlaneMethod::sampled;
      options.sampling.spp = rays;
      p->error = std::nan("");  // noise
    }
    render_plane_into(p->picture, p->ready(), options);
    p->tiles = p->drawn = std::ceil(width / 16.0) * std::ceil(height / 16.0);
    return reinterpret_cast<const float*>(p->picture.pixels.data());
  });
}

// The data of a picture by WebGL2 (gl_lists.h): where lists, pairs, vertices and the base picture stand and how many words or numbers
// they are; words of masks, disks; first job and number of jobs of the four kinds; 1 where no light is listed tile by tile.
EMSCRIPTEN_KEEPALIVE const double* plane_gl_lists(Plane* p, int width, int height, int bounces, int room) {
  return guarded(static_cast<const double*>(nullptr), [&] {
    PlaneFrameOptions options = plane::frame_options(width, height);
    p->error = 2e-5;
    if (bounces != 0) {
      options.bounces = &p->bounced(bounces);
      p->error = std::max(p->error, options.bounces->stats().error);
    }
    plane::GlLists& gl = p->gl;
    plane::make_gl_lists(gl, p->ready(), options, static_cast<std::size_t>(room));
    p->tiles = p->drawn = std::ceil(width / 16.0) * std::ceil(height / 16.0);
    const auto at = [](const auto& list) { return static_cast<double>(reinterpret_cast<std::uintptr_t>(list.data())); };
    const auto count = [](std::size_t n) { return static_cast<double>(n); };
    p->numbers = {at(gl.lists),         count(gl.lists.size()),
                  at(gl.pairs),         count(gl.pairs.size()),
                  at(gl.vertices),      count(gl.vertices.size()),
                  at(gl.base.pixels),   count(3 * gl.base.pixels.size()),
                  count(gl.mask_words), count(gl.disks)};
    for (const plane::GlLists::Jobs& jobs : gl.jobs) p->numbers.insert(p->numbers.end(), {count(jobs.first), count(jobs.count)});
    p->numbers.push_back(gl.all_on_device ? 1 : 0);
    return static_cast<const double*>(p->numbers.data());
  });
}

// A light map: three values a pixel, then three each of moment_x and moment_y, then of alpha, those that are asked for.
EMSCRIPTEN_KEEPALIVE const float* plane_light(Plane* p, int width, int height, int bounces, int moments, int aa, int occluders) {
  return guarded(static_cast<const float*>(nullptr), [&] {
    PlaneFrameOptions options = plane::frame_options(width, height);
    options.moments = moments != 0;
    options.aa = aa;
    options.occluders = static_cast<PlaneOccluders>(std::clamp(occluders, 0, 2));
    if (bounces != 0) options.bounces = &p->bounced(bounces);
    return static_cast<const float*>(plane::values_of(*p, render_plane(p->ready(), options)));
  });
}

EMSCRIPTEN_KEEPALIVE const char* plane_svg(Plane* p) {
  return guarded(nullptr, [&] {
    p->text = plane_scene_to_svg(p->scene);
    return p->text.c_str();
  });
}

}  // extern "C"
