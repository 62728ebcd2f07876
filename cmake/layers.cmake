# The libraries, from the bottom to the top: steradian::NAME for each layer that STERADIAN_COMPONENTS asks for.
#   needs      layers below that it stands on, all of them
#   joins      it is built wherever all that it needs is
#   packages   what else it asks for, with their libraries; a program that links it needs them too
#   build_packages, build_libraries  headers that only its own build needs
#   sources    its files, as a pattern of paths under source/
set(STERADIAN_LAYERS integrals shadow image scene reference fit plane render plane_vulkan)

# No package at all. The reference methods are part of it: `radiance` answers by them too.
set(STERADIAN_integrals_sources "^(core|shapes|lobes|reference|integrals)/")

set(STERADIAN_shadow_sources "^shadow/")
set(STERADIAN_shadow_needs integrals)

set(STERADIAN_image_sources "^image/")
set(STERADIAN_image_needs integrals)
set(STERADIAN_image_packages OpenEXR PNG JPEG)
set(STERADIAN_image_libraries OpenEXR::OpenEXR PNG::PNG JPEG::JPEG)

set(STERADIAN_scene_sources "^scene/")
set(STERADIAN_scene_needs integrals image)
set(STERADIAN_scene_build_packages Eigen3)
set(STERADIAN_scene_build_libraries Eigen3::Eigen)

set(STERADIAN_reference_sources "^$")  # a name for those who want the ground truth alone
set(STERADIAN_reference_needs integrals)

set(STERADIAN_fit_sources "^fit/")
set(STERADIAN_fit_needs integrals reference)
set(STERADIAN_fit_packages OpenEXR NLopt TBB)
set(STERADIAN_fit_libraries OpenEXR::OpenEXR NLopt::nlopt TBB::tbb)

set(STERADIAN_plane_sources "^plane/")
set(STERADIAN_plane_needs integrals)
set(STERADIAN_plane_packages pugixml TBB fmt Freetype Fontconfig)
set(STERADIAN_plane_libraries pugixml::pugixml TBB::tbb fmt::fmt Freetype::Freetype Fontconfig::Fontconfig)

set(STERADIAN_render_sources "^render/")
set(STERADIAN_render_needs integrals shadow scene reference image)
set(STERADIAN_render_packages TBB "embree 3")
set(STERADIAN_render_libraries TBB::tbb embree)

set(STERADIAN_plane_vulkan_sources "^plane_vulkan/")
set(STERADIAN_plane_vulkan_needs integrals shadow scene reference image plane render)
set(STERADIAN_plane_vulkan_joins TRUE)
set(STERADIAN_plane_vulkan_packages TBB)
set(STERADIAN_plane_vulkan_libraries TBB::tbb)

if(PROJECT_IS_TOP_LEVEL)
  set(default_components ${STERADIAN_LAYERS})
else()
  set(default_components integrals)
endif()
set(STERADIAN_COMPONENTS ${default_components} CACHE STRING "Layers to build: any of ${STERADIAN_LAYERS}; what they need is added")

# steradian_with_needs(OUT COMPONENT...): the components and all that they need, from the bottom to the top.
function(steradian_with_needs out)
  set(wanted ${ARGN})
  foreach(name ${ARGN})
    if(NOT name IN_LIST STERADIAN_LAYERS)
      message(FATAL_ERROR "steradian has no component ${name}: it has ${STERADIAN_LAYERS}")
    endif()
    list(APPEND wanted ${STERADIAN_${name}_needs})
  endforeach()
  set(found ${STERADIAN_LAYERS})
  foreach(name ${STERADIAN_LAYERS})
    if(STERADIAN_${name}_joins)
      set(without ${STERADIAN_${name}_needs})
      list(REMOVE_ITEM without ${wanted})
      if(NOT without)
        list(APPEND wanted ${name})
      endif()
    endif()
    if(NOT name IN_LIST wanted)
      list(REMOVE_ITEM found ${name})
    endif()
  endforeach()
  set(${out} ${found} PARENT_SCOPE)
endfunction()

# steradian_layer(NAME SOURCE...): the library of one layer. Its x_pack.cpp are compiled once per instruction set.
function(steradian_layer name)
  set(packs ${ARGN})
  set(sources ${ARGN})
  list(FILTER packs INCLUDE REGEX "_pack\\.cpp$")
  list(FILTER sources EXCLUDE REGEX "_pack\\.cpp$")
  foreach(package ${STERADIAN_${name}_packages} ${STERADIAN_${name}_build_packages})
    string(REPLACE " " ";" package "${package}")
    find_package(${package} REQUIRED)
  endforeach()
  if(NOT sources)
    add_library(steradian_${name} INTERFACE)
    target_link_libraries(steradian_${name} INTERFACE steradian_${STERADIAN_${name}_needs})
    add_library(steradian::${name} ALIAS steradian_${name})
    set_target_properties(steradian_${name} PROPERTIES EXPORT_NAME ${name})
    return()
  endif()
  add_library(steradian_${name} STATIC ${sources})
  add_library(steradian::${name} ALIAS steradian_${name})
  set_target_properties(steradian_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(steradian_${name} PUBLIC steradian_kernels
                        PRIVATE ${STERADIAN_${name}_libraries} $<BUILD_INTERFACE:steradian_warnings>)
  foreach(library ${STERADIAN_${name}_build_libraries})
    target_link_libraries(steradian_${name} PRIVATE $<BUILD_INTERFACE:${library}>)
  endforeach()
  foreach(need ${STERADIAN_${name}_needs})
    target_link_libraries(steradian_${name} PUBLIC steradian_${need})
  endforeach()
  target_include_directories(steradian_${name} PRIVATE ${PROJECT_SOURCE_DIR}/source ${PROJECT_SOURCE_DIR})
  target_compile_definitions(steradian_${name} PRIVATE STERADIAN_VERSION="${PROJECT_VERSION}")
  if(packs)
    steradian_pack_objects(steradian_${name}_pack "" ${packs})
    foreach(isa ${STERADIAN_INSTRUCTION_SETS})
      target_sources(steradian_${name} PRIVATE $<TARGET_OBJECTS:steradian_${name}_pack_${isa}>)
    endforeach()
  endif()
endfunction()
