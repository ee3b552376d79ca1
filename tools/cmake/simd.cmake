# PkgConfig::HIGHWAY - the instruction sets for which the kernels are compiled: those of `--simd`. A processor with none of them uses the scalar
# reference, so that Highway's own fallbacks would never be used. Instrumented builds, in which a kernel takes a minute to compile, have one set.
find_package(PkgConfig REQUIRED)
pkg_check_modules(HIGHWAY REQUIRED IMPORTED_TARGET libhwy)
# Only its headers are used; builds that check assertions need its library, which takes 4 ms to load (simd_dispatch.h).
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
  # Our batches have vectors in arrays, which is impossible with SVE's vectors of unknown size; Highway's NEON target requires AES.
  target_compile_options(PkgConfig::HIGHWAY INTERFACE -march=armv8-a+crypto)
  target_compile_definitions(PkgConfig::HIGHWAY INTERFACE
    "HWY_DISABLED_TARGETS=(HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)")
endif()
# strata_kernels_of_many_forms(SOURCE...): kernels that are compiled in dozens of forms, one for each choice of formats and tests. With sanitizers in
# all of them the optimizer takes half a minute per source, without them two seconds.
function(strata_kernels_of_many_forms)
  if(STRATA_SANITIZE)
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS -O0)
  endif()
endfunction()
