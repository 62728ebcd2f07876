# Checks on texts rather than on results: the dialect of the kernels, every compiler that reads them, and the
# symbols that keep instruction sets apart.

add_test(NAME Dialect.KernelsKeepIt
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/dialect_lint.py)
add_test(NAME Dialect.LintCatchesEveryBadSnippet
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/dialect_lint_test.py)

foreach(language glsl es hlsl)
  add_test(NAME Dialect.KernelsCompileAs_${language}
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/shader_compilers.py ${language})
endforeach()

add_test(NAME Parity.EveryKernelFunctionIsReached
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/parity/make_cases.py reached)

# Unoptimised and sanitised units keep out-of-line copies; only the release is shipped, and only it is checked.
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  foreach(isa ${STERADIAN_INSTRUCTION_SETS})
    set(objects "")
    foreach(name ${STERADIAN_BUILT})
      if(TARGET steradian_${name}_pack_${isa})
        list(APPEND objects $<TARGET_OBJECTS:steradian_${name}_pack_${isa}>)
      endif()
    endforeach()
    add_test(NAME Packs.SymbolsNameTheirInstructionSet_${isa}
      COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/pack_symbols.py ${CMAKE_NM} ${isa}
              ${objects}
      COMMAND_EXPAND_LISTS)
  endforeach()
  add_library(steradian_leaking_unit OBJECT leaking_unit.cpp)
  add_test(NAME Packs.SymbolTestFindsALeak
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/pack_symbols.py ${CMAKE_NM} avx512
            $<TARGET_OBJECTS:steradian_leaking_unit>)
  set_tests_properties(Packs.SymbolTestFindsALeak PROPERTIES PASS_REGULAR_EXPRESSION "W steradian::leaks.float.")
endif()

# dist/: what is checked in is what the script writes, and compiles in every language, whole and topic by topic.
add_test(NAME Dist.RegeneratingGivesTheSameBytes
  COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/dist/make_dist.py --check)
foreach(language glsl es hlsl wgsl)
  add_test(NAME Dist.Compiles_${language}
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/dist_compiles.py ${language} ${PROJECT_BINARY_DIR}/npm)
  set_tests_properties(Dist.Compiles_${language} PROPERTIES SKIP_RETURN_CODE 77 RESOURCE_LOCK npm)
endforeach()

# No name has two definitions that the linker would merge, and all headers can stand in one unit.
set(one_definition Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/one_definition.py)
set(has -DSTERADIAN_HAS_SSE2=1 -DSTERADIAN_HAS_AVX2=1 -DSTERADIAN_HAS_AVX512=1)
add_test(NAME OneDefinition.NoNameHasTwo
  COMMAND ${one_definition} ${CMAKE_CXX_COMPILER} ${has} -I${PROJECT_SOURCE_DIR} -I${PROJECT_SOURCE_DIR}/source -I${PROJECT_SOURCE_DIR}/include
          -I${PROJECT_SOURCE_DIR}/kernels -I${PROJECT_SOURCE_DIR}/apps -I${PROJECT_SOURCE_DIR}/apps/steradian
          -I${PROJECT_SOURCE_DIR}/apps/command_line -I${PROJECT_SOURCE_DIR}/apps/viewer -I${PROJECT_SOURCE_DIR}/tests)
add_test(NAME OneDefinition.ASecondOneIsFound COMMAND ${one_definition} --test)

# No inclusion runs upward through the layers, and the picture of the dependencies is the one that is drawn from them.
set(layers Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/layers.py)
add_test(NAME Layers.NoInclusionRunsUpward COMMAND ${layers})
add_test(NAME Layers.AnInclusionUpwardIsFound COMMAND ${layers} --test)
add_test(NAME Layers.ThePictureIsCurrent COMMAND ${layers} --check ${PROJECT_SOURCE_DIR}/docs/images/layers.svg)

# Every picture and measured table of docs/ is in the manifest of ./dev figures, which finds differences.
set(figures Python3::Interpreter ${PROJECT_SOURCE_DIR}/tools/figures.py)
add_test(NAME Figures.EveryOneIsInTheManifest COMMAND ${figures} --manifest)
add_test(NAME Figures.DifferencesAndGapsAreFound COMMAND ${figures} --test)

# Instructions, spilled registers and scratch memory of shaders, by the compiler of a GPU that is not here (docs/measured/shaders.md).
if(STERADIAN_VULKAN)
  set(shader_cost Python3::Interpreter ${PROJECT_SOURCE_DIR}/tools/shader_cost.py)
  add_test(NAME Shaders.ExcessesAreFound COMMAND ${shader_cost} --test)
  add_test(NAME Shaders.LoopsAreCounted COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tools/device_model.py --test)
  add_test(NAME Shaders.PipelinesKeepTheirLimits COMMAND ${shader_cost} $<TARGET_FILE:steradian_program> --check gfx1100)
  add_test(NAME Shaders.PipelinesKeepTheirLimitsEverywhere COMMAND ${shader_cost} $<TARGET_FILE:steradian_program> --check)
  set_tests_properties(Shaders.PipelinesKeepTheirLimits Shaders.PipelinesKeepTheirLimitsEverywhere PROPERTIES SKIP_RETURN_CODE 77)
  set_tests_properties(Shaders.PipelinesKeepTheirLimitsEverywhere PROPERTIES LABELS night)
  # A device that compiles and runs nothing is refused by name.
  add_test(NAME Vulkan.ADeviceWithoutItsHardwareIsRefused
    COMMAND steradian_program render ${PROJECT_SOURCE_DIR}/scenes/room.glb -o refused.png --backend vulkan --size 64x64)
  set_tests_properties(Vulkan.ADeviceWithoutItsHardwareIsRefused PROPERTIES PASS_REGULAR_EXPRESSION "runs nothing|no device with Vulkan"
    ENVIRONMENT "RADV_FORCE_FAMILY=gfx1100;VK_ICD_FILENAMES=/usr/share/vulkan/icd.d/radeon_icd.x86_64.json")
endif()

# The public headers: each alone, by day with this compiler, by night with clang too; and steradian.h is all of them.
set(headers Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/headers_test.py ${PROJECT_SOURCE_DIR}/include)
add_test(NAME Packaging.HeadersCompileAlone COMMAND ${headers} ${CMAKE_CXX_COMPILER})
add_test(NAME Packaging.HeadersCompileAlone_clang++ COMMAND ${headers} clang++)
set_tests_properties(Packaging.HeadersCompileAlone_clang++ PROPERTIES LABELS night)

# A program of somebody else's, with both compilers: from the installed tree, and with this project as a subdirectory.
set(consume ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -DSOURCE=${PROJECT_SOURCE_DIR} -DSCRATCH=${PROJECT_BINARY_DIR}/consumer
    -DLAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER} -P ${CMAKE_CURRENT_LIST_DIR}/consumer/consume.cmake)
add_test(NAME Packaging.Installs COMMAND ${consume} install)
set_tests_properties(Packaging.Installs PROPERTIES FIXTURES_SETUP installed_tree)
add_test(NAME Packaging.InstalledTreeServesEverything COMMAND ${consume} everything ${CMAKE_CXX_COMPILER})
set_tests_properties(Packaging.InstalledTreeServesEverything PROPERTIES FIXTURES_REQUIRED installed_tree)
add_test(NAME Packaging.InstalledTreeFitsALobeOfOnesOwn COMMAND ${consume} lobe ${CMAKE_CXX_COMPILER})
set_tests_properties(Packaging.InstalledTreeFitsALobeOfOnesOwn PROPERTIES FIXTURES_REQUIRED installed_tree)
add_test(NAME Packaging.InstalledTreeNamesUnknownComponents COMMAND ${consume} components ${CMAKE_CXX_COMPILER})
set_tests_properties(Packaging.InstalledTreeNamesUnknownComponents PROPERTIES FIXTURES_REQUIRED installed_tree LABELS night)
set_tests_properties(Packaging.Installs Packaging.InstalledTreeServesEverything Packaging.InstalledTreeFitsALobeOfOnesOwn PROPERTIES LABELS night)
foreach(compiler g++ clang++)
  add_test(NAME Packaging.InstalledTreeServesIntegralsAlone_${compiler} COMMAND ${consume} installed ${compiler})
  set_tests_properties(Packaging.InstalledTreeServesIntegralsAlone_${compiler} PROPERTIES FIXTURES_REQUIRED installed_tree)
  add_test(NAME Packaging.SubdirectoryServesIntegralsAlone_${compiler} COMMAND ${consume} subdirectory ${compiler})
  set_tests_properties(Packaging.InstalledTreeServesIntegralsAlone_${compiler} Packaging.SubdirectoryServesIntegralsAlone_${compiler}
    PROPERTIES LABELS night)
endforeach()

# The pages as a site: every link between them leads somewhere.
find_program(MKDOCS mkdocs)
if(MKDOCS)
  add_test(NAME Docs.SiteHasNoBrokenLink
    COMMAND ${MKDOCS} build --strict --quiet --config-file ${PROJECT_SOURCE_DIR}/mkdocs.yml --site-dir ${CMAKE_CURRENT_BINARY_DIR}/site)
  set_tests_properties(Docs.SiteHasNoBrokenLink PROPERTIES LABELS night)
endif()

# The program with each optional part OFF alone, and with all of them OFF; and a preset says ON or OFF for each.
set(parts Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/optional_parts.py ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/parts)
add_test(NAME Parts.EveryPresetSaysOnOrOff COMMAND ${parts} presets)
foreach(part VULKAN FONTS WINDOW BENCH ALL)
  add_test(NAME Parts.ProgramBuildsWithout_${part} COMMAND ${parts} ${part})
  set_tests_properties(Parts.ProgramBuildsWithout_${part} PROPERTIES LABELS night TIMEOUT 3600)
endforeach()

add_test(NAME Parts.ProgramBuildsForClusters COMMAND ${parts} cluster)
set_tests_properties(Parts.ProgramBuildsForClusters PROPERTIES LABELS night TIMEOUT 3600 SKIP_RETURN_CODE 77)

add_test(NAME Build.TimesAreRead COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tools/build_times.py --test)

# The rules of the house that hold everywhere; `tools/house.py` alone prints the figures of all.
set(house Python3::Interpreter ${PROJECT_SOURCE_DIR}/tools/house.py)
add_test(NAME House.BrokenRulesAreFound COMMAND ${house} --test)
foreach(rule comments constants folders mirrors pages types)
  add_test(NAME House.Holds_${rule} COMMAND ${house} --check ${rule})
endforeach()
