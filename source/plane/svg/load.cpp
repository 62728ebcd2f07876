// Converts SVG to bodies: the tree, inherited properties, and the shapes.
#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <optional>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "core/budget.h"
#include "plane/svg/backdrop.h"
#include "plane/svg/light.h"
#include "plane/svg/load.h"
#include "plane/svg/path.h"
#include "plane/svg/stroke.h"
#include "plane/svg/style/style.h"
#include "plane/svg/text/lettering.h"
#include "plane/svg/viewport.h"
#include "steradian/error.h"
#include "steradian/plane.h"

namespace steradian::plane::svg {
namespace {

// Largest distance of a flattened curve from the exact one, as a fraction of the picture's larger side: 0.01 of a pixel in a picture of
// 1000 pixels, whatever a user unit is.
constexpr double kCurveFlatness = 1e-5;
constexpr int kDeepest = 64;  // nested groups and uses: deeper ones are a cycle or an attack
constexpr std::size_t kMostBodies = 1'000'000, kMostUses = 100'000, kMostSuns = 1000;
constexpr std::uint64_t kElementSteps = 1000, kPortion = 20'000'000;
constexpr std::size_t kMostNamed = 8;  // of the shapes that are left out for one reason

// All elements, each behind its parent. Not recursive: files may nest to any depth.
std::vector<pugi::xml_node> elements_of(pugi::xml_node root) {
  std::vector<pugi::xml_node> order{root};
  for (std::size_t i = 0; i < order.size(); ++i) {
    const pugi::xml_node n = order[i];
    for (pugi::xml_node child : n.children())
      if (child.type() == pugi::node_element) order.push_back(child);
  }
  return order;
}

class DrawingReader {
 public:
  DrawingReader(std::string text, std::string name, const Limits& limits) : document_(std::move(text), name), budget_(limits) {
    result_.scene.name = std::move(name);
    find_drawing(document_.root());
  }

  LoadedDrawing read(const Backdrops* backdrops) try {
    if (backdrops != nullptr) keep_backdrops(*backdrops);
    const pugi::xml_node root = document_.root();
    read_frame(root);
    styles_.emplace(document_, diagonal());
    children(root, styles_->inherit(root, {}), 0);
    if (backdrops == nullptr) {
      judge_backdrops();
      warn_of_buried_lights();
    }
    result_.ignored.assign(document_.ignored.begin(), document_.ignored.end());
    for (auto& [why, shapes] : left_out_) result_.left_out.push_back(std::move(shapes));
    return {std::move(result_), std::move(backdrops_)};
  } catch (const std::bad_alloc&) {
    throw budget_.out_of_memory();
  }

 private:
  void read_frame(pugi::xml_node root) {
    PlaneScene& scene = result_.scene;
    const Viewport view = viewport_of(document_, root);
    const bool boxed = view.box.has_value();
    scene.origin = boxed ? view.box->origin : Vec2d{};
    scene.width = boxed ? view.box->size.x : document_.length_attribute(root, "width", 512, 512);
    scene.height = boxed ? view.box->size.y : document_.length_attribute(root, "height", 512, 512);
    scene.fit = view.fit;
    scene.align = view.align;
    if (root.attribute("data-fog-density"))
      scene.fog_density = document_.number_attribute(root, "data-fog-density", 0, "give what is lost of light on a way of one user unit");
    if (!(scene.width > 0 && scene.height > 0 && scene.width < 1e6 && scene.height < 1e6))
      document_.fail(root, "the picture's width and height must be positive and below a million", "set the viewBox");
  }

  // Finds elements that draw anything, themselves or by their children: empty groups are not traversed again and again.
  void find_drawing(pugi::xml_node root) {
    const std::vector<pugi::xml_node> order = elements_of(root);
    for (std::size_t i = order.size(); i-- > 0;) {
      const std::string_view name = order[i].name();
      const bool is_group = name == "g" || name == "a" || name == "svg" || name == "symbol" || name == "defs";
      if (!is_group) drawing_.insert(order[i].internal_object());
      // A definition draws nothing at its own place.
      if (name != "defs" && drawing_.count(order[i].internal_object()) != 0) drawing_.insert(order[i].parent().internal_object());
    }
  }

  // Steps and bytes are counted in portions: finding the place of an element needs a search through the file.
  void spend(pugi::xml_node n, std::uint64_t steps, std::uint64_t bytes) {
    steps_ += steps;
    bytes_ += bytes;
    if (steps_ < kPortion && bytes_ < kPortion) return;
    const std::string place = document_.place_of(n);
    budget_.take_work(place, "what its shapes are made of (nested <use> multiply)", steps_);
    budget_.take_memory(place, "the shapes so far", bytes_);
    steps_ = bytes_ = 0;
  }

  Vec2d size() const { return {result_.scene.width, result_.scene.height}; }

  double diagonal() const { return std::hypot(result_.scene.width, result_.scene.height) / std::sqrt(2.0); }

  double flatness() const { return kCurveFlatness * std::max(result_.scene.width, result_.scene.height); }

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
    static const std::set<std::string_view> kSilent = {"title",          "desc",   "metadata", "defs",     "linearGradient",
                                                       "radialGradient", "symbol", "style",    "clipPath", "mask",
                                                       "filter",         "marker", "pattern",  "script"};
    if (kSilent.count(name) != 0 || name.find(':') != std::string_view::npos) return;
    static const std::set<std::string_view> kKnown = {"g",       "a",    "svg",     "use",      "rect", "circle", "switch",
                                                      "ellipse", "line", "polygon", "polyline", "path", "text"};
    if (name.starts_with("animate") || name == "set") {
      document_.ignored.insert("<" + std::string(name) + "> (it moves in --frames only)");
      return;
    }
    if (kKnown.count(name) == 0) {
      document_.ignored.insert("<" + std::string(name) + ">");
      return;
    }
    Style style = styles_->inherit(n, outer);
    if (style.role == Role::ignore) return leave_out(n, style, PlaneLeftOut::Why::ignored);
    if (!style.clip.empty()) clip(n, style, depth);
    if (!style.mask.empty()) mask(n, style, depth);
    if (name == "g" || name == "a" || name == "switch") return children(n, style, depth + 1);
    if (name == "svg") return box(n, n, style, depth);
    if (name == "use") return use(n, style, depth);
    if (style.role == Role::sun && style.purpose == Purpose::picture) return sun(n, style);
    if (name == "text") return text(n, style);
    shape(n, name, style);
  }

  // The element's shape does not matter: only its paint does.
  void sun(pugi::xml_node n, const Style& style) {
    if (!style.sun)
      document_.fail(n, "a sun without a place", "write data-sun-direction=\"DIRECTION HALF-WIDTH\", in degrees; -90 stands above");
    if (result_.scene.suns.size() >= kMostSuns) document_.fail(n, "more than 1000 suns", "take fewer");
    const bool filled = style.fill != "none";
    PlaneEmission emission = emission_of(document_, n, {}, style, filled, size());
    dim(emission, style.opacity * (filled ? style.fill_opacity : style.stroke_opacity));
    if (emission.gradient) document_.fail(n, "a sun with a gradient", "give it one colour");
    result_.scene.suns.push_back({emission.radiance, style.sun->direction, style.sun->half_width, n.attribute("id").as_string("sun")});
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
    if (std::string_view(target.name()) == "symbol") return box(target, n, styles_->inherit(target, style), depth);
    element(target, style, depth + 1);
  }

  // The element that url(#...) names, if it is of this kind and in this file.
  pugi::xml_node named(const std::string& url, std::string_view kind) const {
    const std::size_t hash = url.find('#'), close = url.find_first_of(")\"'", hash);
    const pugi::xml_node node = hash == std::string::npos ? pugi::xml_node() : document_.by_id(url.substr(hash + 1, close - hash - 1));
    return std::string_view(node.name()) == kind ? node : pugi::xml_node();
  }

  // The shapes of a clipPath or a mask, drawn as if they stood at the place of use, in the order of the file.
  std::vector<PlaneBody> shapes_of(pugi::xml_node node, pugi::xml_node user, const Style& style, Purpose purpose, int depth) {
    if (depth > kDeepest)
      document_.fail(user, "elements nest deeper than " + std::to_string(kDeepest), "look for a clipPath or a mask that uses itself");
    Style plain;
    plain.transform = style.transform;
    plain.role = Role::occluder;
    plain.purpose = purpose;
    std::vector<PlaneBody> outside = std::exchange(result_.scene.bodies, {});
    plain = styles_->inherit(node, plain);
    if (!plain.clip.empty()) clip(node, plain, depth + 1);
    if (!plain.mask.empty()) mask(node, plain, depth + 1);
    children(node, plain, depth + 1);
    return std::exchange(result_.scene.bodies, std::move(outside));
  }

  // Adds the region of the element's clip-path.
  void clip(pugi::xml_node n, Style& style, int depth) {
    const pugi::xml_node node = named(style.clip, "clipPath");
    if (!node || std::string_view(node.attribute("clipPathUnits").value()) == "objectBoundingBox") {
      document_.ignored.insert("clip-path of a box, a shape or another file");
      return;
    }
    auto region = std::make_shared<ClipRegion>();
    for (const PlaneBody& body : shapes_of(node, n, style, Purpose::clip, depth))
      if (body.shape != PlaneBody::Shape::polyline) region->push_back(flattened(body, flatness()));
    style.clips.push_back(std::move(region));
  }

  // A mask of whites and blacks clips to its whites, less the blacks that are painted over them. Any other mask is skipped.
  void mask(pugi::xml_node n, Style& style, int depth) {
    const pugi::xml_node node = named(style.mask, "mask");
    const auto leave_out = [&] { document_.ignored.insert("mask (but of plain white and black shapes)"); };
    if (!node || std::string_view(node.attribute("maskContentUnits").value()) == "objectBoundingBox") return leave_out();
    const bool by_alpha = document_.property(node, "mask-type").value_or("luminance") == "alpha";
    auto region = std::make_shared<ClipRegion>();
    const auto spend_on = [&](std::uint64_t pairs) { spend(n, 20 * pairs, 0); };
    for (const PlaneBody& body : shapes_of(node, n, style, Purpose::mask, depth)) {
      const double y = 0.2126 * body.color.x + 0.7152 * body.color.y + 0.0722 * body.color.z;
      const bool white = by_alpha ? y >= 0 : y > 0.99, black = !by_alpha && y >= 0 && y < 0.01;
      if (!(white || black) || body.shape == PlaneBody::Shape::polyline) return leave_out();
      PlaneBody flat = flattened(body, flatness());
      if (white) {
        region->push_back(std::move(flat));
        continue;
      }
      for (PlaneBody& part : *region) part = without(part, flat, flatness(), spend_on);
    }
    style.clips.push_back(std::move(region));
    // The mask's own rectangle. Rectangles in fractions of the shape's box are skipped: they are larger than the shape unless a file says
    // otherwise.
    if (std::string_view(node.attribute("maskUnits").value()) != "userSpaceOnUse" || !node.attribute("width")) return;
    Pen pen(style.transform, flatness(), {});
    draw_rect(document_, node, size(), size().y, pen);
    PlaneBody room;
    room.contours = pen.finish().points;
    style.clips.push_back(std::make_shared<ClipRegion>(ClipRegion{std::move(room)}));
  }

  // A nested <svg>, or a <symbol>, in the box of its own or the <use>'s width and height.
  void box(pugi::xml_node n, pugi::xml_node user, Style style, int depth) {
    const PlaneScene& scene = result_.scene;
    const auto length = [&](const char* key, double whole) {
      return document_.length_attribute(user, key, whole, document_.length_attribute(n, key, whole, whole));
    };
    const Viewport view = viewport_of(document_, n);
    const Vec2d room{length("width", scene.width), length("height", scene.height)};
    if (view.box && !(view.box->size.x > 0 && view.box->size.y > 0)) return;
    // A <use> has already moved by its x and y.
    const bool nested = n == user;
    const Vec2d corner{nested ? document_.length_attribute(n, "x", scene.width) : 0,
                       nested ? document_.length_attribute(n, "y", scene.height) : 0};
    style.transform = style.transform * view.into(corner, room);
    children(n, style, depth + 1);
  }

  void text(pugi::xml_node n, const Style& style) {
    if (!fonts_) fonts_.emplace();
    for (const TextRun& run : lay_out_text(document_, *styles_, *fonts_, n, style, size(), [&] { spend(n, 2000, 100); })) {
      const bool filled = run.style.fill != "none" && run.style.fill_opacity > 0;
      leave_out_stroke(run.style, "stroke of text");
      if (run.style.opacity * run.style.fill_opacity == 0 || (!filled && run.style.role == Role::by_shape)) {
        leave_out(run.node, run.style, filled ? PlaneLeftOut::Why::transparent : PlaneLeftOut::Why::unpainted);
        continue;
      }
      PlaneBody body;
      for (const TextRun::Letter& letter : run.letters) {
        // FreeType calls the pen, so that it must not throw: the cost of a letter is counted afterwards.
        Pen pen(run.style.transform, flatness(), {});
        letter.face->draw(letter.glyph, letter.at, run.style.font_size, pen);
        for (auto& contour : pen.finish().points) {
          spend(run.node, 400 * contour.size(), 40 * contour.size());
          if (contour.size() > 2) body.contours.push_back(std::move(contour));
        }
      }
      if (!body.contours.empty()) add(run.node, std::move(body), run.style, true);
    }
  }

  void shape(pugi::xml_node n, std::string_view name, const Style& style) {
    const double w = result_.scene.width, h = result_.scene.height;
    const bool outlined = style.purpose == Purpose::clip;
    const bool filled = (outlined || (style.fill != "none" && style.fill_opacity > 0)) && name != "line";
    if (filled) leave_out_stroke(style, "stroke of a filled shape");
    const double opacity = outlined ? 1 : style.opacity * (filled ? style.fill_opacity : style.stroke_opacity);
    if (opacity == 0) return leave_out(n, style, PlaneLeftOut::Why::transparent);
    if (opacity < 1 && style.role != Role::light && style.purpose == Purpose::picture)
      document_.ignored.insert("opacity (what is not a light blocks wholly)");
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
      if (filled) return add(n, std::move(body), style, true);
      Pen pen({body.x_axis.x, body.x_axis.y, body.y_axis.x, body.y_axis.y, body.center.x, body.center.y}, flatness(), {});
      pen.move({1, 0});
      for (double x : {-1.0, 1.0}) pen.arc(1, 1, 0, false, true, {x, 0});
      pen.close();
      return stroke(n, pen.finish(), style);
    }
    Pen pen(style.transform, flatness(), [&](std::size_t points) { spend(n, 400 * points, 40 * points); });
    draw_shape(document_, n, size(), pen);
    Polylines contours = pen.finish();
    if (filled) {
      for (auto& c : contours.points)
        if (c.size() > 2) body.contours.push_back(std::move(c));
      body.even_odd = (outlined ? style.clip_rule : style.rule) == "evenodd";
      if (body.contours.empty()) return;
      return add(n, std::move(body), style, true);
    }
    stroke(n, std::move(contours), style);
  }

  // A shape without a fill: a body of the stroke's width, or a line of no thickness, which is visible from both sides.
  void stroke(pugi::xml_node n, Polylines contours, const Style& style) {
    if (style.stroke == "none" && style.role == Role::by_shape) return leave_out(n, style, PlaneLeftOut::Why::unpainted);
    if (style.purpose == Purpose::picture && style.dashes.find_first_of("123456789") != std::string::npos)
      document_.ignored.insert("stroke-dasharray (the line has no gaps)");
    const Stroke pen = pen_of(style);
    const bool textured = n.attribute("data-texture") && pen.cap != Cap::round;
    if (pen.radius > 0 && style.transform.determinant() != 0 && !textured) return thick_stroke(n, contours, style, pen);
    if (contours.points.empty()) return;
    for (std::size_t i = 0; i < contours.points.size(); ++i)
      if (contours.closed[i]) contours.points[i].push_back(contours.points[i].front());
    PlaneBody body;
    body.shape = PlaneBody::Shape::polyline;
    body.contours = std::move(contours.points);
    add(n, std::move(body), style, false);
  }

  void thick_stroke(pugi::xml_node n, const Polylines& contours, const Style& style, const Stroke& pen) {
    for (std::size_t i = 0; i < contours.points.size(); ++i) {
      const std::uint64_t points = most_points(style.transform, contours.points[i], pen, flatness());
      spend(n, 60 * points, 20 * points);
      PlaneBody body = stroke_after(style.transform, contours.points[i], contours.closed[i], pen, flatness());
      if (!body.contours.empty()) add(n, std::move(body), style, false);
    }
  }

  static Stroke pen_of(const Style& style) {
    Stroke pen;
    pen.cap = style.cap == "round" ? Cap::round : style.cap == "square" ? Cap::square : Cap::butt;
    pen.join = style.join == "round" ? Join::round : style.join == "bevel" ? Join::bevel : Join::miter;
    pen.radius = 0.5 * style.stroke_width.value_or(pen.cap == Cap::round ? 1 : 0);
    pen.miter_limit = style.miter_limit;
    return pen;
  }

  void add(pugi::xml_node n, PlaneBody body, const Style& style, bool filled) {
    if (result_.scene.bodies.size() >= kMostBodies) document_.fail(n, "more than a million shapes", "split the scene");
    spend(n, 500, sizeof(PlaneBody) + 40);
    body.name = n.attribute("id").value();
    const bool shines = style.role == Role::light && style.purpose == Purpose::picture;
    if (shines) body.light = emission_of(document_, n, body, style, filled, size());
    body.albedo = style.albedo;
    if (!body.light) body.color = color_of(document_, style, filled);
    if (style.purpose == Purpose::mask && !is_plain(style, filled)) body.color = {-1, -1, -1};
    if (body.light) dim(*body.light, style.opacity * (filled ? style.fill_opacity : style.stroke_opacity));
    if (style.purpose == Purpose::picture) take_extras(document_, n, style, body);
    if (body.light && n.attribute("data-texture")) return add_textured(n, body, style);
    if (!filled || !may_lie_behind(body, style)) return finish(n, std::move(body), style);
    if (const auto kept = kept_.find(n.internal_object()); kept != kept_.end()) return leave_out(n, style, kept->second);
    const std::size_t number = result_.scene.bodies.size();
    finish(n, std::move(body), style);
    if (result_.scene.bodies.size() > number) fills_.push_back({number, n});
  }

  // A shape that blocks only because nothing says otherwise.
  static bool may_lie_behind(const PlaneBody& body, const Style& style) {
    return style.role == Role::by_shape && style.purpose == Purpose::picture && !body.transmittance && !body.mirror &&
           !(body.light_depth > 0);
  }

  void keep_backdrops(const Backdrops& backdrops) {
    backdrops_ = backdrops;
    const std::vector<pugi::xml_node> elements = elements_of(document_.root());
    for (const auto& [number, why] : backdrops)
      if (number < elements.size()) kept_[elements[number].internal_object()] = why;
  }

  // Takes the backdrops out of the scene.
  void judge_backdrops() {
    std::vector<std::size_t> bodies;
    for (const Fill& fill : fills_) bodies.push_back(fill.body);
    const std::vector<Backdrop> found =
        backdrops_among(result_.scene, bodies, flatness(), [&](std::uint64_t pairs) { spend(document_.root(), 20 * pairs, 0); });
    if (found.empty()) return;
    std::unordered_map<const void*, PlaneLeftOut::Why> why;
    std::vector<char> behind(result_.scene.bodies.size(), 0);
    auto fill = fills_.begin();
    for (const Backdrop& backdrop : found) {
      while (fill->body != backdrop.body) ++fill;
      why[fill->element.internal_object()] = backdrop.why;
      behind[backdrop.body] = 1;
      leave_out(fill->element, {}, backdrop.why);
    }
    std::size_t body = 0, element = 0;
    std::erase_if(result_.scene.bodies, [&](const PlaneBody&) { return behind[body++] != 0; });
    std::erase_if(elements_, [&](pugi::xml_node) { return behind[element++] != 0; });
    const std::vector<pugi::xml_node> elements = elements_of(document_.root());
    for (std::size_t i = 0; i < elements.size(); ++i)
      if (const auto found_here = why.find(elements[i].internal_object()); found_here != why.end()) backdrops_[i] = found_here->second;
  }

  void warn_of_buried_lights() {
    const std::vector<BuriedLight> buried = buried_lights(result_.scene, flatness());
    if (buried.empty()) return;
    std::string names;
    for (std::size_t i = 0; i < std::min(buried.size(), kMostNamed); ++i)
      names += (i == 0 ? "" : ", ") + document_.called(elements_[buried[i].light]) + " (in " +
               document_.called(elements_[buried[i].occluder]) + ")";
    if (buried.size() > kMostNamed) names += " and " + std::to_string(buried.size() - kMostNamed) + " more";
    result_.warnings.push_back("inside an occluder, which no light leaves: " + names +
                               "; data-steradian=\"ignore\" takes an occluder out of the scene");
  }

  void leave_out(pugi::xml_node n, const Style& style, PlaneLeftOut::Why why) {
    if (style.purpose != Purpose::picture) return;
    PlaneLeftOut& shapes = left_out_[why];
    shapes.why = why;
    if (shapes.count++ < kMostNamed) shapes.names.push_back(document_.called(n));
  }

  // A line with colours along it, separated by semicolons.
  void add_textured(pugi::xml_node n, const PlaneBody& body, const Style& style) {
    const std::vector<Vec3d> texels = texels_of(document_, n, style, body);
    for (const auto& contour : body.contours) {
      spend(n, 300 * (texels.size() + contour.size()), sizeof(PlaneStop) * texels.size() + sizeof(PlaneBody) * contour.size());
      double whole = 0;
      for (std::size_t i = 0; i + 1 < contour.size(); ++i) whole += length(contour[i + 1] - contour[i]);
      if (!(whole > 0)) continue;
      for (PlaneBody& line : plane_textured_line(contour, texels, *body.light)) {
        line.name = body.name;
        line.albedo = body.albedo;
        finish(n, std::move(line), style);
      }
    }
  }

  // Applies the clip regions, and adds the body to the scene.
  void finish(pugi::xml_node n, PlaneBody body, const Style& style) {
    if (body.light && body.light->gradient)
      spend(n, 300 * body.light->gradient->stops.size(), sizeof(PlaneStop) * body.light->gradient->stops.size());
    for (const auto& region : style.clips) {
      body = clipped(body, *region, flatness(), [&](std::uint64_t pairs) { spend(n, 20 * pairs, 0); });
      if (body.contours.empty() && body.shape != PlaneBody::Shape::ellipse) return leave_out(n, style, PlaneLeftOut::Why::clipped);
    }
    result_.scene.bodies.push_back(std::move(body));
    if (style.purpose == Purpose::picture) elements_.push_back(n);
  }

  // A stroke that is visible, but not drawn here.
  void leave_out_stroke(const Style& style, const char* what) {
    if (style.purpose == Purpose::picture && style.stroke != "none" && style.stroke_opacity > 0 && style.stroke_width.value_or(1) > 0)
      document_.ignored.insert(what);
  }

  // Is it one opaque colour?
  static bool is_plain(const Style& style, bool filled) {
    const double opacity = style.opacity * (filled ? style.fill_opacity : style.stroke_opacity);
    return opacity == 1 && !(filled ? style.fill : style.stroke).starts_with("url(");
  }

  // Scales a translucent light's radiance by its opacity.
  static void dim(PlaneEmission& light, double opacity) {
    light.radiance = light.radiance * opacity;
    if (!light.gradient) return;
    for (PlaneStop& stop : light.gradient->stops) stop.radiance = stop.radiance * opacity;
  }

  SvgDocument document_;
  std::optional<Styles> styles_;
  std::optional<Fonts> fonts_;
  Budget budget_;
  std::uint64_t steps_ = 0, bytes_ = 0;
  std::unordered_set<const void*> drawing_;
  std::size_t uses_ = 0;
  struct Fill {
    std::size_t body;
    pugi::xml_node element;
  };
  std::vector<Fill> fills_;                                  // that may lie behind the drawing
  std::vector<pugi::xml_node> elements_;                     // of the scene's bodies
  std::unordered_map<const void*, PlaneLeftOut::Why> kept_;  // backdrops of another frame
  Backdrops backdrops_;
  std::map<PlaneLeftOut::Why, PlaneLeftOut> left_out_;
  PlaneSvg result_;
};

}  // namespace

LoadedDrawing read_drawing(const std::string& text, const std::string& name, const Limits& limits, const Backdrops* backdrops) {
  return DrawingReader(text, name, limits).read(backdrops);
}

}  // namespace steradian::plane::svg

namespace steradian {

const char* words_of(PlaneLeftOut::Why why) {
  switch (why) {
    case PlaneLeftOut::Why::covers_picture: return "covers the whole picture";
    case PlaneLeftOut::Why::covers_lights: return "covers every light";
    case PlaneLeftOut::Why::ignored: return "not displayed, or its role is ignore";
    case PlaneLeftOut::Why::transparent: return "has no opacity";
    case PlaneLeftOut::Why::unpainted: return "has no fill and no stroke";
    case PlaneLeftOut::Why::clipped: return "outside of its clip or mask";
  }
  return "";
}

PlaneSvg load_plane_scene_from_text(const std::string& svg, const std::string& name, const Limits& limits) {
  return plane::svg::read_drawing(svg, name, limits).svg;
}

}  // namespace steradian
