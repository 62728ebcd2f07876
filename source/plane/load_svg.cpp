// SVG to bodies: the tree, what is inherited down it, and the shapes.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <optional>
#include <pugixml.hpp>
#include <set>
#include <sstream>

#include "plane/svg_text.h"
#include "steradian/error.h"
#include "steradian/plane.h"

namespace steradian {
namespace {

using namespace svg;

// Paths are flattened to this many user units, which are pixels.
constexpr double kFlatness = 0.01;
constexpr int kDeepest = 64;           // nested groups and uses: deeper is a cycle or an attack
constexpr std::size_t kMostBodies = 1'000'000, kMostUses = 100'000;

enum class Role { by_shape, light, occluder, ignore };

// What elements inherit.
struct Style {
  std::string fill = "black", stroke = "none", color = "black", cap = "butt", rule = "nonzero";
  double stroke_width = 1;
  Role role = Role::by_shape;
  double intensity = 1;
  double range = std::numeric_limits<double>::infinity();
  PlaneProfile profile = PlaneProfile::uniform;
  Vec2d spot_axis;
  double spot_half_angle = 0;
  Transform transform;
};

std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> result;
  std::istringstream in{std::string(text)};
  for (std::string w; in >> w;) result.push_back(w);
  return result;
}

class Reader {
 public:
  Reader(std::string text, std::string name) : text_(std::move(text)), name_(std::move(name)) {}

  PlaneSvg read() {
    pugi::xml_document document;
    const auto parsed = document.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_auto);
    if (!parsed)
      throw Error(place(parsed.offset), std::string("not well-formed XML: ") + parsed.description(),
                  "check the tags and quotes on this line");
    const pugi::xml_node root = document.document_element();
    if (std::string_view(root.name()) != "svg")
      throw Error(place(root), "the root element is <" + std::string(root.name()) + ">, not <svg>", "give an SVG file");
    collect_ids(root);
    read_frame(root);
    Style style;
    children(root, inherit(root, style), 0);
    result_.ignored.assign(ignored_.begin(), ignored_.end());
    return std::move(result_);
  }

 private:
  std::string place(std::ptrdiff_t offset) const {
    const auto end = text_.begin() + std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text_.size()));
    return name_ + ":" + std::to_string(1 + std::count(text_.begin(), end, '\n'));
  }
  std::string place(pugi::xml_node n) const {
    std::string where = place(n.offset_debug());
    if (*n.name() != '\0') where += std::string(": <") + n.name() + ">";
    if (n.attribute("id")) where += std::string(" '") + n.attribute("id").value() + "'";
    return where;
  }
  [[noreturn]] void fail(pugi::xml_node n, const std::string& problem, const std::string& hint) const {
    throw Error(place(n), problem, hint);
  }

  void collect_ids(pugi::xml_node node) {
    std::vector<pugi::xml_node> open{node};
    while (!open.empty()) {
      const pugi::xml_node n = open.back();
      open.pop_back();
      if (n.attribute("id")) ids_.insert({n.attribute("id").value(), n});
      for (pugi::xml_node child : n.children()) open.push_back(child);
    }
  }

  // A length: user units, px, or an absolute unit at 96 to the inch; a percentage of `whole`.
  std::optional<double> length_of(std::string_view text, double whole) const {
    Scanner scan(text);
    const auto value = scan.number();
    if (!value) return {};
    std::string unit;
    while (!scan.at_end()) unit += scan.next();
    unit = std::string(trimmed(unit));
    static constexpr std::pair<const char*, double> kUnits[] = {
        {"", 1}, {"px", 1}, {"pt", 96.0 / 72}, {"pc", 16}, {"in", 96}, {"cm", 96 / 2.54}, {"mm", 9.6 / 2.54}};
    for (const auto& [known, scale] : kUnits)
      if (unit == known) return *value * scale;
    if (unit == "%") return *value / 100 * whole;
    return {};
  }
  double length_attribute(pugi::xml_node n, const char* attribute, double whole, double otherwise = 0) const {
    if (!n.attribute(attribute)) return otherwise;
    const auto v = length_of(n.attribute(attribute).value(), whole);
    if (!v)
      fail(n, std::string(attribute) + "=\"" + n.attribute(attribute).value() + "\" is not a length",
           "write a number, with px, pt, mm, cm, in or %");
    return *v;
  }

  void read_frame(pugi::xml_node root) {
    PlaneScene& scene = result_.scene;
    if (root.attribute("viewBox")) {
      Scanner scan(root.attribute("viewBox").value());
      double v[4];
      for (double& x : v) {
        const auto number = scan.number();
        if (!number) fail(root, "viewBox needs four numbers", "write viewBox=\"0 0 WIDTH HEIGHT\"");
        x = *number;
        scan.skip_separators();
      }
      scene.origin = {v[0], v[1]};
      scene.width = v[2];
      scene.height = v[3];
    } else {
      scene.width = length_attribute(root, "width", 512, 512);
      scene.height = length_attribute(root, "height", 512, 512);
    }
    if (!(scene.width > 0 && scene.height > 0 && scene.width < 1e6 && scene.height < 1e6))
      fail(root, "the picture's width and height must be positive and below a million", "set the viewBox");
  }

  // An attribute, or the same property in style="...".
  static std::optional<std::string> property(pugi::xml_node n, const char* key) {
    std::string_view style = n.attribute("style").value();
    while (!style.empty()) {
      const std::size_t end = std::min(style.find(';'), style.size());
      const std::string_view declaration = style.substr(0, end);
      const std::size_t colon = declaration.find(':');
      if (colon != std::string_view::npos && trimmed(declaration.substr(0, colon)) == key)
        return std::string(trimmed(declaration.substr(colon + 1)));
      style.remove_prefix(std::min(end + 1, style.size()));
    }
    if (n.attribute(key)) return std::string(trimmed(n.attribute(key).value()));
    return {};
  }

  double number_attribute(pugi::xml_node n, const char* key, double low, const char* hint) const {
    Scanner scan(n.attribute(key).value());
    const auto v = scan.number();
    scan.skip_separators();
    if (!v || !scan.at_end() || *v < low) fail(n, std::string(key) + "=\"" + n.attribute(key).value() + "\" does not do", hint);
    return *v;
  }

  Style inherit(pugi::xml_node n, Style style) {
    const std::pair<const char*, std::string*> inherited[] = {{"fill", &style.fill},
                                                              {"stroke", &style.stroke},
                                                              {"color", &style.color},
                                                              {"stroke-linecap", &style.cap},
                                                              {"fill-rule", &style.rule}};
    for (const auto& [key, value] : inherited) {
      const auto p = property(n, key);
      if (p && *p != "inherit") *value = *p;
    }
    if (const auto width = property(n, "stroke-width")) {
      const auto v = length_of(*width, diagonal());
      if (!v || *v < 0) fail(n, "stroke-width=\"" + *width + "\" is not a length", "write a number");
      style.stroke_width = *v;
    }
    if (const auto display = property(n, "display"); display && *display == "none") style.role = Role::ignore;
    read_role(n, style);
    if (n.attribute("data-intensity")) style.intensity = number_attribute(n, "data-intensity", 0, "give a number of at least 0");
    if (n.attribute("data-range")) {
      style.range = number_attribute(n, "data-range", 0, "give a positive distance in user units");
      if (style.range == 0) fail(n, "data-range must be positive", "leave it out for light without a limit");
    }
    read_profile(n, style);
    if (n.attribute("transform")) {
      const auto t = parse_transform(n.attribute("transform").value());
      if (!t) fail(n, std::string("cannot read transform=\"") + n.attribute("transform").value() + "\"",
                   "use matrix, translate, scale, rotate, skewX and skewY");
      style.transform = style.transform * *t;
    }
    return style;
  }

  void read_role(pugi::xml_node n, Style& style) const {
    if (style.role == Role::ignore) return;
    static constexpr std::pair<const char*, Role> kRoles[] = {
        {"light", Role::light}, {"occluder", Role::occluder}, {"ignore", Role::ignore}};
    for (const std::string& word : words(n.attribute("class").value()))
      for (const auto& [key, role] : kRoles)
        if (word == key) style.role = role;
    if (!n.attribute("data-steradian")) return;
    for (const auto& [key, role] : kRoles)
      if (trimmed(n.attribute("data-steradian").value()) == key) {
        style.role = role;
        return;
      }
    fail(n, std::string("data-steradian=\"") + n.attribute("data-steradian").value() + "\" is unknown",
         "use light, occluder or ignore");
  }

  void read_profile(pugi::xml_node n, Style& style) const {
    if (n.attribute("data-profile")) {
      const std::string_view v = trimmed(n.attribute("data-profile").value());
      if (v == "uniform") style.profile = PlaneProfile::uniform;
      else if (v == "lambert") style.profile = PlaneProfile::lambert;
      else if (v == "inverse") style.profile = PlaneProfile::inverse;
      else fail(n, "data-profile=\"" + std::string(v) + "\" is unknown", "use uniform, lambert or inverse");
    }
    if (!n.attribute("data-spot")) return;
    Scanner scan(n.attribute("data-spot").value());
    const auto axis = scan.number();
    scan.skip_separators();
    const auto half = scan.number();
    if (!axis || !half || !(*half >= 0 && *half <= 180))
      fail(n, "data-spot needs two angles in degrees", "write data-spot=\"DIRECTION HALF-ANGLE\", the half angle up to 180");
    const double degree = std::numbers::pi / 180;
    style.spot_axis = {std::cos(*axis * degree), std::sin(*axis * degree)};
    style.spot_half_angle = *half * degree;
  }

  double diagonal() const { return std::hypot(result_.scene.width, result_.scene.height) / std::sqrt(2.0); }

  void children(pugi::xml_node n, const Style& style, int depth) {
    if (depth > kDeepest) fail(n, "elements nest deeper than " + std::to_string(kDeepest), "look for a <use> that contains itself");
    for (pugi::xml_node child : n.children()) {
      if (child.type() != pugi::node_element) continue;
      element(child, style, depth);
    }
  }

  void element(pugi::xml_node n, const Style& outer, int depth) {
    const std::string_view name = n.name();
    static const std::set<std::string_view> kSilent = {"title", "desc", "metadata", "defs", "linearGradient", "symbol"};
    if (kSilent.count(name) != 0 || name.find(':') != std::string_view::npos) return;
    static const std::set<std::string_view> kKnown = {"g",    "a",       "svg",     "use",  "rect", "circle", "ellipse",
                                                      "line", "polygon", "polyline", "path"};
    if (kKnown.count(name) == 0) {
      ignored_.insert("<" + std::string(name) + ">");
      return;
    }
    const Style style = inherit(n, outer);
    if (style.role == Role::ignore) return;
    for (const char* unsupported : {"clip-path", "mask", "filter"})
      if (const auto p = property(n, unsupported); p && *p != "none") ignored_.insert(unsupported);
    if (name == "g" || name == "a" || name == "svg") return children(n, style, depth + 1);
    if (name == "use") return use(n, style, depth);
    shape(n, name, style);
  }

  pugi::xml_node referred(pugi::xml_node n) const {
    std::string_view target = n.attribute("href") ? n.attribute("href").value() : n.attribute("xlink:href").value();
    if (!target.starts_with('#')) return {};
    const auto found = ids_.find(std::string(target.substr(1)));
    return found == ids_.end() ? pugi::xml_node() : found->second;
  }

  void use(pugi::xml_node n, Style style, int depth) {
    if (depth > kDeepest) fail(n, "elements nest deeper than " + std::to_string(kDeepest), "look for a <use> that contains itself");
    const pugi::xml_node target = referred(n);
    if (!target) fail(n, "refers to nothing in this file", "give href=\"#ID\" of an element of this file");
    Transform move;
    move.e = length_attribute(n, "x", result_.scene.width);
    move.f = length_attribute(n, "y", result_.scene.height);
    style.transform = style.transform * move;
    if (++uses_ > kMostUses) fail(n, "the file expands to more than 100000 uses", "look for nested <use>");
    if (std::string_view(target.name()) == "symbol") return children(target, inherit(target, style), depth + 1);
    element(target, style, depth + 1);
  }

  void shape(pugi::xml_node n, std::string_view name, const Style& style) {
    const double w = result_.scene.width, h = result_.scene.height;
    const bool filled = style.fill != "none" && name != "line";
    PlaneBody body;
    Contours contours;
    if (name == "circle" || name == "ellipse") {
      const bool round = name == "circle";
      const double rx = round ? length_attribute(n, "r", diagonal()) : length_attribute(n, "rx", w);
      const double ry = round ? rx : length_attribute(n, "ry", h);
      if (rx < 0 || ry < 0) fail(n, "a radius is negative", "give a radius above 0");
      if (rx == 0 || ry == 0) return;
      body.shape = PlaneBody::Shape::ellipse;
      body.center = style.transform.apply({length_attribute(n, "cx", w), length_attribute(n, "cy", h)});
      body.x_axis = style.transform.apply_vector({rx, 0});
      body.y_axis = style.transform.apply_vector({0, ry});
      if (!filled) {
        if (style.stroke == "none" && style.role == Role::by_shape) return;
        // Seen from both sides: a closed polyline.
        std::vector<Vec2d> ring;
        const double r = std::max(length(body.x_axis), length(body.y_axis));
        const int pieces = static_cast<int>(std::clamp(std::numbers::pi / std::acos(std::max(1 - kFlatness / std::max(r, kFlatness), 0.0)), 8.0, 1e4)) + 1;
        for (int i = 0; i <= pieces; ++i) {
          const double t = 2 * std::numbers::pi * (i % pieces) / pieces;
          ring.push_back(body.center + body.x_axis * std::cos(t) + body.y_axis * std::sin(t));
        }
        body.shape = PlaneBody::Shape::polyline;
        body.contours.push_back(ring);
      }
      return add(n, std::move(body), style, filled);
    }
    const std::string data = path_data(n, name);
    if (data.empty()) return;
    try {
      contours = flatten_path(data, style.transform, kFlatness);
    } catch (const std::string& problem) {
      fail(n, problem, "compare it with the SVG path grammar");
    }
    if (filled) {
      for (auto& c : contours.points)
        if (c.size() > 2) body.contours.push_back(std::move(c));
      body.even_odd = style.rule == "evenodd";
      if (body.contours.empty()) return;
      return add(n, std::move(body), style, true);
    }
    if (style.stroke == "none" && style.role == Role::by_shape) return;
    for (std::size_t i = 0; i < contours.points.size(); ++i)
      if (contours.closed[i]) contours.points[i].push_back(contours.points[i].front());
    const double radius = 0.5 * style.stroke_width * std::sqrt(std::fabs(style.transform.determinant()));
    if (style.cap == "round" && radius > 0) {
      for (const auto& c : contours.points)
        for (std::size_t i = 0; i + 1 < c.size(); ++i) {
          PlaneBody capsule;
          capsule.shape = PlaneBody::Shape::capsule;
          capsule.contours = {{c[i], c[i + 1]}};
          capsule.radius = radius;
          add(n, std::move(capsule), style, false);
        }
      return;
    }
    if (contours.points.empty()) return;
    body.shape = PlaneBody::Shape::polyline;
    body.contours = std::move(contours.points);
    add(n, std::move(body), style, false);
  }

  // Every straight shape is a path.
  std::string path_data(pugi::xml_node n, std::string_view name) const {
    const double w = result_.scene.width, h = result_.scene.height;
    std::ostringstream d;
    d.imbue(std::locale::classic());
    d.precision(17);
    if (name == "path") return std::string(trimmed(n.attribute("d").value()));
    if (name == "line") {
      d << "M" << length_attribute(n, "x1", w) << "," << length_attribute(n, "y1", h) << " L" << length_attribute(n, "x2", w) << ","
        << length_attribute(n, "y2", h);
    } else if (name == "rect") {
      const double x = length_attribute(n, "x", w), y = length_attribute(n, "y", h);
      const double width = length_attribute(n, "width", w), height = length_attribute(n, "height", h);
      if (width < 0 || height < 0) fail(n, "width and height must not be negative", "move x or y instead");
      if (width == 0 || height == 0) return {};
      double rx = length_attribute(n, "rx", w, -1), ry = length_attribute(n, "ry", h, -1);
      if (rx < 0) rx = ry;
      if (ry < 0) ry = rx;
      rx = std::clamp(rx, 0.0, width / 2);
      ry = std::clamp(ry, 0.0, height / 2);
      d << "M" << x + rx << "," << y << " H" << x + width - rx;
      const auto corner = [&](double dx, double dy) {
        if (rx > 0 && ry > 0) d << " a" << rx << "," << ry << " 0 0 1 " << dx << "," << dy;
      };
      corner(rx, ry);
      d << " V" << y + height - ry;
      corner(-rx, ry);
      d << " H" << x + rx;
      corner(-rx, -ry);
      d << " V" << y + ry;
      corner(rx, -ry);
      d << " Z";
    } else {
      const std::string_view points = trimmed(n.attribute("points").value());
      if (points.empty()) return {};
      d << "M" << points << (name == "polygon" ? " Z" : "");
    }
    return d.str();
  }

  void add(pugi::xml_node n, PlaneBody body, const Style& style, bool filled) {
    if (result_.scene.bodies.size() >= kMostBodies) fail(n, "more than a million shapes", "split the scene");
    body.name = n.attribute("id").value();
    if (style.role == Role::light) body.light = emission(n, body, style, filled);
    result_.scene.bodies.push_back(std::move(body));
  }

  Vec3d color(pugi::xml_node n, std::string_view text, const Style& style) const {
    if (text == "currentColor") text = style.color;
    const auto c = parse_color(text);
    if (!c) fail(n, "'" + std::string(text) + "' is not a colour", "write #rrggbb, rgb(r,g,b) or a colour's name");
    return *c;
  }

  PlaneEmission emission(pugi::xml_node n, const PlaneBody& body, const Style& style, bool filled) {
    PlaneEmission e;
    e.profile = style.profile;
    e.range = style.range;
    e.spot_axis = style.spot_axis;
    e.spot_half_angle = style.spot_half_angle;
    std::string paint = filled || style.stroke == "none" ? style.fill : style.stroke;
    if (paint == "none") paint = style.stroke;
    if (paint == "none") fail(n, "a light without a colour", "give it a fill");
    if (paint.starts_with("url(")) {
      const std::size_t hash = paint.find('#'), close = paint.find_first_of(")\"'", hash);
      const auto found = hash == std::string::npos ? ids_.end() : ids_.find(paint.substr(hash + 1, close - hash - 1));
      if (found == ids_.end()) fail(n, "fill=\"" + paint + "\" refers to nothing in this file", "define the gradient in <defs>");
      gradient(n, found->second, body, style, e);
    } else {
      e.radiance = color(n, paint, style) * style.intensity;
    }
    return e;
  }

  void gradient(pugi::xml_node user, pugi::xml_node node, const PlaneBody& body, const Style& style, PlaneEmission& e) {
    const bool is_linear = std::string_view(node.name()) == "linearGradient";
    if (!is_linear) ignored_.insert("<" + std::string(node.name()) + "> (its mean colour shines)");
    // Attributes and stops may come from gradients this one refers to.
    std::vector<pugi::xml_node> chain;
    for (pugi::xml_node g = node; g && chain.size() < 16; g = referred(g)) chain.push_back(g);
    const auto attribute = [&](const char* key) {
      for (pugi::xml_node g : chain)
        if (g.attribute(key)) return g.attribute(key);
      return pugi::xml_attribute();
    };
    std::vector<PlaneStop> stops;
    for (pugi::xml_node g : chain) {
      for (pugi::xml_node s : g.children("stop")) {
        const double offset = std::clamp(length_attribute(s, "offset", 1), stops.empty() ? 0.0 : stops.back().offset, 1.0);
        const std::string text = property(s, "stop-color").value_or("black");
        stops.push_back({offset, color(s, text, style) * style.intensity});
      }
      if (!stops.empty()) break;
    }
    if (stops.empty()) fail(node, "the gradient has no stops", "add <stop> elements");
    if (!is_linear) {
      e.radiance = {};
      for (const PlaneStop& s : stops) e.radiance += s.radiance / static_cast<double>(stops.size());
      return;
    }
    if (const auto spread = attribute("spreadMethod"); spread && std::string_view(spread.value()) != "pad")
      ignored_.insert("spreadMethod");
    const bool in_user_space = std::string_view(attribute("gradientUnits").value()) == "userSpaceOnUse";
    const auto coordinate = [&](const char* key, double whole, double otherwise) {
      const auto a = attribute(key);
      if (!a) return otherwise;
      const auto v = length_of(a.value(), whole);
      if (!v) fail(node, std::string(key) + " is not a length", "write a number or a percentage");
      return *v;
    };
    const double w = in_user_space ? result_.scene.width : 1, h = in_user_space ? result_.scene.height : 1;
    Transform t = in_user_space ? style.transform : box_transform(user, body, style);
    if (attribute("gradientTransform")) {
      const auto own = parse_transform(attribute("gradientTransform").value());
      if (!own) fail(node, "cannot read gradientTransform", "use matrix, translate, scale, rotate, skewX and skewY");
      t = t * *own;
    }
    const Vec2d from{coordinate("x1", w, 0), coordinate("y1", h, 0)}, to{coordinate("x2", w, w), coordinate("y2", h, 0)};
    const Vec2d axis = to - from;
    const double det = t.determinant();
    if (dot(axis, axis) == 0 || det == 0) {
      e.radiance = stops.back().radiance;
      return;
    }
    // Lines of one colour stay lines under the transform, but not at right angles to the mapped axis: map the
    // offset's derivative, a covector, and lay a new axis along it.
    const Vec2d g = axis / dot(axis, axis);
    const Vec2d mapped{(g.x * t.d - g.y * t.b) / det, (g.y * t.a - g.x * t.c) / det};
    PlaneGradient result;
    result.from = t.apply(from);
    result.to = result.from + mapped / dot(mapped, mapped);
    result.stops = std::move(stops);
    e.gradient = std::move(result);
  }

  // From the unit square to the shape's bounding box in its own coordinates, then to the scene.
  Transform box_transform(pugi::xml_node n, const PlaneBody& body, const Style& style) const {
    const Transform& t = style.transform;
    const double det = t.determinant();
    if (det == 0) return t;
    const Transform inverse{t.d / det, -t.b / det, -t.c / det, t.a / det, (t.c * t.f - t.d * t.e) / det,
                            (t.b * t.e - t.a * t.f) / det};
    Vec2d low{1e300, 1e300}, high{-1e300, -1e300};
    const auto grow = [&](Vec2d p) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    };
    for (const auto& c : body.contours)
      for (Vec2d p : c) grow(inverse.apply(p));
    if (body.contours.empty()) {
      const Vec2d c = inverse.apply(body.center), x = inverse.apply_vector(body.x_axis), y = inverse.apply_vector(body.y_axis);
      const Vec2d half{std::hypot(x.x, y.x), std::hypot(x.y, y.y)};
      grow(c - half);
      grow(c + half);
    }
    const Vec2d size = high - low;
    if (!(size.x > 0 && size.y > 0))
      fail(n, "a gradient across a shape without width or height", "use gradientUnits=\"userSpaceOnUse\"");
    return t * Transform{size.x, 0, 0, size.y, low.x, low.y};
  }

  std::string text_, name_;
  std::map<std::string, pugi::xml_node> ids_;
  std::set<std::string> ignored_;
  std::size_t uses_ = 0;
  PlaneSvg result_;
};

}  // namespace

PlaneSvg load_plane_scene_from_text(const std::string& svg, const std::string& name) { return Reader(svg, name).read(); }

PlaneSvg load_plane_scene(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(path, "cannot be opened", "check the path");
  std::ostringstream text;
  text << file.rdbuf();
  if (!file && !file.eof()) throw Error(path, "cannot be read", "check that it is a file");
  return load_plane_scene_from_text(text.str(), path);
}

}  // namespace steradian
