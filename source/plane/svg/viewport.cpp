#include "plane/svg/viewport.h"

#include <algorithm>
#include <string>
#include <vector>

namespace steradian::plane::svg {
namespace {

ViewBox box_of(const SvgDocument& document, pugi::xml_node n) {
  Scanner scan(n.attribute("viewBox").value());
  double v[4];
  for (double& x : v) {
    const auto number = scan.number();
    if (!number) document.fail(n, "viewBox needs four numbers", "write viewBox=\"0 0 WIDTH HEIGHT\"");
    x = *number;
    scan.skip_separators();
  }
  return {{v[0], v[1]}, {v[2], v[3]}};
}

}  // namespace

Transform Viewport::into(Vec2d corner, Vec2d room) const {
  Transform t;
  t.e = corner.x;
  t.f = corner.y;
  if (!box) return t;
  t.a = room.x / box->size.x;
  t.d = room.y / box->size.y;
  if (fit != PlaneFit::stretch) t.a = t.d = fit == PlaneFit::meet ? std::min(t.a, t.d) : std::max(t.a, t.d);
  t.e += (room.x - t.a * box->size.x) * align.x - t.a * box->origin.x;
  t.f += (room.y - t.d * box->size.y) * align.y - t.d * box->origin.y;
  return t;
}

Viewport viewport_of(const SvgDocument& document, pugi::xml_node n) {
  Viewport view;
  if (n.attribute("viewBox")) view.box = box_of(document, n);
  const std::vector<std::string> given = words(n.attribute("preserveAspectRatio").value());
  if (given.empty()) return view;
  const std::string& align = given.front();
  if (align == "none") {
    view.fit = PlaneFit::stretch;
    return view;
  }
  const auto place = [&](std::size_t at) {
    const std::string_view word = std::string_view(align).substr(std::min(at, align.size()), 3);
    return word == "Min" ? 0.0 : word == "Mid" ? 0.5 : word == "Max" ? 1.0 : -1.0;
  };
  view.align = {place(1), place(5)};
  if (align.size() != 8 || view.align.x < 0 || view.align.y < 0)
    document.fail(n, "preserveAspectRatio=\"" + align + "\" is unknown", "write none, or xMidYMid and the like, then meet or slice");
  if (given.size() > 1 && given[1] == "slice") view.fit = PlaneFit::slice;
  return view;
}

}  // namespace steradian::plane::svg
