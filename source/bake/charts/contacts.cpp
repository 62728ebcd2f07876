#include "bake/charts/contacts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <unordered_set>

#include "bake/charts/contact_regions.h"
#include "bake/charts/welded.h"
#include "core/box_tree.h"
#include "core/lattices.h"

namespace steradian::bake {
namespace {

constexpr double kRoundings = 0x1p-19;    // of the largest coordinate: heights in which single precision is sure of above and below
constexpr double kLeastHeight = 1e-3;     // of a texel
constexpr double kTogether = 4;           // heights: nearer points count as one, so that slanted walls do not cut slivers off their floor
constexpr double kLeastRegion = 0.01;     // of a texel's area, and of a chart's
constexpr double kLeastChart = 1;         // texel: leaves that cut through each other are not cut
constexpr double kLeastScreen = 4;        // texels: shorter contacts, such as those of legs, mix little light
constexpr double kThickest = 2;           // texels: no texel reaches across a thicker wall
constexpr std::size_t kLooks = 4;         // pieces of a region from which rays look
constexpr std::size_t kRays = 32;         // of each
constexpr std::uint64_t kRaySteps = 200;  // of work for a ray

struct ContactLine {
  Vec2d from, to;
};

// All triangles of a scene that block light, sorted by place.
class ContactSections {
 public:
  explicit ContactSections(const Scene& scene) : scene_(scene) {
    for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
      const Mesh& mesh = scene.meshes[m];
      if (mesh.is_light_shape || !mesh.casts_shadow) continue;
      for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) triangles_.push_back({m, t});
    }
    tree_ = BoxTree<Box3d>(
        triangles_.size(), [&](std::uint32_t n) { return box_of(n); }, Halving{8});
  }

  // The section of the scene by a plane that lies `height` above a chart, where it is near the chart. Triangles at the chart's border are
  // left out: a fold of the mesh is no contact.
  std::vector<ContactLine> above(const Chart& chart, const std::unordered_set<std::uint32_t>& border, double height) const {
    Box3d box;
    Box2d flat;
    for (const ChartTriangle& t : chart.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3d p = corner_of(scene_.meshes[chart.mesh], t.triangle, k);
        box.add(p);
        box.add(p + chart.plane.normal * (2 * height));
        flat.add(t.at[k]);
      }
    std::vector<ContactLine> lines;
    for (const std::uint32_t n : near_box(tree_, box)) {
      if (triangles_[n].mesh == chart.mesh && border.contains(triangles_[n].triangle)) continue;
      std::array<Vec3d, 3> p;
      std::array<double, 3> d;
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = corner_of(scene_.meshes[triangles_[n].mesh], triangles_[n].triangle, k);
        d[k] = dot(p[k] - chart.plane.origin, chart.plane.normal) - height;
      }
      std::vector<Vec2d> ends;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t l = (k + 1) % 3;
        if ((d[k] > 0) != (d[l] > 0)) ends.push_back(chart.plane.at(p[k] + (p[l] - p[k]) * (d[k] / (d[k] - d[l]))));
      }
      if (ends.size() != 2) continue;
      Box2d around;
      around.add(ends[0]);
      around.add(ends[1]);
      if (around.meets(flat)) lines.push_back({ends[0], ends[1]});
    }
    return lines;
  }

 private:
  struct Number {
    std::uint32_t mesh, triangle;
  };
  Box3d box_of(std::uint32_t n) const {
    Box3d box;
    for (std::size_t k = 0; k < 3; ++k) box.add(corner_of(scene_.meshes[triangles_[n].mesh], triangles_[n].triangle, k));
    return box;
  }
  const Scene& scene_;
  std::vector<Number> triangles_;
  BoxTree<Box3d> tree_;
};

double area_of(const std::vector<Vec2d>& outline) {
  double doubled = 0;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) doubled += cross(outline[i] - outline[0], outline[i + 1] - outline[0]);
  return doubled / 2;
}

Vec2d middle_of(const std::vector<Vec2d>& outline) {
  Vec2d sum;
  for (const Vec2d p : outline) sum = sum + p;
  return sum / static_cast<double>(outline.size());
}

// Regions of a chart that contacts part.
struct Parted {
  std::vector<ChartPiece> pieces;
  std::vector<std::uint32_t> region;  // of each piece
  std::vector<std::uint32_t> lit;     // regions where light may arrive
  std::vector<ContactRegions::Link> doors;
};

// Judges the charts of a scene that is not cut yet.
class ContactJudge {
 public:
  // work: steps that all charts together may take
  ContactJudge(const Scene& scene, double texels, std::uint64_t work)
      : scene_(scene), sections_(scene), texel_(1 / texels), least_(kLeastRegion * texel_ * texel_), work_(work) {
    double reach = 0;
    for (const Mesh& mesh : scene.meshes)
      for (const Vec3f p : mesh.positions)
        reach = std::max(
            {reach, std::fabs(static_cast<double>(p.x)), std::fabs(static_cast<double>(p.y)), std::fabs(static_cast<double>(p.z))});
    height_ = std::max(kRoundings * reach, kLeastHeight / texels);
  }

  // Nothing where no contact parts or covers the chart.
  std::optional<Parted> parted(const Chart& chart, std::vector<std::string>& warnings) {
    double area = 0;
    for (const ChartTriangle& t : chart.triangles) area += std::fabs(doubled_area(t.at)) / 2;
    if (area < kLeastChart * texel_ * texel_) return {};
    const std::vector<ContactLine> lines = sections_.above(chart, border_of(chart), height_);
    if (lines.empty()) return {};
    if (work_ == 0) return give_up(chart);
    ContactRegions regions(chart, kTogether * height_);
    for (const ContactLine& line : lines) {
      const bool few = regions.cut(line.from, line.to);
      if (regions.steps() > work_) return give_up(chart);
      if (!few) {
        warnings.push_back("more than " + std::to_string(ContactRegions::kMostPieces) + " contacts on one plane of " +
                           name_of(scene_.meshes[chart.mesh], chart.mesh) + ": its light may spread below the things on it");
        spend(regions.steps());
        return {};
      }
    }
    spend(regions.steps() + lines.size() * regions.pieces().size());
    Parted result = judged(chart, regions);
    const std::vector<ContactLine> through = screens(lines, regions, result);
    for (const ContactLine& line : through) regions.cut_through(line.from, line.to);
    if (!through.empty()) return judged(chart, regions);
    if (result.lit.size() == 1 && *std::max_element(result.region.begin(), result.region.end()) == 0) return {};
    return result;
  }

  // Appends a sentence about the charts whose contacts take too long.
  void warn(std::vector<std::string>& warnings) const {
    if (given_up_ == 0) return;
    warnings.push_back("the contacts on " + std::to_string(given_up_) + " planes take too long, the first of them of " +
                       name_of(scene_.meshes[first_given_up_], first_given_up_) +
                       ": its light may spread below the things on it (raise the limit with --max-work)");
  }

 private:
  void spend(std::uint64_t steps) { work_ -= std::min(steps, work_); }
  std::optional<Parted> give_up(const Chart& chart) {
    if (given_up_++ == 0) first_given_up_ = chart.mesh;
    work_ = 0;
    return {};
  }

  // The regions, and which of them are lit. No regions: there is one alone.
  Parted judged(const Chart& chart, const ContactRegions& regions) {
    Parted result{regions.pieces(), regions.regions(), {}, regions.doors()};
    const std::uint32_t count = 1 + *std::max_element(result.region.begin(), result.region.end());
    std::vector<double> area(count, 0.0);
    std::vector<std::vector<std::uint32_t>> pieces(count);
    for (std::uint32_t n = 0; n < result.pieces.size(); ++n) {
      area[result.region[n]] += area_of(result.pieces[n].outline);
      pieces[result.region[n]].push_back(n);
    }
    const double least = std::min(least_, kLeastRegion * std::accumulate(area.begin(), area.end(), 0.0));
    for (std::uint32_t r = 0; r < count; ++r)
      if (area[r] >= least && (count == 1 || !is_covered(chart, result, std::move(pieces[r])))) result.lit.push_back(r);
    return result;
  }

  // Contacts of thin walls whose both sides belong to one region: their texels would mix both sides. Each wall has one line.
  std::vector<ContactLine> screens(const std::vector<ContactLine>& lines, const ContactRegions& regions, const Parted& parted) const {
    const auto lit_region = [&](Vec2d p) {
      const std::uint32_t piece = regions.piece_at(p);
      if (piece == ContactRegions::kNowhere) return ContactRegions::kNowhere;
      const std::uint32_t region = parted.region[piece];
      return std::find(parted.lit.begin(), parted.lit.end(), region) != parted.lit.end() ? region : ContactRegions::kNowhere;
    };
    std::vector<ContactLine> found;
    for (const ContactLine& line : lines) {
      const double l = length(line.to - line.from);
      if (!(l >= kLeastScreen * texel_)) continue;
      const Vec2d along = (line.to - line.from) / l, across{-along.y, along.x}, middle = (line.from + line.to) * 0.5;
      // One side is lit at the line, the other one at the line or behind the wall.
      const double near = 2 * kTogether * height_, far = kThickest * texel_;
      bool thin = false;
      for (const double side : {-1.0, 1.0}) {
        const std::uint32_t here = lit_region(middle + across * (side * near));
        thin |= here != ContactRegions::kNowhere &&
                (lit_region(middle - across * (side * near)) == here || lit_region(middle - across * (side * far)) == here);
      }
      const bool has_line = std::any_of(found.begin(), found.end(), [&](const ContactLine& other) {
        const Vec2d direction = (other.to - other.from) / length(other.to - other.from);
        return std::fabs(cross(direction, line.from - other.from)) < far && std::fabs(cross(direction, line.to - other.from)) < far;
      });
      if (thin && !has_line) found.push_back(line);
    }
    return found;
  }

  // The triangles of a chart's mesh across its outer edges.
  std::unordered_set<std::uint32_t> border_of(const Chart& chart) {
    if (mesh_ != chart.mesh || !neighbours_) {
      neighbours_.emplace(scene_.meshes[chart.mesh]);
      mesh_ = chart.mesh;
    }
    std::unordered_set<std::uint32_t> border;
    for (const ChartTriangle& t : chart.triangles)
      for (std::uint32_t k = 0; k < 3; ++k)
        if (const std::uint32_t edge = neighbours_->across(t.triangle, k); edge != MeshNeighbours::kNone) border.insert(edge / 3);
    return border;
  }

  // True if all that a region sees is the backs of triangles: it lies in something that stands on the chart.
  //
  //   own  its pieces
  bool is_covered(const Chart& chart, const Parted& parted, std::vector<std::uint32_t> own) {
    if (!rays_) rays_ = std::make_unique<RayScene>(scene_);
    std::stable_sort(own.begin(), own.end(), [&](std::uint32_t a, std::uint32_t b) {
      return area_of(parted.pieces[a].outline) > area_of(parted.pieces[b].outline);
    });
    if (own.size() > kLooks) own.resize(kLooks);
    const ChartPlane& plane = chart.plane;
    for (const std::uint32_t n : own) {
      const Vec2d at = middle_of(parted.pieces[n].outline);
      const Vec3d from = plane.origin + plane.x * at.x + plane.y * at.y + plane.normal * height_;
      for (std::size_t k = 0; k < kRays; ++k) {
        const auto [square, v] = fibonacci_place(k, kRays, 0.0);
        const double r = std::sqrt(square), phi = 2 * std::numbers::pi * v;
        const Vec3d to = plane.x * (r * std::cos(phi)) + plane.y * (r * std::sin(phi)) + plane.normal * std::sqrt(1 - square);
        spend(kRaySteps);
        RTCRayHit hit;
        if (!rays_->intersect(static_cast<Vec3f>(from), static_cast<Vec3f>(to), hit)) return false;
        const Vec3d normal = across(scene_.meshes[hit.hit.geomID], hit.hit.primID);
        if (!(dot(normal, to) > 0)) return false;
      }
    }
    return true;
  }

  const Scene& scene_;
  const ContactSections sections_;
  const double texel_, least_;
  double height_ = 0;
  std::uint64_t work_;
  std::size_t given_up_ = 0;          // charts
  std::uint32_t first_given_up_ = 0;  // mesh of the first
  std::unique_ptr<RayScene> rays_;
  std::uint32_t mesh_ = 0;  // of the neighbours
  std::optional<MeshNeighbours> neighbours_;
};

// Applies the cuts to the charts.
class ChartCutter {
 public:
  explicit ChartCutter(CutScene& to) : cutter_(to) {}

  // The charts in the place of one that is parted: one for each lit region, and one for all others.
  std::vector<Chart> cut(const Chart& chart, const Parted& parted, std::uint32_t number) {
    std::vector<Chart> charts;
    std::map<std::uint32_t, std::size_t> chart_of;  // by lit region
    cutter_.begin_part();
    std::vector<std::uint8_t> replaced(chart.triangles.size(), 0);
    const auto add = [&](Chart& to, const ChartPiece& piece) {
      const std::uint32_t source = chart.triangles[piece.number].triangle;
      for (std::size_t i = 1; i + 1 < piece.outline.size(); ++i) {
        const std::array<Vec2d, 3> at{piece.outline[0], piece.outline[i], piece.outline[i + 1]};
        if (!(doubled_area(at) > 0)) continue;
        std::array<CutCorner, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) corners[k] = corner_at(chart.triangles[piece.number], source, at[k]);
        to.triangles.push_back({cutter_.put(chart.mesh, source, replaced[piece.number] == 0, corners), at});
        replaced[piece.number] = 1;
      }
    };
    Chart covered = empty_like(chart, number);
    covered.is_covered = true;
    for (const std::uint32_t region : parted.lit) {
      chart_of[region] = charts.size();
      Chart& part = charts.emplace_back(empty_like(chart, number));
      for (std::size_t n = 0; n < parted.pieces.size(); ++n)
        if (parted.region[n] == region) add(part, parted.pieces[n]);
    }
    for (std::size_t n = 0; n < parted.pieces.size(); ++n)
      if (std::find(parted.lit.begin(), parted.lit.end(), parted.region[n]) == parted.lit.end()) add(covered, parted.pieces[n]);
    for (const ContactRegions::Link& door : parted.doors) {
      const auto one = chart_of.find(parted.region[door.piece[0]]), other = chart_of.find(parted.region[door.piece[1]]);
      if (one == chart_of.end() || other == chart_of.end() || one->second == other->second) continue;
      for (const std::size_t c : {one->second, other->second})
        charts[c].doors.push_back({doors_, {door.from, door.to}, length(door.to - door.from)});
      ++doors_;
    }
    if (!covered.triangles.empty()) charts.push_back(std::move(covered));
    return charts;
  }

 private:
  static Chart empty_like(const Chart& chart, std::uint32_t number) {
    Chart part = chart;
    part.triangles.clear();
    part.cut_from = number;
    return part;
  }
  static CutCorner corner_at(const ChartTriangle& t, std::uint32_t source, Vec2d p) {
    const double doubled = doubled_area(t.at);
    const double u = cross(p - t.at[0], t.at[2] - t.at[0]) / doubled, v = cross(t.at[1] - t.at[0], p - t.at[0]) / doubled;
    return {source, {1 - u - v, u, v}};
  }

  MeshCutter cutter_;
  std::uint32_t doors_ = 0;
};

}  // namespace

CutScene cut_at_contacts(Scene scene, std::vector<Chart>& charts, double texels, std::uint64_t work, const WorkFraction& progress) {
  CutScene result;
  result.corners.resize(scene.meshes.size());
  std::vector<std::optional<Parted>> parted(charts.size());
  {
    ContactJudge judge(scene, texels, work);
    WorkSteps steps(progress, charts.size());
    for (std::size_t c = 0; c < charts.size(); ++c) {
      if (charts[c].is_flat) parted[c] = judge.parted(charts[c], result.warnings);
      steps.advance();
    }
    judge.warn(result.warnings);
  }
  result.scene = std::move(scene);
  ChartCutter cutter(result);
  std::vector<Chart> all;
  for (std::size_t c = 0; c < charts.size(); ++c) {
    if (parted[c] && parted[c]->lit.size() > 1) {
      for (Chart& part : cutter.cut(charts[c], *parted[c], static_cast<std::uint32_t>(result.cut))) all.push_back(std::move(part));
      ++result.cut;
      continue;
    }
    Chart& chart = all.emplace_back(std::move(charts[c]));
    if (!parted[c]) continue;
    chart.is_covered = parted[c]->lit.empty();
    for (std::size_t n = 0; n < parted[c]->pieces.size() && !chart.is_covered; ++n)
      if (parted[c]->region[n] == parted[c]->lit.front()) chart.pieces.push_back(std::move(parted[c]->pieces[n]));
  }
  charts = std::move(all);
  return result;
}

}  // namespace steradian::bake
