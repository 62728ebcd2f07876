#include "device/vulkan/compute_program.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/fingerprint.h"
#include "device/vulkan/buffer_handles.h"

namespace steradian::vulkan {

struct ComputeProgram::Handles {
  std::uint32_t buffers = 0, texels = 0;
  vk::DescriptorType type(std::uint32_t binding) const {
    return binding < texels ? vk::DescriptorType::eUniformTexelBuffer : vk::DescriptorType::eStorageBuffer;
  }

  std::vector<ShaderCode> shaders;
  Pipelines* pipelines = nullptr;  // the device's
  vk::raii::DescriptorPool pool = nullptr;
  vk::raii::DescriptorSet set = nullptr;
  vk::raii::CommandBuffer commands = nullptr;
  vk::raii::Fence done = nullptr;
  vk::raii::QueryPool queries = nullptr;
  std::size_t query_count = 0;
  std::uint32_t stamps = 0;  // that the commands write
};

namespace {

// The device's pipelines for these shaders, created if it has none yet. type(i): type of binding i.
template <class Type>
Pipelines& pipelines_of(const Device& device, const std::vector<ShaderCode>& shaders, std::uint32_t buffers, std::uint32_t texels,
                        Type type) {
  const Device::Handles& d = device.handles();
  std::vector<Fingerprint> key = {buffers, texels};
  for (const ShaderCode& shader : shaders)
    for (const ShaderModuleCode& module : shader.modules) key.push_back(fingerprint(module.words));
  if (const auto found = d.pipelines.find(key); found != d.pipelines.end()) return found->second;
  Pipelines p;
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  for (std::uint32_t i = 0; i < buffers + texels; ++i) bindings.emplace_back(i, type(i), 1, vk::ShaderStageFlagBits::eCompute);
  p.set_layout = d.device.createDescriptorSetLayout({{}, bindings});
  const vk::PushConstantRange push(vk::ShaderStageFlagBits::eCompute, 0, sizeof(std::uint32_t));
  p.layout = d.device.createPipelineLayout({{}, *p.set_layout, push});
  return d.pipelines.emplace(std::move(key), std::move(p)).first->second;
}

}  // namespace

ComputeProgram::ComputeProgram(const Device& device, const std::vector<ShaderCode>& shaders, std::size_t buffers, std::size_t texels)
    : device_(device), handles_(std::make_unique<Handles>()) {
  checked(device, "make a compute program", [&] {
    Handles& h = *handles_;
    h.buffers = static_cast<std::uint32_t>(buffers);
    h.texels = static_cast<std::uint32_t>(texels);
    h.shaders = shaders;
    h.pipelines = &pipelines_of(device, shaders, h.buffers, h.texels, [&](std::uint32_t i) { return h.type(i); });
  });
}

// Creates what a run needs besides pipelines. Drivers that only compile do not have it.
void ComputeProgram::prepare_to_run() {
  const vk::raii::Device& d = device_.handles().device;
  Handles& h = *handles_;
  if (*h.done) return;
  std::vector<vk::DescriptorPoolSize> sizes = {{vk::DescriptorType::eStorageBuffer, h.buffers}};
  if (h.texels > 0) sizes.emplace_back(vk::DescriptorType::eUniformTexelBuffer, h.texels);
  h.pool = d.createDescriptorPool({vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes});
  h.set = std::move(d.allocateDescriptorSets({*h.pool, *h.pipelines->set_layout}).front());
  h.commands = std::move(d.allocateCommandBuffers({*device_.handles().commands, vk::CommandBufferLevel::ePrimary, 1}).front());
  h.done = d.createFence({});
}

ComputeProgram::~ComputeProgram() { device_.handles().leave(handles_); }

std::size_t ComputeProgram::pipeline(std::size_t shader, const std::vector<std::int32_t>& constants) {
  Pipelines& p = *handles_->pipelines;
  if (const auto found = p.numbers.find({shader, constants}); found != p.numbers.end()) return found->second;
  checked(device_, "make a compute pipeline", [&] {
    std::vector<vk::SpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < constants.size(); ++i) entries.emplace_back(i, i * 4u, sizeof(std::int32_t));
    const vk::SpecializationInfo specialization(static_cast<std::uint32_t>(entries.size()), entries.data(),
                                                constants.size() * sizeof(std::int32_t), constants.data());
    const ShaderCode& code = handles_->shaders.at(shader);
    const auto module = std::find_if(code.modules.begin(), code.modules.end(), [&](const auto& m) { return m.serves(constants); });
    if (module == code.modules.end()) throw Error("Vulkan", "the shader " + code.name + " has no module for these constants");
    const Device::Handles& d = device_.handles();
    const vk::raii::ShaderModule made = module_of(d.device, module->words);
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *made, "main", &specialization);
    const auto start = std::chrono::steady_clock::now();
    p.made.push_back(d.device.createComputePipeline(d.pipeline_cache, {d.pipeline_flags(), stage, *p.layout}));
    p.reports.push_back(d.reports.size());
    report(d, p.made.back(), {{code.name, constants, module->words.size_bytes(), ms_since(start)}});
  });
  return p.numbers.emplace(std::pair(shader, constants), p.made.size() - 1).first->second;
}

void ComputeProgram::record(const std::vector<const Buffer*>& buffers, const std::vector<Dispatch>& dispatches) {
  checked(device_, "record a compute shader", [&] {
    const Device::Handles& d = device_.handles();
    Handles& h = *handles_;
    for (const Dispatch& one : dispatches) {
      PipelineReport& of = d.reports[h.pipelines->reports.at(one.pipeline)];
      ++of.dispatches;
      of.groups += one.groups != nullptr ? 0 : std::uint64_t{one.groups_x} * one.groups_y;
      of.units += one.units;
    }
    if (device_.only_compiles()) return;
    prepare_to_run();
    for (std::uint32_t i = 0; i < buffers.size(); ++i) {
      const Buffer::Handles& buffer = buffers[i]->handles();
      const vk::DescriptorBufferInfo info(*buffer.buffer, 0, VK_WHOLE_SIZE);
      vk::WriteDescriptorSet write(*h.set, i, 0, 1, h.type(i), nullptr, &info, &*buffer.texels);
      d.device.updateDescriptorSets(write, nullptr);
    }
    const bool timed = device_.info().timestamps;
    h.stamps = timed ? static_cast<std::uint32_t>(dispatches.size() + 1) : 0;
    if (h.query_count < h.stamps) {
      h.queries = d.device.createQueryPool({{}, vk::QueryType::eTimestamp, h.stamps});
      h.query_count = h.stamps;
    }

    // Writes of a dispatch become visible to the next one, and to the host. Once llvmpipe has drawn something, it takes a timestamp only
    // at its next flush, which a barrier causes. So a barrier follows every timestamp.
    using Stage = vk::PipelineStageFlagBits;
    using Access = vk::AccessFlagBits;
    const vk::MemoryBarrier written(Access::eShaderWrite,
                                    Access::eShaderRead | Access::eShaderWrite | Access::eIndirectCommandRead | Access::eHostRead);
    const auto wait = [&] {
      h.commands.pipelineBarrier(Stage::eComputeShader, Stage::eComputeShader | Stage::eDrawIndirect | Stage::eHost, {}, written, nullptr,
                                 nullptr);
    };
    h.commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    if (timed) {
      h.commands.resetQueryPool(*h.queries, 0, h.stamps);
      h.commands.writeTimestamp(Stage::eBottomOfPipe, *h.queries, 0);
      wait();
    }
    h.commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *h.pipelines->layout, 0, *h.set, nullptr);
    for (std::uint32_t i = 0; i < dispatches.size(); ++i) {
      const Dispatch& one = dispatches[i];
      h.commands.bindPipeline(vk::PipelineBindPoint::eCompute, *h.pipelines->made.at(one.pipeline));
      h.commands.pushConstants<std::uint32_t>(*h.pipelines->layout, vk::ShaderStageFlagBits::eCompute, 0, one.push);
      if (one.groups != nullptr)
        h.commands.dispatchIndirect(*one.groups->handles().buffer, one.groups_at);
      else
        h.commands.dispatch(one.groups_x, one.groups_y, 1);
      if (timed) h.commands.writeTimestamp(Stage::eBottomOfPipe, *h.queries, i + 1);
      wait();
    }
    h.commands.end();
  });
}

void ComputeProgram::read_times() {
  times_ = handles_->stamps > 0 ? times_between(device_, handles_->queries, handles_->stamps) : std::vector<double>{};
}

void ComputeProgram::run(ComputeProgram* before) {
  if (device_.only_compiles()) return;
  checked(device_, "run a compute shader", [&] {
    std::vector<vk::CommandBuffer> commands;
    if (before != nullptr) commands.push_back(*before->handles_->commands);
    commands.push_back(*handles_->commands);
    submit_and_wait(device_, commands, handles_->done, "a compute shader");
    if (before != nullptr) before->read_times();
    read_times();
  });
}

const std::vector<double>& ComputeProgram::run(const std::vector<const Buffer*>& buffers, const std::vector<Dispatch>& dispatches) {
  record(buffers, dispatches);
  run();
  return times_;
}

}  // namespace steradian::vulkan
