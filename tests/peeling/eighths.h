// tests/peeling/eighths.h - scenes whose colours, alphas and depths are eighths or sixteenths: with up to six fragments
// a pixel every product and sum of compositing fits into binary32, so that models are exact real numbers in binary64
// and pictures must equal them.
#pragma once
#include <array>
#include <bit>
#include <random>
#include <sstream>
#include <string>

#include "tests/peeling/rendering.h"

namespace strata::testing {

using Color3 = std::array<double, 3>;

// Composited fragments in real numbers: the premultiplied colour, and the transmittance.
struct RealLayer {
    Color3 color{};
    double through = 1;
};

[[nodiscard]] inline RealLayer layer_of(const GivenFragment& f) {
    const double a = f.color[3];
    return {{f.color[0] * a, f.color[1] * a, f.color[2] * a}, 1 - a};
}
[[nodiscard]] inline RealLayer joined(const RealLayer& front, const RealLayer& back) {
    RealLayer all{front.color, front.through * back.through};
    for (std::size_t c = 0; c < 3; ++c) all.color[c] += front.through * back.color[c];
    return all;
}

inline constexpr pipeline::Rgba eighths_background{0.25f, 0.5f, 0.875f, 1};

// Up to `most` fragments per pixel in any order, with or without ties. A quarter of the pixels have an opaque surface,
// which hides some of them.
[[nodiscard]] inline FragmentScene eighths_scene(unsigned seed, unsigned most, bool has_ties = true) {
    std::mt19937 random{seed};
    const auto eighth = [&](unsigned least) { return static_cast<float>(least + random() % (9 - least)) / 8.0f; };
    FragmentScene scene{16, 16};
    for (GivenPixel& pixel : scene.pixels) {
        const auto count = random() % (most + 1);
        const auto start = random();
        for (unsigned i = 0; i < count; ++i) {
            // Without ties the depths of a pixel differ, because 5 and 14 have no common divisor.
            const auto depth = has_ties ? random() % 6 : (start + 5 * i) % 14;
            pixel.fragments.push_back(
                {static_cast<float>(depth) / 16.0f, {eighth(0), eighth(0), eighth(0), eighth(0)}});
        }
        if (random() % 4 == 0) pixel.opaque = GivenFragment{4.0f / 16.0f, {eighth(0), eighth(0), eighth(0), 1}};
    }
    return scene;
}

[[nodiscard]] inline Color3 behind(const GivenPixel& pixel) {
    const pipeline::Rgba color = pixel.opaque ? pixel.opaque->color : eighths_background;
    return {color[0], color[1], color[2]};
}
[[nodiscard]] inline Color3 over(const RealLayer& front, const Color3& back) {
    Color3 color = front.color;
    for (std::size_t c = 0; c < 3; ++c) color[c] += front.through * back[c];
    return color;
}

[[nodiscard]] inline peeling::RenderOptions eighths_options(const FragmentScene& scene) {
    peeling::RenderOptions options = options_for(scene);
    options.background = eighths_background;
    return options;
}

// The first pixel of a binary32 picture whose colour is further than `tolerance` from `expected(number)`; empty if
// there is none.
template <class Expected>
[[nodiscard]] std::string first_unlike(const pipeline::Image& image, Expected&& expected, double tolerance = 0) {
    for (std::size_t p = 0; p < image.codes.size() / 4; ++p) {
        const Color3 wanted = expected(p);
        for (std::size_t c = 0; c < 3; ++c) {
            const double found = std::bit_cast<float>(image.codes[4 * p + c]);
            if (std::abs(found - wanted[c]) <= tolerance) continue;
            std::ostringstream text;
            text << "pixel " << p << " channel " << c << ": found " << found << ", expected " << wanted[c];
            return text.str();
        }
    }
    return "";
}

// Renders in every execution and returns the first result; clears `are_alike` if a picture or a diagnostic differs from
// it.
[[nodiscard]] inline peeling::RenderResult rendered_alike(const FragmentScene& scene, const char* algorithm,
                                                          peeling::RenderOptions options, bool& are_alike) {
    std::optional<peeling::RenderResult> first;
    for (const Running& running : all_ways_of_running) {
        running.apply(options);
        peeling::RenderResult found = render(scene, {"ideal", algorithm}, options);
        if (!first)
            first = std::move(found);
        else
            are_alike &= found.frame.color == first->frame.color && found.frame.diagnostics == first->frame.diagnostics;
    }
    return *std::move(first);
}

}  // namespace strata::testing
