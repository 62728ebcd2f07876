#include "device/bounce/bounce.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <utility>

#include "core/budget.h"
#include "device/vulkan/shaders.h"
#include "render/bounce/lighting.h"
#include "render/bounce/receivers/filter.h"
#include "steradian/error.h"
#include "steradian/kernels.h"

namespace steradian::vulkan {
namespace {

#include "shaders/bounce/bounce_layout.glsl"

using indirect::DiffuseLight;
using indirect::GgxLight;
using indirect::GlossyLight;
using indirect::Layout;
using indirect::LightSet;
using indirect::LobeArrays;
using indirect::PictureSurfaces;
using indirect::QuadLight;
using indirect::ShadowMap;
using indirect::VectorArray;
using Clock = std::chrono::steady_clock;

static_assert(static_cast<std::size_t>(kReceiversOfTile) == indirect::kTileReceivers && kTileSide == indirect::kTile &&
              kBlockSide == indirect::kBlock && kTaps == 2 * indirect::kFilterReach + 1);

constexpr std::size_t kBuffers = 14;
constexpr std::size_t kVector = 4 * sizeof(float);
constexpr std::uint32_t kGroupSize = 64, kGroupsAcross = 32768;
constexpr std::size_t kLightsOfWord = 32;
// Limit of a round: a software device ends a thread's loops after 65,535 turns in all, and other devices watch for long work.
constexpr std::size_t kMostWords = 512;

double ms_since(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }

ComputeProgram::Dispatch threads(std::size_t pipeline, std::size_t count, std::uint32_t push) {
  const auto groups = static_cast<std::uint32_t>((count + kGroupSize - 1) / kGroupSize);
  return {pipeline, std::min(groups, kGroupsAcross), (groups + kGroupsAcross - 1) / kGroupsAcross, push};
}

// Writes vectors of four, one after another.
class FourWriter {
 public:
  explicit FourWriter(float* to) : to_(to) {}
  void put(Vec3f v, float w) {
    for (float x : {v.x, v.y, v.z, w}) *to_++ = x;
  }

 private:
  float* to_;
};

// The order is that of shaders/bounce/bounce_layout.glsl.
void put_diffuse(const LightSet& set, std::size_t i, FourWriter to) {
  const DiffuseLight& light = set.diffuse[i];
  const QuadLight& quad = set.diffuse_quads[i];
  to.put(light.position, light.reach);
  to.put(light.normal, light.xi);
  to.put(light.bright, light.soft);
  to.put(quad.edge_x, quad.inverse_area);
  to.put(quad.edge_y, quad.size2);
  to.put({set.eggs.range[i], set.eggs.offset[i], 0}, 0);
}

void put_glossy(const LightSet& set, std::size_t i, IndirectMode mode, FourWriter to) {
  const GlossyLight& light = set.glossy[i];
  const QuadLight& quad = set.glossy_quads[i];
  const indirect::SpheroidArrays& s = set.spheroids;
  if (mode == IndirectMode::ggx) {
    const GgxLight& ggx = set.ggx[i];
    to.put(ggx.position, ggx.reach);
    to.put(ggx.frame_x, ggx.xi);
    to.put(ggx.frame_y, ggx.soft);
    to.put(ggx.normal, ggx.alpha);
    to.put(light.normal, ggx.view_x);
    to.put(ggx.bright, ggx.view_z);
    to.put(ggx.grazing, s.offset[i]);
  } else {
    to.put(light.position, light.reach);
    to.put(light.row_x, light.xi);
    to.put(light.row_y, light.soft);
    to.put(light.row_z, light.by_pair);
    to.put(light.normal, quad.inverse_area);
    to.put(light.bright, quad.size2);
    to.put(light.grazing, s.offset[i]);
  }
  to.put(light.incoming, 0);
  to.put(quad.edge_x, 0);
  to.put(quad.edge_y, 0);
  to.put(s.x[i], s.g.x[i]);
  to.put(s.y[i], s.g.y[i]);
  to.put(s.z[i], s.g.z[i]);
}

std::size_t words_of(std::size_t lights) { return (lights + kLightsOfWord - 1) / kLightsOfWord; }

}  // namespace

Bounce::Bounce(const Device& device)
    : device_((check_device(device.info(), kBuffers, "the bounce"), device)),
      tables_(ltc_pack_tables(Method::ltc_compact)),
      lobe_program_(device, {shader("bounce_lobes.comp")}, 3),
      program_(device,
               {shader("bounce_boxes.comp"), shader("bounce_cull.comp"), shader("bounce_light.comp"), shader("bounce_filter.comp"),
                shader("bounce_resolve.comp")},
               kBuffers),
      texels_(device),
      texel_lobes_(device, BufferUse::host_reads),
      table_(device),
      lights_(device),
      masks_(device),
      boxes_(device),
      parameters_(device) {
  for (std::size_t p = 0; p < kPlanes; ++p)
    planes_.emplace_back(device, p == kDiffuseRows ? BufferUse::host_reads : BufferUse::host_writes);
  std::vector<float> nodes = tables_.matrix.nodes;
  nodes.insert(nodes.end(), tables_.magnitude.nodes.begin(), tables_.magnitude.nodes.end());
  table_.hold(nodes);
}

void Bounce::find_first_hits_by(std::shared_ptr<const SceneRays> rays) {
  if (rays == nullptr) {
    first_hits_.reset();
  } else if (first_hits_ == nullptr || first_hits_->scene() != rays.get()) {
    first_hits_ = std::make_unique<DeviceFirstHits>(std::move(rays));
  }
}

Buffer& Bounce::fitting(KeptBuffer& buffer, std::size_t bytes, const std::string& what) const {
  return buffer.fit_with_room(bytes, what, "render a smaller picture with fewer --vpls, or use --backend cpu");
}

void Bounce::run(const std::vector<ComputeProgram::Dispatch>& dispatches, const std::vector<const char*>& names) {
  std::vector<const Buffer*> buffers;
  for (const KeptBuffer& plane : planes_) buffers.push_back(&plane.get());
  for (const KeptBuffer* other : {&lights_, &masks_, &boxes_, &table_, &parameters_}) buffers.push_back(&other->get());
  const std::vector<double> ms = program_.run(buffers, dispatches);
  for (std::size_t i = 0; i < ms.size(); ++i) times_[std::string("device: ") + names[i]] += ms[i];
}

LobeArrays Bounce::lobes(const ShadowMap& map) {
  const std::size_t count = map.alpha.size();
  LobeArrays result(count);
  if (count == 0) return result;
  auto* texels = static_cast<float*>(fitting(texels_, count * kTexel * kVector, "the shadow map").mapped());
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    FourWriter to(texels + i * kTexel * 4);
    to.put(map.normal[i], map.alpha[i]);
    to.put(map.incoming[i], 0);
  });
  fitting(texel_lobes_, count * kLobe * kVector, "virtual lights");
  const std::size_t pipeline = lobe_program_.pipeline(0, {tables_.matrix.size, tables_.magnitude.size});
  const auto ms = lobe_program_.run({&texels_.get(), &texel_lobes_.get(), &table_.get()},
                                    {threads(pipeline, count, static_cast<std::uint32_t>(count))});
  if (!ms.empty()) times_["device: virtual lights"] += ms.front();
  const auto* from = static_cast<const float*>(texel_lobes_.get().mapped());
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    const float* l = from + i * kLobe * 4;
    result.x.put(i, {l[0], l[1], l[2]});
    result.y.put(i, {l[4], l[5], l[6]});
    result.z.put(i, {l[8], l[9], l[10]});
    result.scale[i] = l[3];
    result.n_a[i] = l[7];
    result.f_a[i] = l[11];
    result.stretch[i] = l[12];
  });
  return result;
}

void Bounce::upload(const PictureSurfaces& s) {
  const auto width = static_cast<std::size_t>(s.raster.width), height = static_cast<std::size_t>(s.raster.height);
  float* to[kPlanes];
  const std::size_t bytes = width * height * kVector;
  for (std::size_t p = 0; p < kPlanes; ++p) to[p] = static_cast<float*>(fitting(planes_[p], bytes, "a picture's surfaces").mapped());
  tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t from = s.raster.at(static_cast<int>(x), static_cast<int>(y)), at = 4 * (y * width + x);
      const Vec3f f90 = s.f90[from];
      FourWriter(to[kPositions] + at).put(s.position[from], s.alpha[from]);
      FourWriter(to[kNormals] + at).put(s.normal[from], f90.x);
      FourWriter(to[kViews] + at).put(s.view[from], f90.y);
      FourWriter(to[kF0s] + at).put(s.f0[from], f90.z);
      FourWriter(to[kAlbedos] + at).put(s.albedo[from], 0);
    }
  });
}

// Uploads the lights of every set that `count` words from `first` on represent. Their places go into the parameters.
void Bounce::upload_lights(const std::vector<LightSet>& sets, const indirect::BounceSettings& settings, std::size_t first,
                           std::size_t count) {
  const std::size_t begin = first * kLightsOfWord, most = count * kLightsOfWord;
  const auto part = [&](std::size_t size) { return size > begin ? std::min(size - begin, most) : 0; };
  std::size_t vectors = 0;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const std::size_t diffuse = part(sets[s].diffuse.size()), glossy = part(sets[s].glossy.size());
    std::uint32_t* of = &values_[kSets + s * kSet];
    of[0] = static_cast<std::uint32_t>(vectors);
    of[1] = static_cast<std::uint32_t>(diffuse);
    vectors += diffuse * kDiffuse;
    of[2] = static_cast<std::uint32_t>(vectors);
    of[3] = static_cast<std::uint32_t>(glossy);
    vectors += glossy * kGlossy;
  }
  auto* to = static_cast<float*>(fitting(lights_, std::max<std::size_t>(vectors, 1) * kVector, "a round of virtual lights").mapped());
  tbb::parallel_for(std::size_t{0}, sets.size(), [&](std::size_t s) {
    const std::uint32_t* of = &values_[kSets + s * kSet];
    for (std::size_t i = 0; i < of[1]; ++i) put_diffuse(sets[s], begin + i, FourWriter(to + 4 * (of[0] + i * kDiffuse)));
    for (std::size_t i = 0; i < of[3]; ++i) put_glossy(sets[s], begin + i, settings.mode, FourWriter(to + 4 * (of[2] + i * kGlossy)));
  });
}

std::vector<ComputeProgram::Dispatch> Bounce::light_tiles(const PictureSurfaces& s, const Layout& layout,
                                                          const indirect::BounceSettings& settings) {
  enum Kind : std::uint8_t { kEmpty, kDull, kShiny, kSharp };
  const float sharp_alpha = Kernels<float>().indirect_sharp().v;
  const auto tiles = static_cast<std::size_t>(layout.tiles());
  std::vector<std::uint8_t> kinds(static_cast<std::size_t>(layout.sets()) * tiles, kEmpty);
  // One thread handles a row of tiles of all sets.
  const int side = layout.stride * indirect::kTile;
  tbb::parallel_for(0, layout.tiles_y, [&](int row) {
    for (int y = row * side; y < std::min((row + 1) * side, layout.height); ++y)
      for (int x = 0; x < layout.width; ++x) {
        const std::size_t i = s.raster.at(x, y);
        if (!(dot(s.normal[i], s.normal[i]) > 0)) continue;
        const bool shiny = indirect::largest(s.f0[i]) + indirect::largest(s.f90[i]) > 0;
        const bool sharp = shiny && settings.quads && settings.mode == IndirectMode::ltc && s.alpha[i] < sharp_alpha;
        const std::uint8_t kind = sharp ? kSharp : shiny ? kShiny : kDull;
        const auto set = static_cast<std::size_t>(y % layout.stride * layout.stride + x % layout.stride);
        std::uint8_t& of = kinds[set * tiles + static_cast<std::size_t>(row * layout.tiles_x + x / side)];
        of = std::max(of, kind);
      }
  });
  values_[kTilesAt] = static_cast<std::uint32_t>(values_.size());
  constexpr std::size_t kMostOfDispatch = 65535;  // guaranteed by Vulkan
  std::vector<ComputeProgram::Dispatch> dispatches;
  std::size_t listed = 0;
  for (const Kind kind : {kDull, kShiny, kSharp}) {
    const std::size_t pipeline =
        program_.pipeline(kLight, {tables_.matrix.size, tables_.magnitude.size, settings.mode == IndirectMode::ggx ? 1 : 0,
                                   kind >= kShiny ? 1 : 0, kind == kSharp ? 1 : 0});
    const std::size_t begin = listed;
    for (std::size_t tile = 0; tile < kinds.size(); ++tile)
      if (kinds[tile] == kind) values_.push_back(static_cast<std::uint32_t>(tile)), ++listed;
    for (std::size_t first = begin; first < listed; first += kMostOfDispatch)
      dispatches.push_back({pipeline, indirect::kTileReceivers / kGroupSize,
                            static_cast<std::uint32_t>(std::min(listed - first, kMostOfDispatch)), static_cast<std::uint32_t>(first)});
  }
  return dispatches;
}

VectorArray Bounce::radiance(const PictureSurfaces& surfaces, const std::vector<LightSet>& sets, const Layout& layout,
                             const indirect::BounceSettings& settings) {
  auto start = Clock::now();
  upload(surfaces);
  const auto pixels = static_cast<std::size_t>(layout.width) * static_cast<std::size_t>(layout.height);
  const std::size_t tiles = static_cast<std::size_t>(layout.sets()) * static_cast<std::size_t>(layout.tiles());
  const std::size_t blocks = tiles * indirect::kBlocks;
  fitting(boxes_, (blocks + tiles) * kBox * kVector, "a picture's bounds");

  std::size_t words = 1;
  for (const LightSet& set : sets) words = std::max({words, words_of(set.diffuse.size()), words_of(set.glossy.size())});
  // A round has as many words as the masks and lights have capacity for.
  const std::size_t room = device_.info().storage_buffer, mask_bytes = blocks * 2 * sizeof(std::uint32_t);
  const std::size_t light_bytes = sets.size() * kLightsOfWord * (kDiffuse + kGlossy) * kVector;
  const std::size_t of_round = std::max<std::size_t>(std::min({words, kMostWords, room / mask_bytes, room / light_bytes}), 1);
  fitting(masks_, of_round * mask_bytes, "a round of culling");

  values_.assign(kSets + sets.size() * kSet + 3 * kTaps, 0);
  values_[kWidth] = static_cast<std::uint32_t>(layout.width);
  values_[kHeight] = static_cast<std::uint32_t>(layout.height);
  values_[kStride] = static_cast<std::uint32_t>(layout.stride);
  values_[kTilesX] = static_cast<std::uint32_t>(layout.tiles_x);
  values_[kTilesY] = static_cast<std::uint32_t>(layout.tiles_y);
  const indirect::FilterWeights weights = indirect::filter_weights(layout.stride);
  std::uint32_t* taps = &values_[kSets + sets.size() * kSet];
  for (const auto* kind : {&weights.diffuse, &weights.glossy, &weights.sharp})
    for (float weight : *kind) *taps++ = bits(weight);
  // The diffuse taps are the widest.
  int low = -indirect::kFilterReach, high = indirect::kFilterReach;
  while (weights.diffuse[low + indirect::kFilterReach] == 0) ++low;
  while (weights.diffuse[high + indirect::kFilterReach] == 0) --high;
  values_[kReachLow] = static_cast<std::uint32_t>(-low);
  values_[kReachHigh] = static_cast<std::uint32_t>(high);
  const std::vector<ComputeProgram::Dispatch> lighting = light_tiles(surfaces, layout, settings);
  times_["upload"] += ms_since(start);
  for (std::size_t first = 0; first < words; first += of_round) {
    start = Clock::now();
    const std::size_t count = std::min(of_round, words - first);
    values_[kMaskWords] = static_cast<std::uint32_t>(count);
    values_[kAdds] = first > 0 ? 1 : 0;
    upload_lights(sets, settings, first, count);
    fitting(parameters_, values_.size() * sizeof(std::uint32_t), "parameters")
        .write(values_.data(), values_.size() * sizeof(std::uint32_t));
    times_["upload"] += ms_since(start);
    std::vector<ComputeProgram::Dispatch> dispatches;
    std::vector<const char*> names;
    const auto add = [&](const ComputeProgram::Dispatch& dispatch, const char* name) {
      dispatches.push_back(dispatch);
      names.push_back(name);
    };
    if (first == 0) {
      add(threads(program_.pipeline(kBoxes), blocks, 0), "cull");
      add(threads(program_.pipeline(kBoxes), tiles, 1), "cull");
    }
    add(threads(program_.pipeline(kCull), tiles * count, 0), "cull");
    for (const ComputeProgram::Dispatch& dispatch : lighting) add(dispatch, "light");
    if (first + of_round >= words) {
      if (settings.filter) {
        add(threads(program_.pipeline(kFilter), pixels, 0), "filter");
        add(threads(program_.pipeline(kFilter), pixels, 1), "filter");
      }
      add(threads(program_.pipeline(kResolve, {tables_.matrix.size, tables_.magnitude.size}), pixels, 0), "resolve");
    }
    run(dispatches, names);
  }

  start = Clock::now();
  VectorArray result(surfaces.raster.size());
  const auto* from = static_cast<const float*>(planes_[kDiffuseRows].get().mapped());
  tbb::parallel_for(0, layout.height, [&](int y) {
    for (int x = 0; x < layout.width; ++x) {
      const float* r = from + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(layout.width) + static_cast<std::size_t>(x));
      result.put(surfaces.raster.at(x, y), {r[0], r[1], r[2]});
    }
  });
  times_["download"] += ms_since(start);
  return result;
}

std::vector<PassTime> Bounce::take_times() {
  std::vector<PassTime> result;
  if (first_hits_ != nullptr)
    if (const double ms = first_hits_->take_time(); ms > 0) result.push_back({"device: shadow map", ms});
  for (const char* name :
       {"upload", "device: virtual lights", "device: cull", "device: light", "device: filter", "device: resolve", "download"})
    if (const auto found = times_.find(name); found != times_.end()) result.push_back({name, found->second});
  times_.clear();
  return result;
}

}  // namespace steradian::vulkan
