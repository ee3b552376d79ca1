# strata_unity(TARGET SIZE [APART...]): compiles its sources SIZE at a time, because parsing takes longer than compiling most of them. Kernels, which
# Highway includes repeatedly, and sources whose names collide with another's (APART) are compiled alone. Preset dev compiles the core's sources one
# by one: after an edit of an algorithm only that file is compiled.
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
