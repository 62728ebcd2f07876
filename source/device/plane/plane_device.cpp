#include "device/plane/plane_device.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <span>
#include <string>
#include <string_view>
#include <tbb/parallel_for.h>
#include <utility>

#include "device/plane/listed_disks.h"
#include "device/plane/pair_words.h"
#include "device/plane/recorded_tiles.h"
#include "device/vulkan/compute_program.h"
#include "plane/frame/events/event_walk.h"
#include "plane/frame/frame.h"
#include "steradian/error.h"
#include "steradian/plane_device.h"

namespace steradian::plane {
namespace {

#include "shaders/plane/plane_layout.glsl"

using Clock = std::chrono::steady_clock;
using vulkan::Buffer;
using vulkan::BufferUse;

double ms_since(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

constexpr std::size_t kWordsOfBatch = std::size_t{4} << 20;
constexpr std::size_t kTilesOfBatch = 8192;
constexpr std::size_t kWordBytes = sizeof(std::uint32_t);
constexpr std::size_t kHeader = kJob;  // pixel steps, slack: in the place of a job
constexpr std::uint32_t kGroupsOfTile = 4, kThreads = 64;
constexpr std::size_t kBuffers = 5, kMostOfDispatch = 65535;  // groups along one axis, as Vulkan guarantees

static_assert(kPixels == kTilePixels);

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }

}  // namespace
}  // namespace steradian::plane

namespace steradian {

using namespace plane;

struct PlaneDevice::Impl {
  explicit Impl(std::shared_ptr<const vulkan::Device> d)
      : device(std::move(d)), program((vulkan::check_device(device->info(), kBuffers, "the plane"), *device), plane_shaders(), kBuffers) {
    for (std::size_t g = 0; g < kPrograms; ++g) pipelines[g] = program.pipeline(g);
  }

  // A buffer of at least `bytes`. One that is too small is replaced by a new one with a capacity of half as much again.
  Buffer& fitting(std::unique_ptr<Buffer>& buffer, std::size_t bytes, BufferUse use) {
    if (buffer == nullptr || buffer->bytes() < bytes) {
      const std::size_t room = std::min(bytes + bytes / 2, vulkan::kGuaranteedBuffer);
      buffer.reset();
      buffer = std::make_unique<Buffer>(*device, std::max<std::size_t>(room, 4096), use);
    }
    return *buffer;
  }

  // Uploads pairs and vertices, and returns the number of pairs on the device. Lights with other pairs use the general rules.
  std::size_t upload_pairs(const FrameScene& frame) {
    const std::size_t vertex_bytes = 4 * sizeof(float) * frame.vertices.size(), most = vulkan::kGuaranteedBuffer / (kPair * kWordBytes);
    const std::size_t count = vertex_bytes > vulkan::kGuaranteedBuffer ? 0 : std::min(frame.pairs.size(), most);
    auto* to = static_cast<std::uint32_t*>(fitting(pairs, count * kPair * kWordBytes, BufferUse::host_writes).mapped());
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { put_pair(to + i * kPair, frame.pairs[i]); });
    auto* v = static_cast<float*>(fitting(vertices, count == 0 ? 0 : vertex_bytes, BufferUse::host_writes).mapped());
    for (std::size_t i = 0; count > 0 && i < frame.vertices.size(); ++i) {
      const Split x(frame.vertices[i].x), y(frame.vertices[i].y);
      for (float number : {x.most, x.rest, y.most, y.rest}) *v++ = number;
    }
    return count;
  }

  void fill(const FrameScene& frame, const PlaneFrameOptions& options, const PixelGrid& grid, Picture& picture, PlaneFrameStats& counts);
  void run(const PixelGrid& grid, float slack, Picture& picture);
  void resolve(const PixelGrid& grid, Picture& picture);

  const std::shared_ptr<const vulkan::Device> device;
  vulkan::ComputeProgram program;
  static constexpr std::size_t kListed = kLightGroups, kLists = kLightGroups + 1, kPrograms = kLightGroups + 2;
  std::size_t pipelines[kPrograms];
  std::unique_ptr<Buffer> lists, pairs, vertices, sums, masks;
  ListedDisks disks;
  bool lists_made = false;  // have the lists of the disks been computed in this frame?
  std::vector<RecordedTiles> squares;
  struct InBatch {
    const RecordedTiles* of;
    const RecordedTile* tile;
    std::span<const ListedDisks::Entry> disks;
  };
  std::vector<InBatch> batch;
  std::vector<const RecordedTile*> for_cpu;
  PlaneDeviceStats stats;
};

// Renders the batch's tiles on the device, and adds their sums to the picture.
void PlaneDevice::Impl::run(const PixelGrid& grid, float slack, Picture& picture) {
  if (batch.empty()) return;
  auto start = Clock::now();
  // The buffer holds the header, disks, jobs, and their data.
  const std::size_t before_jobs = (kHeader + disks.records().size() + kJob - 1) / kJob * kJob;
  std::size_t jobs = 0, words = before_jobs;
  int rounds = 0;
  for (const InBatch& l : batch) {
    const std::size_t own = l.tile->jobs + (l.disks.empty() ? 0 : 1);
    jobs += own;
    words += own * kJob + l.tile->words + l.disks.size() * kListedLight;
    for (std::size_t k = 0; k < l.tile->jobs; ++k) rounds = std::max(rounds, l.of->jobs(*l.tile)[k].round + 1);
  }
  auto* to = static_cast<std::uint32_t*>(fitting(lists, words * kWordBytes, BufferUse::host_writes).mapped());
  to[0] = bits(static_cast<float>(grid.step.x));
  to[1] = bits(static_cast<float>(grid.step.y));
  to[2] = bits(slack);
  to[kDiskHeader] = kHeader;
  std::copy(disks.records().begin(), disks.records().end(), to + kHeader);
  std::uint32_t *job = to + before_jobs, *free = job + jobs * kJob;
  std::vector<bool> begun(batch.size(), false);
  std::vector<vulkan::ComputeProgram::Dispatch> dispatches;
  std::vector<double PlaneDeviceStats::*> clocks;
  const auto put_job = [&](std::size_t i, std::uint32_t lights) {
    const RecordedTile& tile = *batch[i].tile;
    const Split x(tile.center.x), y(tile.center.y);
    const std::uint32_t values[kJob] = {static_cast<std::uint32_t>(i),
                                        static_cast<std::uint32_t>(free - to),
                                        lights,
                                        bits(x.most),
                                        bits(x.rest),
                                        bits(y.most),
                                        bits(y.rest),
                                        begun[i] ? 0u : 1u};
    begun[i] = true;
    job = std::copy(std::begin(values), std::end(values), job);
  };
  if (!std::exchange(lists_made, true))
    for (std::size_t first = 0; first < disks.count(); first += kMostOfDispatch) {
      dispatches.push_back({pipelines[kLists], static_cast<std::uint32_t>((disks.most_cells() + kThreads - 1) / kThreads),
                            static_cast<std::uint32_t>(std::min(disks.count() - first, kMostOfDispatch)),
                            static_cast<std::uint32_t>(first)});
      clocks.push_back(&PlaneDeviceStats::making_lists_ms);
    }
  const auto first_listed = static_cast<std::uint32_t>((job - to) / kJob);
  std::uint32_t listed = 0;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    if (batch[i].disks.empty()) continue;
    put_job(i, static_cast<std::uint32_t>(batch[i].disks.size()));
    for (const ListedDisks::Entry& entry : batch[i].disks) {
      *free++ = static_cast<std::uint32_t>(kHeader) + entry.disk * static_cast<std::uint32_t>(kDisk);
      *free++ = entry.mask;
    }
    ++listed;
  }
  if (listed > 0) {
    dispatches.push_back({pipelines[kListed], kGroupsOfTile, listed, first_listed});
    clocks.push_back(&PlaneDeviceStats::disks_ms);
  }
  for (const LightGroup group : {LightGroup::disks, LightGroup::cuts, LightGroup::arcs})
    for (int round = 0; round < rounds; ++round) {
      const auto first = static_cast<std::uint32_t>((job - to) / kJob);
      std::uint32_t count = 0;
      for (std::size_t i = 0; i < batch.size(); ++i) {
        const RecordedTile& tile = *batch[i].tile;
        const RecordedJob *begin = batch[i].of->jobs(tile), *end = begin + tile.jobs;
        const RecordedJob* one = std::find_if(begin, end, [&](const RecordedJob& j) { return j.group == group && j.round == round; });
        if (one == end) continue;
        put_job(i, one->lights);
        free = std::copy_n(batch[i].of->words(group) + one->first, one->words, free);
        ++count;
      }
      if (count == 0) continue;
      dispatches.push_back({pipelines[static_cast<std::size_t>(group)], kGroupsOfTile, count, first});
      clocks.push_back(group == LightGroup::disks  ? &PlaneDeviceStats::disks_ms
                       : group == LightGroup::cuts ? &PlaneDeviceStats::cuts_ms
                                                   : &PlaneDeviceStats::arcs_ms);
    }
  Buffer& result = fitting(sums, batch.size() * kTileSums * sizeof(float), BufferUse::host_reads);
  for (std::size_t i = 0; i < batch.size(); ++i) static_cast<float*>(result.mapped())[i * kTileSums + kToCpu] = 0;
  stats.upload_ms += ms_since(start);

  start = Clock::now();
  const std::vector<double> ms = program.run({lists.get(), pairs.get(), vertices.get(), sums.get(), masks.get()}, dispatches);
  for (std::size_t i = 0; i < ms.size(); ++i) stats.*clocks[i] += ms[i];
  stats.device_ms += ms_since(start);

  start = Clock::now();
  resolve(grid, picture);
  stats.resolve_ms += ms_since(start);
  stats.tiles += batch.size();
  batch.clear();
}

void PlaneDevice::Impl::resolve(const PixelGrid& grid, Picture& picture) {
  const auto* from = static_cast<const float*>(sums->mapped());
  tbb::parallel_for(std::size_t{0}, batch.size(), [&](std::size_t i) {
    const RecordedTile& tile = *batch[i].tile;
    const float* red = from + i * kTileSums;
    for (int y = 0; y < plane::kTileSide && tile.y + y < grid.height; ++y)
      for (int x = 0; x < plane::kTileSide && tile.x + x < grid.width; ++x) {
        const int k = y * plane::kTileSide + x;
        if (!tile.filled[static_cast<std::size_t>(k)])
          picture.at(tile.x + x, tile.y + y) += Vec3f{red[k], red[kPixels + k], red[2 * kPixels + k]};
      }
  });
  for (std::size_t i = 0; i < batch.size(); ++i)
    if (from[i * kTileSums + kToCpu] != 0) for_cpu.push_back(batch[i].tile);
}

void PlaneDevice::Impl::fill(const FrameScene& frame, const PlaneFrameOptions& options, const PixelGrid& grid, Picture& picture,
                             PlaneFrameStats& counts) {
  auto start = Clock::now();
  const std::size_t on_device = upload_pairs(frame);
  disks.choose(frame, grid, on_device, vulkan::kGuaranteedBuffer / kWordBytes);
  fitting(masks, disks.mask_words() * kWordBytes, BufferUse::host_writes);
  lists_made = false;
  stats.lights_listed += disks.count();
  stats.upload_ms += ms_since(start);
  start = Clock::now();
  if (squares.size() < squares_of(grid)) squares.resize(squares_of(grid));
  for (RecordedTiles& square : squares) square.clear(on_device, disks.is_listed());
  const ListsOfSquare lists_of = [&](std::size_t square) -> TileLists& { return squares[square]; };
  list_tiles(frame, options, grid, lists_of, picture, counts);
  stats.lists_ms += ms_since(start);

  for_cpu.clear();
  batch.clear();
  std::size_t words = 0;
  for (const RecordedTiles& square : squares)
    for (const RecordedTile& tile : square.tiles()) {
      const std::span<const ListedDisks::Entry> of_disks =
          tile.filled.all() ? std::span<const ListedDisks::Entry>() : disks.of_tile(tile.x / plane::kTileSide, tile.y / plane::kTileSide);
      if (tile.words == 0 && of_disks.empty() && !tile.for_cpu) continue;
      counts.tile_lights += of_disks.size();
      const std::size_t more = tile.words + (tile.jobs + 1) * kJob + of_disks.size() * kListedLight;
      if (tile.for_cpu || (more + 2 * kHeader + disks.records().size()) * kWordBytes > vulkan::kGuaranteedBuffer) {
        for_cpu.push_back(&tile);
        ++stats.tiles;
        continue;
      }
      if (words + more > kWordsOfBatch || batch.size() == kTilesOfBatch) run(grid, slack_of(frame), picture), words = 0;
      batch.push_back({&square, &tile, of_disks});
      words += more;
    }
  run(grid, slack_of(frame), picture);

  stats.tiles_of_cpu += for_cpu.size();
  if (for_cpu.empty()) return;
  TileSet again(grid);
  for (const RecordedTile* tile : for_cpu) again.mark(tile->x, tile->y, plane::kTileSide);
  PlaneFrameOptions silent = options;
  silent.progress = nullptr;
  PlaneFrameStats unused;
  render_tiles(frame, silent, grid, picture, unused, &again);
}

PlaneDevice::PlaneDevice(const std::string& device) : PlaneDevice(vulkan::open_device({device, false})) {}
PlaneDevice::PlaneDevice(std::shared_ptr<const vulkan::Device> device) : impl_(std::make_unique<Impl>(std::move(device))) {}
PlaneDevice::~PlaneDevice() = default;
PlaneDevice::PlaneDevice(PlaneDevice&&) noexcept = default;
PlaneDevice& PlaneDevice::operator=(PlaneDevice&&) noexcept = default;

const std::string& PlaneDevice::name() const { return impl_->device->info().name; }
const PlaneDeviceStats& PlaneDevice::stats() const { return impl_->stats; }

Picture PlaneDevice::render(const PlaneWorld& world, const PlaneFrameOptions& options, PlaneFrameStats* stats) {
  Picture picture;
  render_into(picture, world, options, stats);
  return picture;
}

void PlaneDevice::render_into(Picture& picture, const PlaneWorld& world, const PlaneFrameOptions& options, PlaneFrameStats* stats) {
  if (options.method != PlaneMethod::exact)
    throw UsageError("--backend vulkan", std::string("does not have the method ") + name_of(options.method) + " of the plane",
                     "use exact, or --backend cpu");
  if (options.moments) throw UsageError("--backend vulkan", "does not have --moments", "use --backend cpu");
  impl_->stats = {};
  const FillTiles fill = [this](const FrameScene& frame, const PlaneFrameOptions& o, const PixelGrid& grid, Picture& to,
                                PlaneFrameStats& counts) { impl_->fill(frame, o, grid, to, counts); };
  render_plane_with(fill, picture, world, options, stats);
  for (const auto* buffer : {&impl_->lists, &impl_->pairs, &impl_->vertices, &impl_->sums, &impl_->masks})
    if (*buffer != nullptr) impl_->stats.bytes += (*buffer)->bytes();
}

}  // namespace steradian

namespace steradian::plane {
namespace {

vulkan::ShaderCode shader(std::string_view name) {
#include "steradian_plane_vulkan_shaders.inc"
  throw Error("Vulkan", "this build has no shader " + std::string(name));
}

}  // namespace

std::vector<vulkan::ShaderCode> plane_shaders() {
  return {shader("plane_disks.comp"), shader("plane_cuts.comp"), shader("plane_arcs.comp"), shader("plane_listed.comp"),
          shader("plane_lists.comp")};
}

std::vector<vulkan::PipelineReport> compile_picture(const PlaneWorld& world, const PlaneFrameOptions& options, const std::string& device) {
  const auto compiler = std::make_shared<const vulkan::Device>(vulkan::DeviceOptions{device, false, true});
  PlaneDevice(compiler).render(world, options);
  return compiler->pipelines();
}

}  // namespace steradian::plane
