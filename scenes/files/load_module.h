// scenes/files/load_module.h - shared libraries that are loaded when first needed, because their dependencies are
// large.
//
// Rule     A program that is linked with a module uses that one. Otherwise its file is searched in the program's folder
//          (build tree), then in ../lib/strata relative to it (installed), then in the folder of the shared library
//          that contains this code, and in its subfolder strata. SystemError if it is in none of them, or is of another
//          version; for the image module also if the system has not enough threads or address space for its
//          dependencies.
// Tests    tests/tools/strata/render/image_module_test.cpp
#pragma once
#include <string>

#include "scenes/images/image_module.h"

namespace strata::scenes {

struct ModuleFile {
    const char* file;       // "strata_images.so"
    const char* symbol;     // its only exported function
    const char* task;       // "load the image module"
    const char* is_needed;  // "PNG and JPEG need it"
};

// Returns the exported function.
[[nodiscard]] void* module_function(const ModuleFile& module);

// Program and module must come from one build of the project: their tables have no version numbers.
void check_version(const ModuleFile& module, const std::string& version);

// The first call loads it.
[[nodiscard]] const ImageModule& image_module();

}  // namespace strata::scenes
