// strata/strata.h - the library: renders reference pictures of transparent scenes for the tests of other programs.
//
//     const strata::Scene scene("teapot");
//     const auto picture =
//         strata::render(scene, strata::algorithm("dual"), strata::profile("geforce8"), {.width = 640, .height = 480});
//     const auto found = strata::compare(picture.picture(), strata::from_memory(pixels, bytes, "640x480:rgba8"));
//
// Numbers  Bits do not depend on the machine, the number of threads or the instruction set; README.md, "The same bits
//          everywhere".
// Tests    tests/tools/library, tests/tools/package/install_test.cmake
#pragma once
#include "strata/compare.h"
#include "strata/diagnose.h"
#include "strata/names.h"
#include "strata/picture.h"
#include "strata/render.h"
#include "strata/scene.h"
#include "strata/version.h"
