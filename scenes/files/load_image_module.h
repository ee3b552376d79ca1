// scenes/files/load_image_module.h - the image module, loaded when it is first needed.
//
// Rule     A program that is linked with the module has it. Else `strata_images.so` is looked for beside the program (the
//          build tree), then in the folder ../lib/strata from there (an installed one), then beside the shared library that this
//          code is in, and in the folder strata there. SystemError if it is in none of them, or is another version's.
// Tests    tests/tools/image_module_test.cpp
#pragma once
#include "scenes/images/image_module.h"

namespace strata::scenes {

[[nodiscard]] const ImageModule& image_module();

}  // namespace strata::scenes
