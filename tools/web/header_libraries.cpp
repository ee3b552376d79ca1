// tools/web/header_libraries.cpp - definitions that other builds link from packages: tinygltf's reader, without images
// and file access, and the functions of Highway that one instruction set needs. The image module is replaced by an
// error message.
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <tiny_gltf.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "hwy/highway.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/load_module.h"

namespace tinygltf {

// Declared by tinygltf's writer, which is not used.
bool WriteImageData(const std::string*, const std::string*, const Image*, bool, std::string*, void*) { return false; }

}  // namespace tinygltf

namespace hwy {

std::int64_t SupportedTargets() { return HWY_STATIC_TARGET; }

void Abort(const char*, int, const char*, ...) { std::abort(); }

}  // namespace hwy

namespace strata::scenes {

const ImageModule& image_module() {
    throw InputError("page", "texture", "a model without textures; the command reads them", "a picture to decode");
}

}  // namespace strata::scenes
