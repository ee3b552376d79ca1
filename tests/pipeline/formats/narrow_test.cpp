// Tests surfaces without alpha or with fewer bits per channel (pipeline/reference/formats.md 4).
#include "pipeline/formats/narrow.h"

#include <catch2/catch.hpp>

using namespace strata::pipeline;

TEST_CASE("a narrow surface keeps the upper bits of a channel and reads zeros below") {
    for (std::uint32_t code = 0; code < 256; ++code) {
        CHECK(narrowed(Format::r5g6b5, 0, code) == code / 8 * 8);
        CHECK(narrowed(Format::r5g6b5, 1, code) == code / 4 * 4);
        CHECK(narrowed(Format::r5g6b5, 2, code) == code / 8 * 8);
        CHECK(narrowed(Format::x1r5g5b5, 1, code) == code / 8 * 8);
        CHECK(narrowed(Format::x8r8g8b8, 1, code) == code);
        CHECK(narrowed(Format::rgba8, 3, code) == code);
    }
}

TEST_CASE("destination alpha is 1 where none is stored and seven bits are expanded to eight where seven are") {
    for (std::uint32_t code = 0; code < 256; ++code) {
        for (const Format format : {Format::x8r8g8b8, Format::r5g6b5, Format::x1r5g5b5})
            CHECK(narrowed(format, 3, code) == 255);
        const std::uint32_t seven = code / 2;
        CHECK(narrowed(Format::x1a7r8g8b8, 3, code) == seven * 2 + seven / 64);
    }
}

TEST_CASE("storing a value that was read back changes nothing") {
    for (const Format format : {Format::rgba8, Format::x8r8g8b8, Format::x1a7r8g8b8, Format::r5g6b5, Format::x1r5g5b5})
        for (int channel = 0; channel < 4; ++channel)
            for (std::uint32_t code = 0; code < 256; ++code) {
                const std::uint32_t once = narrowed(format, channel, code);
                CHECK(narrowed(format, channel, once) == once);
            }
}
