# PkgConfig::HIGHWAY - the instruction sets that the kernels are compiled for: those that `--simd` names. A machine with none of them
# runs the scalar reference, so Highway's own fallbacks would never run. Instrumented builds, where a kernel takes a minute
# to compile, have one set.
find_package(PkgConfig REQUIRED)
pkg_check_modules(HIGHWAY REQUIRED IMPORTED_TARGET libhwy)
# Its headers are all that is used; builds that check assertions need its library, which takes 4 ms to load (simd_dispatch.h).
get_target_property(highway_library PkgConfig::HIGHWAY INTERFACE_LINK_LIBRARIES)
if(highway_library)
  set_target_properties(PkgConfig::HIGHWAY PROPERTIES INTERFACE_LINK_LIBRARIES "-Wl,--push-state,--as-needed,${highway_library},--pop-state")
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
  set(disabled HWY_SSSE3|HWY_SSE4)
  if(STRATA_SANITIZE OR STRATA_COVERAGE)
    string(APPEND disabled |HWY_AVX3)
  endif()
  target_compile_definitions(PkgConfig::HIGHWAY INTERFACE HWY_BASELINE_TARGETS=HWY_AVX2 "HWY_DISABLED_TARGETS=(${disabled})")
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
  # Our batches hold vectors in arrays, which SVE's vectors without a size cannot be; NEON's target of Highway asks for AES.
  target_compile_options(PkgConfig::HIGHWAY INTERFACE -march=armv8-a+crypto)
  target_compile_definitions(PkgConfig::HIGHWAY INTERFACE
    "HWY_DISABLED_TARGETS=(HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)")
endif()
# strata_kernels_of_many_forms(SOURCE...): kernels that stand in dozens of forms, one for each choice of formats and tests. An
# optimizer that is to carry sanitizers through all of them takes half a minute a source; without it they take two seconds.
function(strata_kernels_of_many_forms)
  if(STRATA_SANITIZE)
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS -O0)
  endif()
endfunction()
