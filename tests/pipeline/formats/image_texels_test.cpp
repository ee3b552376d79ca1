// Tests the conversion of bytes to codes. Expected bytes are computed by division; memory next to the target must be
// unchanged.
#include "pipeline/formats/image_texels.h"

#include <catch2/catch.hpp>
#include <vector>

#include "rasterizer/base/simd.h"
#include "tests/support/random_numbers.h"

using namespace strata;
using namespace strata::pipeline;

TEST_CASE("packed values become codes at every length and alignment without changing neighbouring memory") {
    testing::Random random{17};
    std::vector<std::uint32_t> words(80);
    for (auto& word : words) word = static_cast<std::uint32_t>(random());
    int wrong = 0;
    for (const Simd simd : available_simd()) {
        const SimdScope kernels{simd};
        for (std::size_t count = 0; count <= 70; ++count)
            for (std::size_t offset = 0; offset < 5; ++offset) {
                std::vector<std::uint32_t> widened(400, 7), expected(400, 7);
                for (std::size_t i = 0; i < count; ++i) {
                    std::uint32_t rest = words[offset + i];
                    for (std::size_t c = 0; c < 4; ++c, rest /= 256) expected[offset + 4 * i + c] = rest % 256;
                }
                widen_words(&words[offset], count, &widened[offset]);
                finish_words();
                wrong += widened == expected ? 0 : 1;
            }
    }
    CHECK(wrong == 0);
}
