#include "compare/report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/page.h"
#include "image/codecs.h"
#include "page_text.h"
#include "steradian/area_light.h"  // luminance
#include "steradian/version.h"

namespace steradian::app {
namespace {

using Json = nlohmann::ordered_json;

// Pictures in the page are logarithmic with 16 bits per value: radiance in steps of 1/2048 of a stop from `smallest` up, signed errors in
// steps of 1/1024.
double smallest_radiance(const ComparisonReport& report) { return std::max(report.white, 1e-30) * std::exp2(-16); }
double smallest_error(const ComparisonReport& report) { return std::max(report.white, 1e-30) * std::exp2(-20); }

std::uint16_t code_of(double value, double smallest, double steps, double most) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(std::log2(1 + std::max(value, 0.0) / smallest) * steps, 0.0, most)));
}

std::string encoded_radiance(const Picture& picture, double smallest) {
  return image::encode_png_bytes(2 * picture.width, picture.height, [&](int y, std::uint8_t* row) {
    std::uint8_t *high = row, *low = row + 3 * picture.width;
    for (int x = 0; x < picture.width; ++x) {
      const Vec3f& p = picture.at(x, y);
      for (const float channel : {p.x, p.y, p.z}) {
        const std::uint16_t code = code_of(static_cast<double>(channel), smallest, 2048, 65535);
        *high++ = static_cast<std::uint8_t>(code >> 8);
        *low++ = static_cast<std::uint8_t>(code & 255);
      }
    }
  });
}

// Red and green hold the error of the luminance, with its sign relative to 32768. Blue holds FLIP.
std::string encoded_error(const ComparedPicture& of, const Picture& reference, double smallest) {
  return image::encode_png_bytes(reference.width, reference.height, [&](int y, std::uint8_t* row) {
    for (int x = 0; x < reference.width; ++x) {
      const double error = luminance(static_cast<Vec3d>(of.picture.at(x, y))) - luminance(static_cast<Vec3d>(reference.at(x, y)));
      const int size = code_of(std::fabs(error), smallest, 1024, 32767), code = 32768 + (error < 0 ? -size : size);
      const float flip =
          of.flip_error[static_cast<std::size_t>(y) * static_cast<std::size_t>(reference.width) + static_cast<std::size_t>(x)];
      *row++ = static_cast<std::uint8_t>(code >> 8);
      *row++ = static_cast<std::uint8_t>(code & 255);
      *row++ = static_cast<std::uint8_t>(std::lround(255 * flip));
    }
  });
}

Json numbers_of(const Run& run) {
  const Difference& d = run.difference;
  return {{"name", run.method},
          {"setting", run.setting},
          {"ms", run.ms},
          {"relative_l2", d.relative_l2},
          {"rmse", d.rmse},
          {"max", d.max},
          {"max_at", {d.max_x, d.max_y}},
          {"mean_ratio", d.mean_ratio}};
}

Json report_data(const ComparisonReport& report) {
  Json methods = Json::array(), over_time = Json::array();
  for (const ComparedPicture& of : report.methods) {
    Json m = numbers_of(of.run);
    m["flip"] = of.flip;
    m["passes"] = Json::array();
    for (const PassTime& pass : of.passes) m["passes"].push_back({{"name", pass.name}, {"ms", pass.ms}});
    m["picture"] = of.run.method + ".exr";
    methods.push_back(std::move(m));
  }
  for (const Run& run : report.over_time)
    over_time.push_back({{"method", run.method}, {"setting", run.setting}, {"ms", run.ms}, {"relative_l2", run.difference.relative_l2}});
  return {{"version", version()},
          {"command", report.command},
          {"scene", report.scene},
          {"width", report.reference.width},
          {"height", report.reference.height},
          {"exposure", report.exposure},
          {"white", report.white},
          {"reference",
           {{"words", report.reference_words},
            {"ms", report.reference_ms},
            {"relative_error", report.reference_error},
            {"picture", "reference.exr"}}},
          {"time_limit", report.time_limit},
          {"did_not_fit", report.did_not_fit},
          {"methods", methods},
          {"over_time", over_time}};
}

}  // namespace

std::string report_json(const ComparisonReport& report) {
  return report_data(report).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string report_page(const ComparisonReport& report) {
  Json data = report_data(report), pictures;
  const double smallest = smallest_radiance(report), error = smallest_error(report);
  data["encoding"] = {{"smallest", smallest}, {"smallest_error", error}};
  pictures["reference"] = {{"radiance", base64(encoded_radiance(report.reference, smallest))}};
  for (const ComparedPicture& of : report.methods)
    pictures[of.run.method] = {{"radiance", base64(encoded_radiance(of.picture, smallest))},
                               {"error", base64(encoded_error(of, report.reference, error))}};
  std::string page = kComparePage;
  put(page, "@PICTURES@", in_script(pictures));
  put(page, "@DATA@", in_script(data));
  return page;
}

}  // namespace steradian::app
