// peeling/multisampling.h - the samples of a pixel in a frame, as options.
//
// Source   pipeline/reference/fragment-stages.md 13
#pragma once
#include "pipeline/frame/run_settings.h"

namespace strata::peeling {

// The samples of a pixel, and the ones that programs load. RenderOptions::raster says where programs are evaluated.
struct Multisampling {
    int samples = 1;  // 1, 2, 4 or 8
    pipeline::Resolve resolve = pipeline::Resolve::box;
    pipeline::LoadedSample loads = pipeline::LoadedSample::own;       // of geometry passes
    pipeline::LoadedSample composites = pipeline::LoadedSample::own;  // of full-screen passes
    [[nodiscard]] bool loads_others() const noexcept {
        return samples > 1 && (loads != pipeline::LoadedSample::own || composites != pipeline::LoadedSample::own);
    }
};

}  // namespace strata::peeling
