// scenes/exr/openexr.h - conversions to OpenEXR's types that reader and writer share.
#pragma once
#include <ImathBox.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfPixelType.h>

#include "scenes/exr/parts.h"

namespace strata::scenes::exr {

[[nodiscard]] constexpr Imf::PixelType pixel_type(StoredType type) noexcept {
    switch (type) {
        case StoredType::half: return Imf::HALF;
        case StoredType::single: return Imf::FLOAT;
        case StoredType::word: break;
    }
    return Imf::UINT;
}

// A frame buffer over the rows of `window` in `bytes`, laid out pixel by pixel as PartSource::rows.
[[nodiscard]] Imf::FrameBuffer flat_frame(const PartHeader& header, const Imath::Box2i& window, const std::byte* bytes);

// The samples of some rows of a deep part: per pixel the sample count, per pixel and channel the address of the first
// sample.
class DeepRows {
  public:
    DeepRows(const PartHeader& header, std::size_t pixels);

    // The frame buffer for `window`, whose rows these are.
    [[nodiscard]] Imf::DeepFrameBuffer frame(const Imath::Box2i& window);

    // Sets the addresses for samples that are consecutive in `bytes`, with the numbers in `counts`.
    void point_at(std::byte* bytes);

    std::vector<unsigned int> counts;  // OpenEXR's type for sample counts

  private:
    const PartHeader& header_;
    std::vector<std::vector<std::byte*>> places_;  // per channel, per pixel
};

}  // namespace strata::scenes::exr
