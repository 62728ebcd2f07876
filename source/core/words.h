// The words of options: one table for each enumeration. The command line, eval's JSON, Python and the viewer's panel read and print them
// from here. Methods have a table of their own, integrals/methods.h.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "steradian/load_scene.h"
#include "steradian/plane.h"
#include "steradian/render.h"
#include "steradian/solve.h"
#include "steradian/tone.h"

namespace steradian::words {

template <class Value>
struct OptionWord {
  Value value;
  const char* name;
};

// An enumeration without a table does not compile.
template <class Value>
struct HasNoWords;
template <class Value>
inline constexpr auto kTable = HasNoWords<Value>::kWords;
template <>
inline constexpr auto kTable<bool> = std::to_array<OptionWord<bool>>({{true, "on"}, {false, "off"}});
template <>
inline constexpr auto kTable<Quality> =
    std::to_array<OptionWord<Quality>>({{Quality::draft, "draft"}, {Quality::normal, "normal"}, {Quality::high, "high"}});
template <>
inline constexpr auto kTable<Precision> = std::to_array<OptionWord<Precision>>({{Precision::double_, "double"},
                                                                                {Precision::float_, "float"}});
template <>
inline constexpr auto kTable<PeakForm> = std::to_array<OptionWord<PeakForm>>(
    {{PeakForm::best, "best"}, {PeakForm::one, "one"}, {PeakForm::x, "x"}, {PeakForm::by_parity, "published"}});
template <>
inline constexpr auto kTable<Shadows> =
    std::to_array<OptionWord<Shadows>>({{Shadows::off, "off"}, {Shadows::on, "on"}, {Shadows::exact, "exact"}});
template <>
inline constexpr auto kTable<Terminator> = std::to_array<OptionWord<Terminator>>({{Terminator::strict, "strict"},
                                                                                  {Terminator::smooth, "smooth"}});
template <>
inline constexpr auto kTable<LightSum> =
    std::to_array<OptionWord<LightSum>>({{LightSum::automatic, "auto"}, {LightSum::all, "all"}, {LightSum::tree, "tree"}});
template <>
inline constexpr auto kTable<Backend> = std::to_array<OptionWord<Backend>>({{Backend::cpu, "cpu"}, {Backend::vulkan, "vulkan"}});
template <>
inline constexpr auto kTable<IndirectMode> = std::to_array<OptionWord<IndirectMode>>({{IndirectMode::off, "off"},
                                                                                      {IndirectMode::ltc, "ltc"},
                                                                                      {IndirectMode::ltc_outgoing, "ltc-outgoing"},
                                                                                      {IndirectMode::ggx, "ggx"},
                                                                                      {IndirectMode::path, "path"}});
template <>
inline constexpr auto kTable<AddedLight> = std::to_array<OptionWord<AddedLight>>(
    {{AddedLight::standard, "default"}, {AddedLight::none, "none"}, {AddedLight::sun, "sun"}, {AddedLight::studio, "studio"}});
template <>
inline constexpr auto kTable<LightUnits> = std::to_array<OptionWord<LightUnits>>({{LightUnits::from_generator, "auto"},
                                                                                  {LightUnits::candela, "candela"},
                                                                                  {LightUnits::watt, "watt"}});
template <>
inline constexpr auto kTable<ToneCurve> = std::to_array<OptionWord<ToneCurve>>(
    {{ToneCurve::neutral, "neutral"}, {ToneCurve::clip, "clip"}, {ToneCurve::reinhard, "reinhard"}, {ToneCurve::filmic, "filmic"}});
template <>
inline constexpr auto kTable<PlaneMethod> = std::to_array<OptionWord<PlaneMethod>>(
    {{PlaneMethod::exact, "exact"}, {PlaneMethod::par, "par"}, {PlaneMethod::sampled, "sampled"}, {PlaneMethod::marched, "marched"}});
template <>
inline constexpr auto kTable<PlaneOccluders> = std::to_array<OptionWord<PlaneOccluders>>({{PlaneOccluders::black, "black"},
                                                                                          {PlaneOccluders::fill, "fill"},
                                                                                          {PlaneOccluders::clear, "clear"}});

template <>
inline constexpr auto kTable<ResidualSpace> = std::to_array<OptionWord<ResidualSpace>>({{ResidualSpace::root, "root"},
                                                                                        {ResidualSpace::linear, "linear"},
                                                                                        {ResidualSpace::log, "log"}});
template <>
inline constexpr auto kTable<ResidualLoss> = std::to_array<OptionWord<ResidualLoss>>({{ResidualLoss::squares, "squares"},
                                                                                      {ResidualLoss::cauchy, "cauchy"}});
template <>
inline constexpr auto kTable<LightPart> =
    std::to_array<OptionWord<LightPart>>({{LightPart::all, "all"}, {LightPart::diffuse, "diffuse"}, {LightPart::specular, "specular"}});

template <class Value>
constexpr const char* name_of(Value value) {
  for (const OptionWord<Value>& word : kTable<Value>)
    if (word.value == value) return word.name;
  return "?";
}

template <class Value>
constexpr std::optional<Value> find(std::string_view name) {
  for (const OptionWord<Value>& word : kTable<Value>)
    if (name == word.name) return word.value;
  return {};
}

template <class Value>
std::vector<std::string> names() {
  std::vector<std::string> names;
  for (const OptionWord<Value>& word : kTable<Value>) names.emplace_back(word.name);
  return names;
}

// "draft, normal or high"
template <class Value>
std::string choices(const char* before_last = " or ") {
  std::string text;
  for (const OptionWord<Value>& word : kTable<Value>)
    text += (text.empty() ? "" : &word == &kTable<Value>.back() ? before_last : ", ") + std::string(word.name);
  return text;
}

// True if a list of words, separated by spaces, contains `word`.
inline bool contains(std::string_view list, std::string_view word) {
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(' '), list.size());
    if (list.substr(0, end) == word) return true;
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return false;
}

}  // namespace steradian::words
