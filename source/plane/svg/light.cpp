#include "plane/svg/light.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/box.h"

namespace steradian::plane::svg {

void take_extras(const SvgDocument& document, pugi::xml_node n, const Style& style, PlaneBody& body) {
  if (body.light) {
    // Attributes of a group apply to the occluders in it.
    for (const char* key : {"data-transmittance", "data-mirror", "data-light-depth"})
      if (n.attribute(key)) document.fail(n, std::string(key) + " of a light", "it is for occluders; make two shapes of it");
    return;
  }
  if (n.attribute("data-texture")) document.fail(n, "data-texture of an occluder", "make it a light, with fill=\"none\" and a stroke");
  const bool straight = body.shape == PlaneBody::Shape::polygon || body.shape == PlaneBody::Shape::polyline;
  const int count = (style.transmittance ? 1 : 0) + (style.mirror ? 1 : 0) + (style.light_depth > 0 ? 1 : 0);
  if (count > 1) document.fail(n, "more than one of data-transmittance, data-mirror and data-light-depth", "give one of them");
  if (style.mirror && !straight) document.fail(n, "data-mirror of a round shape", "make it a rect, a polygon or a line");
  if (style.light_depth > 0 && body.shape == PlaneBody::Shape::polyline)
    document.fail(n, "data-light-depth of a line, which has no inside", "give it to a filled shape");
  body.transmittance = style.transmittance;
  body.mirror = style.mirror;
  body.light_depth = style.light_depth;
}

std::vector<Vec3d> texels_of(const SvgDocument& document, pugi::xml_node n, const Style& style, const PlaneBody& line) {
  if (line.shape != PlaneBody::Shape::polyline)
    document.fail(n, "data-texture of a shape that is not a plain line", "give it fill=\"none\", a stroke, and no round ends");
  const char* const hint = "write colours with semicolons between them";
  std::vector<Vec3d> texels;
  for (std::string_view list = n.attribute("data-texture").value(); !list.empty();) {
    const std::size_t end = std::min(list.find(';'), list.size());
    const std::string_view text = trimmed(list.substr(0, end));
    list.remove_prefix(std::min(end + 1, list.size()));
    if (text.empty()) continue;
    const auto color = parse_color(text);
    if (!color) document.fail(n, "'" + std::string(text) + "' in data-texture is not a colour", hint);
    texels.push_back(*color * (style.intensity * style.opacity * style.stroke_opacity));
  }
  if (texels.empty()) document.fail(n, "data-texture is empty", hint);
  return texels;
}

namespace {

class Paint {
 public:
  Paint(SvgDocument& document, Vec2d size) : document_(document), size_(size) {}

  PlaneEmission emission(pugi::xml_node n, const PlaneBody& body, const Style& style, bool filled) {
    PlaneEmission e;
    e.profile = style.profile;
    e.range = style.range;
    e.spot_axis = style.spot_axis;
    e.spot_half_angle = style.spot_half_angle;
    std::string paint = filled || style.stroke == "none" ? style.fill : style.stroke;
    if (paint == "none") paint = style.stroke;
    if (paint == "none") document_.fail(n, "a light without a colour", "give it a fill");
    if (paint.starts_with("url(")) {
      const std::size_t hash = paint.find('#'), close = paint.find_first_of(")\"'", hash);
      const pugi::xml_node found = hash == std::string::npos ? pugi::xml_node() : document_.by_id(paint.substr(hash + 1, close - hash - 1));
      if (!found) document_.fail(n, "fill=\"" + paint + "\" refers to nothing in this file", "define the gradient in <defs>");
      gradient(n, found, body, style, e);
    } else {
      e.radiance = color(n, paint, style) * style.intensity;
    }
    return e;
  }

 private:
  Vec3d color(pugi::xml_node n, std::string_view text, const Style& style) const {
    if (text == "currentColor") text = style.color;
    const auto c = parse_color(text);
    if (!c) document_.fail(n, "'" + std::string(text) + "' is not a colour", "write #rrggbb, rgb(r,g,b) or a colour's name");
    return *c;
  }

  void gradient(pugi::xml_node user, pugi::xml_node node, const PlaneBody& body, const Style& style, PlaneEmission& e) {
    const bool is_linear = std::string_view(node.name()) == "linearGradient";
    if (!is_linear) document_.ignored.insert("<" + std::string(node.name()) + "> (its mean colour shines)");
    // Attributes and stops may come from gradients to which this one refers.
    std::vector<pugi::xml_node> chain;
    for (pugi::xml_node g = node; g && chain.size() < 16; g = document_.referred(g)) chain.push_back(g);
    const auto attribute = [&](const char* key) {
      for (pugi::xml_node g : chain)
        if (g.attribute(key)) return g.attribute(key);
      return pugi::xml_attribute();
    };
    std::vector<PlaneStop> stops;
    for (pugi::xml_node g : chain) {
      for (pugi::xml_node s : g.children("stop")) {
        const double offset = std::clamp(document_.length_attribute(s, "offset", 1), stops.empty() ? 0.0 : stops.back().offset, 1.0);
        const std::string text = document_.property(s, "stop-color").value_or("black");
        stops.push_back({offset, color(s, text, style) * style.intensity});
      }
      if (!stops.empty()) break;
    }
    if (stops.empty()) document_.fail(node, "the gradient has no stops", "add <stop> elements");
    if (!is_linear) {
      e.radiance = {};
      for (const PlaneStop& s : stops) e.radiance += s.radiance / static_cast<double>(stops.size());
      return;
    }
    if (const auto spread = attribute("spreadMethod"); spread && std::string_view(spread.value()) != "pad")
      document_.ignored.insert("spreadMethod");
    const bool in_user_space = std::string_view(attribute("gradientUnits").value()) == "userSpaceOnUse";
    const auto coordinate = [&](const char* key, double whole, double otherwise) {
      const auto a = attribute(key);
      if (!a) return otherwise;
      const auto v = document_.length_of(a.value(), whole);
      if (!v) document_.fail(node, std::string(key) + " is not a length", "write a number or a percentage");
      return *v;
    };
    const double w = in_user_space ? size_.x : 1, h = in_user_space ? size_.y : 1;
    Transform t = in_user_space ? style.transform : box_transform(user, body, style);
    if (attribute("gradientTransform")) {
      const auto own = parse_transform(attribute("gradientTransform").value());
      if (!own) document_.fail(node, "cannot read gradientTransform", "use matrix, translate, scale, rotate, skewX and skewY");
      t = t * *own;
    }
    const Vec2d from{coordinate("x1", w, 0), coordinate("y1", h, 0)}, to{coordinate("x2", w, w), coordinate("y2", h, 0)};
    const Vec2d axis = to - from;
    const double det = t.determinant();
    if (dot(axis, axis) == 0 || det == 0) {
      e.radiance = stops.back().radiance;
      return;
    }
    // Lines of one colour stay lines under the transform, but not at right angles to the mapped axis. So map the offset's derivative, a
    // covector, and lay a new axis along it.
    const Vec2d g = axis / dot(axis, axis);
    const Vec2d mapped{(g.x * t.d - g.y * t.b) / det, (g.y * t.a - g.x * t.c) / det};
    PlaneGradient result;
    result.from = t.apply(from);
    result.to = result.from + mapped / dot(mapped, mapped);
    result.stops = std::move(stops);
    e.gradient = std::move(result);
  }

  // Maps the unit square to the shape's bounding box in its own coordinates, then to the scene.
  Transform box_transform(pugi::xml_node n, const PlaneBody& body, const Style& style) const {
    const Transform& t = style.transform;
    const double det = t.determinant();
    if (det == 0) return t;
    const Transform inverse{t.d / det, -t.b / det, -t.c / det, t.a / det, (t.c * t.f - t.d * t.e) / det, (t.b * t.e - t.a * t.f) / det};
    Box2d box;
    for (const auto& c : body.contours)
      for (Vec2d p : c) box.add(inverse.apply(p));
    if (body.contours.empty()) {
      const Vec2d c = inverse.apply(body.center), x = inverse.apply_vector(body.x_axis), y = inverse.apply_vector(body.y_axis);
      const Vec2d half{std::hypot(x.x, y.x), std::hypot(x.y, y.y)};
      box.add(c - half);
      box.add(c + half);
    }
    const Vec2d size = box.size();
    if (!(size.x > 0 && size.y > 0))
      document_.fail(n, "a gradient across a shape without width or height", "use gradientUnits=\"userSpaceOnUse\"");
    return t * Transform{size.x, 0, 0, size.y, box.low.x, box.low.y};
  }

  SvgDocument& document_;
  Vec2d size_;
};

}  // namespace

Vec3d color_of(const SvgDocument& document, const Style& style, bool filled) {
  std::string_view paint = filled ? style.fill : style.stroke;
  if (paint == "currentColor") paint = style.color;
  if (!paint.starts_with("url(")) return parse_color(paint).value_or(Vec3d{});
  // The mean of a gradient's stops.
  const std::size_t hash = paint.find('#'), close = paint.find_first_of(")\"'", hash);
  if (hash == std::string_view::npos) return {};
  Vec3d sum;
  int count = 0;
  pugi::xml_node node = document.by_id(std::string(paint.substr(hash + 1, close - hash - 1)));
  for (int i = 0; node && count == 0 && i < 16; node = document.referred(node), ++i)
    for (pugi::xml_node stop : node.children("stop")) {
      sum += parse_color(document.property(stop, "stop-color").value_or("black")).value_or(Vec3d{});
      ++count;
    }
  return sum / std::max(count, 1);
}

PlaneEmission emission_of(SvgDocument& document, pugi::xml_node n, const PlaneBody& body, const Style& style, bool filled, Vec2d size) {
  return Paint(document, size).emission(n, body, style, filled);
}

}  // namespace steradian::plane::svg
