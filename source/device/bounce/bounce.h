// The bounce on a device: first hits of the shadow map's rays, the lobes of virtual lights, then culling, lighting, filter and resolve
// (shaders/bounce/). The host evaluates the surfaces at the hits, and computes the ranges and sets of virtual lights.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "device/shadow/scene_rays.h"
#include "device/vulkan/buffer.h"
#include "device/vulkan/compute_program.h"
#include "render/bounce/passes.h"
#include "render/direct/ltc_tables.h"

namespace steradian::vulkan {

class Bounce final : public indirect::Passes {
 public:
  // Buffers and pipelines serve any number of frames. The device must outlive this object. Throws Error if the device lacks something.
  explicit Bounce(const Device& device);

  // Sets the rays that make the shadow map. Null: the host's rays, as before the first call.
  void find_first_hits_by(std::shared_ptr<const SceneRays> rays);
  DeviceFirstHits* first_hits() override { return first_hits_.get(); }
  indirect::LobeArrays lobes(const indirect::ShadowMap& map) override;
  indirect::VectorArray radiance(const indirect::PictureSurfaces& surfaces, const std::vector<indirect::LightSet>& sets,
                                 const indirect::Layout& layout, const indirect::BounceSettings& settings) override;
  std::vector<PassTime> take_times() override;

 private:
  enum Plane : std::size_t {
    kPositions,
    kNormals,
    kViews,
    kF0s,
    kAlbedos,
    kDiffuseLight,
    kGlossyLight,
    kDiffuseRows,
    kGlossyRows,
    kPlanes
  };
  enum Kernel : std::size_t { kBoxes, kCull, kLight, kFilter, kResolve };

  Buffer& fitting(KeptBuffer& buffer, std::size_t bytes, const std::string& what) const;
  void upload(const indirect::PictureSurfaces& surfaces);
  void upload_lights(const std::vector<indirect::LightSet>& sets, const indirect::BounceSettings& settings, std::size_t first,
                     std::size_t count);
  // Dispatches of the light pass, with a pipeline for each kind of tiles.
  std::vector<ComputeProgram::Dispatch> light_tiles(const indirect::PictureSurfaces& surfaces, const indirect::Layout& layout,
                                                    const indirect::BounceSettings& settings);
  void run(const std::vector<ComputeProgram::Dispatch>& dispatches, const std::vector<const char*>& names);

  const Device& device_;
  const LtcPackTables tables_;
  std::unique_ptr<DeviceFirstHits> first_hits_;
  ComputeProgram lobe_program_, program_;
  KeptBuffer texels_, texel_lobes_, table_;
  std::vector<KeptBuffer> planes_;  // by Plane
  KeptBuffer lights_, masks_, boxes_, parameters_;
  std::vector<std::uint32_t> values_;  // values of the parameters
  std::map<std::string, double> times_;
};

}  // namespace steradian::vulkan
