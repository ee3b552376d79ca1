// tests/pipeline/fragments/stored_columns.h - the store of some batches, and the same fragments pixel by pixel as they arrived.
#pragma once
#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "pipeline/fragments/fragment_store.h"
#include "tests/support/random_numbers.h"

namespace strata::testing {

inline constexpr std::size_t column_pixels = 300;

struct SortedArrival {
    std::uint32_t key;
    float red;
};

// The store of some batches, and beside it the same fragments pixel by pixel as they arrived.
struct StoredColumns {
    pipeline::FragmentStore store;
    std::vector<std::vector<SortedArrival>> columns = std::vector<std::vector<SortedArrival>>(column_pixels);
    std::uint64_t rasterized = 0, masked = 0, faint = 0;
    std::uint64_t of_part = 0, masked_of_part = 0;  // primitives 3 to 8, 12, and 40 to 47
};

// Distinct pixels, in no order.
inline void choose_pixels(Random& random, rasterizer::FragmentBatch& batch) {
    std::vector<std::uint32_t> all(column_pixels);
    for (std::uint32_t p = 0; p < column_pixels; ++p) all[p] = p;
    std::shuffle(all.begin(), all.end(), random);
    std::copy_n(all.begin(), batch.count, batch.pixel.begin());
}

// `codes`: how many different ones there are. Alpha below 0.25 counts as faint.
inline void fill_columns(Random& random, int batches, int codes, StoredColumns& to) {
    to.store.start({.shader_z = true, .code = true, .color = true, .reference = true}, std::uint64_t{64} << 20);
    auto batch = std::make_unique<rasterizer::FragmentBatch>();
    for (int b = 0; b < batches; ++b) {
        batch->count = random_int(random, 1, 240);
        choose_pixels(random, *batch);
        rasterizer::Lanes<std::uint32_t> alive{};
        const bool has_dead = random_int(random, 0, 2) == 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch->count); ++i) {
            batch->code[i] = static_cast<std::uint32_t>(random_int(random, 0, codes - 1));
            batch->shader_z[i] = random_float(random, -1, 1);
            batch->reference_code[i] = static_cast<std::uint32_t>(random_int(random, 0, codes - 1));
            batch->primitive[i] = static_cast<std::uint32_t>(b + (static_cast<int>(i) > batch->count / 2 ? 1 : 0));
            for (auto& channel : batch->color) channel[i] = random_channel(random);
            alive[i] = has_dead && random_int(random, 0, 3) == 0 ? 0u : ~0u;
            const bool is_faint = batch->color[3][i] < 0.25f;
            to.masked += alive[i] == 0 ? 1 : 0;
            const std::uint32_t n = batch->primitive[i];
            const bool is_of_part = (n >= 3 && n < 9) || n == 12 || (n >= 40 && n < 48);
            to.of_part += is_of_part ? 1 : 0;
            to.masked_of_part += is_of_part && alive[i] == 0 ? 1 : 0;
            to.faint += alive[i] != 0 && is_faint ? 1 : 0;
            if (alive[i] != 0 && !is_faint) to.columns[batch->pixel[i]].push_back({batch->code[i], batch->color[0][i]});
        }
        to.rasterized += static_cast<std::uint64_t>(batch->count);
        to.store.append(*batch, alive);
    }
    to.store.finish();
    for (auto& column : to.columns)
        std::stable_sort(column.begin(), column.end(),
                         [](const SortedArrival& a, const SortedArrival& b) { return a.key < b.key; });
}

[[nodiscard]] inline std::uint32_t place_of(std::uint64_t word) { return static_cast<std::uint32_t>(word); }

// Fragments of a column in the order of arrival: places rise with it.
[[nodiscard]] inline std::vector<std::uint64_t> in_order_of_arrival(std::span<const std::uint64_t> words) {
    std::vector<std::uint64_t> arrived(words.begin(), words.end());
    std::sort(arrived.begin(), arrived.end(),
              [](std::uint64_t a, std::uint64_t b) { return place_of(a) < place_of(b); });
    return arrived;
}

}  // namespace strata::testing
