// The shaders of the plane, compiled at build time and part of the program, and their pipelines.
#pragma once

#include <string>
#include <vector>

#include "device/vulkan/pipeline_report.h"
#include "device/vulkan/shader_code.h"
#include "steradian/plane.h"

namespace steradian::plane {

// By LightGroup; then the shader of round lights by the device's lists, and the one that computes these lists.
std::vector<vulkan::ShaderCode> plane_shaders();

// The pipelines that a device makes for a picture, and their work. The device runs nothing. Throws Error as PlaneDevice does.
std::vector<vulkan::PipelineReport> compile_picture(const PlaneWorld& world, const PlaneFrameOptions& options, const std::string& device);

}  // namespace steradian::plane
