# Changes of the browser's build for every target: packages of headers only, exceptions, and replacements for the gaps of Emscripten's C++ library.
if(NOT EMSCRIPTEN)
  message(FATAL_ERROR "STRATA_WEB: expected Emscripten's compiler (tools/web/build.sh), found ${CMAKE_CXX_COMPILER}")
endif()
list(PREPEND CMAKE_MODULE_PATH "${CMAKE_CURRENT_LIST_DIR}/packages")
add_compile_options(-fwasm-exceptions -msimd128 "SHELL:-include ${CMAKE_CURRENT_LIST_DIR}/missing_library.h")
add_link_options(-fwasm-exceptions)
