// tools/port/probe/samples.h - measures multisampling: the positions of the samples, and the samples that triangles
// cover.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/port/probe/kit.h"
#include "tools/port/probe/painter.h"

namespace strata::port {

// A multisampled texture, RGBA8 with a D32F depth, bound for drawing; contents undefined.
class SampledTarget {
  public:
    // Throws std::runtime_error if OpenGL does not support such a target.
    SampledTarget(FrameSize size, int samples);

    // Samples per pixel: at least the requested number.
    [[nodiscard]] int samples() const noexcept { return samples_; }
    // x and y of each sample in pixels, from the pixel's corner with the least window coordinates; multiples of 1/16 on
    // most devices.
    [[nodiscard]] nlohmann::ordered_json positions() const;
    // The codes of one sample of each pixel.
    [[nodiscard]] PixelCodes color(int sample) const;
    [[nodiscard]] PixelCodes depth(int sample) const;

  private:
    FrameSize size_;
    int samples_ = 0;
    Handle color_, depth_, framebuffer_;
};

// Draws the kit's scenes without blending and without an alpha test, with that many samples per pixel and in both
// orientations, into FOLDER/ORIENTATION/SCENE/sample.K.color.npy and .depth.npy. Returns {"samples": n, "positions":
// [[x, y], ...]}.
[[nodiscard]] nlohmann::ordered_json answer_samples(const Kit& kit, const Painter& painter, int samples,
                                                    const std::string& folder);

}  // namespace strata::port
