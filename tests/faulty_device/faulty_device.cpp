// A Vulkan layer whose device fails on demand: STERADIAN_FAULT=CALL:N, from the N-th call on. vkQueueSubmit, vkWaitForFences and
// vkQueuePresentKHR lose the device, vkCreateSwapchainKHR and vkAllocateMemory find no memory left, "render" in
// place of a call loses the device where it renders but not where it draws a window, and "timeout" is work that does not end. So the
// program's reaction runs as on a broken machine, without any line of code for tests in it.
#define VK_NO_PROTOTYPES
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

struct Next {
  PFN_vkGetInstanceProcAddr instance_proc = nullptr;
  PFN_vkGetDeviceProcAddr device_proc = nullptr;
  PFN_vkQueueSubmit submit = nullptr;
  PFN_vkWaitForFences wait = nullptr;
  PFN_vkAllocateMemory allocate = nullptr;
  PFN_vkCreateSwapchainKHR create_swapchain = nullptr;  // null, as the next one, on a device that does not present
  PFN_vkQueuePresentKHR present = nullptr;
};
Next next;  // for all devices: those of a program are of one driver, and have the same functions

// True if this call of that name fails.
bool fails(const char* call) {
  static const std::string fault = std::getenv("STERADIAN_FAULT") != nullptr ? std::getenv("STERADIAN_FAULT") : "";
  static std::atomic<long> calls{0};
  const std::size_t colon = fault.find(':');
  if (fault.substr(0, colon) != call) return false;
  return ++calls >= (colon == std::string::npos ? 1 : std::atol(fault.c_str() + colon + 1));
}

VKAPI_ATTR VkResult VKAPI_CALL submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos, VkFence fence) {
  const bool renders = count > 0 && infos->signalSemaphoreCount == 0;  // a frame of a window signals that it can be presented
  return fails("vkQueueSubmit") || (renders && fails("render")) ? VK_ERROR_DEVICE_LOST : next.submit(queue, count, infos, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL wait(VkDevice device, std::uint32_t count, const VkFence* fences, VkBool32 all, std::uint64_t timeout) {
  if (fails("vkWaitForFences")) {
    next.wait(device, count, fences, all, timeout);  // on a lost device nothing continues
    return VK_ERROR_DEVICE_LOST;
  }
  if (fails("timeout")) return VK_TIMEOUT;
  return next.wait(device, count, fences, all, timeout);
}

VKAPI_ATTR VkResult VKAPI_CALL allocate(VkDevice device, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks* callbacks,
                                        VkDeviceMemory* memory) {
  return fails("vkAllocateMemory") ? VK_ERROR_OUT_OF_DEVICE_MEMORY : next.allocate(device, info, callbacks, memory);
}

VKAPI_ATTR VkResult VKAPI_CALL create_swapchain(VkDevice device, const VkSwapchainCreateInfoKHR* info,
                                                const VkAllocationCallbacks* callbacks, VkSwapchainKHR* swapchain) {
  return fails("vkCreateSwapchainKHR") ? VK_ERROR_OUT_OF_DEVICE_MEMORY : next.create_swapchain(device, info, callbacks, swapchain);
}

VKAPI_ATTR VkResult VKAPI_CALL present(VkQueue queue, const VkPresentInfoKHR* info) {
  return fails("vkQueuePresentKHR") ? VK_ERROR_DEVICE_LOST : next.present(queue, info);
}

// The information that the loader passes to the layers of a chain.
template <class Link>
Link* link_of(const void* chain, VkStructureType type) {
  for (auto* info = static_cast<const VkBaseInStructure*>(chain); info != nullptr; info = info->pNext)
    if (info->sType == type && reinterpret_cast<const Link*>(info)->function == VK_LAYER_LINK_INFO)
      return const_cast<Link*>(reinterpret_cast<const Link*>(info));
  return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* callbacks,
                                               VkInstance* instance) {
  auto* link = link_of<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  next.instance_proc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(next.instance_proc(nullptr, "vkCreateInstance"));
  return create(info, callbacks, instance);
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* callbacks, VkDevice* device) {
  auto* link = link_of<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  const PFN_vkGetInstanceProcAddr instance_proc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  next.device_proc = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create = reinterpret_cast<PFN_vkCreateDevice>(instance_proc(nullptr, "vkCreateDevice"));
  const VkResult result = create(physical, info, callbacks, device);
  if (result != VK_SUCCESS) return result;
  next.submit = reinterpret_cast<PFN_vkQueueSubmit>(next.device_proc(*device, "vkQueueSubmit"));
  next.wait = reinterpret_cast<PFN_vkWaitForFences>(next.device_proc(*device, "vkWaitForFences"));
  next.allocate = reinterpret_cast<PFN_vkAllocateMemory>(next.device_proc(*device, "vkAllocateMemory"));
  if (const auto f = next.device_proc(*device, "vkCreateSwapchainKHR"))
    next.create_swapchain = reinterpret_cast<PFN_vkCreateSwapchainKHR>(f);
  if (const auto f = next.device_proc(*device, "vkQueuePresentKHR")) next.present = reinterpret_cast<PFN_vkQueuePresentKHR>(f);
  return VK_SUCCESS;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL device_proc(VkDevice device, const char* name) {
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(device_proc);
  if (std::strcmp(name, "vkQueueSubmit") == 0) return reinterpret_cast<PFN_vkVoidFunction>(submit);
  if (std::strcmp(name, "vkWaitForFences") == 0) return reinterpret_cast<PFN_vkVoidFunction>(wait);
  if (std::strcmp(name, "vkAllocateMemory") == 0) return reinterpret_cast<PFN_vkVoidFunction>(allocate);
  if (std::strcmp(name, "vkCreateSwapchainKHR") == 0) return reinterpret_cast<PFN_vkVoidFunction>(create_swapchain);
  if (std::strcmp(name, "vkQueuePresentKHR") == 0) return reinterpret_cast<PFN_vkVoidFunction>(present);
  return next.device_proc(device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instance_proc(VkInstance instance, const char* name) {
  if (std::strcmp(name, "vkGetInstanceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(instance_proc);
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(device_proc);
  if (std::strcmp(name, "vkCreateInstance") == 0) return reinterpret_cast<PFN_vkVoidFunction>(create_instance);
  if (std::strcmp(name, "vkCreateDevice") == 0) return reinterpret_cast<PFN_vkVoidFunction>(create_device);
  return next.instance_proc == nullptr ? nullptr : next.instance_proc(instance, name);
}

}  // namespace

extern "C" VK_LAYER_EXPORT VKAPI_ATTR VkResult VKAPI_CALL vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* layer) {
  layer->loaderLayerInterfaceVersion = 2;
  layer->pfnGetInstanceProcAddr = instance_proc;
  layer->pfnGetDeviceProcAddr = device_proc;
  layer->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}
