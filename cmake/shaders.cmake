# steradian_shaders(TARGET SHADER...): each shader of shaders/ becomes SPIR-V, as the numbers of an array in SHADER.inc, which the
# target's sources include. TARGET_shaders.inc is the body of a C++ function that finds such an array by its `name`.
find_program(STERADIAN_GLSLC glslc DOC "Compiler of shaders")

function(steradian_shaders target)
  steradian_require(VULKAN "the compiler of shaders, glslc," glslc "${STERADIAN_GLSLC}")
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/shaders)
  file(MAKE_DIRECTORY ${folder})
  set(body "")
  foreach(shader ${ARGN})
    add_custom_command(OUTPUT ${folder}/${shader}.inc
      COMMAND ${STERADIAN_GLSLC} --target-env=vulkan1.2 -O -mfmt=c -MD -MF ${folder}/${shader}.d -MT ${folder}/${shader}.inc
              -I ${PROJECT_SOURCE_DIR}/shaders -I ${PROJECT_SOURCE_DIR}/kernels -I ${PROJECT_SOURCE_DIR}/source
              ${PROJECT_SOURCE_DIR}/shaders/${shader} -o ${folder}/${shader}.inc
      DEPENDS ${PROJECT_SOURCE_DIR}/shaders/${shader} DEPFILE ${folder}/${shader}.d VERBATIM)
    target_sources(${target} PRIVATE ${folder}/${shader}.inc)
    string(MAKE_C_IDENTIFIER ${shader} array)
    string(APPEND body "static constexpr std::uint32_t ${array}[] =\n#include \"${shader}.inc\"\n;\nif (name == \"${shader}\") return {\"${shader}\", ${array}};\n")
  endforeach()
  file(CONFIGURE OUTPUT ${folder}/${target}_shaders.inc CONTENT "${body}" @ONLY)
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
