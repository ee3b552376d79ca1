# strata::numerics - the floating-point rules of every result bit (rasterizer/base/numerics.h), for our targets and for those that include our arithmetic.
add_library(strata_numerics INTERFACE)
add_library(strata::numerics ALIAS strata_numerics)
target_compile_features(strata_numerics INTERFACE cxx_std_20)
# GCC's vectorizer of straight-line code drops the rounding of a double to float and back (rasterizer/reference/numbers.md 1.2).
target_compile_options(strata_numerics INTERFACE -ffp-contract=off -fno-fast-math $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)
target_compile_definitions(strata_numerics INTERFACE GLM_FORCE_CTOR_INIT)  # rasterizer/base/vector.h
target_include_directories(strata_numerics INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)

# GeForce3's depth interpolator is exact in 128 bits (rasterizer/chip/window_z.h).
include(CheckCXXSourceCompiles)
check_cxx_source_compiles("__extension__ typedef unsigned __int128 Wide; int main() { return static_cast<int>(Wide{0}); }"
  STRATA_HAS_INT128)
if(NOT STRATA_HAS_INT128)
  message(FATAL_ERROR "Strata needs a compiler with 128-bit integers (__int128): GCC or Clang for a 64-bit processor.")
endif()

# strata::warnings - the warnings without which our own code must compile.
add_library(strata_warnings INTERFACE)
add_library(strata::warnings ALIAS strata_warnings)
target_compile_options(strata_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wswitch $<$<BOOL:${STRATA_WERROR}>:-Werror>)
# GLM's operators are deleted in our own code (rasterizer/base/no_arithmetic.h), not in programs that use the package.
target_compile_definitions(strata_warnings INTERFACE $<BUILD_INTERFACE:STRATA_GLM_IS_STORAGE>)

# Instrumented builds (presets asan, tsan, fuzz, sanitized, coverage). Their flags are in strata::numerics because every target links it.
set(STRATA_SANITIZE "" CACHE STRING "Sanitizers to build with, as -fsanitize= takes them")
option(STRATA_SANITIZE_TESTS "Build the tests' own sources with them, too" ON)
option(STRATA_COVERAGE "Count the branches that are taken (clang of 18 or later)" OFF)
option(STRATA_FUZZ "Build the fuzz targets (clang only)" OFF)
set(sanitizer_flags "")
if(STRATA_SANITIZE)
  list(APPEND sanitizer_flags -fsanitize=${STRATA_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
endif()
# An index beyond a vector's end but within its memory, or std::clamp with exchanged bounds: the library detects these.
if(STRATA_SANITIZE MATCHES "address|undefined")
  list(APPEND sanitizer_flags -D_GLIBCXX_ASSERTIONS)
endif()
if(STRATA_FUZZ)
  list(APPEND sanitizer_flags -fsanitize=fuzzer-no-link)
endif()
if(STRATA_COVERAGE)
  list(APPEND sanitizer_flags -fprofile-instr-generate -fcoverage-mapping -fcoverage-mcdc -fprofile-list=${PROJECT_SOURCE_DIR}/tests/coverage/counted.txt)
endif()
# A target whose STRATA_UNSANITIZED is set is only linked with them.
target_compile_options(strata_numerics INTERFACE
  "$<BUILD_INTERFACE:$<$<NOT:$<BOOL:$<TARGET_PROPERTY:STRATA_UNSANITIZED>>>:${sanitizer_flags}>>")
target_link_options(strata_numerics INTERFACE "$<BUILD_INTERFACE:${sanitizer_flags}>")  # -D has no effect there
