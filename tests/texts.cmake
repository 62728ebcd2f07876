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
    add_test(NAME Packs.SymbolsNameTheirInstructionSet_${isa}
      COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/pack_symbols.py ${CMAKE_NM} ${isa}
              $<TARGET_OBJECTS:steradian_pack_${isa}>
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

# The public headers: each alone, by this compiler and by clang where there is one; and steradian.h is all of them.
add_test(NAME Packaging.HeadersCompileAlone
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/headers_test.py ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/kernels
          ${CMAKE_CXX_COMPILER} clang++)

add_test(NAME Packaging.ExampleBuildsAgainstTheInstalledTree
  COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -DSOURCE=${PROJECT_SOURCE_DIR} -DCOMPILER=${CMAKE_CXX_COMPILER}
          -DSCRATCH=${PROJECT_BINARY_DIR}/installed_tree -P ${CMAKE_CURRENT_LIST_DIR}/installed_tree.cmake)
