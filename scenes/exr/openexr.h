// scenes/exr/openexr.h - what reader and writer have in common of OpenEXR's own terms.
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
        case StoredType::word: return Imf::UINT;
    }
    return Imf::NUM_PIXELTYPES;  // unreachable: the enum is closed
}

// The rows of `window` in `bytes`, pixel by pixel as PartSource::rows has them.
[[nodiscard]] Imf::FrameBuffer flat_frame(const PartHeader& header, const Imath::Box2i& window, const std::byte* bytes);

// The samples of some rows of a deep part: for each pixel their number, and for each channel the place of the first.
class DeepRows {
  public:
    DeepRows(const PartHeader& header, std::size_t pixels);

    // The frame in which `window` is what these rows hold.
    [[nodiscard]] Imf::DeepFrameBuffer frame(const Imath::Box2i& window);

    // Points at samples that stand one after the other in `bytes`, by `counts`.
    void point_at(std::byte* bytes);

    std::vector<unsigned int> counts;  // OpenEXR's type for them

  private:
    const PartHeader& header_;
    std::vector<std::vector<std::byte*>> places_;  // of each channel, of each pixel
};

}  // namespace strata::scenes::exr
