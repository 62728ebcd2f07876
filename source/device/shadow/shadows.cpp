#include "device/shadow/shadows.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "device/shadow/edge_buffers.h"
#include "device/vulkan/shaders.h"

namespace steradian::vulkan {
namespace {

#include "shaders/shadow/shadow_layout.glsl"

constexpr std::size_t kVector = 4 * sizeof(std::uint32_t);
// Limits of one search: work groups in a row, lights and groups whose values fill half of a buffer.
constexpr std::size_t kMostGroups = 65535, kMostLights = 16384, kMostValues = kGuaranteedBuffer / 2 / sizeof(std::uint32_t);
constexpr std::size_t kVectorsOfPart = 32;                                        // initial number for each point
constexpr std::size_t kEdgesOfGroup = 512, kEdgesAtFirst = std::size_t{1} << 20;  // the same of the edges of groups
// Capacities of a subgroup for one point: segments, and as many pieces of them. The smaller ones let more subgroups run at a time
// (docs/theory/device.md). In the first ones a subgroup serves several points. Bytes in shared memory, of a segment with its piece and
// crossing, of a lane, and of all else: shaders/shadow/shadow_segments.glsl, shadow_order.glsl and shadow_count.glsl.
constexpr std::array<std::size_t, kShadowSpaces> kSegments = {16, 48, 96, 192, 608};
constexpr std::size_t kLeastSegments = 256, kSegmentBytes = 50, kLaneBytes = 20, kOtherBytes = 128;
static_assert(static_cast<std::size_t>(kMostListed) < kSegments[kFewSpaces - 1] && kMostListed == 4 * kListVectors);

// Layout of Answers in shaders/shadow/shadow_parts.comp.
struct AnswersHead {
  std::uint32_t parts_used, parts_room, left, found;
  std::uint32_t lists, seen_at_once, edges_used, edges_room;
  std::uint32_t points_of[kShadowSpaces], looks, nodes_met, leaves_met, work[kShadowSpaces][kWork];
  struct Space {
    std::uint32_t groups_x, groups_y, one, first_name;
  } spaces[kShadowSpaces];
};
struct ShadowAnswer {
  Vec3f origin;
  std::uint32_t state;
  Vec3f way;
  std::uint32_t sees;
};
static_assert(sizeof(AnswersHead) == kAnswersHead * kVector && sizeof(ShadowAnswer) == kShadowAnswer * kVector);

constexpr std::size_t kThreads = 64;  // work group size of shaders/shadow/shadow_rays.comp

// Lanes of a subgroup that serve a point of a space.
int lanes_of(const DeviceInfo& device, std::size_t space) {
  constexpr std::uint32_t kTogether[] = {8, 4}, kLeastLanes = 4;
  const std::uint32_t lanes = space < kFewSpaces ? std::max(device.subgroup / kTogether[space], kLeastLanes) : device.subgroup;
  return static_cast<int>(std::min(device.subgroup, lanes));
}

// Segments for which a device has shared memory.
std::size_t most_segments(const DeviceInfo& device) {
  const std::size_t others = kLaneBytes * device.subgroup + kOtherBytes;
  return device.shared_memory > others ? (device.shared_memory - others) / kSegmentBytes : 0;
}

std::uint32_t number(std::size_t n) { return static_cast<std::uint32_t>(n); }

// Vectors that the names of all points take, and bytes of everything for the points.
std::size_t names_of(std::size_t points) { return (points + 3) / 4; }
std::size_t bytes_of_answers(std::size_t points) {
  return sizeof(AnswersHead) + (points * (kShadowAnswer + kListVectors) + kSegments.size() * names_of(points)) * kVector;
}

ShadowAnswer* answers_in(const Buffer& buffer) {
  return reinterpret_cast<ShadowAnswer*>(static_cast<char*>(buffer.mapped()) + sizeof(AnswersHead));
}

}  // namespace

DeviceShadows::DeviceShadows(Kept& kept, const SceneRays& rays, std::shared_ptr<const ShadowEdges> edges)
    : kept_(kept), rays_(rays), pairs_(1 + kSegments.size()), work_(kSegments.size(), std::vector<std::uint64_t>(kWork)) {
  if (kept.edges == edges) return;
  const auto vectors = mesh_vectors(edges->mesh);
  kept.mesh.fit_with_room(vectors.size() * kVector, "edges of the scene").write(vectors.data(), vectors.size() * kVector);
  kept.edges = std::move(edges);
}

DeviceShadows::Kept::Kept(const Device& d)
    : device(d),
      program(d, {shader("shadow_gather.comp"), shader("shadow_edges.comp"), shader("shadow_parts.comp"), shader("shadow_rays.comp")}, 9),
      groups(d),
      answers(d, BufferUse::host_reads),
      parts(d),
      states(d),
      mesh(d),
      frames(d),
      gathered(d, BufferUse::host_reads) {}

bool DeviceShadows::has(const DeviceInfo& device) {
  return device.adds && device.int64 && device.subgroup > 1 && device.subgroup <= kSegments[kFewSpaces] &&
         most_segments(device) >= kLeastSegments;
}

bool DeviceShadows::fits(const DeviceInfo& device, const ShadowEdges& edges, const std::vector<PackLight>& lights) {
  const auto areas = std::count_if(lights.begin(), lights.end(), [](const PackLight& light) { return light.is_area(); });
  const std::size_t frames = 2 * static_cast<std::size_t>(areas);  // a light may have two sides
  const shadow::EdgeMesh& mesh = edges.mesh;
  const std::size_t of_mesh = vectors_of_frame(mesh) + 2 * mesh.edges.size() + mesh.edge_triangles.size();
  return std::max(of_mesh, frames * vectors_of_frame(mesh)) * kVector <= device.storage_buffer;
}

// Writes the vertices and planes for lights that no earlier search has asked for. Point lights need none, but the buffer is there.
void DeviceShadows::upload_frames() {
  std::vector<const TileShadows::Search*> added;
  const std::size_t before = frames_.size();
  for (const TileShadows& tile : tiles_)
    for (const TileShadows::Search& group : tile.groups)
      if (frames_.emplace(group.key, frames_.size()).second) added.push_back(&group);
  if (added.empty() && before > 0) return;
  const shadow::EdgeMesh& mesh = kept_.edges->mesh;
  const std::size_t vectors = vectors_of_frame(mesh), all = std::max<std::size_t>(frames_.size() * vectors, 1);
  const void* last = before > 0 ? kept_.frames.get().mapped() : nullptr;
  Buffer& buffer = kept_.frames.fit_with_room(all * kVector, "edges of the scene before lights");
  if (last != nullptr && buffer.mapped() != last) {  // growing has discarded the frames before
    frames_.clear();
    return upload_frames();
  }
  for (std::size_t i = 0; i < added.size(); ++i)
    write_frame(mesh, added[i]->axes, added[i]->origin, static_cast<std::array<float, 4>*>(buffer.mapped()) + (before + i) * vectors);
}

void DeviceShadows::upload_groups() {
  constexpr std::size_t kHeader = static_cast<std::size_t>(kShadowHeader);
  const std::size_t headers = begins_.back().group * kHeader;
  auto* to =
      static_cast<std::uint32_t*>(kept_.groups.fit_with_room((headers + begins_.back().row) * kVector, "the edges before lights").mapped());
  std::size_t row = 0;
  const shadow::EdgeMesh& mesh = kept_.edges->mesh;
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    for (const TileShadows::Search& group : tiles_[i].groups) {
      auto header = group.header;
      header[0] = number(frames_.at(group.key) * vectors_of_frame(mesh));
      header[1] = header[0] + number(mesh.vertices.size());
      for (const std::size_t at : {5, 6}) header[at] += number(headers + begins_[i].row);
      header[9] += number(begins_[i].point);
      std::memcpy(to + 4 * row, header.data(), sizeof header);
      row += kHeader;
    }
    std::memcpy(to + 4 * (headers + begins_[i].row), tiles_[i].values.data(), tiles_[i].values.size() * sizeof(std::uint32_t));
  }
}

// Writes the states that the host knows.
void DeviceShadows::upload_states() {
  auto* to = static_cast<std::uint32_t*>(
      kept_.states.fit_with_room(begins_.back().light * kTilePixels * sizeof(std::uint32_t), "states of lights").mapped());
  for (const TileShadows& tile : tiles_)
    for (const TileShadows::Light& light : tile.by_light) to = std::copy(light.states.begin(), light.states.end(), to);
  const std::size_t vectors = std::max(std::min(begins_.back().point * kVectorsOfPart, kept_.parts.most() / kVector), wanted_);
  kept_.parts.fit_with_room(vectors * kVector, "parts of lights");
}

void DeviceShadows::upload_points() {
  const std::size_t count = begins_.back().point, names = names_of(count), first_list = count * kShadowAnswer,
                    first_name = first_list + count * kListVectors;
  AnswersHead head{};
  head.parts_room = number(parts().bytes() / kVector);
  head.lists = number(first_list);
  const std::size_t heads = static_cast<std::size_t>(kGatheredHead) * begins_.back().group;
  const std::size_t edges = std::max({begins_.back().group * kEdgesOfGroup, kEdgesAtFirst, wanted_edges_});
  Buffer& gathered = kept_.gathered.fit_with_room((heads + edges) * sizeof(std::uint32_t), "edges of groups of pixels");
  head.edges_room = number(gathered.bytes() / sizeof(std::uint32_t) - heads);
  for (std::size_t i = 0; i < kSegments.size(); ++i) head.spaces[i] = {0, 0, 1, number(first_name + i * names)};
  Buffer& buffer = kept_.answers.fit_with_room(bytes_of_answers(count), "points before lights");
  buffer.write(&head, sizeof head);
  ShadowAnswer* answers = answers_in(buffer);
  for (std::size_t i = 0; i < tiles_.size(); ++i)
    for (std::size_t k = 0; k < tiles_[i].points.size(); ++k) {
      const TileShadows::Point& point = tiles_[i].points[k];
      const std::size_t state = (begins_[i].light + point.light) * kTilePixels + point.slot;
      answers[begins_[i].point + k] = {static_cast<Vec3f>(point.at.position), number(state), {}, kAskHost};
    }
}

std::size_t DeviceShadows::upload(std::span<TileShadows> tiles) {
  const auto fits = [&](const Begin& b) {
    return b.group <= kMostGroups && bytes_of_answers(b.point) <= kept_.answers.most() && b.light <= kMostLights &&
           b.row * 4 <= kMostValues;
  };
  begins_.assign(1, {});
  for (const TileShadows& tile : tiles) {
    const Begin& b = begins_.back();
    const Begin next = {b.light + tile.by_light.size(), b.point + tile.points.size(), b.row + tile.values.size() / 4,
                        b.group + tile.groups.size()};
    if (begins_.size() > 1 && (!fits(next) || begins_.size() > most_tiles_)) break;
    begins_.push_back(next);
  }
  tiles_ = tiles.first(begins_.size() - 1);
  upload_frames();
  upload_groups();
  upload_states();
  upload_points();
  return tiles_.size();
}

ComputeProgram& DeviceShadows::record(const Buffer& gates) {
  std::vector<ComputeProgram::Dispatch> dispatches;
  const std::size_t count = begins_.back().point;
  if (count > 0) {
    const DeviceInfo& device = kept_.device.info();
    const int subgroup = static_cast<int>(device.subgroup);
    std::array<int, kSegments.size()> spaces, together;
    for (std::size_t i = 0; i < kSegments.size(); ++i) {
      spaces[i] = static_cast<int>(std::min(most_segments(device), kSegments[i])) / kAtOnce * kAtOnce;
      together[i] = subgroup / lanes_of(device, i);
    }
    dispatches.push_back({.pipeline = kept_.program.pipeline(0), .groups_x = number(begins_.back().group)});
    dispatches.push_back({.pipeline = kept_.program.pipeline(1, {spaces[0], spaces[1], spaces[2], spaces[3], together[0], together[1]}),
                          .groups_x = number(begins_.back().group)});
    for (std::size_t i = 0; i < kSegments.size(); ++i) {
      const int next = i + 1 < kSegments.size() ? together[i + 1] : 1;
      dispatches.push_back(
          {.pipeline = kept_.program.pipeline(2, {spaces[i], lanes_of(device, i), subgroup, i < kFewSpaces, next, device.software}),
           .push = number(i),
           .groups = &kept_.answers.get(),
           .groups_at = kVector * (static_cast<std::size_t>(kAnswersHead - kShadowSpaces) + i)});
    }
    dispatches.push_back({kept_.program.pipeline(3), number((count + kThreads - 1) / kThreads), 1, number(count)});
  }
  kept_.program.record({&kept_.groups.get(), &kept_.parts.get(), &kept_.answers.get(), &rays_.hierarchy(), &kept_.states.get(), &gates,
                        &kept_.mesh.get(), &kept_.frames.get(), &kept_.gathered.get()},
                       dispatches);
  return kept_.program;
}

bool DeviceShadows::finish() {
  const std::vector<double>& times = kept_.program.times();
  for (std::size_t i = 0; i < times.size(); ++i) (i + 1 == times.size() ? rays_time_ : time_) += times[i];
  AnswersHead head;
  std::memcpy(&head, kept_.answers.get().mapped(), sizeof head);
  if (head.edges_used > head.edges_room) {
    wanted_edges_ = head.edges_used;
    return false;
  }
  if (head.parts_used > head.parts_room) {
    const bool too_many = tiles_.size() > 1 && head.parts_used * kVector > kept_.parts.most();
    if (too_many) most_tiles_ = tiles_.size() / 2;
    wanted_ = too_many ? 0 : head.parts_used;
    return false;
  }
  wanted_ = wanted_edges_ = 0;
  most_tiles_ = SIZE_MAX;
  left_ = head.left;
  points_ += begins_.back().point - head.left;
  found_ += head.found;
  looks_ += head.looks;
  gathered_[0] += head.nodes_met;
  gathered_[1] += head.leaves_met;
  pairs_.front() += head.seen_at_once;
  for (std::size_t i = 0; i < kSegments.size(); ++i) {
    pairs_[i + 1] += head.points_of[i];
    for (std::size_t k = 0; k < kWork; ++k) work_[i][k] += std::uint64_t{head.work[i][k]} * (k == 3 ? kPairUnit : 1);
  }
  return true;
}

void DeviceShadows::each_left(std::size_t tile_number, const std::function<void(const PackLight&, const TilePoints&)>& add) const {
  if (left_ == 0) return;
  const TileShadows& tile = tiles_[tile_number];
  const ShadowAnswer* answers = answers_in(kept_.answers.get()) + begins_[tile_number].point;
  TilePoints points;
  points.points.resize(kTilePixels);
  for (std::size_t g = 0; g < tile.groups.size(); ++g) {
    const std::size_t first = tile.groups[g].header[9], end = first + tile.groups[g].points;
    std::vector<std::uint32_t> slots;
    for (std::size_t k = first; k < end; ++k) {
      if (answers[k].sees != kAskHost) continue;
      points.points[tile.points[k].slot] = tile.points[k].at;
      slots.push_back(tile.points[k].slot);
    }
    if (!slots.empty()) {
      points.groups.clusters.push_back({number(points.groups.groups.size())});
      points.groups.groups.push_back(std::move(slots));
    }
    const std::uint32_t light = tile.points[first].light;
    const bool last = g + 1 == tile.groups.size() || tile.points[end].light != light;
    if (!last || points.groups.groups.empty()) continue;
    add(*tile.by_light[light].light, points);
    points.groups = {};
  }
}

}  // namespace steradian::vulkan
