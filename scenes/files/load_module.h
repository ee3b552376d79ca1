// scenes/files/load_module.h - shared libraries that are loaded when they are first needed, for what they bring along
// is large.
//
// Rule     A program that is linked with a module has it. Else its file is looked for beside the program (the build
//          tree), then in the folder ../lib/strata from there (an installed one), then beside the shared library that
//          this code is in, and in the folder strata there. SystemError if it is in none of them, or is another
//          version's; of the image module, too, where the system has no threads or no address space for what it brings
//          along.
// Tests    tests/tools/image_module_test.cpp
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

// The exported function.
[[nodiscard]] void* module_function(const ModuleFile& module);

// Program and module must come from one build of the project: their tables have no version of their own.
void check_version(const ModuleFile& module, const std::string& version);

// Loaded by the first call.
[[nodiscard]] const ImageModule& image_module();

}  // namespace strata::scenes
