# Replaces pkg-config for the two packages that the core requests: their headers. Functions of their libraries are in header_libraries.cpp.
include(${CMAKE_CURRENT_LIST_DIR}/debian_headers.cmake)
macro(pkg_check_modules name)
  if("${name}" STREQUAL "HIGHWAY")
    debian_headers(PkgConfig::HIGHWAY hwy)
    # Its SIMD128 has no binary64, which our kernels use: the compiler vectorizes the plain loops.
    set_target_properties(PkgConfig::HIGHWAY PROPERTIES INTERFACE_COMPILE_DEFINITIONS HWY_COMPILE_ONLY_EMU128)
  elseif("${name}" STREQUAL "XXHASH")
    debian_headers(PkgConfig::XXHASH xxhash.h xxh3.h)
    set_target_properties(PkgConfig::XXHASH PROPERTIES INTERFACE_COMPILE_DEFINITIONS XXH_INLINE_ALL)
  endif()
endmacro()
set(PkgConfig_FOUND TRUE)
