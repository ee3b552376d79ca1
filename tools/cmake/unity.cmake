# strata_unity(TARGET SIZE [APART...]): its sources are compiled SIZE at a time, for parsing takes longer than most of them. Kernels,
# which Highway includes again and again, and sources whose names collide with a neighbour's (APART) are compiled alone.
# Preset dev compiles the core's sources one by one: an edit of an algorithm is that file alone.
option(STRATA_CORE_UNITY "Compile the sources of rasterizer, pipeline and peeling many at a time" ON)
function(strata_unity target size)
  if(target MATCHES "^strata_(rasterizer|pipeline|peeling)$" AND NOT STRATA_CORE_UNITY)
    return()
  endif()
  get_target_property(kernels ${target} SOURCES)
  list(FILTER kernels INCLUDE REGEX "_simd\\.cpp$")
  set_source_files_properties(${kernels} ${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${size})
endfunction()
