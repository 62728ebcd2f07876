# Installs the build into a folder of its own, builds examples/cpp against it with find_package, and runs it.
#   cmake -DBUILD=... -DSOURCE=... -DCOMPILER=... -DSCRATCH=... -P installed_tree.cmake
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGV}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/installed)
run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE}/examples/cpp -B ${SCRATCH}/build -DCMAKE_PREFIX_PATH=${SCRATCH}/installed
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${SCRATCH}/build)
run(${SCRATCH}/build/example)
# 4 x/s atan(x/s) with x = 1/2 and s = sqrt(5/4), from the configuration factor of a rectangle under its corner.
if(NOT output MATCHES "irradiance 0\\.75227")
  message(FATAL_ERROR "the example says\n${output}")
endif()
message(STATUS "${output}")
