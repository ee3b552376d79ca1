// Tests how the fragments of a triangle at the samples of a pixel become one.
// pipeline/reference/fragment-stages.md 13.9.
#include "pipeline/fragments/pixel_fragments.h"

#include <catch2/catch.hpp>
#include <map>
#include <memory>
#include <tuple>

#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using strata::pipeline::FragmentBatch;
using strata::pipeline::Lanes;
using strata::pipeline::PixelBatch;
using strata::pipeline::PixelFragments;
using strata::rasterizer::Rect;

constexpr Rect joined_tile{40, 7, 40 + 23, 7 + 30};

// By triangle and pixel: the codes of the samples that are covered.
using Covered = std::map<std::pair<std::uint32_t, std::uint32_t>, std::map<unsigned, std::uint32_t>>;

}  // namespace

TEST_CASE("the fragments that a triangle has at the samples of a pixel are one, in batches without a pixel twice") {
    Random random{5603};
    for (int round = 0; round < 20; ++round) {
        PixelFragments joined{joined_tile};
        Covered given, found;
        auto batch = std::make_unique<FragmentBatch>();
        Lanes<std::uint32_t> alive{};
        for (unsigned sample = 0; sample < 8; ++sample)
            for (int part = 0; part < 3; ++part) {
                batch->count = random_int(random, 0, 256);
                for (std::size_t i = 0; i < static_cast<std::size_t>(batch->count); ++i) {
                    const int x = random_int(random, 0, 22), y = random_int(random, 0, 29);
                    batch->x[i] = static_cast<std::uint16_t>(joined_tile.x0 + x);
                    batch->y[i] = static_cast<std::uint16_t>(joined_tile.y0 + y);
                    batch->primitive[i] = static_cast<std::uint32_t>(random_int(random, 3, 9));
                    batch->code[i] = static_cast<std::uint32_t>(random_int(random, 0, 1 << 24));
                    batch->reference_code[i] = batch->primitive[i] * 1000 + batch->x[i];
                    batch->color[3][i] = static_cast<float>(batch->primitive[i]);
                    alive[i] = random_int(random, 0, 3) > 0 ? ~0u : 0u;
                    auto& samples = given[{batch->primitive[i], static_cast<std::uint32_t>(y * 23 + x)}];
                    if (samples.contains(sample)) alive[i] = 0;  // a triangle covers a sample once
                    if (alive[i] != 0) samples[sample] = batch->code[i];
                }
                joined.add(*batch, alive, alive, 0, sample);
            }
        std::erase_if(given, [](const auto& entry) { return entry.second.empty(); });
        std::uint64_t twice = 0, disordered = 0, wrong = 0;
        std::pair<std::uint32_t, std::uint32_t> last{};
        joined.join([&](PixelBatch& pixels) {
            std::map<std::uint32_t, int> of_pixel;
            for (std::size_t i = 0; i < static_cast<std::size_t>(pixels.batch.count); ++i) {
                const std::pair at{pixels.batch.primitive[i], pixels.batch.pixel[i]};
                twice += of_pixel[at.second]++ > 0 ? 1 : 0;
                disordered += at <= last ? 1 : 0;
                last = at;
                wrong += pixels.batch.code[i] != at.first * 1000 + pixels.batch.x[i] ||
                                 pixels.batch.color[3][i] != static_cast<float>(at.first)
                             ? 1
                             : 0;
                for (unsigned s = 0; s < 8; ++s)
                    if ((pixels.covered[i] >> s & 1) != 0) found[at][s] = pixels.sample_code[s][i];
            }
        });
        CHECK(twice == 0);
        CHECK(disordered == 0);
        CHECK(wrong == 0);
        CHECK(found == given);
        bool is_empty = true;
        joined.join([&](PixelBatch&) { is_empty = false; });
        CHECK(is_empty);
    }
}
