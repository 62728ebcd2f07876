// SVG to bodies: the tree, what is inherited down it, and the shapes.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <new>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

#include "core/budget.h"
#include "plane/svg/light.h"
#include "plane/svg/path.h"
#include "plane/svg/stroke.h"
#include "steradian/error.h"
#include "steradian/plane.h"

namespace steradian::plane::svg {
namespace {

// How far a flattened curve may be from its own, as a share of the picture's larger side: 0.01 of a pixel in a picture of
// 1000 pixels, whatever a user unit is.
constexpr double kFlatness = 1e-5;
constexpr int kDeepest = 64;  // nested groups and uses: deeper is a cycle or an attack
constexpr std::size_t kMostBodies = 1'000'000, kMostUses = 100'000;
constexpr std::uint64_t kElementSteps = 1000, kPortion = 20'000'000;

// Levenshtein's distance: letters to change, add or leave out.
std::size_t edits_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t k = 0; k <= b.size(); ++k) row[k] = k;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t corner = row[0]++;
    for (std::size_t k = 0; k < b.size(); ++k) {
      const std::size_t changed = corner + (a[i] == b[k] ? 0 : 1);
      corner = row[k + 1];
      row[k + 1] = std::min({changed, row[k] + 1, row[k + 1] + 1});
    }
  }
  return row[b.size()];
}

std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> result;
  std::istringstream in{std::string(text)};
  for (std::string w; in >> w;) result.push_back(w);
  return result;
}

class Reader {
 public:
  Reader(std::string text, std::string name, const Limits& limits) : document_(std::move(text), name), budget_(limits) {
    result_.scene.name = std::move(name);
    find_drawing(document_.root());
  }

  PlaneSvg read() try {
    const pugi::xml_node root = document_.root();
    read_frame(root);
    children(root, inherit(root, {}), 0);
    result_.ignored.assign(document_.ignored.begin(), document_.ignored.end());
    return std::move(result_);
  } catch (const std::bad_alloc&) {
    throw budget_.out_of_memory();
  }

 private:
  void read_frame(pugi::xml_node root) {
    PlaneScene& scene = result_.scene;
    if (root.attribute("viewBox")) {
      Scanner scan(root.attribute("viewBox").value());
      double v[4];
      for (double& x : v) {
        const auto number = scan.number();
        if (!number) document_.fail(root, "viewBox needs four numbers", "write viewBox=\"0 0 WIDTH HEIGHT\"");
        x = *number;
        scan.skip_separators();
      }
      scene.origin = {v[0], v[1]};
      scene.width = v[2];
      scene.height = v[3];
    } else {
      scene.width = document_.length_attribute(root, "width", 512, 512);
      scene.height = document_.length_attribute(root, "height", 512, 512);
    }
    read_aspect(root, scene);
    if (!(scene.width > 0 && scene.height > 0 && scene.width < 1e6 && scene.height < 1e6))
      document_.fail(root, "the picture's width and height must be positive and below a million", "set the viewBox");
  }

  void read_aspect(pugi::xml_node root, PlaneScene& scene) const {
    scene.fit = PlaneFit::meet;
    const std::vector<std::string> given = words(root.attribute("preserveAspectRatio").value());
    if (given.empty()) return;
    const std::string& align = given.front();
    if (align == "none") {
      scene.fit = PlaneFit::stretch;
      return;
    }
    const auto place = [&](std::size_t at) {
      const std::string_view word = std::string_view(align).substr(std::min(at, align.size()), 3);
      return word == "Min" ? 0.0 : word == "Mid" ? 0.5 : word == "Max" ? 1.0 : -1.0;
    };
    scene.align = {place(1), place(5)};
    if (align.size() != 8 || scene.align.x < 0 || scene.align.y < 0)
      document_.fail(root, "preserveAspectRatio=\"" + align + "\" is unknown", "write none, or xMidYMid and the like, then meet or slice");
    if (given.size() > 1 && given[1] == "slice") scene.fit = PlaneFit::slice;
  }

  // What one element says of itself, read once however many <use> show it.
  struct Declared {
    std::optional<std::string> fill, stroke, color, cap, rule;
    std::optional<double> stroke_width, intensity, range, fill_opacity, stroke_opacity;
    double opacity = 1;          // of the whole element
    Role role = Role::by_shape;  // by_shape: says nothing
    std::optional<PlaneProfile> profile;
    std::optional<std::pair<Vec2d, double>> spot;
    std::optional<Transform> transform;
  };

  const Declared& declared(pugi::xml_node n) {
    const auto [found, is_new] = declared_.try_emplace(n.internal_object());
    if (is_new) read_declared(n, found->second);
    return found->second;
  }

  void read_declared(pugi::xml_node n, Declared& d) {
    const std::pair<const char*, std::optional<std::string>*> texts[] = {
        {"fill", &d.fill}, {"stroke", &d.stroke}, {"color", &d.color}, {"stroke-linecap", &d.cap}, {"fill-rule", &d.rule}};
    for (const auto& [key, value] : texts) {
      auto p = document_.property(n, key);
      if (p && *p != "inherit") *value = std::move(p);
    }
    if (const auto width = document_.property(n, "stroke-width")) {
      d.stroke_width = document_.length_of(*width, diagonal());
      if (!d.stroke_width || *d.stroke_width < 0) document_.fail(n, "stroke-width=\"" + *width + "\" is not a length", "write a number");
    }
    if (n.attribute("data-intensity")) d.intensity = document_.number_attribute(n, "data-intensity", 0, "give a number of at least 0");
    if (n.attribute("data-range")) {
      d.range = document_.number_attribute(n, "data-range", 0, "give a positive distance in user units");
      if (*d.range == 0) document_.fail(n, "data-range must be positive", "leave it out for light without a limit");
    }
    if (const auto display = document_.property(n, "display"); display && *display == "none") d.role = Role::ignore;
    d.opacity = share(n, "opacity").value_or(1);
    d.fill_opacity = share(n, "fill-opacity");
    d.stroke_opacity = share(n, "stroke-opacity");
    refuse_misspelt(n);
    read_role(n, d);
    read_profile(n, d);
    if (n.attribute("transform")) {
      d.transform = parse_transform(n.attribute("transform").value());
      if (!d.transform)
        document_.fail(n, std::string("cannot read transform=\"") + n.attribute("transform").value() + "\"",
                       "use matrix, translate, scale, rotate, skewX and skewY");
    }
    if (d.role == Role::ignore) return;
    for (const char* unsupported : {"clip-path", "mask", "filter"})
      if (const auto p = document_.property(n, unsupported); p && *p != "none") document_.ignored.insert(unsupported);
  }

  Style inherit(pugi::xml_node n, Style style) {
    const Declared& d = declared(n);
    const std::pair<const std::optional<std::string>*, std::string*> texts[] = {
        {&d.fill, &style.fill}, {&d.stroke, &style.stroke}, {&d.color, &style.color}, {&d.cap, &style.cap}, {&d.rule, &style.rule}};
    for (const auto& [own, value] : texts)
      if (*own) *value = **own;
    style.stroke_width = d.stroke_width.value_or(style.stroke_width);
    style.intensity = d.intensity.value_or(style.intensity);
    style.range = d.range.value_or(style.range);
    style.profile = d.profile.value_or(style.profile);
    style.opacity *= d.opacity;
    style.fill_opacity = d.fill_opacity.value_or(style.fill_opacity);
    style.stroke_opacity = d.stroke_opacity.value_or(style.stroke_opacity);
    if (d.role != Role::by_shape && style.role != Role::ignore) style.role = d.role;
    if (d.spot) std::tie(style.spot_axis, style.spot_half_angle) = *d.spot;
    if (d.transform) style.transform = style.transform * *d.transform;
    return style;
  }

  // A share of 1, or a percentage.
  std::optional<double> share(pugi::xml_node n, const char* key) const {
    const auto text = document_.property(n, key);
    if (!text || *text == "inherit") return {};
    const auto v = document_.length_of(*text, 1);
    if (!v) document_.fail(n, std::string(key) + "=\"" + *text + "\" is not a number", "write a number from 0 to 1");
    return std::clamp(*v, 0.0, 1.0);
  }

  // Other programs write data- attributes of their own; one that is nearly ours is a slip.
  void refuse_misspelt(pugi::xml_node n) const {
    static constexpr const char* kOurs[] = {"data-steradian", "data-intensity", "data-range", "data-profile", "data-spot"};
    for (pugi::xml_attribute a : n.attributes()) {
      const std::string_view name = a.name();
      if (!name.starts_with("data-") || std::find(std::begin(kOurs), std::end(kOurs), name) != std::end(kOurs)) continue;
      for (const char* ours : kOurs)
        if (edits_between(name, ours) <= 2) document_.fail(n, std::string(name) + " is unknown", std::string("write ") + ours);
    }
  }

  void read_role(pugi::xml_node n, Declared& d) const {
    if (d.role == Role::ignore) return;
    static constexpr std::pair<const char*, Role> kRoles[] = {
        {"light", Role::light}, {"occluder", Role::occluder}, {"ignore", Role::ignore}};
    for (const std::string& word : words(n.attribute("class").value()))
      for (const auto& [key, role] : kRoles)
        if (word == key) d.role = role;
    // Names of layers, as Inkscape writes them: "Lights", "light 2".
    for (std::string word : words(n.attribute("inkscape:label").value())) {
      for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      for (const auto& [key, role] : kRoles)
        if (word == key || word == std::string(key) + "s") d.role = role;
    }
    if (!n.attribute("data-steradian")) return;
    for (const auto& [key, role] : kRoles)
      if (trimmed(n.attribute("data-steradian").value()) == key) {
        d.role = role;
        return;
      }
    document_.fail(n, std::string("data-steradian=\"") + n.attribute("data-steradian").value() + "\" is unknown",
                   "use light, occluder or ignore");
  }

  void read_profile(pugi::xml_node n, Declared& d) const {
    if (n.attribute("data-profile")) {
      const std::string_view v = trimmed(n.attribute("data-profile").value());
      if (v == "uniform")
        d.profile = PlaneProfile::uniform;
      else if (v == "lambert")
        d.profile = PlaneProfile::lambert;
      else if (v == "inverse")
        d.profile = PlaneProfile::inverse;
      else
        document_.fail(n, "data-profile=\"" + std::string(v) + "\" is unknown", "use uniform, lambert or inverse");
    }
    if (!n.attribute("data-spot")) return;
    Scanner scan(n.attribute("data-spot").value());
    const auto axis = scan.number();
    scan.skip_separators();
    const auto half = scan.number();
    if (!axis || !half || !(*half >= 0 && *half <= 180))
      document_.fail(n, "data-spot needs two angles in degrees", "write data-spot=\"DIRECTION HALF-ANGLE\", the half angle up to 180");
    const double degree = std::numbers::pi / 180;
    d.spot = {{std::cos(*axis * degree), std::sin(*axis * degree)}, *half * degree};
  }

  // Which elements show anything, themselves or by what is in them: groups of nothing are not gone through again and again.
  void find_drawing(pugi::xml_node root) {
    std::vector<pugi::xml_node> order{root};
    for (std::size_t i = 0; i < order.size(); ++i) {
      // Not recursive: files may nest as deep as they like.
      const pugi::xml_node n = order[i];
      for (pugi::xml_node child : n.children())
        if (child.type() == pugi::node_element) order.push_back(child);
    }
    for (std::size_t i = order.size(); i-- > 0;) {
      const std::string_view name = order[i].name();
      const bool is_group = name == "g" || name == "a" || name == "svg" || name == "symbol" || name == "defs";
      if (!is_group) drawing_.insert(order[i].internal_object());
      // A definition draws nothing where it stands.
      if (name != "defs" && drawing_.count(order[i].internal_object()) != 0) drawing_.insert(order[i].parent().internal_object());
    }
  }

  // Steps and bytes are taken in portions: the place of an element costs a look through the file.
  void spend(pugi::xml_node n, std::uint64_t steps, std::uint64_t bytes) {
    steps_ += steps;
    bytes_ += bytes;
    if (steps_ < kPortion && bytes_ < kPortion) return;
    const std::string place = document_.place_of(n);
    budget_.take_work(place, "what its shapes are made of (nested <use> multiply)", steps_);
    budget_.take_memory(place, "the shapes so far", bytes_);
    steps_ = bytes_ = 0;
  }

  double diagonal() const { return std::hypot(result_.scene.width, result_.scene.height) / std::sqrt(2.0); }

  double flatness() const { return kFlatness * std::max(result_.scene.width, result_.scene.height); }

  void children(pugi::xml_node n, const Style& style, int depth) {
    if (uses_ > 0 && drawing_.count(n.internal_object()) == 0) return;
    if (depth > kDeepest)
      document_.fail(n, "elements nest deeper than " + std::to_string(kDeepest), "look for a <use> that contains itself");
    for (pugi::xml_node child : n.children()) {
      if (child.type() != pugi::node_element) continue;
      element(child, style, depth);
    }
  }

  void element(pugi::xml_node n, const Style& outer, int depth) {
    spend(n, kElementSteps, 0);
    const std::string_view name = n.name();
    static const std::set<std::string_view> kSilent = {"title",          "desc",           "metadata", "defs",
                                                       "linearGradient", "radialGradient", "symbol",   "style"};
    if (kSilent.count(name) != 0 || name.find(':') != std::string_view::npos) return;
    static const std::set<std::string_view> kKnown = {"g",       "a",    "svg",     "use",      "rect", "circle",
                                                      "ellipse", "line", "polygon", "polyline", "path"};
    if (kKnown.count(name) == 0) {
      document_.ignored.insert("<" + std::string(name) + ">");
      return;
    }
    const Style style = inherit(n, outer);
    if (style.role == Role::ignore) return;
    if (name == "g" || name == "a" || name == "svg") return children(n, style, depth + 1);
    if (name == "use") return use(n, style, depth);
    shape(n, name, style);
  }

  void use(pugi::xml_node n, Style style, int depth) {
    if (depth > kDeepest)
      document_.fail(n, "elements nest deeper than " + std::to_string(kDeepest), "look for a <use> that contains itself");
    const pugi::xml_node target = document_.referred(n);
    if (!target) document_.fail(n, "refers to nothing in this file", "give href=\"#ID\" of an element of this file");
    Transform move;
    move.e = document_.length_attribute(n, "x", result_.scene.width);
    move.f = document_.length_attribute(n, "y", result_.scene.height);
    style.transform = style.transform * move;
    if (++uses_ > kMostUses) document_.fail(n, "the file expands to more than 100000 uses", "look for nested <use>");
    if (std::string_view(target.name()) == "symbol") return children(target, inherit(target, style), depth + 1);
    element(target, style, depth + 1);
  }

  void shape(pugi::xml_node n, std::string_view name, const Style& style) {
    const double w = result_.scene.width, h = result_.scene.height;
    const bool filled = style.fill != "none" && style.fill_opacity > 0 && name != "line";
    const double opacity = style.opacity * (filled ? style.fill_opacity : style.stroke_opacity);
    if (opacity == 0) return;
    if (opacity < 1 && style.role != Role::light) document_.ignored.insert("opacity (what is not a light blocks wholly)");
    PlaneBody body;
    if (name == "circle" || name == "ellipse") {
      const bool round = name == "circle";
      const double rx = round ? document_.length_attribute(n, "r", diagonal()) : document_.length_attribute(n, "rx", w);
      const double ry = round ? rx : document_.length_attribute(n, "ry", h);
      if (rx < 0 || ry < 0) document_.fail(n, "a radius is negative", "give a radius above 0");
      if (rx == 0 || ry == 0) return;
      body.shape = PlaneBody::Shape::ellipse;
      body.center = style.transform.apply({document_.length_attribute(n, "cx", w), document_.length_attribute(n, "cy", h)});
      body.x_axis = style.transform.apply_vector({rx, 0});
      body.y_axis = style.transform.apply_vector({0, ry});
      if (!filled) {
        if (style.stroke == "none" && style.role == Role::by_shape) return;
        // Seen from both sides: a closed polyline.
        Pen pen({body.x_axis.x, body.x_axis.y, body.y_axis.x, body.y_axis.y, body.center.x, body.center.y}, flatness(), {});
        pen.move({1, 0});
        for (double x : {-1.0, 1.0}) pen.arc(1, 1, 0, false, true, {x, 0});
        body.shape = PlaneBody::Shape::polyline;
        body.contours = pen.finish().points;
      }
      return add(n, std::move(body), style, filled);
    }
    Pen pen(style.transform, flatness(), [&](std::size_t points) { spend(n, 400 * points, 40 * points); });
    draw(n, name, pen);
    Contours contours = pen.finish();
    if (filled) {
      for (auto& c : contours.points)
        if (c.size() > 2) body.contours.push_back(std::move(c));
      body.even_odd = style.rule == "evenodd";
      if (body.contours.empty()) return;
      return add(n, std::move(body), style, true);
    }
    if (style.stroke == "none" && style.role == Role::by_shape) return;
    const double radius = 0.5 * style.stroke_width * std::sqrt(std::fabs(style.transform.determinant()));
    if (style.cap == "round" && radius > 0) {
      for (std::size_t i = 0; i < contours.points.size(); ++i) {
        spend(n, 60 * contours.points[i].size(), 80 * contours.points[i].size());
        add(n, stroke_of(contours.points[i], contours.closed[i], radius, flatness()), style, false);
      }
      return;
    }
    if (contours.points.empty()) return;
    for (std::size_t i = 0; i < contours.points.size(); ++i)
      if (contours.closed[i]) contours.points[i].push_back(contours.points[i].front());
    body.shape = PlaneBody::Shape::polyline;
    body.contours = std::move(contours.points);
    add(n, std::move(body), style, false);
  }

  void draw(pugi::xml_node n, std::string_view name, Pen& pen) const {
    const auto x_of = [&](const char* key) { return document_.length_attribute(n, key, result_.scene.width); };
    const auto y_of = [&](const char* key) { return document_.length_attribute(n, key, result_.scene.height); };
    if (name == "line") {
      pen.move({x_of("x1"), y_of("y1")});
      pen.line({x_of("x2"), y_of("y2")});
      return;
    }
    if (name == "rect") return draw_rect(n, {x_of("x"), y_of("y")}, {x_of("width"), y_of("height")}, pen);
    try {
      if (name == "path") return draw_path(n.attribute("d").value(), pen);
      draw_points(n.attribute("points").value(), pen);
      if (name == "polygon") pen.close();
    } catch (const std::string& problem) {
      document_.fail(n, problem, "compare it with the SVG path grammar");
    }
  }

  void draw_rect(pugi::xml_node n, Vec2d corner, Vec2d size, Pen& pen) const {
    if (size.x < 0 || size.y < 0) document_.fail(n, "width and height must not be negative", "move x or y instead");
    if (size.x == 0 || size.y == 0) return;
    double rx = document_.length_attribute(n, "rx", result_.scene.width, -1),
           ry = document_.length_attribute(n, "ry", result_.scene.height, -1);
    if (rx < 0) rx = ry;
    if (ry < 0) ry = rx;
    rx = std::clamp(rx, 0.0, size.x / 2);
    ry = std::clamp(ry, 0.0, size.y / 2);
    const bool round = rx > 0 && ry > 0;
    if (!round) rx = ry = 0;
    const Vec2d far = corner + size;
    const auto turn = [&](Vec2d to) {
      if (round) pen.arc(rx, ry, 0, false, true, to);
    };
    pen.move({corner.x + rx, corner.y});
    pen.line({far.x - rx, corner.y});
    turn({far.x, corner.y + ry});
    pen.line({far.x, far.y - ry});
    turn({far.x - rx, far.y});
    pen.line({corner.x + rx, far.y});
    turn({corner.x, far.y - ry});
    pen.line({corner.x, corner.y + ry});
    turn({corner.x + rx, corner.y});
    pen.close();
  }

  void add(pugi::xml_node n, PlaneBody body, const Style& style, bool filled) {
    if (result_.scene.bodies.size() >= kMostBodies) document_.fail(n, "more than a million shapes", "split the scene");
    spend(n, 500, sizeof(PlaneBody) + 40);
    body.name = n.attribute("id").value();
    if (style.role == Role::light) body.light = emission_of(document_, n, body, style, filled, {result_.scene.width, result_.scene.height});
    if (body.light) dim(*body.light, style.opacity * (filled ? style.fill_opacity : style.stroke_opacity));
    if (body.light && body.light->gradient)
      spend(n, 300 * body.light->gradient->stops.size(), sizeof(PlaneStop) * body.light->gradient->stops.size());
    result_.scene.bodies.push_back(std::move(body));
  }

  // A translucent light shines as much less.
  static void dim(PlaneEmission& light, double opacity) {
    light.radiance = light.radiance * opacity;
    if (!light.gradient) return;
    for (PlaneStop& stop : light.gradient->stops) stop.radiance = stop.radiance * opacity;
  }

  Document document_;
  Budget budget_;
  std::uint64_t steps_ = 0, bytes_ = 0;
  std::unordered_map<const void*, Declared> declared_;
  std::unordered_set<const void*> drawing_;
  std::size_t uses_ = 0;
  PlaneSvg result_;
};

}  // namespace

}  // namespace steradian::plane::svg

namespace steradian {

PlaneSvg load_plane_scene_from_text(const std::string& svg, const std::string& name, const Limits& limits) {
  return plane::svg::Reader(svg, name, limits).read();
}

PlaneSvg load_plane_scene(const std::string& path, const Limits& limits) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw Error(path, "cannot be opened", "check the path");
  const std::streamoff size = file.tellg();
  if (size > 0) Budget(limits).take_memory(path, "the text of the file, as a tree", static_cast<std::uint64_t>(size) * 4);
  file.seekg(0);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file && !file.eof()) throw Error(path, "cannot be read", "check that it is a file");
  return load_plane_scene_from_text(text.str(), path, limits);
}

}  // namespace steradian
