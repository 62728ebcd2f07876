#include "gl_lists.h"

#include <bit>
#include <span>

#include "plane/frame/events/event_walk.h"
#include "plane/frame/frame.h"
#include "device/plane/listed_disks.h"
#include "device/plane/pair_words.h"
#include "device/plane/recorded_tiles.h"

namespace steradian::plane {
namespace {

#include "shaders/plane/plane_layout.glsl"

constexpr std::size_t kHeader = kJob, kRecord = 2 + kPixels / 32;

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }

struct Listed {
  const RecordedTiles* of;
  const RecordedTile* tile;
  std::span<const ListedDisks::Entry> disks;
  std::size_t record = 0;
};

void put_tile(std::vector<std::uint32_t>& to, const RecordedTile& tile) {
  to.push_back(static_cast<std::uint32_t>(tile.x));
  to.push_back(static_cast<std::uint32_t>(tile.y));
  for (std::size_t word = 0; word < kPixels / 32; ++word) {
    std::uint32_t filled = 0;
    for (std::size_t bit = 0; bit < 32; ++bit) filled |= std::uint32_t{tile.filled[32 * word + bit]} << bit;
    to.push_back(filled);
  }
}

class Filling {
 public:
  Filling(GlLists& to, std::size_t room) : to_(to), room_(room) {}

  void operator()(const FrameScene& frame, const PlaneFrameOptions& options, const PixelGrid& grid, Picture& picture,
                  PlaneFrameStats& counts) {
    const std::size_t pairs = put_pairs(frame);
    disks_.choose(frame, grid, pairs, room_);
    to_.mask_words = disks_.mask_words();
    to_.disks = disks_.count();
    squares_.resize(squares_of(grid));
    for (RecordedTiles& square : squares_) square.clear(pairs, disks_.is_listed());
    const ListsOfSquare lists_of = [&](std::size_t square) -> TileLists& { return squares_[square]; };
    list_tiles(frame, options, grid, lists_of, picture, counts);
    TileSet for_cpu(grid);
    const bool any_for_cpu = gather(for_cpu);
    write(frame, grid);
    if (any_for_cpu) render_tiles(frame, options, grid, picture, counts, &for_cpu);
  }

 private:
  std::size_t put_pairs(const FrameScene& frame) {
    const std::size_t count = 4 * frame.vertices.size() > room_ ? 0 : std::min(frame.pairs.size(), room_ / kPair);
    to_.pairs.resize(count * kPair);
    for (std::size_t i = 0; i < count; ++i) put_pair(to_.pairs.data() + i * kPair, frame.pairs[i]);
    to_.vertices.clear();
    for (std::size_t i = 0; count > 0 && i < frame.vertices.size(); ++i) put_vertex(to_.vertices, frame.vertices[i]);
    return count;
  }

  // The tiles that shaders light; the others are marked.
  bool gather(TileSet& for_cpu) {
    bool any = false;
    std::size_t words = kHeader + disks_.records().size() + kJob;
    to_.all_on_device = true;
    for (const RecordedTiles& square : squares_)
      for (const RecordedTile& tile : square.tiles()) {
        if (tile.filled.all()) continue;
        const auto of_disks = disks_.of_tile(tile.x / kTileSide, tile.y / kTileSide);
        if (tile.words == 0 && of_disks.empty() && !tile.for_cpu) continue;
        to_.all_on_device = to_.all_on_device && tile.words == 0 && !tile.for_cpu;
        const std::size_t more = kRecord + (tile.jobs + 1) * kJob + tile.words + of_disks.size() * kListedLight;
        if (tile.for_cpu || words + more > room_) {
          for_cpu.mark(tile.x, tile.y, kTileSide);
          any = true;
          continue;
        }
        words += more;
        tiles_.push_back({&square, &tile, of_disks});
      }
    return any;
  }

  void write(const FrameScene& frame, const PixelGrid& grid) {
    std::vector<std::uint32_t>& lists = to_.lists;
    lists.assign({bits(static_cast<float>(grid.step.x)), bits(static_cast<float>(grid.step.y)), bits(slack_of(frame)), kHeader});
    lists.resize(kHeader);
    lists.insert(lists.end(), disks_.records().begin(), disks_.records().end());
    for (Listed& l : tiles_) {
      l.record = lists.size();
      put_tile(lists, *l.tile);
    }
    lists.resize((lists.size() + kJob - 1) / kJob * kJob);
    std::size_t jobs = 0;
    for (const Listed& l : tiles_) jobs += l.tile->jobs + (l.disks.empty() ? 0 : 1);
    job_ = lists.size();
    lists.resize(job_ + jobs * kJob);
    begin(0);
    for (const Listed& l : tiles_) {
      if (l.disks.empty()) continue;
      put_job(0, l, l.disks.size());
      for (const ListedDisks::Entry& entry : l.disks) {
        lists.push_back(static_cast<std::uint32_t>(kHeader + entry.disk * kDisk));
        lists.push_back(entry.mask);
      }
    }
    for (const LightGroup group : {LightGroup::disks, LightGroup::cuts, LightGroup::arcs}) {
      const std::size_t kind = 1 + static_cast<std::size_t>(group);
      begin(kind);
      for (const Listed& l : tiles_)
        for (std::size_t k = 0; k < l.tile->jobs; ++k) {
          const RecordedJob& job = l.of->jobs(*l.tile)[k];
          if (job.group != group) continue;
          put_job(kind, l, job.lights);
          const std::uint32_t* words = l.of->words(group) + job.first;
          lists.insert(lists.end(), words, words + job.words);
        }
    }
  }

  void begin(std::size_t kind) { to_.jobs[kind] = {job_ / kJob, 0}; }

  // Writes a job's head. The caller appends the job's list next.
  void put_job(std::size_t kind, const Listed& l, std::size_t lights) {
    std::uint32_t* job = to_.lists.data() + job_;
    job[0] = static_cast<std::uint32_t>(l.record);
    job[1] = static_cast<std::uint32_t>(to_.lists.size());
    job[2] = static_cast<std::uint32_t>(lights);
    std::vector<float> center;
    put_vertex(center, l.tile->center);
    for (std::size_t i = 0; i < 4; ++i) job[3 + i] = bits(center[i]);
    job_ += kJob;
    ++to_.jobs[kind].count;
  }

  GlLists& to_;
  std::size_t room_, job_ = 0;
  ListedDisks disks_;
  std::vector<RecordedTiles> squares_;
  std::vector<Listed> tiles_;
};

}  // namespace

void make_gl_lists(GlLists& to, const PlaneWorld& world, const PlaneFrameOptions& options, std::size_t room) {
  to = {};
  Filling filling(to, room);
  render_plane_with(std::ref(filling), to.base, world, options, nullptr);
}

}  // namespace steradian::plane
