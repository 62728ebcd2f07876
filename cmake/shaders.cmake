# steradian_shaders(TARGET SHADER...): each shader of a folder of shaders/ becomes SPIR-V, as the numbers of an array in SHADER.inc, which the
# target's sources include. TARGET_shaders.inc is the body of a C++ function that finds the ShaderCode of a `name`.
#
# SHADER is the name of a file, or NAME@ID:MACRO=VALUE,VALUE@...: a module for each combination of the values. The macro takes the place of
# the specialisation constant ID, so that a module holds the code of its values alone.
find_program(STERADIAN_GLSLC glslc DOC "Compiler of shaders")

function(steradian_shaders target)
  steradian_require(VULKAN "the compiler of shaders, glslc," glslc "${STERADIAN_GLSLC}")
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/shaders)
  file(MAKE_DIRECTORY ${folder})
  set(body "")
  foreach(shader ${ARGN})
    string(REPLACE "@" ";" constants ${shader})
    list(POP_FRONT constants name)
    file(GLOB_RECURSE source ${PROJECT_SOURCE_DIR}/shaders/${name})
    set(combinations "|")  # ending of the file's name | constants and options of the compiler
    foreach(constant ${constants})
      string(REGEX MATCH "^([0-9]+):([A-Z_]+)=(.*)$" matched ${constant})
      set(id ${CMAKE_MATCH_1})
      set(macro ${CMAKE_MATCH_2})
      string(REPLACE "," ";" values ${CMAKE_MATCH_3})
      set(before ${combinations})
      set(combinations "")
      foreach(combination ${before})
        foreach(value ${values})
          string(REPLACE "|" ".${value}|{${id}, ${value}}, -D${macro}=${value} " one "${combination}")
          list(APPEND combinations "${one}")
        endforeach()
      endforeach()
    endforeach()
    set(modules "")
    foreach(combination ${combinations})
      string(REGEX REPLACE "\\|.*$" "" ending "${combination}")
      set(file ${name}${ending})
      string(REGEX MATCHALL "-D[A-Z_]+=[0-9]+" macros "${combination}")
      string(REGEX REPLACE "^.*\\||-D[A-Z_]+=[0-9]+ " "" fixed "${combination}")
      add_custom_command(OUTPUT ${folder}/${file}.inc
        COMMAND ${STERADIAN_GLSLC} --target-env=vulkan1.2 -O -mfmt=c -MD -MF ${folder}/${file}.d -MT ${folder}/${file}.inc ${macros}
                -I ${PROJECT_SOURCE_DIR}/kernels -I ${PROJECT_SOURCE_DIR}/source ${source} -o ${folder}/${file}.inc
        DEPENDS ${source} DEPFILE ${folder}/${file}.d VERBATIM)
      target_sources(${target} PRIVATE ${folder}/${file}.inc)
      string(MAKE_C_IDENTIFIER ${file} array)
      string(APPEND body "static constexpr std::uint32_t ${array}[] =\n#include \"${file}.inc\"\n;\n")
      string(APPEND modules "{{${fixed}}, ${array}}, ")
    endforeach()
    string(APPEND body "if (name == \"${name}\") return {\"${name}\", {${modules}}};\n")
  endforeach()
  file(CONFIGURE OUTPUT ${folder}/${target}_shaders.inc CONTENT "${body}" @ONLY)
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
