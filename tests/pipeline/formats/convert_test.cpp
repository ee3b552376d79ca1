// Tests the batch conversions against the conversion of one value after the other.
#include "pipeline/formats/convert.h"

#include <catch2/catch.hpp>

#include "pipeline/formats/half.h"
#include "pipeline/formats/unorm8.h"
#include "tests/pipeline/format_models.h"
#include "tests/pipeline/stage_values.h"

using namespace strata::pipeline;
using strata::rasterizer::Lanes;

// The loops of convert.h are vectorized; other tests prove the scalar rules, this one each lane at each length.
TEST_CASE("a batch of any length converts like its fragments one by one and leaves the vectors beyond unchanged") {
    Random random{20};
    Tally tally;
    for (int count = 0; count <= strata::rasterizer::batch_capacity; ++count) {
        Lanes<float> values, decoded;
        Lanes<std::uint32_t> bytes, nearest, zero, words;
        for (float& v : values) v = any_float(random);
        for (auto* lanes : {&bytes, &nearest, &zero, &words}) lanes->fill(0xabcd);
        encode(ChannelType::unorm8, HalfRounding::nearest_even, values, bytes, count);
        encode(ChannelType::half, HalfRounding::nearest_even, values, nearest, count);
        encode(ChannelType::half, HalfRounding::toward_zero, values, zero, count);
        encode(ChannelType::single, HalfRounding::nearest_even, values, words, count);
        for (int lane = 0; lane < strata::rasterizer::batch_capacity; ++lane) {
            if (lane >= count && lane < (count + 15) / 16 * 16)
                continue;  // lanes of the last vector may be
                           // overwritten
            const auto i = static_cast<std::size_t>(lane);
            const std::uint32_t bits = bits_of(values[i]);
            const bool holds =
                lane >= count
                    ? bytes[i] == 0xabcd && nearest[i] == 0xabcd && zero[i] == 0xabcd && words[i] == 0xabcd
                    : model::is_unorm8(bits, static_cast<int>(bytes[i])) && model::is_nearest_half(bits, nearest[i]) &&
                          model::is_half_toward_zero(bits, zero[i]) && words[i] == bits;
            tally.expect(holds, [&] { return fmt::format("{:08x} in lane {} of {}", bits, lane, count); });
        }
        decode(ChannelType::half, nearest, decoded, count);
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
            tally.expect(bits_of(decoded[i]) == bits_of(half_to_float(static_cast<std::uint16_t>(nearest[i]))),
                         [&] { return fmt::format("half {:04x}", nearest[i]); });
        decode(ChannelType::unorm8, bytes, decoded, count);
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
            tally.expect(bits_of(decoded[i]) == bits_of(unorm8_table[bytes[i]]),
                         [&] { return fmt::format("code {}", bytes[i]); });
        decode(ChannelType::single, words, decoded, count);
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
            tally.expect(bits_of(decoded[i]) == words[i], [&] { return fmt::format("float {:08x}", words[i]); });
    }
    INFO("first wrong: " << tally.first());
    CHECK(tally.wrong() == 0);
}
