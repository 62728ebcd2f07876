#include "plane/svg/extras.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace steradian::plane::svg {

void take_extras(const Document& document, pugi::xml_node n, const Style& style, PlaneBody& body) {
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

std::vector<Vec3d> texels_of(const Document& document, pugi::xml_node n, const Style& style, const PlaneBody& line) {
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

}  // namespace steradian::plane::svg
