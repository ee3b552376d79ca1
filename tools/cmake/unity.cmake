# strata_unity(TARGET SIZE [APART...]): its sources are compiled SIZE at a time, for parsing takes longer than most of them. Kernels,
# which Highway includes again and again, and sources whose names collide with a neighbour's (APART) are compiled alone.
function(strata_unity target size)
  get_target_property(kernels ${target} SOURCES)
  list(FILTER kernels INCLUDE REGEX "_simd\\.cpp$")
  set_source_files_properties(${kernels} ${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${size})
endfunction()
