// Scenes as SVG text.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "plane/svg/text/text.h"
#include "steradian/plane.h"

namespace steradian::plane::svg {
namespace {

// The shortest text that reads back as the same double.
std::string number(double x) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, x).ptr};
}

std::string attribute(const char* name, double x) { return std::string(" ") + name + "=\"" + number(x) + "\""; }

double largest(Vec3d c) { return std::max({c.x, c.y, c.z, 0.0}); }

// sRGB in percent with all digits, so that linear radiance is preserved.
std::string color(Vec3d linear) {
  const auto percent = [](double x) { return number(100 * srgb_from_linear(std::clamp(x, 0.0, 1.0))) + "%"; };
  return "rgb(" + percent(linear.x) + "," + percent(linear.y) + "," + percent(linear.z) + ")";
}

std::string shares(const char* name, Vec3d v) {
  return std::string(" ") + name + "=\"" + number(v.x) + " " + number(v.y) + " " + number(v.z) + "\"";
}

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string emission(const PlaneEmission& e, std::size_t index, const char* paint) {
  double scale = largest(e.radiance);
  if (e.gradient) {
    scale = 0;
    for (const PlaneStop& s : e.gradient->stops) scale = std::max(scale, largest(s.radiance));
  }
  if (scale <= 0) scale = 1;
  std::string out =
      std::string(" ") + paint + "=\"" + (e.gradient ? "url(#gradient" + std::to_string(index) + ")" : color(e.radiance / scale)) + "\"";
  out += " data-steradian=\"light\"";
  if (scale != 1) out += attribute("data-intensity", scale);
  if (e.range < 1e300) out += attribute("data-range", e.range);
  if (e.profile == PlaneProfile::lambert) out += " data-profile=\"lambert\"";
  if (e.profile == PlaneProfile::inverse) out += " data-profile=\"inverse\"";
  const double degree = std::numbers::pi / 180;
  if (e.spot_axis.x != 0 || e.spot_axis.y != 0)
    out += " data-spot=\"" + number(angle_of(e.spot_axis) / degree) + " " + number(e.spot_half_angle / degree) + "\"";
  return out;
}

std::string gradient(const PlaneEmission& e, std::size_t index) {
  const PlaneGradient& g = *e.gradient;
  double scale = 0;
  for (const PlaneStop& s : g.stops) scale = std::max(scale, largest(s.radiance));
  if (scale <= 0) scale = 1;
  std::string out = "<linearGradient id=\"gradient" + std::to_string(index) + "\" gradientUnits=\"userSpaceOnUse\"" +
                    attribute("x1", g.from.x) + attribute("y1", g.from.y) + attribute("x2", g.to.x) + attribute("y2", g.to.y) + ">";
  for (const PlaneStop& s : g.stops) out += "<stop" + attribute("offset", s.offset) + " stop-color=\"" + color(s.radiance / scale) + "\"/>";
  return out + "</linearGradient>\n";
}

std::string sun(const PlaneSun& sun) {
  const double scale = largest(sun.radiance) > 0 ? largest(sun.radiance) : 1, degree = std::numbers::pi / 180;
  return "<circle r=\"1\" data-steradian=\"sun\" data-sun-direction=\"" + number(sun.direction / degree) + " " +
         number(sun.half_width / degree) + "\"" + attribute("data-intensity", scale) + " fill=\"" + color(sun.radiance / scale) +
         "\" id=\"" + escaped(sun.name) + "\"/>\n";
}

std::string path(const PlaneBody& body, bool closed) {
  std::string d;
  for (const auto& contour : body.contours) {
    for (std::size_t i = 0; i < contour.size(); ++i) d += (i == 0 ? "M" : " ") + number(contour[i].x) + "," + number(contour[i].y);
    if (closed) d += "Z";
  }
  return " d=\"" + d + "\"";
}

}  // namespace

}  // namespace steradian::plane::svg

namespace steradian {

using namespace plane::svg;

std::string plane_scene_to_svg(const PlaneScene& scene) {
  std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"" + number(scene.origin.x) + " " + number(scene.origin.y) + " " +
                    number(scene.width) + " " + number(scene.height) + "\"" +
                    (scene.fog_density > 0 ? attribute("data-fog-density", scene.fog_density) : "") + ">\n";
  for (const PlaneSun& s : scene.suns) out += sun(s);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const PlaneBody& body = scene.bodies[i];
    if (body.light && body.light->gradient) out += gradient(*body.light, i);
    const bool stroked = body.shape == PlaneBody::Shape::polyline || body.shape == PlaneBody::Shape::capsule;
    const char* paint = stroked ? "stroke" : "fill";
    std::string rest = body.light ? emission(*body.light, i, paint) : std::string(" ") + paint + "=\"" + color(body.color) + "\"";
    if (stroked) rest += " fill=\"none\"";
    if (!stroked && !body.light) rest += " data-steradian=\"occluder\"";  // also if it looks like a backdrop
    if (body.albedo) rest += shares("data-albedo", *body.albedo);
    if (body.transmittance) rest += shares("data-transmittance", *body.transmittance);
    if (body.mirror) rest += shares("data-mirror", *body.mirror);
    if (body.light_depth > 0) rest += attribute("data-light-depth", body.light_depth);
    if (!body.name.empty()) rest += " id=\"" + escaped(body.name) + "\"";
    switch (body.shape) {
      case PlaneBody::Shape::polygon:
        out += "<path" + path(body, true) + (body.even_odd ? " fill-rule=\"evenodd\"" : "") + rest + "/>\n";
        break;
      case PlaneBody::Shape::polyline: out += "<path" + path(body, false) + rest + "/>\n"; break;
      case PlaneBody::Shape::capsule:
        out += "<line" + attribute("x1", body.contours[0][0].x) + attribute("y1", body.contours[0][0].y) +
               attribute("x2", body.contours[0][1].x) + attribute("y2", body.contours[0][1].y) +
               attribute("stroke-width", 2 * body.radius) + " stroke-linecap=\"round\"" + rest + "/>\n";
        break;
      case PlaneBody::Shape::ellipse:
        if (body.x_axis.y == 0 && body.y_axis.x == 0 && body.x_axis.x == body.y_axis.y) {
          out +=
              "<circle" + attribute("cx", body.center.x) + attribute("cy", body.center.y) + attribute("r", body.x_axis.x) + rest + "/>\n";
        } else {
          // The gradient's coordinates are the scene's: the ellipse has the transform only if there is no gradient.
          out += "<circle r=\"1\" transform=\"matrix(" + number(body.x_axis.x) + " " + number(body.x_axis.y) + " " + number(body.y_axis.x) +
                 " " + number(body.y_axis.y) + " " + number(body.center.x) + " " + number(body.center.y) + ")\"" + rest + "/>\n";
        }
    }
  }
  return out + "</svg>\n";
}

}  // namespace steradian
