// plane/frame/LxB: 1080p frames of the plane, cold except for the picture's memory;
// plane/warm/LxB: the same with the scene prepared;
// plane/rays/LxB: 64 rays a pixel over the grid, on every 97th pixel of a frame;
// plane/par/LxB and plane/marched/LxB: the published heuristic, and 64 marched rays, on up to 100 points of the frame, for lights without
// range;
// plane/drawing/SHAPE-EMISSION: 1080p of fifteen shapes;
// plane/extras/WHAT: 640x360 of eight lamps and sixty boxes, some of which are glass, mirrors or stones, or under suns, or in fog;
// plane/extras-move/WHAT: one of the boxes moves by 3.6 pixels, and a stage follows;
// plane/bounce/N: all bounces in a room of N boxes, one item an element; plane/bounce-frame/N: 1080p with them;
// plane/bounce-lattice/N: the same by a lattice, to 3e-3;
// vulkan/plane/frame/LxB: plane/frame/LxB on a Vulkan device, with all threads of the host;
// plane/move/LxB and plane/move-lamp/LxB: a box, or a lamp, moves by 3.6 pixels, another one every time, and a 1080p stage follows.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "benches.h"
#include "plane/stage/drawing.h"
#include "steradian/plane_bounce.h"
#include "steradian/plane_device.h"
#include "steradian/plane_stage.h"

namespace steradian::bench {
namespace {

using plane::kLightFields;
using plane::LightField;
using plane::make_light_field;

constexpr std::uint64_t kSeed = 1;
constexpr int kStride = 97;

std::string suffix(const LightField& field) { return fmt::format("{}x{}", field.lights, field.boxes); }

std::size_t pixels(const LightField& field) { return static_cast<std::size_t>(field.width) * static_cast<std::size_t>(field.height); }

PlaneFrameOptions one_thread() {
  PlaneFrameOptions options;
  options.threads = 1;
  return options;
}

Bench cold(const LightField& field, const BenchOptions& options) {
  auto scene = std::make_shared<PlaneScene>(make_light_field(field, kSeed));
  auto picture = std::make_shared<Picture>();
  return {"plane/frame/" + suffix(field), pixels(field), name_of(options.simd), [scene, picture] {
            const PlaneWorld world(*scene);
            render_plane_into(*picture, world, one_thread());
            keep(picture->pixels.front());
          }};
}

Bench warm(const LightField& field, const BenchOptions& options) {
  auto world = std::make_shared<PlaneWorld>(make_light_field(field, kSeed));
  auto picture = std::make_shared<Picture>();
  return {"plane/warm/" + suffix(field), pixels(field), name_of(options.simd), [world, picture] {
            render_plane_into(*picture, *world, one_thread());
            keep(picture->pixels.front());
          }};
}

Bench plane_on_device(const LightField& field, const std::string& device) {
  struct Work {
    PlaneScene scene;
    PlaneDevice device;
    Picture picture;
  };
  auto work = std::make_shared<Work>(Work{make_light_field(field, kSeed), PlaneDevice(device), {}});
  const auto passes = [work] {
    const PlaneDeviceStats& s = work->device.stats();
    return std::vector<BenchPass>{{"lists", s.lists_ms},
                                  {"upload", s.upload_ms},
                                  {"device", s.device_ms},
                                  {"resolve", s.resolve_ms},
                                  {"device: lists", s.making_lists_ms},
                                  {"device: round lights", s.disks_ms},
                                  {"device: edges", s.cuts_ms}};
  };
  return {"vulkan/plane/frame/" + suffix(field),
          pixels(field),
          name_of(active_simd()),
          [work] {
            work->device.render_into(work->picture, PlaneWorld(work->scene), {});
            keep(work->picture.pixels.front());
          },
          false,
          passes};
}

Bench plane_rays(const LightField& field) {
  auto world = std::make_shared<PlaneWorld>(make_light_field(field, kSeed));
  const std::size_t count = pixels(field) / kStride;
  return {"plane/rays/" + suffix(field), count, "scalar", [world, field] {
            double sum = 0;
            for (std::size_t i = 0; i < pixels(field); i += kStride) {
              const auto width = static_cast<std::size_t>(field.width);
              const Vec2d p{static_cast<double>(i % width) + 0.5, static_cast<double>(i / width) + 0.5};
              sum += world->query(p, PlaneMethod::sampled, {64, 1}).radiance.x;
            }
            keep(sum);
          }};
}

// Evaluates points of the frame by a method without ranges. The more pairs of light and box, the fewer points.
Bench points(LightField field, const char* name, PlaneMethod method) {
  const double pairs = static_cast<double>(field.lights) * field.boxes;
  const auto count = static_cast<std::size_t>(std::clamp(3e6 / pairs, 2.0, 100.0));
  const std::string bench = std::string("plane/") + name + "/" + suffix(field);
  field.range = std::numeric_limits<double>::infinity();
  auto world = std::make_shared<PlaneWorld>(make_light_field(field, kSeed));
  Bench result{bench, count, "scalar", [world, field, method, count] {
                 double sum = 0;
                 for (std::size_t i = 0; i < count; ++i) {
                   const Vec2d p{(static_cast<double>(i) + 0.5) * field.width / static_cast<double>(count),
                                 std::fmod(static_cast<double>(i) * 0.6180339887498949, 1.0) * field.height};
                   sum += world->query(p, method, {64, 1}).radiance.x;
                 }
                 keep(sum);
               }};
  result.once = pairs > 1e6;  // seconds a call
  return result;
}

// A closed room of boxes with four lamps in it.
PlaneScene room_of(int boxes) {
  PlaneScene scene = make_light_field({4, boxes, std::numeric_limits<double>::infinity(), 14, 30}, kSeed);
  for (PlaneBody& body : scene.bodies)
    if (!body.light) body.albedo = Vec3d{0.75, 0.75, 0.75};
  scene.bodies.push_back(plane_polygon({{-20, -20}, {1940, -20}, {1940, 1100}, {-20, 1100}}));
  scene.bodies.back().contours.push_back({{1, 1}, {1, 1079}, {1919, 1079}, {1919, 1}});
  scene.bodies.back().albedo = Vec3d{0.75, 0.75, 0.75};
  return scene;
}

Bench bounces(int boxes) {
  auto world = std::make_shared<PlaneWorld>(room_of(boxes));
  const std::size_t elements = PlaneBounces(*world).stats().elements;
  return {"plane/bounce/" + std::to_string(boxes), elements, name_of(active_simd()), [world] { keep(PlaneBounces(*world).stats().error); }};
}

Bench bounce_frame(int boxes, double lattice, const BenchOptions& options) {
  auto world = std::make_shared<PlaneWorld>(room_of(boxes));
  auto solved = std::make_shared<PlaneBounces>(*world);
  auto picture = std::make_shared<Picture>();
  const char* name = lattice > 0 ? "plane/bounce-lattice/" : "plane/bounce-frame/";
  return {name + std::to_string(boxes), std::size_t{1920} * 1080, name_of(options.simd), [world, solved, picture, lattice] {
            PlaneFrameOptions frame = one_thread();
            frame.bounces = solved.get();
            frame.bounce_lattice = lattice;
            render_plane_into(*picture, *world, frame);
            keep(picture->pixels.front());
          }};
}

Bench moves(const LightField& field, const char* name, std::size_t first, std::size_t count, const BenchOptions& options) {
  struct Moving {
    PlaneStage stage;
    std::size_t next = 0;
  };
  auto moving = std::make_shared<Moving>(Moving{PlaneStage(make_light_field(field, kSeed), one_thread())});
  moving->stage.draw();
  return {std::string("plane/") + name + "/" + suffix(field), 1, name_of(options.simd), [moving, first, count] {
            moving->stage.move(first + moving->next % count, {moving->next % 2 == 0 ? 3.6 : -3.6, 0});
            ++moving->next;
            keep(moving->stage.draw().pixels.front());
          }};
}

constexpr const char* kExtras[] = {"none", "sun", "hard-sun", "glass", "mirror", "stone", "fog"};

PlaneScene with_extras(const std::string& what) {
  PlaneScene scene = make_light_field({8, 60, 200, 8, 12, 640, 360}, kSeed);
  if (what == "sun") scene.suns = {{{5, 4, 3}, -0.5, 0.02}, {{0.2, 0.3, 0.5}, -1.5707963267948966, 1.5707963267948966}};
  if (what == "hard-sun") scene.suns = {{{5, 4, 3}, -0.5, 0}};
  if (what == "fog") scene.fog_density = 0.005;
  int boxes = 0;
  for (PlaneBody& body : scene.bodies) {
    if (body.light || ++boxes % 10 != 0) continue;
    if (what == "glass") body.transmittance = Vec3d{0.9, 0.6, 0.3};
    if (what == "mirror") body.mirror = Vec3d{0.9, 0.9, 0.9};
    if (what == "stone") body.light_depth = 10;
  }
  return scene;
}

Bench extras(const std::string& what, const BenchOptions& options) {
  auto world = std::make_shared<PlaneWorld>(with_extras(what));
  auto picture = std::make_shared<Picture>();
  return {"plane/extras/" + what, std::size_t{640} * 360, name_of(options.simd), [world, picture] {
            render_plane_into(*picture, *world, one_thread());
            keep(picture->pixels.front());
          }};
}

Bench extras_move(const std::string& what, const BenchOptions& options) {
  struct Moving {
    PlaneStage stage;
    std::size_t next = 0;
  };
  auto moving = std::make_shared<Moving>(Moving{PlaneStage(with_extras(what), one_thread())});
  moving->stage.draw();
  return {"plane/extras-move/" + what, 1, name_of(options.simd), [moving] {
            moving->stage.move(moving->next % 60, {moving->next % 2 == 0 ? 3.6 : -3.6, 0});
            ++moving->next;
            keep(moving->stage.draw().pixels.front());
          }};
}

std::string suffix(const plane::LightPairDrawing& drawing) { return drawing.shape + "-" + drawing.emission; }

Bench drawn(const plane::LightPairDrawing& drawing, const BenchOptions& options) {
  auto scene = std::make_shared<PlaneScene>(plane::make_drawing(drawing));
  auto picture = std::make_shared<Picture>();
  return {"plane/drawing/" + suffix(drawing), std::size_t{1920} * 1080, name_of(options.simd), [scene, picture] {
            PlaneFrameOptions frame = one_thread();
            frame.width = 1920;
            frame.height = 1080;
            render_plane_into(*picture, PlaneWorld(*scene), frame);
            keep(picture->pixels.front());
          }};
}

}  // namespace

void add_plane(BenchList& list) {
  for (const plane::LightPairDrawing& drawing : plane::all_drawings())
    list.add("plane/drawing/" + suffix(drawing), [drawing](const BenchOptions& o) { return drawn(drawing, o); });
  for (const std::string what : kExtras) {
    list.add("plane/extras/" + what, [what](const BenchOptions& o) { return extras(what, o); });
    list.add("plane/extras-move/" + what, [what](const BenchOptions& o) { return extras_move(what, o); });
  }
  for (int boxes : {10, 50}) {
    list.add("plane/bounce/" + std::to_string(boxes), [boxes](const BenchOptions&) { return bounces(boxes); });
    list.add("plane/bounce-frame/" + std::to_string(boxes), [boxes](const BenchOptions& o) { return bounce_frame(boxes, 0, o); });
    list.add("plane/bounce-lattice/" + std::to_string(boxes), [boxes](const BenchOptions& o) { return bounce_frame(boxes, 3e-3, o); });
  }
  for (const LightField& field : kLightFields) {
    list.add("plane/frame/" + suffix(field), [field](const BenchOptions& o) { return cold(field, o); });
    const auto lamps = static_cast<std::size_t>(field.lights), boxes = static_cast<std::size_t>(field.boxes);
    list.add("plane/move/" + suffix(field), [field, boxes](const BenchOptions& o) { return moves(field, "move", 0, boxes, o); });
    list.add("plane/move-lamp/" + suffix(field), [=](const BenchOptions& o) { return moves(field, "move-lamp", boxes, lamps, o); });
    list.add("plane/warm/" + suffix(field), [field](const BenchOptions& o) { return warm(field, o); });
    list.add("plane/rays/" + suffix(field), [field](const BenchOptions&) { return plane_rays(field); });
    list.add("plane/par/" + suffix(field), [field](const BenchOptions&) { return points(field, "par", PlaneMethod::par); });
    list.add("plane/marched/" + suffix(field), [field](const BenchOptions&) { return points(field, "marched", PlaneMethod::marched); });
  }
}

void add_plane_on_device(BenchList& list, const std::string& device) {
  for (const LightField& field : kLightFields)
    list.add("vulkan/plane/frame/" + suffix(field), [field, device](const BenchOptions&) { return plane_on_device(field, device); });
}

}  // namespace steradian::bench
