# Units of several files: the compiler reads the headers once for a dozen files. On in the presets that build everything, where it halves
# the time; off where each file must compile from its own includes alone (the presets debug and quick).
option(STERADIAN_UNITY "Compile the files of a target together, a dozen a unit" OFF)

# steradian_unity(TARGET FILES_A_UNIT)
function(steradian_unity target files)
  if(STERADIAN_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${files})
    # g++ takes an unnamed namespace for that of a header where the unit's main file is another one.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

# steradian_alone(FILE...): files that are units of their own everywhere.
function(steradian_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
