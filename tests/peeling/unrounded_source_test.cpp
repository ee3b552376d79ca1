// Tests blends whose source is not rounded to a code (pipeline/reference/fragment-stages.md 8.2) against real numbers.
// Direct3D allows this, and devices do it.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/peeling/rendering.h"
#include "tests/support/random_numbers.h"

using namespace strata::testing;
using namespace strata::pipeline;

namespace {

struct Differing {
    int codes = 0, most = 0, channels = 0;
};

// Computes each blend in real numbers and rounds once to a code; within 2^-12 of the middle between two codes either is
// accepted.
[[nodiscard]] Differing from_real_numbers(const FragmentScene& scene, const Image& picture, const Rgba& background) {
    Differing found;
    for (std::size_t p = 0; p < scene.pixels.size(); ++p)
        for (std::size_t c = 0; c < 3; ++c) {
            double code = std::floor(double{background[c]} * 255 + 0.5);
            bool is_near_middle = false;
            for (const GivenFragment& f : scene.pixels[p].fragments) {
                const double alpha{f.color[3]};
                const double scaled = 255 * (double{f.color[c]} * alpha + code / 255 * (1 - alpha));
                code = std::floor(scaled + 0.5);
                is_near_middle |= std::abs(scaled - std::floor(scaled) - 0.5) < 0x1p-12;
            }
            const int apart = std::abs(static_cast<int>(picture.codes[4 * p + c]) - static_cast<int>(code));
            if (is_near_middle) continue;
            ++found.channels;
            found.codes += apart != 0 ? 1 : 0;
            found.most = std::max(found.most, apart);
        }
    return found;
}

}  // namespace

TEST_CASE("unrounded sources blend as in real numbers rounded once and rounded sources differ by at most 3 codes") {
    Random random{811};
    FragmentScene scene{16, 16};
    for (GivenPixel& pixel : scene.pixels)
        for (int k = 0; k < 6; ++k) {
            Rgba color{};
            for (int c = 0; c < 4; ++c) color[c] = random_float(random, 0, 1);
            pixel.fragments.push_back({static_cast<float>(k + 1) / 16, color});
        }
    const DrawList list = draw_list(scene);
    for (const BlendRounding rounding : {BlendRounding::unrounded_source, BlendRounding::nearest})
        for (const Running& running : all_ways_of_running) {
            DeviceProfile profile = *find_profile("geforce8_dx101");
            profile.blend_rounding = rounding;
            strata::peeling::RenderOptions options = options_for(scene);
            options.background = {0.2f, 0.3f, 0.5f, 1.0f};
            running.apply(options);
            strata::peeling::Renderer renderer{list, {}, profile, options};
            const auto drawn = renderer.render(*strata::peeling::find_algorithm("unsorted"));
            const Differing found = from_real_numbers(scene, drawn.frame.color, options.background);
            const bool is_real = rounding == BlendRounding::unrounded_source;
            CHECK(found.channels > 700);
            CHECK(is_real == (found.codes == 0));
            CHECK((is_real || (found.codes > 150 && found.most <= 3)));
        }
}
