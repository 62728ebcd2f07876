#include "plane/svg/style/style.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

namespace steradian::plane::svg {
namespace {

// Levenshtein's distance: letters to change, add or remove.
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

// Units of the parent's size, names, and lengths. Any other text keeps the parent's size.
double font_size_of(std::string_view text, double parent) {
  static constexpr std::pair<const char*, double> kNames[] = {{"xx-small", 9}, {"x-small", 10}, {"small", 13},   {"medium", 16},
                                                              {"large", 18},   {"x-large", 24}, {"xx-large", 32}};
  for (const auto& [name, size] : kNames)
    if (text == name) return size;
  if (text == "smaller") return parent / 1.2;
  if (text == "larger") return parent * 1.2;
  if (text.ends_with("em")) {
    const bool root = text.ends_with("rem");
    Scanner scan(text.substr(0, text.size() - (root ? 3 : 2)));
    return scan.number().value_or(1) * (root ? 16 : parent);
  }
  return std::max(SvgDocument::length_of(text, parent).value_or(parent), 0.0);
}

}  // namespace

const Styles::Declared& Styles::declared(pugi::xml_node n) {
  const auto [found, is_new] = declared_.try_emplace(n.internal_object());
  if (is_new) read_declared(n, found->second);
  return found->second;
}

void Styles::read_declared(pugi::xml_node n, Declared& d) {
  const std::pair<const char*, std::optional<std::string>*> texts[] = {{"fill", &d.fill},
                                                                       {"stroke", &d.stroke},
                                                                       {"color", &d.color},
                                                                       {"stroke-linecap", &d.cap},
                                                                       {"stroke-linejoin", &d.join},
                                                                       {"fill-rule", &d.rule},
                                                                       {"clip-rule", &d.clip_rule},
                                                                       {"font-family", &d.family},
                                                                       {"font-size", &d.font_size},
                                                                       {"font-weight", &d.weight},
                                                                       {"font-style", &d.slant},
                                                                       {"text-anchor", &d.anchor},
                                                                       {"stroke-dasharray", &d.dashes}};
  for (const auto& [key, value] : texts) {
    auto p = document_.property(n, key);
    if (p && *p != "inherit") *value = std::move(p);
  }
  if (const auto width = document_.property(n, "stroke-width")) {
    d.stroke_width = document_.length_of(*width, diagonal_);
    if (!d.stroke_width || *d.stroke_width < 0) document_.fail(n, "stroke-width=\"" + *width + "\" is not a length", "write a number");
  }
  if (const auto limit = document_.property(n, "stroke-miterlimit")) d.miter_limit = document_.length_of(*limit, 1);
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
  d.albedo = read_shares(n, "data-albedo");
  d.transmittance = read_shares(n, "data-transmittance");
  d.mirror = read_shares(n, "data-mirror");
  if (n.attribute("data-light-depth"))
    d.light_depth = document_.number_attribute(n, "data-light-depth", 0, "give a distance in user units; 0 for a body that stays dark");
  read_sun(n, d);
  if (n.attribute("data-fog-density") && n != document_.root())
    document_.fail(n, "data-fog-density is of the whole drawing", "give it to the outermost <svg>");
  if (n.attribute("transform")) {
    d.transform = parse_transform(n.attribute("transform").value());
    if (!d.transform)
      document_.fail(n, std::string("cannot read transform=\"") + n.attribute("transform").value() + "\"",
                     "use matrix, translate, scale, rotate, skewX and skewY");
  }
  if (d.role == Role::ignore) return;
  if (auto clip = document_.property(n, "clip-path"); clip && *clip != "none") d.clip = std::move(clip);
  if (auto mask = document_.property(n, "mask"); mask && *mask != "none") d.mask = std::move(mask);
  if (const auto filter = document_.property(n, "filter"); filter && *filter != "none") document_.ignored.insert("filter");
}

Style Styles::inherit(pugi::xml_node n, Style style) {
  const Declared& d = declared(n);
  const std::pair<const std::optional<std::string>*, std::string*> texts[] = {
      {&d.fill, &style.fill},     {&d.stroke, &style.stroke}, {&d.color, &style.color},         {&d.cap, &style.cap},
      {&d.join, &style.join},     {&d.rule, &style.rule},     {&d.clip_rule, &style.clip_rule}, {&d.family, &style.family},
      {&d.weight, &style.weight}, {&d.slant, &style.slant},   {&d.anchor, &style.anchor},       {&d.dashes, &style.dashes}};
  for (const auto& [own, value] : texts)
    if (*own) *value = **own;
  if (d.font_size) style.font_size = font_size_of(*d.font_size, style.font_size);
  style.clip = d.clip.value_or("");
  style.mask = d.mask.value_or("");
  if (d.stroke_width) style.stroke_width = d.stroke_width;
  style.miter_limit = std::max(d.miter_limit.value_or(style.miter_limit), 1.0);
  style.intensity = d.intensity.value_or(style.intensity);
  style.range = d.range.value_or(style.range);
  if (d.albedo) style.albedo = d.albedo;
  if (d.transmittance) style.transmittance = d.transmittance;
  if (d.mirror) style.mirror = d.mirror;
  style.light_depth = d.light_depth.value_or(style.light_depth);
  if (d.sun) style.sun = d.sun;
  style.profile = d.profile.value_or(style.profile);
  style.opacity *= d.opacity;
  style.fill_opacity = d.fill_opacity.value_or(style.fill_opacity);
  style.stroke_opacity = d.stroke_opacity.value_or(style.stroke_opacity);
  if (d.role != Role::by_shape && style.role != Role::ignore) style.role = d.role;
  if (d.spot) std::tie(style.spot_axis, style.spot_half_angle) = *d.spot;
  if (d.transform) style.transform = style.transform * *d.transform;
  return style;
}

// A fraction of 1, or a percentage.
std::optional<double> Styles::share(pugi::xml_node n, const char* key) const {
  const auto text = document_.property(n, key);
  if (!text || *text == "inherit") return {};
  const auto v = document_.length_of(*text, 1);
  if (!v) document_.fail(n, std::string(key) + "=\"" + *text + "\" is not a number", "write a number from 0 to 1");
  return std::clamp(*v, 0.0, 1.0);
}

// Other programs write data- attributes of their own; one that is nearly ours is a typing error.
void Styles::refuse_misspelt(pugi::xml_node n) const {
  static constexpr const char* kOurs[] = {"data-steradian",   "data-intensity", "data-range",         "data-profile",
                                          "data-spot",        "data-albedo",    "data-transmittance", "data-mirror",
                                          "data-light-depth", "data-texture",   "data-sun-direction", "data-fog-density"};
  for (pugi::xml_attribute a : n.attributes()) {
    const std::string_view name = a.name();
    if (!name.starts_with("data-") || std::find(std::begin(kOurs), std::end(kOurs), name) != std::end(kOurs)) continue;
    for (const char* ours : kOurs)
      if (edits_between(name, ours) <= 2) document_.fail(n, std::string(name) + " is unknown", std::string("write ") + ours);
  }
}

void Styles::read_role(pugi::xml_node n, Declared& d) const {
  if (d.role == Role::ignore) return;
  static constexpr std::pair<const char*, Role> kRoles[] = {
      {"light", Role::light}, {"occluder", Role::occluder}, {"sun", Role::sun}, {"ignore", Role::ignore}};
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
                 "use light, occluder, sun or ignore");
}

// One fraction, or three.
std::optional<Vec3d> Styles::read_shares(pugi::xml_node n, const char* key) const {
  if (!n.attribute(key)) return {};
  Scanner scan(n.attribute(key).value());
  double shares[3] = {};
  int count = 0;
  for (; count < 3; ++count) {
    scan.skip_separators();
    const auto share = scan.number();
    if (!share || !(*share >= 0 && *share <= 1)) break;
    shares[count] = *share;
  }
  scan.skip_separators();
  if ((count != 1 && count != 3) || !scan.at_end())
    document_.fail(n, std::string(key) + "=\"" + n.attribute(key).value() + "\" is not a share of light",
                   "write one number from 0 to 1, or three: red green blue");
  return count == 1 ? Vec3d{shares[0], shares[0], shares[0]} : Vec3d{shares[0], shares[1], shares[2]};
}

void Styles::read_sun(pugi::xml_node n, Declared& d) const {
  if (!n.attribute("data-sun-direction")) return;
  Scanner scan(n.attribute("data-sun-direction").value());
  const auto direction = scan.number();
  scan.skip_separators();
  const auto half_width = scan.at_end() ? std::optional<double>(0) : scan.number();
  scan.skip_separators();
  if (!direction || !half_width || !(*half_width >= 0 && *half_width <= 180) || !scan.at_end())
    document_.fail(n, "data-sun-direction needs one angle in degrees, or two",
                   "write data-sun-direction=\"DIRECTION HALF-WIDTH\": -90 stands above; a sun is 0.27 wide, 0 gives hard shadows");
  const double degree = std::numbers::pi / 180;
  d.sun = SunPlace{*direction * degree, *half_width * degree};
}

void Styles::read_profile(pugi::xml_node n, Declared& d) const {
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

}  // namespace steradian::plane::svg
