// pipeline/textures/depth_texels.h - a depth texture for lookups: a finished image, or a depth target of the pass's own
// region.
//
// Rule     A region has only its own rectangle of a screen-sized texture. A lookup inside it reads the same value as
//          literal execution; a lookup outside throws NeedsFrame, and the executor runs the frame literally. OpenGL's
//          window is y up: row 0 of a copied depth texture is the last row of memory (`bottom_up`).
// Source   pipeline/reference/execution.md 5.4; GL 1.2.1 3.8.2 (CopyTexImage: the lower left pixel is texel 0, 0).
// Tests    tests/pipeline/region/fragment_path_test.cpp
#pragma once
#include <cstdint>

#include "pipeline/formats/format.h"
#include "pipeline/formats/image.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::pipeline {

// Thrown if a lookup leaves its region: the result exists only in literal execution.
struct NeedsFrame {};

struct DepthTexels {
    // Codes of the pixels in `held`, row by row from the top; the whole texture is width by height.
    const std::uint32_t* codes = nullptr;
    rasterizer::Rect held;
    int width = 0, height = 0;
    DepthFormat format = DepthFormat::d24;
    // Texels are 0..255, whatever the format: Heidrich's limited form (texturing.md 4).
    bool is_eight_bit = false;
    bool bottom_up = false;

    DepthTexels() = default;
    explicit DepthTexels(const Image& image)
        : codes{image.codes.data()},
          held{0, 0, image.width, image.height},
          width{image.width},
          height{image.height},
          format{depth_format(image.format)} {}

    [[nodiscard]] bool exists() const noexcept { return codes != nullptr; }
    // The code of depth 1.0 in fixed-point texels.
    [[nodiscard]] std::uint32_t max() const noexcept { return is_eight_bit ? 255u : rasterizer::max_code(format); }
    // The code at texel (column, row) of the whole texture; throws NeedsFrame if it is outside `held`.
    [[nodiscard]] std::uint32_t at(int column, int row) const {
        const int y = bottom_up ? height - 1 - row : row;
        if (column < held.x0 || column >= held.x1 || y < held.y0 || y >= held.y1) throw NeedsFrame{};
        return codes[static_cast<std::size_t>(y - held.y0) * static_cast<std::size_t>(held.width()) +
                     static_cast<std::size_t>(column - held.x0)];
    }
};

}  // namespace strata::pipeline
