#include "render/vulkan/compute_pipeline.h"

#include <limits>

#include "render/vulkan/buffer_handles.h"

namespace steradian::vulkan {

struct ComputePipeline::Handles {
  vk::raii::DescriptorSetLayout set_layout = nullptr;
  vk::raii::PipelineLayout layout = nullptr;
  vk::raii::Pipeline pipeline = nullptr;
  vk::raii::DescriptorPool pool = nullptr;
  vk::raii::DescriptorSet set = nullptr;
};

ComputePipeline::ComputePipeline(const Device& device, const std::vector<std::uint32_t>& spirv, std::size_t buffers,
                                 const std::vector<std::int32_t>& constants)
    : device_(device), handles_(std::make_unique<Handles>()) {
  checked("make a compute pipeline", [&] {
    const vk::raii::Device& d = device.handles().device;
    Handles& h = *handles_;
    const auto buffer_count = static_cast<std::uint32_t>(buffers);

    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (std::uint32_t i = 0; i < buffer_count; ++i)
      bindings.emplace_back(i, vk::DescriptorType::eStorageBuffer, 1, vk::ShaderStageFlagBits::eCompute);
    h.set_layout = d.createDescriptorSetLayout({{}, bindings});
    h.layout = d.createPipelineLayout({{}, *h.set_layout});

    std::vector<vk::SpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < constants.size(); ++i) entries.emplace_back(i, i * 4u, sizeof(std::int32_t));
    const vk::SpecializationInfo specialization(static_cast<std::uint32_t>(entries.size()), entries.data(),
                                                constants.size() * sizeof(std::int32_t), constants.data());
    const vk::raii::ShaderModule shader = d.createShaderModule({{}, spirv});
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *shader, "main", &specialization);
    h.pipeline = d.createComputePipeline(nullptr, {{}, stage, *h.layout});

    const vk::DescriptorPoolSize size(vk::DescriptorType::eStorageBuffer, buffer_count);
    h.pool = d.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, size});
    h.set = std::move(d.allocateDescriptorSets({*h.pool, *h.set_layout}).front());
  });
}

ComputePipeline::~ComputePipeline() = default;

void ComputePipeline::run(const std::vector<const Buffer*>& buffers, std::uint32_t groups) {
  checked("run a compute shader", [&] {
    const Device::Handles& d = device_.handles();
    Handles& h = *handles_;
    for (std::uint32_t i = 0; i < buffers.size(); ++i) {
      const vk::DescriptorBufferInfo info(*buffers[i]->handles().buffer, 0, VK_WHOLE_SIZE);
      d.device.updateDescriptorSets(vk::WriteDescriptorSet(*h.set, i, 0, vk::DescriptorType::eStorageBuffer, {}, info), nullptr);
    }
    const vk::raii::CommandBuffer commands =
        std::move(d.device.allocateCommandBuffers({*d.commands, vk::CommandBufferLevel::ePrimary, 1}).front());
    commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *h.pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *h.layout, 0, *h.set, nullptr);
    commands.dispatch(groups, 1, 1);
    // What the shader wrote becomes visible to the host.
    const vk::MemoryBarrier written(vk::AccessFlagBits::eShaderWrite, vk::AccessFlagBits::eHostRead);
    commands.pipelineBarrier(vk::PipelineStageFlagBits::eComputeShader, vk::PipelineStageFlagBits::eHost, {}, written, nullptr, nullptr);
    commands.end();

    const vk::raii::Fence done = d.device.createFence({});
    const vk::SubmitInfo submit({}, {}, *commands, {});
    d.queue.submit(submit, *done);
    if (d.device.waitForFences(*done, VK_TRUE, std::numeric_limits<std::uint64_t>::max()) != vk::Result::eSuccess)
      throw Error("Vulkan", "the device did not finish a compute shader");
  });
}

}  // namespace steradian::vulkan
