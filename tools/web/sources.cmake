# The sources of the page's program in addition to the core: scenes that need no disk, image module or packs, layers and histories.
set(scenes ${PROJECT_SOURCE_DIR}/scenes)
set(oracle ${PROJECT_SOURCE_DIR}/tools/oracle)
set(request ${PROJECT_SOURCE_DIR}/tools/request)
include(${scenes}/sources.cmake)
list(REMOVE_ITEM strata_scenes_sources ${strata_scenes_with_files})
list(TRANSFORM strata_scenes_sources PREPEND ${scenes}/)
set(strata_web_sources
  ${CMAKE_CURRENT_LIST_DIR}/header_libraries.cpp
  ${CMAKE_CURRENT_LIST_DIR}/workbench.cpp
  ${PROJECT_SOURCE_DIR}/tools/strata/report/survey.cpp
  ${oracle}/picture/codes.cpp
  ${oracle}/explain/fragment_facts.cpp
  ${oracle}/explain/history.cpp
  ${oracle}/explain/history_text.cpp
  ${oracle}/passes/passes.cpp
  ${oracle}/passes/target_parts.cpp
  ${request}/algorithm_fields.cpp
  ${request}/complete.cpp
  ${request}/device_fields.cpp
  ${request}/execution_fields.cpp
  ${request}/option_fields.cpp
  ${request}/sample_fields.cpp
  ${request}/values.cpp
  ${request}/light_words.cpp
  ${request}/weight_words.cpp
  ${request}/view_fields.cpp
  ${strata_scenes_sources})
set(strata_web_definitions TINYGLTF_NO_STB_IMAGE TINYGLTF_NO_INCLUDE_JSON STRATA_VERSION="${PROJECT_VERSION}")
