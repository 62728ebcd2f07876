#include "bake/bake.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "bake/charts/atlas.h"
#include "bake/charts/charts.h"
#include "bake/fit_space.h"
#include "bake/hat_fit.h"
#include "bake/sample_light.h"
#include "bake/charts/seams.h"
#include "render/tile/pass_clock.h"
#include "steradian/area_light.h"  // luminance
#include "steradian/error.h"

namespace steradian::bake {
namespace {

constexpr std::size_t kMostBlocks = std::size_t{1} << 12;  // of samples in memory at a time, unless one group has more
constexpr std::uint64_t kChartBytes = 600;                 // memory of a triangle, its edges and its place in a chart: 650 with vertices
// Memory of a block of samples: itself, its light, and the cells of the chart from which it is made.
constexpr std::uint64_t kBytesPerBlock = sizeof(PlacedBlock) + sizeof(LitBlock) + 16 * kBytesPerCell;

double luminance_of(Vec3d v) { return luminance(v); }

// The work on one map.
class MapBake {
 public:
  MapBake(Scene& scene, const BakeOptions& options, const std::string& place, Budget& budget, BakeStats& stats)
      : scene_(scene), options_(options), place_(place), budget_(budget), stats_(stats) {}

  LightMap empty() {
    prepare();
    return std::move(map_);
  }

  LightMap run() {
    prepare();
    const std::vector<Group> groups = find_groups();
    take_memory_of(groups);
    const std::vector<Batch> batches = batches_of(groups);
    std::size_t unknown = 0;  // blocks of samples without light
    for (const Batch& batch : batches)
      if (!take_up(batch)) unknown += blocks_of(batch.groups);
    if (unknown > 0) bake_batches(batches, unknown);
    finish();
    return std::move(map_);
  }

 private:
  using Group = std::vector<std::uint32_t>;  // charts that are fitted together
  // Groups whose samples are in memory together. The number does not depend on the part.
  struct Batch {
    std::uint64_t number = 0;
    std::span<const Group> groups;
  };
  struct GroupSums {
    double area = 0, light = 0, residual = 0, error = 0;  // squares of the last two, all times area
    std::uint64_t samples = 0;
  };

  // Shares of the time: estimates. The charts' share is that of scenes of 10^4 to 10^5 triangles.
  static constexpr double kCharts = 0.05;
  WorkFraction part(double first, double last) const { return part_of(options_.progress, first, last); }

  // Finds the charts, cuts them at contacts and gives them texels.
  void prepare() {
    if (!(options_.texels >= kLeastTexels && options_.texels <= kMostTexels))
      throw Error(place_, "a light map of " + std::to_string(options_.texels) + " texels a metre is out of range", "give 0.001 to 10000");
    std::uint64_t triangles = 0;
    for (const Mesh& mesh : scene_.meshes) triangles += mesh.triangle_count();
    budget_.take_memory(place_, "the charts of its triangles", triangles * kChartBytes);
    Charts charts = charts_of(scene_, options_.texels, place_);
    map_.warnings = std::move(charts.warnings);
    map_.charts = std::move(charts.charts);
    if (map_.charts.empty()) throw Error(place_, "has no surface that takes light", "bake a scene with lit meshes");
    CutScene cut = cut_at_contacts(std::move(scene_), map_.charts, options_.texels, budget_.limits().work, part(0, kCharts));
    scene_ = std::move(cut.scene);
    map_.cuts = std::move(cut.corners);
    map_.warnings.insert(map_.warnings.end(), cut.warnings.begin(), cut.warnings.end());
    const MapSize size =
        place_charts(scene_, map_.charts, options_.texels, place_,
                     options_.target == BakeTarget::vertex ? "lower --texels" : "lower --texels, or choose --target vertex");
    stats_.cut = cut.cut;
    stats_.charts = map_.charts.size();
    if (options_.target == BakeTarget::vertex) {
      map_.corners.resize(scene_.meshes.size());
      return;
    }
    map_.width = size.width;
    map_.height = size.height;
    const auto texels = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
    budget_.take_memory(place_, "the texels of the map", texels * 2 * sizeof(Vec3f));
    map_.irradiance.resize(texels);
    map_.error.resize(texels);
    seams_ = seams_of(scene_, map_.charts);
    seams_of_.resize(map_.charts.size());
    for (const Seam& seam : seams_) seams_of_[seam.chart[0]].push_back(&seam);
    stats_.seams = seams_.size();
  }

  // Charts that seams join; for vertices those of one mesh.
  std::vector<Group> find_groups() const {
    if (options_.target == BakeTarget::texture) return joined_charts(map_.charts.size(), seams_);
    std::map<std::uint32_t, Group> by_mesh;
    for (std::uint32_t c = 0; c < map_.charts.size(); ++c) by_mesh[map_.charts[c].mesh].push_back(c);
    std::vector<Group> groups;
    for (auto& [mesh, group] : by_mesh) groups.push_back(std::move(group));
    return groups;
  }

  std::unique_ptr<const FitSpace> space_of(const Group& group) {
    const std::uint32_t mesh = map_.charts[group.front()].mesh;
    if (options_.target == BakeTarget::vertex)
      return std::make_unique<const VertexSpace>(scene_.meshes[mesh], map_.charts, group, map_.corners[mesh]);
    std::vector<const Seam*> seams;
    for (const std::uint32_t c : group) seams.insert(seams.end(), seams_of_[c].begin(), seams_of_[c].end());
    return std::make_unique<const TexelSpace>(map_.charts, group, std::move(seams), 1 / options_.texels, map_);
  }

  bool stopped() const { return options_.light.stop != nullptr && options_.light.stop->load(std::memory_order_relaxed); }
  std::size_t blocks_in(const Group& group) const {
    std::size_t blocks = 0;
    for (const std::uint32_t c : group) {
      const Chart& chart = map_.charts[c];
      if (!chart.is_covered) blocks += static_cast<std::size_t>((chart.width + 1) / 2) * static_cast<std::size_t>((chart.height + 1) / 2);
    }
    return blocks;
  }

  // An unknown has a row of the matrix, of a second one while the matrix grows, and of a few vectors. Seams have longer rows, and a
  // preconditioner of as many entries.
  void take_memory_of(const std::vector<Group>& groups) {
    std::uint64_t most_of_fit = 0, most_of_samples = 0;
    std::uint32_t chart_of_fit = 0, chart_of_samples = 0;
    for (const auto& group : groups) {
      const std::unique_ptr<const FitSpace> space = space_of(group);
      const std::uint64_t fit = space->count() * (space->has_seams() ? 2000 : 600);
      if (fit > most_of_fit) most_of_fit = fit, chart_of_fit = group.front();
      const std::uint64_t samples = std::max(blocks_in(group), kMostBlocks) * kBytesPerBlock;
      if (samples > most_of_samples) most_of_samples = samples, chart_of_samples = group.front();
    }
    const auto place = [&](std::uint32_t chart) {
      return place_ + ": " + name_of(scene_.meshes[map_.charts[chart].mesh], map_.charts[chart].mesh);
    };
    budget_.take_memory(place(chart_of_fit), "the fit of its texels", most_of_fit);
    budget_.take_memory(place(chart_of_samples), "the samples of its charts", most_of_samples);
  }

  std::size_t blocks_of(std::span<const Group> groups) const {
    std::size_t blocks = 0;
    for (const Group& group : groups) blocks += blocks_in(group);
    return blocks;
  }

  // The batches of this part.
  std::vector<Batch> batches_of(const std::vector<Group>& groups) const {
    std::vector<Batch> batches;
    std::uint64_t number = 0;
    for (std::size_t first = 0; first < groups.size(); ++number) {
      std::size_t last = first, blocks = 0;
      while (last < groups.size() && (last == first || blocks + blocks_in(groups[last]) <= kMostBlocks))
        blocks += blocks_in(groups[last++]);
      if (number % options_.parts == options_.part - 1) batches.push_back({number, std::span(groups).subspan(first, last - first)});
      first = last;
    }
    return batches;
  }

  // The number of a batch among those of all maps of a run.
  std::uint64_t key_of(const Batch& batch) const { return std::uint64_t{options_.run} << 32 | batch.number; }

  // A batch in the file of an unfinished run: the sums of each group, its texels and their errors.
  static void keep(std::string& bytes, const GroupSums& sums, const std::vector<Vec3d>& values, const std::vector<Vec3d>& errors) {
    const auto put = [&](const auto& number) { bytes.append(reinterpret_cast<const char*>(&number), sizeof number); };
    put(sums);
    for (const std::vector<Vec3d>* list : {&values, &errors})
      for (const Vec3d v : *list) put(static_cast<Vec3f>(v));
  }

  // Takes a batch that an earlier run has finished. Returns false where there is none.
  bool take_up(const Batch& batch) {
    const auto bytes = options_.unfinished != nullptr ? options_.unfinished->find(key_of(batch)) : std::nullopt;
    if (!bytes) return false;
    std::uint64_t wanted = 0;
    for (const Group& group : batch.groups) wanted += sizeof(GroupSums) + 2 * sizeof(Vec3f) * space_of(group)->count();
    if (bytes->size() != wanted) return false;
    const char* from = bytes->data();
    const auto take = [&](auto& number) {
      std::memcpy(&number, from, sizeof number);
      from += sizeof number;
    };
    for (const Group& group : batch.groups) {
      const std::unique_ptr<const FitSpace> space = space_of(group);
      GroupSums sums;
      take(sums);
      std::array<std::vector<Vec3d>, 2> lists;
      for (std::vector<Vec3d>& list : lists)
        for (std::size_t n = 0; n < space->count(); ++n) {
          Vec3f v;
          take(v);
          list.push_back(static_cast<Vec3d>(v));
        }
      space->store(lists[0], lists[1]);
      sums_of_[batch.number].push_back(sums);
    }
    return true;
  }

  // Bakes the batches that no earlier run has finished.
  //
  //   blocks  of their samples, at most
  void bake_batches(const std::vector<Batch>& batches, std::size_t blocks) {
    // A tile of samples gathers the light of all patches, which takes a few times as long as its direct light.
    const auto solve = static_cast<double>(SurfaceLight::solve_tiles(scene_, options_.light));
    const double samples = static_cast<double>(blocks) / SampleLight::kBlocksPerTile;
    const double solved = kCharts + (1 - kCharts) * solve / (solve + samples);
    const auto start = Clock::now();
    SampleLight light(scene_, options_.light, options_.direct == BakedDirect::on ? SurfaceLight::Direct::on : SurfaceLight::Direct::off,
                      part(kCharts, solved));
    stats_.solve_ms = ms_since(start);
    WorkSteps steps(part(solved, 1), blocks);
    for (const Batch& batch : batches) {
      if (stopped()) return;
      if (sums_of_.count(batch.number) == 0) bake_batch(batch, light, steps);
    }
    stats_.patches = light.surfaces().patches();
    stats_.shadow_fallback = light.surfaces().shadow_fallback();
  }

  void bake_batch(const Batch& batch, SampleLight& light, WorkSteps& steps) {
    const std::span<const Group> groups = batch.groups;
    std::vector<PlacedBlock> blocks;
    std::vector<std::size_t> first_of(groups.size() + 1, 0);
    std::vector<std::uint32_t> chart_of;  // by block
    for (std::size_t g = 0; g < groups.size(); ++g) {
      for (const std::uint32_t c : groups[g]) {
        const Chart& chart = map_.charts[c];
        if (chart.is_covered) continue;
        for (const SampleBlock& block : samples_of(chart, scene_.meshes[chart.mesh])) {
          blocks.push_back({chart.mesh, block});
          chart_of.push_back(c);
        }
      }
      first_of[g + 1] = blocks.size();
    }
    const auto start = Clock::now();
    const std::vector<LitBlock> lit = light.of(blocks, batch.number << 32, [&] { steps.advance(); });
    stats_.sample_ms += ms_since(start);
    if (stopped()) return;
    const auto fit_start = Clock::now();
    std::vector<GroupSums>& sums = sums_of_[batch.number];
    sums.resize(groups.size());
    std::vector<std::string> kept(groups.size());
    tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t g) {
      const std::size_t first = first_of[g], count = first_of[g + 1] - first;
      sums[g] = fit(groups[g], std::span(blocks).subspan(first, count), std::span(lit).subspan(first, count),
                    std::span(chart_of).subspan(first, count), kept[g]);
    });
    if (options_.unfinished != nullptr) {
      std::string bytes;
      for (const std::string& k : kept) bytes += k;
      options_.unfinished->add(key_of(batch), bytes);
    }
    // The charts' bounding boxes hold places without a sample.
    const std::size_t expected = blocks_of(groups);
    if (expected > blocks.size()) steps.advance(expected - blocks.size());
    stats_.fit_ms += ms_since(fit_start);
  }

  GroupSums fit(const Group& group, std::span<const PlacedBlock> blocks, std::span<const LitBlock> lit,
                std::span<const std::uint32_t> chart_of, std::string& kept) {
    GroupSums sums;
    const std::unique_ptr<const FitSpace> space = space_of(group);
    HatFit equations(space->count());
    for (std::size_t b = 0; b < blocks.size(); ++b)
      for (std::size_t i = 0; i < 16; ++i) {
        const Sample& sample = blocks[b].samples[i];
        if (sample.area > 0) equations.add_value(space->at(chart_of[b], sample), sample.area, static_cast<Vec3d>(lit[b][i].irradiance));
      }
    space->add_conditions(equations);
    const std::vector<Vec3d> values = equations.solve();

    std::vector<Vec3d> squares(space->count());
    std::vector<double> weight(space->count(), 0.0);
    for (std::size_t b = 0; b < blocks.size(); ++b)
      for (std::size_t i = 0; i < 16; ++i) {
        const Sample& sample = blocks[b].samples[i];
        if (!(sample.area > 0)) continue;
        const auto hats = space->at(chart_of[b], sample);
        Vec3d shown{};
        for (const Hat& h : hats) shown += values[h.unknown] * h.value;
        const Vec3d d = shown - static_cast<Vec3d>(lit[b][i].irradiance), e = static_cast<Vec3d>(lit[b][i].error);
        for (const Hat& h : hats) {
          squares[h.unknown] += (d * d + e * e) * (h.value * sample.area);
          weight[h.unknown] += h.value * sample.area;
        }
        sums.area += sample.area;
        sums.light += luminance_of(static_cast<Vec3d>(lit[b][i].irradiance)) * sample.area;
        sums.residual += luminance_of(d * d) * sample.area;
        sums.error += luminance_of(e * e) * sample.area;
        ++sums.samples;
      }
    for (std::size_t n = 0; n < squares.size(); ++n) {
      const Vec3d mean = weight[n] > 0 ? squares[n] / weight[n] : Vec3d{};
      squares[n] = {std::sqrt(mean.x), std::sqrt(mean.y), std::sqrt(mean.z)};
    }
    space->store(values, squares);
    if (options_.unfinished != nullptr) keep(kept, sums, values, squares);
    return sums;
  }

  void finish() {
    if (stopped()) return;
    GroupSums total;
    for (const auto& [number, sums] : sums_of_)
      for (const GroupSums& s : sums) {
        total.area += s.area;
        total.light += s.light;
        total.residual += s.residual;
        total.error += s.error;
        total.samples += s.samples;
      }
    const double mean = total.area > 0 ? total.light / total.area : 0;
    stats_.mean = mean;
    const auto relative = [&](double sum) { return mean > 0 ? std::sqrt(sum / total.area) / mean : 0; };
    stats_.rms_residual = relative(total.residual);
    stats_.rms_error = relative(total.error);
    stats_.samples = total.samples;
    if (options_.target == BakeTarget::texture)
      for (const Chart& chart : map_.charts)
        stats_.texels += static_cast<std::size_t>(chart.width) * static_cast<std::size_t>(chart.height);
    if (options_.parts > 1) return;  // the other sides of seams may lack
    for (const Seam& seam : seams_) {
      const int places = 3 * TexelSpace::places_on(seam);
      for (int k = 0; k <= places; ++k) {
        const double t = static_cast<double>(k) / places;
        const auto shown = [&](std::size_t side) {
          return shown_at(map_.irradiance, map_.width, seam.ends[side][0] + (seam.ends[side][1] - seam.ends[side][0]) * t);
        };
        const Vec3d d = shown(0) - shown(1);
        if (mean > 0)
          stats_.largest_seam = std::max(stats_.largest_seam, std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)}) / mean);
      }
    }
  }

  Scene& scene_;
  const BakeOptions& options_;
  const std::string& place_;
  Budget& budget_;
  BakeStats& stats_;
  LightMap map_;
  std::vector<Seam> seams_;
  std::vector<std::vector<const Seam*>> seams_of_;           // by their first chart
  std::map<std::uint64_t, std::vector<GroupSums>> sums_of_;  // by batch
};

}  // namespace

LightMap bake_map(Scene scene, const BakeOptions& options, const std::string& place, Budget& budget, BakeStats* stats) {
  BakeOptions own = options;
  own.light.width = own.light.height = 16;  // of a camera that nothing looks through
  own.light.lights = LightSum::all;
  own.light.aa = 1;
  BakeStats unread;
  LightMap map;
  const auto run = [&] { map = MapBake(scene, own, place, budget, stats != nullptr ? *stats : unread).run(); };
  if (own.light.threads > 0)
    tbb::task_arena(own.light.threads).execute(run);
  else
    run();
  return map;
}

LightMap empty_map(Scene scene, const BakeOptions& options, const std::string& place, Budget& budget) {
  BakeStats unread;
  return MapBake(scene, options, place, budget, unread).empty();
}

}  // namespace steradian::bake
