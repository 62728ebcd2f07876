#include "plane/stage/drawing.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

#include "plane/exact/outline.h"
#include "plane/exact/random.h"

namespace steradian::plane {

PlaneScene make_light_field(const LightField& field, std::uint64_t seed) {
  SceneRandom random(seed);
  PlaneScene scene;
  scene.width = field.width;
  scene.height = field.height;
  for (int i = 0; i < field.boxes; ++i) {
    const Vec2d c{random.uniform(0, scene.width), random.uniform(0, scene.height)};
    const double a = random.uniform(0, 2 * std::numbers::pi), hx = field.size * random.uniform(0.4, 1.2),
                 hy = field.size * random.uniform(0.4, 1.2);
    const Vec2d x = Vec2d{std::cos(a), std::sin(a)} * hx, y = Vec2d{-std::sin(a), std::cos(a)} * hy;
    scene.bodies.push_back(plane_polygon({c - x - y, c + x - y, c + x + y, c - x + y}));
  }
  for (int i = 0; i < field.lights;) {
    const Vec2d c{random.uniform(0, scene.width), random.uniform(0, scene.height)};
    bool free = true;
    for (int k = 0; k < field.boxes && free; ++k) free = !contains(scene.bodies[static_cast<std::size_t>(k)], c);
    if (!free) continue;
    scene.bodies.push_back(plane_circle(c, field.radius));
    PlaneEmission& light = scene.bodies.back().light.emplace();
    light.radiance = {random.uniform(0.4, 1), random.uniform(0.4, 1), random.uniform(0.4, 1)};
    light.range = field.range;
    ++i;
  }
  return scene;
}

namespace {

struct NamedShape {
  const char *name, *svg;
};

// Two shapes of each kind; {} is the place of their emission.
constexpr NamedShape kShapes[] = {
    {"circle", R"(<circle cx="150" cy="120" r="24" {0}/><circle cx="470" cy="250" r="30" {0}/>)"},
    {"ellipse", R"(<ellipse cx="150" cy="120" rx="40" ry="14" {0}/><ellipse cx="470" cy="250" rx="18" ry="44" {0}/>)"},
    {"polygon", R"(<rect x="150" y="120" width="50" height="24" {0}/><polygon points="470,250 520,260 500,300 460,290" {0}/>)"},
    {"capsule",
     R"(<g stroke-linecap="round"><path d="M150 120L210 100" stroke-width="20" {0}/><path d="M470 250L480 300" stroke-width="14" {0}/></g>)"},
    {"stroke", R"(<g stroke-linecap="round"><path d="M150 120C200 60 220 180 280 120" stroke-width="10" {0}/>)"
               R"(<path d="M470 250q40 10 30 50" stroke-width="14" {0}/></g>)"},
    {"curve", R"(<path d="M150 120C200 60 220 180 280 120z" {0}/><path d="M470 250q40 10 30 50t-30 -20z" {0}/>)"}};

constexpr NamedShape kEmissions[] = {{"uniform", ""},
                                     {"range", R"(data-range="200")"},
                                     {"lambert", R"(data-profile="lambert")"},
                                     {"inverse", R"(data-profile="inverse" data-intensity="60")"},
                                     {"spot", R"(data-spot="60 50")"},
                                     {"gradient", ""}};

constexpr const char* kGradient = R"(<linearGradient id="g" x1="0" y1="0" x2="1" y2="0.4"><stop offset="0.1" stop-color="#ffe08a"/>)"
                                  R"(<stop offset="0.55" stop-color="#ff3010"/><stop offset="1" stop-color="#20a0ff"/></linearGradient>)";

template <std::size_t N>
const char* named(const NamedShape (&parts)[N], const std::string& name) {
  for (const NamedShape& part : parts)
    if (name == part.name) return part.svg;
  return "";
}

}  // namespace

std::vector<LightPairDrawing> all_drawings() {
  std::vector<LightPairDrawing> all;
  for (const NamedShape& shape : kShapes)
    for (const NamedShape& emission : kEmissions) all.push_back({shape.name, emission.name});
  return all;
}

PlaneScene make_drawing(const LightPairDrawing& drawing) {
  const bool stroked = drawing.shape == "capsule" || drawing.shape == "stroke";
  const char* paint = drawing.emission == "gradient" ? "url(#g)" : "#fff";
  const std::string look = stroked ? fmt::format("fill=\"none\" stroke=\"{}\" ", paint) : fmt::format("fill=\"{}\" ", paint);
  std::string svg = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 640 360\">{}<g class=\"light\">", kGradient);
  svg += fmt::format(fmt::runtime(named(kShapes, drawing.shape)), look + named(kEmissions, drawing.emission)) + "</g>";
  SceneRandom random(7);
  for (int i = 0; i < 13; ++i) {
    const double x = random.uniform(20, 620), y = random.uniform(20, 340), turn = random.uniform(0, 360);
    const double a = random.uniform(6, 24), b = random.uniform(4, 12);
    const std::string turned = fmt::format("transform=\"rotate({} {} {})\"", turn, x, y);
    switch (i % 4) {
      case 0: svg += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"/>", x, y, b + 4); break;
      case 1: svg += fmt::format("<ellipse cx=\"{}\" cy=\"{}\" rx=\"{}\" ry=\"{}\" {}/>", x, y, a, b, turned); break;
      case 2: svg += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}/>", x, y, a + b, 2 * b, turned); break;
      default:
        svg += fmt::format("<path d=\"M{} {}l{} {}\" stroke=\"#000\" stroke-width=\"7\" stroke-linecap=\"round\"/>", x, y, 2 * a, b - 20);
    }
  }
  PlaneScene scene = load_plane_scene_from_text(svg + "</svg>", drawing.shape + "-" + drawing.emission).scene;
  scene.fit = PlaneFit::stretch;
  return scene;
}

}  // namespace steradian::plane
