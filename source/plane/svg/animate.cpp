// The SMIL animations of a drawing, written into its elements as the attributes that they have at a time.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <set>
#include <sstream>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/budget.h"
#include "plane/svg/document.h"
#include "plane/svg/load.h"
#include "plane/svg/path.h"
#include "plane/svg/style/values.h"
#include "plane/svg/timing.h"
#include "steradian/error.h"
#include "steradian/plane_animation.h"

namespace steradian::plane::svg {
namespace {

constexpr double kMotionFlatness = 1e-5;  // for a motion's path, as a fraction of the picture's larger side

bool is_animation(std::string_view name) {
  return name == "animate" || name == "set" || name == "animateTransform" || name == "animateMotion" || name == "animateColor";
}

// Elements of some names in the file's order. The search is not recursive, since files may nest to any depth.
std::vector<pugi::xml_node> animations_of(pugi::xml_node root) {
  std::vector<pugi::xml_node> open{root}, found;
  while (!open.empty()) {
    const pugi::xml_node n = open.back();
    open.pop_back();
    if (is_animation(n.name())) {
      found.push_back(n);
      continue;
    }
    for (pugi::xml_node child = n.last_child(); child; child = child.previous_sibling()) open.push_back(child);
  }
  return found;
}

// The value at x of a Bezier curve from (0, 0) to (1, 1): keySplines.
double on_spline(const std::vector<double>& s, double x) {
  const auto at = [](double a, double b, double t) { return ((1 - 3 * b + 3 * a) * t + 3 * b - 6 * a) * t * t + 3 * a * t; };
  double low = 0, high = 1;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (at(s[0], s[2], middle) < x ? low : high) = middle;
  }
  return at(s[1], s[3], low);
}

std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> result;
  Scanner scan(text);
  while (const auto number = scan.number()) {
    result.push_back(*number);
    scan.skip_separators();
  }
  return result;
}

// The picture's larger side.
double size_of(const SvgDocument& document) {
  const std::vector<double> box = numbers_in(document.root().attribute("viewBox").value());
  return std::max(box.size() == 4 ? std::max(box[2], box[3]) : 512, 1e-6);
}

// The two values between which an animation is, and the place between them.
struct KeyPlace {
  std::size_t index = 0;
  double share = 0;  // fraction of the way to the next one
};

class Animating {
 public:
  Animating(SvgDocument& document, double seconds, Budget& budget)
      : document_(document), seconds_(seconds), tolerance_(kMotionFlatness * size_of(document)), budget_(budget) {}

  void run() {
    const std::vector<pugi::xml_node> all = animations_of(document_.root());
    for (pugi::xml_node n : all) {
      const std::string_view name = n.name();
      const pugi::xml_node target = n.attribute("href") || n.attribute("xlink:href") ? document_.referred(n) : n.parent();
      if (!target) continue;
      if (name == "animateMotion")
        move(n, target);
      else if (name == "animateTransform")
        transform(n, target);
      else
        change(n, target);
    }
    // Motions apply outside of an element's own transforms.
    for (auto& [element, motion] : motions_) {
      const pugi::xml_node target = motion.target;
      const std::string own = target.attribute("transform").value();
      put(target, "transform", motion.transform + " " + own);
    }
    for (pugi::xml_node n : all) n.parent().remove_child(n);
  }

 private:
  struct Motion {
    pugi::xml_node target;
    std::string transform;
  };

  KeyPlace place_of(pugi::xml_node n, std::size_t values, double share, const char* otherwise) {
    const std::string mode = n.attribute("calcMode") ? n.attribute("calcMode").value() : otherwise;
    std::vector<double> times;
    for (const std::string& t : split_list(n.attribute("keyTimes").value(), ';')) {
      const auto number = Scanner(t).number();
      if (!number || *number < 0 || *number > 1 || (!times.empty() && *number < times.back()))
        document_.fail(n, "keyTimes do not rise from 0 to 1", "write as many as there are values");
      times.push_back(*number);
    }
    if (!times.empty() && times.size() != values) document_.fail(n, "there are not as many keyTimes as values", "give one for each");
    if (mode == "discrete") {
      std::size_t i = 0;
      if (times.empty())
        i = std::min(static_cast<std::size_t>(share * static_cast<double>(values)), values - 1);
      else
        while (i + 1 < values && times[i + 1] <= share) ++i;
      return {i, 0};
    }
    if (values < 2) return {0, 0};
    if (mode == "paced" && std::string_view(n.name()) != "animateMotion") document_.ignored.insert("calcMode=\"paced\" (taken as linear)");
    std::size_t i = 0;
    double from = 0, to = 1;
    if (times.empty()) {
      i = std::min(static_cast<std::size_t>(share * static_cast<double>(values - 1)), values - 2);
      from = static_cast<double>(i) / static_cast<double>(values - 1);
      to = static_cast<double>(i + 1) / static_cast<double>(values - 1);
    } else {
      while (i + 2 < values && times[i + 1] <= share) ++i;
      from = times[i];
      to = times[i + 1];
    }
    double at = to > from ? std::clamp((share - from) / (to - from), 0.0, 1.0) : 1;
    if (mode == "spline") {
      const std::vector<std::string> splines = split_list(n.attribute("keySplines").value(), ';');
      const std::vector<double> s = i < splines.size() ? numbers_in(splines[i]) : std::vector<double>{};
      if (s.size() != 4) document_.fail(n, "keySplines lacks four numbers for each step", "write as in \".4 0 .6 1; .4 0 .6 1\"");
      at = on_spline(s, at);
    }
    return {i, at};
  }

  // The values of an animation: `values`, or from and to. `base` replaces a missing from; `by` adds to it.
  struct Values {
    std::vector<std::string> list;
    bool adds = false;  // are they added to the element's own value?
  };
  Values values_of(pugi::xml_node n, const std::string& base, const std::string& nothing) {
    Values v;
    v.adds = std::string_view(n.attribute("additive").value()) == "sum";
    const auto from = n.attribute("from"), to = n.attribute("to"), by = n.attribute("by");
    if (n.attribute("values")) {
      v.list = split_list(n.attribute("values").value(), ';');
    } else if (to) {
      v.list = {from ? from.value() : base, to.value()};
      if (!from) v.adds = false;
    } else if (by) {
      const std::string start = from ? from.value() : nothing;
      v.list = {start, value_sum(start, by.value(), 1).value_or(by.value())};
      if (!from) v.adds = true;
    }
    return v;
  }

  std::string value_at(pugi::xml_node n, const std::vector<std::string>& list, const TimelineProgress& p, const char* mode) {
    const KeyPlace at = place_of(n, list.size(), p.share, mode);
    std::string value = list[at.index];
    if (at.share > 0) {
      // Values that cannot be interpolated change to the second one half way.
      const auto between = value_between(list[at.index], list[at.index + 1], at.share);
      value = between ? *between : list[at.index + (at.share >= 0.5 ? 1 : 0)];
    }
    if (p.iteration > 0 && std::string_view(n.attribute("accumulate").value()) == "sum")
      value = value_sum(value, list.back(), p.iteration).value_or(value);
    return value;
  }

  void change(pugi::xml_node n, pugi::xml_node target) {
    const std::string key(trimmed(n.attribute("attributeName").value()));
    if (key.empty()) document_.fail(n, "says not which attribute it changes", "give it an attributeName");
    const auto progress = progress_of(document_, n, seconds_);
    if (!progress) return;
    if (std::string_view(n.name()) == "set") {
      if (n.attribute("to")) put(target, key, n.attribute("to").value());
      return;
    }
    const std::string base = document_.property(target, key.c_str()).value_or("");
    Values v = values_of(n, base, "0");
    if (v.list.empty()) return;
    if (v.list.front().empty()) v.list.front() = v.list.back();
    std::string value = value_at(n, v.list, *progress, "linear");
    if (v.adds) value = value_sum(base, value, 1).value_or(value);
    put(target, key, value);
  }

  void transform(pugi::xml_node n, pugi::xml_node target) {
    const auto progress = progress_of(document_, n, seconds_);
    if (!progress) return;
    std::string key = n.attribute("attributeName") ? n.attribute("attributeName").value() : "transform";
    if (key != "transform" && key != "gradientTransform") {
      document_.ignored.insert("<animateTransform> of " + key);
      return;
    }
    const std::string type = n.attribute("type") ? n.attribute("type").value() : "translate";
    if (type != "translate" && type != "scale" && type != "rotate" && type != "skewX" && type != "skewY")
      document_.fail(n, "type=\"" + type + "\" is no transform", "write translate, scale, rotate, skewX or skewY");
    // Lists get the same number of values everywhere: "10" and "10 5" can be interpolated, too.
    const auto full = [&](const std::string& text) {
      std::vector<double> x = numbers_in(text);
      if (x.empty()) x.push_back(type == "scale" ? 1 : 0);
      const std::size_t count = type == "rotate" ? 3 : type == "translate" || type == "scale" ? 2 : 1;
      while (x.size() < count) x.push_back(type == "scale" ? x[0] : 0);
      x.resize(count);
      std::string result;
      for (double number : x) result += (result.empty() ? "" : " ") + number_text(number);
      return result;
    };
    Values v = values_of(n, "", full(type == "scale" ? "0 0" : ""));
    if (v.list.empty()) return;
    for (std::string& text : v.list) text = full(text);
    const std::string now = type + "(" + value_at(n, v.list, *progress, "linear") + ")";
    put(target, key, v.adds ? std::string(target.attribute(key.c_str()).value()) + " " + now : now);
  }

  // The places along a motion, as lines, one after another.
  std::vector<Vec2d> way_of(pugi::xml_node n) {
    std::vector<Vec2d> way;
    std::string data = n.attribute("path").value();
    for (pugi::xml_node child : n.children())
      if (std::string_view(child.name()) == "mpath") data = document_.referred(child).attribute("d").value();
    if (!data.empty()) {
      Pen pen({}, tolerance_, [&](std::size_t points) {
        budget_.take_work(document_.place_of(n), "the points of its motion", 100 * points);
        budget_.take_memory(document_.place_of(n), "the points of its motion", 40 * points);
      });
      try {
        draw_path(data, pen);
      } catch (const std::string& problem) {
        document_.fail(n, "the path of the motion: " + problem, "correct it");
      }
      const Polylines contours = pen.finish();
      for (std::size_t i = 0; i < contours.points.size(); ++i) {
        way.insert(way.end(), contours.points[i].begin(), contours.points[i].end());
        if (contours.closed[i] && !contours.points[i].empty()) way.push_back(contours.points[i].front());
      }
      return way;
    }
    for (const std::string& text : values_of(n, "0 0", "0 0").list) {
      const std::vector<double> x = numbers_in(text);
      if (x.size() == 2) way.push_back({x[0], x[1]});
    }
    return way;
  }

  void move(pugi::xml_node n, pugi::xml_node target) {
    const auto progress = progress_of(document_, n, seconds_);
    if (!progress) return;
    const std::vector<Vec2d> way = way_of(n);
    if (way.empty()) return;
    const bool drawn = n.attribute("path") || n.child("mpath");
    std::vector<double> lengths{0};
    for (std::size_t i = 1; i < way.size(); ++i) lengths.push_back(lengths.back() + length(way[i] - way[i - 1]));
    double share = progress->share;
    const std::string_view mode = n.attribute("calcMode").value();
    if (n.attribute("keyPoints")) {
      const std::vector<std::string> points = split_list(n.attribute("keyPoints").value(), ';');
      if (points.empty()) return;
      const auto point = Scanner(value_at(n, points, *progress, "linear")).number();
      share = std::clamp(point.value_or(0), 0.0, 1.0);
    } else if (!drawn && !mode.empty() && mode != "paced") {
      const KeyPlace at = place_of(n, way.size(), share, "linear");
      const double from = lengths[at.index], to = lengths[std::min(at.index + 1, way.size() - 1)];
      share = lengths.back() > 0 ? (from + at.share * (to - from)) / lengths.back() : 0;
    }
    const double at = share * lengths.back();
    const auto after = std::upper_bound(lengths.begin(), lengths.end(), at);
    const std::size_t k = std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - lengths.begin(), 1)), way.size() - 1);
    Vec2d here = way[k], along;
    if (k > 0) {
      const double size = lengths[k] - lengths[k - 1];
      along = way[k] - way[k - 1];
      if (size > 0) here = way[k - 1] + along * std::clamp((at - lengths[k - 1]) / size, 0.0, 1.0);
    }
    if (std::string_view(n.attribute("accumulate").value()) == "sum") here = here + way.back() * progress->iteration;
    std::string now = "translate(" + number_text(here.x) + " " + number_text(here.y) + ")";
    const std::string_view rotate = n.attribute("rotate").value();
    const double heading = std::atan2(along.y, along.x) * 180 / std::numbers::pi;
    if (rotate == "auto" || rotate == "auto-reverse")
      now += " rotate(" + number_text(rotate == "auto" ? heading : heading + 180) + ")";
    else if (const auto angle = Scanner(rotate).number())
      now += " rotate(" + number_text(*angle) + ")";
    Motion& motion = motions_[target.internal_object()];
    motion.target = target;
    const bool adds = std::string_view(n.attribute("additive").value()) == "sum";
    motion.transform = adds ? motion.transform + " " + now : now;
  }

  // Overrides style sheets and the element's own attributes.
  static void put(pugi::xml_node target, const std::string& key, const std::string& value) {
    static constexpr std::array<std::string_view, 15> kProperties = {
        "fill",       "stroke",    "opacity",    "fill-opacity", "stroke-opacity", "stroke-width",   "color",          "display",
        "visibility", "font-size", "stop-color", "fill-rule",    "clip-rule",      "stroke-linecap", "stroke-linejoin"};
    if (std::find(kProperties.begin(), kProperties.end(), key) == kProperties.end()) return set(target, key.c_str(), value);
    auto declarations = parse_declarations(target.attribute("style").value());
    declarations[key] = value;
    std::string text;
    for (const auto& [k, v] : declarations) text += k + ":" + v + ";";
    set(target, "style", text);
  }
  static void set(pugi::xml_node target, const char* key, const std::string& value) {
    (target.attribute(key) ? target.attribute(key) : target.append_attribute(key)).set_value(value.c_str());
  }

  SvgDocument& document_;
  double seconds_, tolerance_;
  Budget& budget_;
  std::unordered_map<const void*, Motion> motions_;
};

}  // namespace
}  // namespace steradian::plane::svg

namespace steradian {

using plane::svg::SvgDocument;

PlaneAnimation::PlaneAnimation(std::string svg, std::string name, const Limits& limits)
    : svg_(std::move(svg)), name_(std::move(name)), limits_(limits) {
  moves_ = !plane::svg::animations_of(SvgDocument(svg_, name_).root()).empty();
  if (moves_) backdrops_ = plane::svg::read_drawing(still_at(0).svg, name_, limits_).backdrops;
}

PlaneAnimation::Still PlaneAnimation::still_at(double seconds) const {
  SvgDocument document(svg_, name_);
  Budget budget(limits_);
  plane::svg::Animating(document, seconds, budget).run();
  std::ostringstream text;
  document.root().print(text, "", pugi::format_raw);
  return {text.str(), document.ignored};
}

PlaneAnimation::PlaneAnimation(const std::string& path, const Limits& limits)
    : PlaneAnimation(plane::svg::read_text(path, limits), path, limits) {}

double PlaneAnimation::duration() const {
  SvgDocument document(svg_, name_);
  double end = 0;
  for (const pugi::xml_node n : plane::svg::animations_of(document.root())) end = std::max(end, extent_of(document, n).seconds);
  return end;
}

bool PlaneAnimation::endless() const {
  SvgDocument document(svg_, name_);
  bool any = false;
  for (const pugi::xml_node n : plane::svg::animations_of(document.root())) any |= extent_of(document, n).endless;
  return any;
}

PlaneSvg PlaneAnimation::at(double seconds) const {
  if (!std::isfinite(seconds)) throw Error(name_, "the time is not finite", "give seconds");
  if (!moves_) return load_plane_scene_from_text(svg_, name_, limits_);
  Still still = still_at(seconds);
  PlaneSvg result = plane::svg::read_drawing(still.svg, name_, limits_, &backdrops_).svg;
  std::set<std::string>& ignored = still.ignored;
  ignored.insert(result.ignored.begin(), result.ignored.end());
  result.ignored.assign(ignored.begin(), ignored.end());
  return result;
}

}  // namespace steradian
