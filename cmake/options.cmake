# The optional parts. Each is ON or OFF and never "if found", so that a preset builds the same program on every machine, or stops with the
# name of the missing package. Where a part X is OFF, a unit without_X.cpp stands for it: its functions say how to get the part.
option(STERADIAN_VULKAN "Build the Vulkan back end" ON)
option(STERADIAN_FONTS "Build text in drawings (FreeType, fontconfig)" ON)
option(STERADIAN_ASSIMP "Build the reading of OBJ, STL and PLY for view factors (Assimp)" OFF)
option(STERADIAN_WINDOW "Build the window of `steradian view` (GLFW, Dear ImGui)" ${PROJECT_IS_TOP_LEVEL})
option(STERADIAN_BENCH "Build the program steradian-bench" ${PROJECT_IS_TOP_LEVEL})
option(STERADIAN_PYTHON "Build the Python module (pybind11)" OFF)
option(STERADIAN_MPI "Build the sharing of work between ranks of mpirun (Open MPI)" OFF)
option(STERADIAN_HDF5 "Build the writing of view factors as HDF5" OFF)
set(STERADIAN_OPTIONAL_PARTS VULKAN FONTS ASSIMP WINDOW BENCH PYTHON MPI HDF5)

if(STERADIAN_TESTS)
  foreach(part VULKAN FONTS WINDOW BENCH)
    if(NOT STERADIAN_${part})
      message(FATAL_ERROR "The tests test STERADIAN_${part} too: configure with -DSTERADIAN_${part}=ON, or with -DSTERADIAN_TESTS=OFF")
    endif()
  endforeach()
endif()

# steradian_optional_sources(LIST PART WITH WITHOUT): keeps in LIST the sources that match WITH where the part is ON, those that match
# WITHOUT where it is OFF.
function(steradian_optional_sources list part with without)
  set(sources ${${list}})
  if(STERADIAN_${part})
    list(FILTER sources EXCLUDE REGEX "${without}")
  else()
    list(FILTER sources EXCLUDE REGEX "${with}")
  endif()
  set(${list} ${sources} PARENT_SCOPE)
endfunction()

# steradian_require(PART WHAT DEBIAN_PACKAGE FOUND): stops with the package's name where FOUND is false.
function(steradian_require part what package found)
  if(NOT found)
    message(FATAL_ERROR "STERADIAN_${part} is ON and needs ${what}, which is not installed: apt-get install ${package}, or configure with "
                        "-DSTERADIAN_${part}=OFF")
  endif()
endfunction()

# steradian_beside_libraries(PROGRAM): libraries beside the program come first, and theirs (an older kind of path than the linker's own
# choice hands down), so that a package runs from anywhere.
function(steradian_beside_libraries program)
  set_target_properties(${program} PROPERTIES BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH "$ORIGIN/../lib")
  target_link_options(${program} PRIVATE LINKER:--disable-new-dtags)
endfunction()
