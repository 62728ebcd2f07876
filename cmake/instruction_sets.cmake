# Pack code (*_pack.cpp) is compiled once per instruction set, each unit in its own inline namespace
# (include/steradian/config.h), and chosen at run time (source/core/simd.h). The strict variants are the same code
# without contraction and without approximate square roots: bit-equal to scalar float, for the tests.
# A build for one machine, or under a sanitizer, may leave some out: cmake -DSTERADIAN_INSTRUCTION_SETS=avx512
set(STERADIAN_INSTRUCTION_SETS sse2 avx2 avx512 CACHE STRING "Instruction sets that packs are compiled for")
foreach(isa sse2 avx2 avx512)
  string(TOUPPER ${isa} upper)
  if(isa IN_LIST STERADIAN_INSTRUCTION_SETS)
    add_compile_definitions(STERADIAN_HAS_${upper}=1)
  else()
    add_compile_definitions(STERADIAN_HAS_${upper}=0)
  endif()
endforeach()
set(STERADIAN_PACK_FLAGS -O3 CACHE STRING "Optimisation of packs. g++ 12 takes three times as long for them by -O1 as by -O2 or -O3")
# On a processor of arm64, the packs of sse2 are those of NEON, which are as wide (source/core/pack.h). They are the only ones there.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  set(STERADIAN_FLAGS_sse2 "")
else()
  set(STERADIAN_FLAGS_sse2 -msse2)
endif()
set(STERADIAN_FLAGS_avx2 -mavx2 -mfma -mtune=haswell)
# A pack copied by two half moves and read whole waits for both to reach the cache.
set(STERADIAN_FLAGS_avx512 -mavx512f -mavx512dq -mavx512bw -mavx512vl -mavx512cd -mfma -mtune=skylake-avx512
                           -mprefer-vector-width=512 $<$<CXX_COMPILER_ID:GNU>:-mmove-max=512 -mstore-max=512>)

# steradian_pack_objects(NAME SOURCES...): object libraries NAME_sse2, NAME_avx2, NAME_avx512.
function(steradian_pack_objects name namespace_suffix)
  foreach(isa ${STERADIAN_INSTRUCTION_SETS})
    add_library(${name}_${isa} OBJECT ${ARGN})
    target_compile_definitions(${name}_${isa} PRIVATE STERADIAN_ISA=isa_${isa}${namespace_suffix})
    # No trapping math and no errno: nothing here reads either, and both keep loops from becoming vectors.
    target_compile_options(${name}_${isa} PRIVATE ${STERADIAN_FLAGS_${isa}} -fno-math-errno -fno-trapping-math
                           -fno-exceptions)
    # Kernels are many small functions: one that stays a call spills whole registers (twice the time of an LTC walk). And a
    # struct of ten packs is large: above eight words, g++ leaves it in memory and stores every copy (15 % of an LTC walk).
    target_compile_options(${name}_${isa} PRIVATE $<$<CXX_COMPILER_ID:GNU>:--param=max-inline-insns-single=2000
      --param=inline-unit-growth=400 --param=large-function-growth=2000 --param=large-stack-frame-growth=20000
      --param=sra-max-scalarization-size-Ospeed=4096>)
    # g++ 12 takes the undefined operands of its own AVX-512 intrinsics for uninitialised variables.
    target_compile_options(${name}_${isa} PRIVATE -Wno-uninitialized -Wno-maybe-uninitialized)
    target_link_libraries(${name}_${isa} PRIVATE steradian_kernels steradian_warnings)
    target_include_directories(${name}_${isa} PRIVATE ${PROJECT_SOURCE_DIR}/source)
    if(CMAKE_BUILD_TYPE STREQUAL "Release")
      target_compile_options(${name}_${isa} PRIVATE ${STERADIAN_PACK_FLAGS})
    endif()
    # Sanitised packs take g++ minutes a file; they read no stranger's input, and the scalar kernels are sanitised.
    if(CMAKE_BUILD_TYPE STREQUAL "RelWithDebInfo")
      target_compile_options(${name}_${isa} PRIVATE -fno-sanitize=all -O2)
    endif()
    # Unoptimised packs would call out-of-line copies that the linker may merge across units.
    if(CMAKE_BUILD_TYPE STREQUAL "Debug")
      target_compile_options(${name}_${isa} PRIVATE -O2)
    endif()
  endforeach()
endfunction()
