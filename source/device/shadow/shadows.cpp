#include "device/shadow/shadows.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "core/budget.h"
#include "device/vulkan/shaders.h"
#include "steradian/error.h"

namespace steradian::vulkan {
namespace {

#include "shaders/shadow_layout.glsl"

constexpr std::size_t kVector = 4 * sizeof(std::uint32_t);
constexpr std::size_t kLargestBuffer = std::size_t{128} << 20;  // guaranteed by Vulkan
// Limits of one search: work groups in a row, points whose parts fill a quarter of a buffer, lights and groups whose values fill half of
// one.
constexpr std::size_t kMostGroups = 65535, kMostPoints = 65535, kMostLights = 16384,
                      kMostValues = kLargestBuffer / 2 / sizeof(std::uint32_t);
constexpr std::size_t kVectorsOfPart = 32;  // initial size of a part
// Capacities of a subgroup for one point: segments, and as many pieces of them. The smaller ones let more subgroups run at a time
// (docs/theory/device.md). Bytes of a segment and a piece in shared memory: shaders/shadow_segments.glsl, shaders/shadow_count.glsl.
constexpr std::array<std::size_t, kShadowSpaces> kSegments = {96, 208, 640};
constexpr std::size_t kLeastSegments = 256, kSegmentBytes = 48;

// Layout of Answers in shaders/shadow_parts.comp.
struct AnswersHead {
  std::uint32_t parts_begin, parts_used, parts_room, unused;
  struct Space {
    std::uint32_t points, one_y, one_z, first_name;
  } spaces[kShadowSpaces];
};
struct Answer {
  Vec3f origin;
  std::uint32_t edges;
  Vec3f way;
  std::uint32_t sees;
};
static_assert(sizeof(AnswersHead) == (kShadowSpaces + 1) * kVector && sizeof(Answer) == kShadowAnswer * kVector);

constexpr std::size_t kThreads = 64;  // work group size of shaders/shadow_rays.comp

std::uint32_t flag(int f) { return static_cast<std::uint32_t>(f); }
std::uint32_t number(std::size_t n) { return static_cast<std::uint32_t>(n); }

// First places of a tile's data among those of a batch.
struct Begin {
  std::size_t light = 0, point = 0, record = 0, row = 0, group = 0;
};

}  // namespace

struct Shadows::Batch {
  explicit Batch(std::span<TileShadows> t) : tiles(t), begins(t.size() + 1) {
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      const TileShadows& tile = tiles[i];
      const Begin& b = begins[i];
      begins[i + 1] = {b.light + tile.by_light.size(), b.point + tile.points.size(), 0, b.row + tile.values.size() / 4,
                       b.group + tile.groups.size()};
    }
  }
  const Begin& all() const { return begins.back(); }

  std::span<TileShadows> tiles;
  std::vector<Begin> begins;
  std::vector<std::uint32_t> names;  // of all points
  Answer* answers = nullptr;         // by point
};

Shadows::Kept::Kept(const Device& d)
    : device(d),
      program(d, {shader("shadow_parts.comp"), shader("shadow_rays.comp")}, 4),
      groups(d),
      answers(d, BufferUse::host_reads),
      parts(d),
      states(d) {}

bool Shadows::has(const DeviceInfo& device) {
  return device.adds && device.subgroup > 0 && device.shared_memory >= kLeastSegments * kSegmentBytes;
}

Shadows::Shadows(Kept& kept, const SceneParts& parts, TileLighting& host, const SceneRays* rays)
    : kept_(kept), rays_(*parts.rays), device_rays_(rays), host_(host) {}

std::size_t Shadows::most_of_buffer() const { return std::min<std::size_t>(kLargestBuffer, kept_.device.info().storage_buffer); }

Buffer& Shadows::fitting(KeptBuffer& buffer, std::size_t bytes, const char* what) const {
  const std::size_t most = most_of_buffer();
  if (bytes > most)
    throw Error(
        "Vulkan",
        std::string(what) + " of one tile take " + readable_bytes(bytes) + ", more than the " + readable_bytes(most) + " of a buffer",
        "use --backend cpu");
  return buffer.fit_with_room(bytes, most);
}

void Shadows::upload(Batch& batch) {
  constexpr std::size_t kHeader = static_cast<std::size_t>(kShadowHeader);
  const std::size_t headers = batch.all().group * kHeader;
  auto* to = static_cast<std::uint32_t*>(fitting(kept_.groups, (headers + batch.all().row) * kVector, "the edges before lights").mapped());
  std::size_t row = 0;
  for (std::size_t i = 0; i < batch.tiles.size(); ++i)
    for (const TileShadows::Search& group : batch.tiles[i].groups) {
      for (std::size_t k = 0; k < group.points; ++k)
        batch.names.push_back(number(row / kHeader * static_cast<std::size_t>(kGroupPoints) + k));
      auto header = group.header;
      for (const std::size_t at : {0, 1, 2, 4, 5, 6}) header[at] += number(headers + batch.begins[i].row);
      header[9] += number(batch.begins[i].point);
      std::memcpy(to + 4 * row, header.data(), sizeof header);
      row += kHeader;
    }
  for (std::size_t i = 0; i < batch.tiles.size(); ++i)
    std::memcpy(to + 4 * (headers + batch.begins[i].row), batch.tiles[i].values.data(),
                batch.tiles[i].values.size() * sizeof(std::uint32_t));
}

// Returns the number of vectors that the parts' records need.
std::size_t Shadows::search(Batch& batch) {
  const std::size_t count = batch.all().point;
  const std::size_t list = (count + 3) / 4, first_list = count * kShadowAnswer;
  AnswersHead head{0, 0, number(parts().bytes() / kVector), 0, {}};
  for (std::size_t i = 0; i < kSegments.size(); ++i) head.spaces[i] = {i == 0 ? number(count) : 0, 1, 1, number(first_list + i * list)};
  Buffer& answers = fitting(kept_.answers, sizeof head + (first_list + kSegments.size() * list) * kVector, "points before lights");
  answers.write(&head, sizeof head);
  batch.answers = reinterpret_cast<Answer*>(static_cast<char*>(answers.mapped()) + sizeof head);
  for (std::size_t i = 0; i < batch.tiles.size(); ++i)
    for (std::size_t k = 0; k < batch.tiles[i].points.size(); ++k)
      batch.answers[batch.begins[i].point + k] = {static_cast<Vec3f>(batch.tiles[i].points[k].at.position), 0, {}, kAskHost};
  std::memcpy(static_cast<void*>(batch.answers + count), batch.names.data(), batch.names.size() * sizeof(std::uint32_t));
  std::vector<ComputeProgram::Dispatch> dispatches;
  const DeviceInfo& device = kept_.device.info();
  for (std::size_t i = 0; i < kSegments.size() && count > 0; ++i) {
    const int space = static_cast<int>(std::min(device.shared_memory / kSegmentBytes, kSegments[i]));
    dispatches.push_back({.pipeline = kept_.program.pipeline(0, {space, space, static_cast<int>(device.subgroup)}),
                          .push = number(i),
                          .groups = &answers,
                          .groups_at = kVector * (i + 1)});
  }
  if (device_rays_ != nullptr && count > 0)
    dispatches.push_back({kept_.program.pipeline(1), number((count + kThreads - 1) / kThreads), 1, number(count)});
  const std::vector<double> times = kept_.program.run(
      {&kept_.groups.get(), &kept_.parts.get(), &answers, device_rays_ != nullptr ? &device_rays_->hierarchy() : &answers}, dispatches);
  for (std::size_t i = 0; i < times.size(); ++i) (device_rays_ != nullptr && i + 1 == times.size() ? rays_time_ : time_) += times[i];
  std::memcpy(&head, answers.mapped(), sizeof head);
  return head.parts_used;
}

// Traces on the host the rays that the device left undecided.
void Shadows::trace(Batch& batch, const Each& each) {
  each(batch.tiles.size(), [&](std::size_t i) {
    constexpr std::size_t kRays = 16;
    const std::size_t end = batch.begins[i + 1].point;
    RayScene::Sixteen rays;
    for (std::size_t first = batch.begins[i].point; first < end; first += kRays) {
      std::uint32_t asked = 0;
      for (std::size_t k = 0; k < std::min(kRays, end - first); ++k) {
        const Answer& answer = batch.answers[first + k];
        if ((answer.edges & flag(kAskRay)) == 0) continue;
        rays.set(k, static_cast<Vec3d>(answer.origin), static_cast<Vec3d>(answer.way));
        asked |= 1u << k;
      }
      const std::uint32_t blocked = rays_.blocked_among(rays, asked);
      for (std::size_t k = 0; k < kRays; ++k) {
        if ((asked >> k & 1) == 0) continue;
        Answer& answer = batch.answers[first + k];
        answer.edges -= flag(kAskRay);
        if ((blocked >> k & 1) != 0) answer.sees = flag(kSeesNone);
      }
    }
  });
}

void Shadows::ask_host(Batch& batch, const Each& each) {
  each(batch.tiles.size(), [&](std::size_t i) {
    TileShadows& tile = batch.tiles[i];
    const std::size_t begin = batch.begins[i].point;
    TilePoints points;
    points.points.resize(kTilePixels);
    std::vector<std::uint32_t> slots;
    for (std::size_t g = 0; g < tile.groups.size(); ++g) {
      const std::size_t first = tile.groups[g].header[9], count = tile.groups[g].points;
      const std::uint32_t light = tile.points[first].light;
      points.groups.groups.emplace_back();
      for (std::size_t k = first; k < first + count; ++k) {
        if (batch.answers[begin + k].sees != kAskHost) continue;
        const std::uint32_t slot = tile.points[k].slot;
        points.points[slot] = tile.points[k].at;
        points.groups.groups.back().push_back(slot);
        slots.push_back(slot);
      }
      if (points.groups.groups.back().empty())
        points.groups.groups.pop_back();
      else
        points.groups.clusters.push_back({number(points.groups.groups.size() - 1)});
      const bool last = g + 1 == tile.groups.size() || tile.points[tile.groups[g + 1].header[9]].light != light;
      if (!last || slots.empty()) continue;
      tile.set(light, slots, host_.find_at(points, *tile.by_light[light].light));
      points.groups = {};
      slots.clear();
    }
  });
}

void Shadows::write_states(Batch& batch, const Each& each) {
  auto* states = static_cast<std::uint32_t*>(
      fitting(kept_.states, batch.all().light * kTilePixels * sizeof(std::uint32_t), "states of lights").mapped());
  auto* records = static_cast<Vec4Floats*>(kept_.parts.get().mapped());
  each(batch.tiles.size(), [&](std::size_t i) {
    TileShadows& tile = batch.tiles[i];
    const Begin& begin = batch.begins[i];
    std::copy(tile.records.begin(), tile.records.end(), records + begin.record);
    std::uint32_t* to = states + begin.light * kTilePixels;
    for (std::size_t l = 0; l < tile.by_light.size(); ++l)
      for (std::size_t slot = 0; slot < kTilePixels; ++slot) {
        const std::uint32_t state = tile.by_light[l].states[slot];
        to[l * kTilePixels + slot] = state < kSeesPart ? state : state + number(begin.record);
      }
    for (std::size_t k = 0; k < tile.points.size(); ++k) {
      const Answer& answer = batch.answers[begin.point + k];
      if (answer.sees == flag(kSeesNone) || answer.sees == flag(kAskHost)) continue;
      const TileShadows::Point& point = tile.points[k];
      to[point.light * kTilePixels + point.slot] = answer.sees;
      TileShadows::Light& light = tile.by_light[point.light];
      light.edges = std::max(light.edges, static_cast<int>(answer.edges));
      light.shares |= point.shares && answer.sees >= kSeesPart;
    }
  });
}

std::size_t Shadows::find(std::span<TileShadows> tiles, const Each& each) {
  const Batch all(tiles);
  std::size_t count = 1;
  const auto fits = [&](const Begin& b) {
    return b.group <= kMostGroups && b.point <= kMostPoints && b.light <= kMostLights && b.row * 4 <= kMostValues;
  };
  while (count < tiles.size() && fits(all.begins[count + 1])) ++count;
  bool asked = false;
  while (true) {
    Batch batch(tiles.first(count));
    fitting(kept_.parts, std::min(batch.all().point * kVectorsOfPart * kVector, most_of_buffer()), "parts of lights");
    upload(batch);
    std::size_t wanted = search(batch);
    if (!asked && wanted * kVector <= parts().bytes()) {
      ask_host(batch, each);
      asked = true;
    }
    for (std::size_t i = 0; i < count; ++i) {
      batch.begins[i].record = wanted;
      wanted += batch.tiles[i].records.size();
    }
    if (wanted * kVector > parts().bytes()) {
      // Try again with more capacity or fewer tiles.
      if (wanted * kVector > most_of_buffer() && count > 1)
        count /= 2;
      else
        fitting(kept_.parts, wanted * kVector, "parts of lights");
      continue;
    }
    trace(batch, each);
    write_states(batch, each);
    for (std::size_t k = 0; k < batch.all().point; ++k) {
      points_ += batch.answers[k].sees != kAskHost;
      found_ += batch.answers[k].sees >= kSeesPart;
    }
    return count;
  }
}

}  // namespace steradian::vulkan
