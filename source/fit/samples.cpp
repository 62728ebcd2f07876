// Measured reflection as a lobe: MERL's binary files and tables of angles and values.

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "core/files.h"
#include "fit/lobe.h"
#include "lobes/samplers.h"
#include "steradian/area_light.h"  // luminance
#include "steradian/error.h"
#include "steradian/fit.h"

namespace steradian::fit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Measured values of f, three channels.
class Measured {
 public:
  virtual ~Measured() = default;
  virtual Vec3d value(Vec3d view, Vec3d light) const = 0;
};

// The middles of the two cells between which a value lies.
struct CellPair {
  std::size_t low, high;
  double share;  // weight of high
};
CellPair between_cells(double at, std::size_t cells) {
  const double x = std::clamp(at - 0.5, 0.0, static_cast<double>(cells - 1));
  const auto low = static_cast<std::size_t>(x);
  return {low, std::min(low + 1, cells - 1), x - static_cast<double>(low)};
}

class Merl : public Measured {
 public:
  Merl(std::array<std::size_t, 3> sizes, std::vector<double> values) : sizes_(sizes), values_(std::move(values)) {}

  // Rusinkiewicz's angles of half vector and difference: the cells' edges are uniform in the square root of the first.
  Vec3d value(Vec3d view, Vec3d light) const override {
    const Vec3d h = normalized(view + light);
    const double theta_h = std::acos(std::clamp(h.z, -1.0, 1.0));
    // The light in the frame of the half vector.
    const double sine = std::sqrt(std::max(1 - h.z * h.z, 0.0));
    const Vec3d along = sine > 1e-12 ? Vec3d{h.x / sine, h.y / sine, 0} : Vec3d{1, 0, 0};
    const Vec3d x = along * h.z - Vec3d{0, 0, sine}, y = cross(h, x);
    const double theta_d = std::acos(std::clamp(dot(light, h), -1.0, 1.0));
    double phi_d = std::atan2(dot(light, y), dot(light, x));
    if (phi_d < 0) phi_d += std::numbers::pi;  // reciprocity: light and view are exchanged
    const auto of = [&](double share, std::size_t axis) { return between_cells(share * static_cast<double>(sizes_[axis]), sizes_[axis]); };
    const CellPair a = of(std::sqrt(theta_h / (0.5 * std::numbers::pi)), 0), b = of(theta_d / (0.5 * std::numbers::pi), 1);
    // The azimuth is periodic.
    const double at = phi_d / std::numbers::pi * static_cast<double>(sizes_[2]) - 0.5, floor = std::floor(at);
    const auto round = [&](double i) {
      const auto n = static_cast<double>(sizes_[2]);
      return static_cast<std::size_t>(i - n * std::floor(i / n));
    };
    const CellPair c = {round(floor), round(floor + 1), at - floor};
    Vec3d sum;
    double weights = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const auto pick = [](const CellPair& p, bool high) { return high ? p.high : p.low; };
      const auto weight = [](const CellPair& p, bool high) { return high ? p.share : 1 - p.share; };
      const bool ha = (corner & 1) != 0, hb = (corner & 2) != 0, hc = (corner & 4) != 0;
      const double w = weight(a, ha) * weight(b, hb) * weight(c, hc);
      const std::size_t cell = (pick(a, ha) * sizes_[1] + pick(b, hb)) * sizes_[2] + pick(c, hc);
      const Vec3d v = {values_[cell], values_[cells() + cell], values_[2 * cells() + cell]};
      if (v.x < 0 || v.y < 0 || v.z < 0) continue;  // not measured
      sum += Vec3d{v.x / 1500, v.y * (1.15 / 1500), v.z * (1.66 / 1500)} * w;
      weights += w;
    }
    return weights > 0 ? sum / weights : Vec3d{};
  }

 private:
  std::size_t cells() const { return sizes_[0] * sizes_[1] * sizes_[2]; }
  std::array<std::size_t, 3> sizes_;
  std::vector<double> values_;
};

class Table : public Measured {
 public:
  Table(std::array<std::vector<double>, 3> angles, std::vector<Vec3d> values) : angles_(std::move(angles)), values_(std::move(values)) {}

  Vec3d value(Vec3d view, Vec3d light) const override {
    const auto theta = [](Vec3d v) { return std::acos(std::clamp(v.z, -1.0, 1.0)) / kDegree; };
    double phi = std::fabs(std::atan2(view.x * light.y - view.y * light.x, view.x * light.x + view.y * light.y)) / kDegree;
    const CellPair a = place(0, theta(view)), b = place(1, theta(light));
    const auto at = [&](double azimuth) {
      const CellPair c = place(2, azimuth);
      Vec3d sum;
      for (int corner = 0; corner < 8; ++corner) {
        const bool ha = (corner & 1) != 0, hb = (corner & 2) != 0, hc = (corner & 4) != 0;
        const double w = (ha ? a.share : 1 - a.share) * (hb ? b.share : 1 - b.share) * (hc ? c.share : 1 - c.share);
        const std::size_t i =
            ((ha ? a.high : a.low) * angles_[1].size() + (hb ? b.high : b.low)) * angles_[2].size() + (hc ? c.high : c.low);
        sum += values_[i] * w;
      }
      return sum;
    };
    // A lobe is symmetric about the plane of the view: for a whole turn, use the mean of both sides.
    return angles_[2].back() > 180 ? (at(phi) + at(360 - phi)) * 0.5 : at(phi);
  }

 private:
  CellPair place(std::size_t axis, double at) const {
    const std::vector<double>& nodes = angles_[axis];
    const auto above = std::upper_bound(nodes.begin(), nodes.end(), at);
    if (above == nodes.begin()) return {0, 0, 0};
    const auto low = static_cast<std::size_t>(above - nodes.begin()) - 1;
    if (above == nodes.end()) return {low, low, 0};
    return {low, low + 1, (at - nodes[low]) / (nodes[low + 1] - nodes[low])};
  }
  std::array<std::vector<double>, 3> angles_;  // rising
  std::vector<Vec3d> values_;
};

// ---- Files -----------------------------------------------------------------------------------------------------

std::optional<std::array<std::size_t, 3>> merl_sizes(const Bytes& bytes) {
  if (bytes.size() < 12) return {};
  std::array<std::size_t, 3> sizes{};
  std::uint64_t cells = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    std::uint32_t n = 0;
    for (std::size_t i = 0; i < 4; ++i) n |= std::uint32_t{bytes[4 * k + i]} << (8 * i);
    if (n < 1 || n > 4096) return {};
    sizes[k] = n;
    cells *= n;
  }
  if (bytes.size() != 12 + 24 * cells) return {};
  return sizes;
}

std::unique_ptr<Measured> read_merl(const Bytes& bytes, std::array<std::size_t, 3> sizes, const std::string& path, Budget& budget) {
  const std::size_t count = (bytes.size() - 12) / 8;
  budget.take_memory(path, "its values", 8 * count);
  std::vector<double> values(count);
  std::memcpy(values.data(), bytes.data() + 12, 8 * count);
  for (std::size_t i = 0; i < count; ++i)
    if (!(std::fabs(values[i]) < 1e30)) throw Error(path, "value " + std::to_string(i) + " is not a number of a BRDF");
  return std::make_unique<Merl>(sizes, std::move(values));
}

struct TabledRow {
  std::array<double, 3> angle;
  Vec3d value;
  std::size_t line;
};

TabledRow read_row(std::string_view text, std::size_t line, const std::string& path) {
  const std::string place = path + ":" + std::to_string(line);
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (;;) {
    while (at < end && (*at == ' ' || *at == '\t' || *at == ',' || *at == ';' || *at == '\r')) ++at;
    if (at == end) break;
    double x = 0;
    const auto [next, error] = std::from_chars(at, end, x);
    if (error != std::errc() || !std::isfinite(x))
      throw Error(place, "is not a line of numbers", "write angles in degrees and values, or # before a comment");
    numbers.push_back(x);
    at = next;
  }
  if (numbers.size() != 4 && numbers.size() != 6)
    throw Error(place, "has " + std::to_string(numbers.size()) + " numbers",
                "write theta_view theta_light azimuth, then one value or three");
  TabledRow row{{numbers[0], numbers[1], numbers[2]}, {}, line};
  row.value = numbers.size() == 4 ? Vec3d{numbers[3], numbers[3], numbers[3]} : Vec3d{numbers[3], numbers[4], numbers[5]};
  for (std::size_t k = 0; k < 3; ++k)
    if (row.angle[k] < 0 || row.angle[k] > (k == 2 ? 360 : 90))
      throw Error(place, "has an angle out of its range", "angles from the normal are 0 to 90, azimuths 0 to 360 degrees");
  if (row.value.x < 0 || row.value.y < 0 || row.value.z < 0)
    throw Error(place, "has a negative value", "leave out what was not measured, for all angles");
  return row;
}

std::unique_ptr<Measured> read_table(const Bytes& bytes, const std::string& path, Budget& budget) {
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  budget.take_memory(path, "its lines",
                     (sizeof(TabledRow) + sizeof(Vec3d)) * static_cast<std::uint64_t>(1 + std::count(text.begin(), text.end(), '\n')));
  std::vector<TabledRow> rows;
  std::array<std::vector<double>, 3> angles;
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view whole = text.substr(0, end), content = whole.substr(0, whole.find('#'));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (content.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    rows.push_back(read_row(content, line, path));
    for (std::size_t k = 0; k < 3; ++k) angles[k].push_back(rows.back().angle[k]);
  }
  if (rows.empty()) throw Error(path, "has no samples", "MERL's binary, or lines of theta_view theta_light azimuth and values");
  for (std::vector<double>& nodes : angles) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  // More combinations than lines: some are missing, and no memory is allocated for them.
  const double combinations =
      static_cast<double>(angles[0].size()) * static_cast<double>(angles[1].size()) * static_cast<double>(angles[2].size());
  if (combinations != static_cast<double>(rows.size()))
    throw Error(path,
                std::to_string(rows.size()) + " samples of " + std::to_string(angles[0].size()) + " x " + std::to_string(angles[1].size()) +
                    " x " + std::to_string(angles[2].size()) + " angles",
                "give every combination of the angles that occur, once");
  std::vector<Vec3d> values(rows.size());
  std::vector<bool> known(rows.size(), false);
  for (const TabledRow& row : rows) {
    std::size_t i = 0;
    for (std::size_t k = 0; k < 3; ++k)
      i = i * angles[k].size() +
          static_cast<std::size_t>(std::lower_bound(angles[k].begin(), angles[k].end(), row.angle[k]) - angles[k].begin());
    if (known[i]) throw Error(path + ":" + std::to_string(row.line), "has angles that an earlier line has", "give every combination once");
    known[i] = true;
    values[i] = row.value;
  }
  return std::make_unique<Table>(std::move(angles), std::move(values));
}

// ---- The lobe --------------------------------------------------------------------------------------------------

// Width of a distribution of half vectors that falls to half of its peak as the samples do, with the view along the normal. The
// distribution of GGX does so at tan^2 = (sqrt 2 - 1) alpha^2.
double width_of(const Measured& measured) {
  const Vec3d view{0, 0, 1};
  const auto at = [&](double theta_h) { return luminance(measured.value(view, {std::sin(2 * theta_h), 0, std::cos(2 * theta_h)})); };
  const double peak = at(0), wide = at(40 * kDegree);
  if (!(peak > 1.1 * wide)) return 1;  // no peak
  for (double theta = 0.05 * kDegree; theta < 40 * kDegree; theta *= 1.05)
    if (at(theta) - wide < 0.5 * (peak - wide)) return std::clamp(std::tan(theta) / std::sqrt(std::sqrt(2.0) - 1), 0.005, 1.0);
  return 1;
}

Lobe lobe_of(const std::shared_ptr<const Measured>& measured, double alpha, Vec3d view) {
  const Lobe glossy = ggx_lobe(alpha, view);
  Lobe lobe;
  lobe.view = view;
  lobe.evaluate = [=](Vec3d l) { return l.z > 0 ? luminance(measured->value(view, l)) * l.z : 0.0; };
  // Half of the square samples the cosine, half a glossy lobe as wide as this one.
  lobe.sample = [=](double a, double b) { return a < 0.5 ? lobes::sample_cosine_hemisphere(b, 2 * a) : glossy.sample(2 * a - 1, b); };
  lobe.pdf = [=](Vec3d l) { return 0.5 * (lobes::pdf_cosine_hemisphere(l) + glossy.pdf(l)); };
  return lobe;
}

Vec3d albedo_of(const Measured& measured, const Lobe& lobe) {
  constexpr int kSide = 256;
  Vec3d sum;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const Vec3d l = lobe.sample((i + 0.5) / kSide, (j + 0.5) / kSide);
      if (l.z > 0) sum += measured.value(lobe.view, l) * (l.z / lobe.pdf(l));
    }
  return sum / (kSide * kSide);
}

}  // namespace

}  // namespace steradian::fit

namespace steradian {

LobeSamples read_lobe_samples(const std::string& path, const Limits& limits) {
  Budget budget(limits);
  const Bytes bytes = read_file(path, path, budget);
  const auto sizes = fit::merl_sizes(bytes);
  const std::shared_ptr<const fit::Measured> measured =
      sizes ? fit::read_merl(bytes, *sizes, path, budget) : fit::read_table(bytes, path, budget);
  const double alpha = fit::width_of(*measured);
  LobeSamples samples;
  samples.family.name = "samples";
  // The frame is about the mirror direction only if there is a peak to follow it.
  samples.family.frame = alpha < 0.7 ? LobeFrame::mirror : LobeFrame::normal;
  samples.family.fixed_roughness = std::sqrt(alpha);
  samples.family.at = [measured, alpha](double, double cosine) { return fit::lobe_of(measured, alpha, view_from_cosine(cosine)); };
  samples.albedo = fit::albedo_of(*measured, fit::lobe_of(measured, alpha, {0, 0, 1}));
  return samples;
}

}  // namespace steradian
