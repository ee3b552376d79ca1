include(${CMAKE_CURRENT_LIST_DIR}/debian_headers.cmake)
debian_headers(TinyGLTF::TinyGLTF tiny_gltf.h)
set(TinyGLTF_FOUND TRUE)
