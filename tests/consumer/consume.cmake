# Builds a program against this project as somebody else would, and runs it.
#   cmake -DBUILD=... -DSOURCE=... -DSCRATCH=... [-DLAUNCHER=...] -P consume.cmake install | (everything|installed|subdirectory COMPILER)
#     install       installs the build into SCRATCH
#     everything    from the installed tree, all layers
#     installed     from the installed tree, the integrals alone: every package that other layers ask for is hidden
#     subdirectory  the integrals alone, with this project as a subdirectory
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGV}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

foreach(n RANGE 1 ${CMAKE_ARGC})
  if("${CMAKE_ARGV${n}}" MATCHES "consume.cmake$")
    math(EXPR how "${n} + 1")
    math(EXPR compiler "${n} + 2")
  endif()
endforeach()
set(how "${CMAKE_ARGV${how}}")
set(compiler "${CMAKE_ARGV${compiler}}")

if(how STREQUAL "install")
  file(REMOVE_RECURSE ${SCRATCH}/installed)
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/installed)
  return()
endif()

get_filename_component(name ${compiler} NAME)
set(build ${SCRATCH}/${how}_${name})
file(REMOVE_RECURSE ${build})
set(configure ${CMAKE_COMMAND} -G Ninja -B ${build} -DCMAKE_CXX_COMPILER=${compiler} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
    -DCMAKE_BUILD_TYPE=Debug -DCMAKE_PREFIX_PATH=${SCRATCH}/installed)
set(hidden "")
foreach(package OpenEXR fmt simdjson ZLIB TBB embree NLopt pugixml Freetype Fontconfig GTest nlohmann_json CLI11 Python3)
  list(APPEND hidden -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
if(how STREQUAL "everything")
  run(${configure} -S ${SOURCE}/tests/consumer/everything)
elseif(how STREQUAL "installed")
  run(${configure} ${hidden} -S ${SOURCE}/examples/cpp)
else()
  run(${configure} ${hidden} -S ${SOURCE}/tests/consumer/subdirectory -DSTERADIAN_SOURCE=${SOURCE})
endif()
run(${CMAKE_COMMAND} --build ${build})
run(${build}/example)
# 4 x/s atan(x/s) with x = 1/2 and s = sqrt(5/4), from the configuration factor of a rectangle under its corner.
if(NOT output MATCHES "irradiance 0\\.75227")
  message(FATAL_ERROR "the example says\n${output}")
endif()
message(STATUS "${output}")
