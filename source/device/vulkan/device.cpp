#include "device/vulkan/device.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <mutex>
#include <optional>
#include <tuple>

#include "core/cache_file.h"
#include "device/vulkan/handles.h"

namespace steradian::vulkan {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL keep_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                            const VkDebugUtilsMessengerCallbackDataEXT* data, void* messages) {
  static_cast<std::vector<std::string>*>(messages)->emplace_back(data->pMessage);
  return VK_FALSE;
}

bool has_validation_layer(const vk::raii::Context& context) {
  for (const auto& layer : context.enumerateInstanceLayerProperties())
    if (std::string(layer.layerName.data()) == kValidationLayer) return true;
  return false;
}

vk::raii::Instance make_instance(const vk::raii::Context& context, const DeviceOptions& options) {
  const vk::ApplicationInfo application("steradian", 0, "steradian", 0, VK_API_VERSION_1_2);
  std::vector<const char*> layers, extensions;
  for (const std::string& name : options.window_extensions) extensions.push_back(name.c_str());
  if (options.validation) {
    if (!has_validation_layer(context))
      throw Error("Vulkan", std::string("the layer ") + kValidationLayer + " is not installed", "install vulkan-validationlayers");
    layers.push_back(kValidationLayer);
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  }
  return vk::raii::Instance(context, vk::InstanceCreateInfo({}, &application, layers, extensions));
}

// A queue family that can also draw, if there is one.
std::optional<std::uint32_t> compute_queue_family(const vk::raii::PhysicalDevice& device) {
  const auto families = device.getQueueFamilyProperties();
  const vk::QueueFlags compute = vk::QueueFlagBits::eCompute, both = compute | vk::QueueFlagBits::eGraphics;
  for (const vk::QueueFlags wanted : {both, compute})
    for (std::uint32_t i = 0; i < families.size(); ++i)
      if ((families[i].queueFlags & wanted) == wanted) return i;
  return {};
}

bool has_extension(const vk::raii::PhysicalDevice& device, const char* name) {
  for (const auto& extension : device.enumerateDeviceExtensionProperties())
    if (std::string(extension.extensionName.data()) == name) return true;
  return false;
}

std::string version_text(std::uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) + "." +
         std::to_string(VK_API_VERSION_PATCH(version));
}

std::size_t own_memory(const vk::raii::PhysicalDevice& device) {
  const auto properties = device.getMemoryProperties();
  std::size_t largest = 0;
  for (std::uint32_t i = 0; i < properties.memoryHeapCount; ++i)
    if (properties.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal)
      largest = std::max(largest, static_cast<std::size_t>(properties.memoryHeaps[i].size));
  return largest;
}

DeviceInfo describe(const vk::raii::PhysicalDevice& device, std::uint32_t queue_family) {
  const auto chain =
      device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties, vk::PhysicalDeviceSubgroupProperties>();
  const auto& properties = chain.get<vk::PhysicalDeviceProperties2>().properties;
  const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
  DeviceInfo info;
  info.name = properties.deviceName.data();
  info.driver = std::string(driver.driverName.data()) + ", " + driver.driverInfo.data();
  info.software = properties.deviceType == vk::PhysicalDeviceType::eCpu;
  info.vulkan = version_text(properties.apiVersion);
  info.memory = own_memory(device);
  info.runs = info.memory > 0;  // Vulkan promises memory. A driver without its hardware, such as RADV's null device, has none
  info.storage_buffer = properties.limits.maxStorageBufferRange;
  info.graphics = static_cast<bool>(device.getQueueFamilyProperties()[queue_family].queueFlags & vk::QueueFlagBits::eGraphics);
  info.picture =
      std::min({properties.limits.maxFramebufferWidth, properties.limits.maxFramebufferHeight, properties.limits.maxViewportDimensions[0],
                properties.limits.maxViewportDimensions[1], properties.limits.maxImageDimension2D});
  info.storage_buffers = properties.limits.maxPerStageDescriptorStorageBuffers;
  info.texel_buffer = properties.limits.maxTexelBufferElements;
  const auto& subgroups = chain.get<vk::PhysicalDeviceSubgroupProperties>();
  info.subgroup = subgroups.subgroupSize;
  info.broadcasts = static_cast<bool>(subgroups.supportedOperations & vk::SubgroupFeatureFlagBits::eBallot) &&
                    static_cast<bool>(subgroups.supportedStages & vk::ShaderStageFlagBits::eCompute);
  info.adds = info.broadcasts && static_cast<bool>(subgroups.supportedOperations & vk::SubgroupFeatureFlagBits::eArithmetic);
  info.int64 = static_cast<bool>(device.getFeatures().shaderInt64);
  info.shared_memory = properties.limits.maxComputeSharedMemorySize;
  info.timestamps = device.getQueueFamilyProperties()[queue_family].timestampValidBits > 0 && properties.limits.timestampPeriod > 0;
  return info;
}

bool is_number(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

struct DeviceCandidate {
  vk::raii::PhysicalDevice device;
  std::uint32_t queue_family;
  DeviceInfo info;
};

std::vector<DeviceCandidate> candidates(const vk::raii::Instance& instance) {
  std::vector<DeviceCandidate> found;
  for (const auto& device : vk::raii::PhysicalDevices(instance)) {
    if (device.getProperties().apiVersion < VK_API_VERSION_1_2) continue;
    if (const auto family = compute_queue_family(device)) found.push_back({device, *family, describe(device, *family)});
  }
  const auto rank = [](const DeviceCandidate& c) { return !c.info.runs ? 2 : c.info.software ? 1 : 0; };
  std::stable_sort(found.begin(), found.end(), [&](const DeviceCandidate& a, const DeviceCandidate& b) { return rank(a) < rank(b); });
  return found;
}

// The device and its driver, for the file of its pipelines.
std::string key_of(const vk::raii::PhysicalDevice& device) {
  const vk::PhysicalDeviceProperties properties = device.getProperties();
  std::string key;
  const auto add = [&](std::uint32_t value, int digits) {
    for (int i = digits - 1; i >= 0; --i) key += "0123456789abcdef"[value >> (4 * i) & 15u];
  };
  add(properties.vendorID, 8);
  add(properties.deviceID, 8);
  for (const std::uint8_t byte : properties.pipelineCacheUUID) add(byte, 2);
  return key;
}

std::mutex shared_mutex;
int shared_users = 0;
std::map<std::tuple<std::string, bool, bool>, std::shared_ptr<const Device>> shared_devices;

}  // namespace

void check_device(const DeviceInfo& device, std::size_t buffers, const std::string& what) {
  const std::string who = "Vulkan device '" + device.name + "'";
  if (device.storage_buffer < kGuaranteedBuffer)
    throw Error(who, "has no storage buffers of 128 MiB", "choose another --device, or --backend cpu");
  if (device.storage_buffers < buffers)
    throw Error(
        who,
        "lets a shader have " + std::to_string(device.storage_buffers) + " storage buffers, " + what + " needs " + std::to_string(buffers),
        "choose another --device, or --backend cpu");
  if (!device.broadcasts) throw Error(who, "has no subgroup ballots in compute shaders", "choose another --device, or --backend cpu");
}

std::vector<DeviceInfo> list_devices() {
  std::vector<DeviceInfo> infos;
  try {
    const vk::raii::Context context;
    for (const DeviceCandidate& c : candidates(make_instance(context, {}))) infos.push_back(c.info);
  } catch (const std::exception&) {
    // No loader or no driver: an expected absence, not an error.
    infos.clear();
  }
  return infos;
}

Device::Device(const DeviceOptions& options) {
  try {
    handles_ = std::make_unique<Handles>();
  } catch (const std::exception& e) {  // vulkan.hpp's own exception if there is no library to load
    throw Error("Vulkan", e.what(), "install libvulkan1 and a driver, such as mesa-vulkan-drivers");
  }
  Handles& h = *handles_;
  checked("Vulkan", "open a device", [&] {
    h.instance = make_instance(h.context, options);
    if (options.validation) {
      using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
      using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
      h.messenger = h.instance.createDebugUtilsMessengerEXT(
          {{}, Severity::eWarning | Severity::eError, Type::eGeneral | Type::eValidation | Type::ePerformance, keep_message, &h.messages});
    }
    std::string seen;
    std::size_t place = 0;
    for (const DeviceCandidate& c : candidates(h.instance)) {
      seen += (seen.empty() ? "" : ", ") + std::to_string(place) + " " + c.info.name;
      const bool is_place = options.name == std::to_string(place++);
      if (!is_place && (is_number(options.name) || c.info.name.find(options.name) == std::string::npos)) continue;
      info_ = c.info;
      only_compiles_ = options.only_compiles;
      if (!info_.runs && !only_compiles_)
        throw Error("Vulkan device '" + info_.name + "'", "runs nothing: its driver compiles for hardware that is not here",
                    "choose another --device, or --backend cpu; `steradian info SCENE --pipelines` reads its compiler's statistics");
      h.physical = c.device;
      h.queue_family = c.queue_family;
      h.timestamp_period = h.physical.getProperties().limits.timestampPeriod;
      const float priority = 1.0f;
      const vk::DeviceQueueCreateInfo queue({}, h.queue_family, 1, &priority);
      vk::PhysicalDeviceFeatures features;
      features.shaderInt64 = info_.int64;
      h.has_statistics = only_compiles_ && has_extension(h.physical, VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
      std::vector<const char*> extensions;
      if (h.has_statistics) extensions.push_back(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
      if (!options.window_extensions.empty()) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
      const vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR statistics(VK_TRUE);
      vk::DeviceCreateInfo device({}, queue, {}, extensions, &features);
      if (h.has_statistics) device.pNext = &statistics;
      h.device = h.physical.createDevice(device);
      h.queue = h.device.getQueue(h.queue_family, 0);
      h.cache_key = key_of(h.physical);
      if (options.window_extensions.empty()) h.cache_file = cache_file("STERADIAN_PIPELINE_CACHE", "pipelines-" + h.cache_key);
      if (!h.cache_file.empty()) h.cached = read_cache_file(h.cache_file, h.cache_key);
      h.pipeline_cache = h.device.createPipelineCache({{}, h.cached.size(), h.cached.data()});
      h.commands = h.device.createCommandPool({vk::CommandPoolCreateFlagBits::eResetCommandBuffer, h.queue_family});
      return;
    }
    if (seen.empty()) throw Error("Vulkan", "no device with Vulkan 1.2", "install a driver, such as mesa-vulkan-drivers");
    throw Error("Vulkan", "no device has the number or the name '" + options.name + "'", "here are: " + seen);
  });
}

Device::~Device() {
  const Handles& h = *handles_;
  if (!h.hangs && !h.cache_file.empty() && *h.pipeline_cache) try {
      const auto bytes = h.pipeline_cache.getData();
      const std::span<const char> now(reinterpret_cast<const char*>(bytes.data()), bytes.size());
      if (!std::ranges::equal(now, h.cached)) write_cache_file(h.cache_file, h.cache_key, now);
    } catch (const std::exception&) {  // the device is lost: its pipelines are made again
    }
  h.leave(handles_);
}

const std::vector<std::string>& Device::validation_messages() const { return handles_->messages; }

const std::vector<PipelineReport>& Device::pipelines() const { return handles_->reports; }

std::size_t Device::allocations() const { return handles_->allocations; }
std::size_t Device::submissions() const { return handles_->submissions; }

std::shared_ptr<const Device> open_device(const DeviceOptions& options) {
  const std::lock_guard lock(shared_mutex);
  if (shared_users == 0) return std::make_shared<const Device>(options);
  std::shared_ptr<const Device>& device = shared_devices[{options.name, options.validation, options.only_compiles}];
  if (device == nullptr) device = std::make_shared<const Device>(options);
  return device;
}

SharedDevices::SharedDevices() {
  const std::lock_guard lock(shared_mutex);
  ++shared_users;
}

SharedDevices::~SharedDevices() {
  const std::lock_guard lock(shared_mutex);
  if (--shared_users == 0) shared_devices.clear();
}

}  // namespace steradian::vulkan
