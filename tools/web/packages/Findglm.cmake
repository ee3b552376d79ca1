include(${CMAKE_CURRENT_LIST_DIR}/debian_headers.cmake)
debian_headers(glm::glm glm)
set(glm_FOUND TRUE)
