// tests/pipeline/fragments/recorded_fragments.h - a record of random batches, and the same fragments one by one in
// submission order.
#pragma once
#include <algorithm>
#include <memory>
#include <vector>

#include "pipeline/fragments/tile_fragments.h"
#include "tests/support/random_numbers.h"

namespace strata::testing {

struct GivenRecord {
    struct Fragment {
        std::uint32_t pixel, primitive, code, exact_code, reference_code;
        float shader_z;
        double reference_z;
        std::array<float, 4> color;
    };
    pipeline::TileFragments record;
    std::vector<Fragment> living;  // in submission order
    std::uint64_t dead = 0;
};

inline constexpr rasterizer::FragmentNeeds all_values{
    .shader_z = true, .code = true, .exact_code = true, .color = true, .reference = true};

// Batches of distinct pixels in random order; `codes`: number of different codes.
inline void fill_record(Random& random, int batches, std::uint32_t pixels, int codes,
                        const rasterizer::FragmentNeeds& needs, GivenRecord& to,
                        std::uint64_t limit = std::uint64_t{64} << 20) {
    to.record.start(needs, limit);
    const auto batch = std::make_unique<rasterizer::FragmentBatch>();
    std::vector<std::uint32_t> all(pixels);
    for (std::uint32_t p = 0; p < pixels; ++p) all[p] = p;
    for (int b = 0; b < batches; ++b) {
        batch->count = random_int(random, 0, static_cast<int>(std::min(pixels, 240u)));
        std::ranges::shuffle(all, random);
        const bool has_dead = random_int(random, 0, 2) == 0;
        rasterizer::Lanes<std::uint32_t> alive{};
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch->count); ++i) {
            const auto code = [&] { return static_cast<std::uint32_t>(random_int(random, 0, codes - 1)); };
            const auto tied_or_not = [&] {
                return random_int(random, 0, 1) == 0 ? static_cast<float>(random_int(random, -4, 4)) / 4
                                                     : random_float(random, -1, 1);
            };
            const GivenRecord::Fragment f{
                all[i],
                static_cast<std::uint32_t>(b),
                code(),
                code(),
                code(),
                tied_or_not(),
                random_float(random, -1, 1),
                {random_channel(random), random_channel(random), random_channel(random), random_channel(random)}};
            batch->pixel[i] = f.pixel;
            batch->primitive[i] = f.primitive;
            batch->code[i] = f.code;
            batch->exact_code[i] = f.exact_code;
            batch->reference_code[i] = f.reference_code;
            batch->shader_z[i] = f.shader_z;
            batch->reference_z[i] = f.reference_z;
            for (std::size_t c = 0; c < 4; ++c) batch->color[c][i] = f.color[c];
            alive[i] = has_dead && random_int(random, 0, 3) == 0 ? 0u : ~0u;
            if (alive[i] != 0)
                to.living.push_back(f);
            else
                ++to.dead;
        }
        to.record.append(*batch, alive);
    }
    to.record.finish();
}

}  // namespace strata::testing
