// Tests render targets against a plain array: the values that scatter and fill store are those that gather and code
// return, and nothing else changes.
#include "pipeline/stages/target_storage.h"

#include <catch2/catch.hpp>

#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;

constexpr std::array all_formats{Format::rgba8, Format::rgba16f,      Format::rgba32f,  Format::r16f,      Format::r32f,
                                 Format::rg32f, Format::d16,          Format::d24,      Format::d24s8,     Format::d32f,
                                 Format::s8,    Format::srgb8_alpha8, Format::rgb10_a2, Format::r11g11b10f};

std::uint32_t stored_bits(Format format) {
    switch (info(format).type) {
        case ChannelType::unorm8:
        case ChannelType::stencil: return 0xffu;
        case ChannelType::unorm10:
        case ChannelType::half: return 0xffffu;
        case ChannelType::single:
        case ChannelType::depth: return 0xffffffffu;
    }
    return 0;
}

// Model of a target: codes by (pixel, channel, sample).
struct Model {
    std::size_t pixels, channels, samples;
    std::vector<std::uint32_t> codes = std::vector<std::uint32_t>(pixels * channels * samples, 0);
    std::uint32_t& at(std::size_t pixel, std::size_t channel, std::size_t sample) {
        return codes[(pixel * channels + channel) * samples + sample];
    }
};

std::size_t differences(const TargetStorage& storage, Model& model) {
    std::size_t wrong = 0;
    for (std::size_t p = 0; p < model.pixels; ++p)
        for (std::size_t c = 0; c < model.channels; ++c)
            for (std::size_t s = 0; s < model.samples; ++s)
                wrong += storage.code(p, static_cast<int>(c), static_cast<int>(s)) != model.at(p, c, s) ? 1 : 0;
    return wrong;
}

void random_scatter(Random& random, TargetStorage& storage, Model& model) {
    const std::uint32_t bits = stored_bits(storage.format());
    Lanes<std::uint32_t> pixel{}, alive{};
    ColorCodes codes{};
    const auto count = static_cast<std::size_t>(random_int(random, 0, static_cast<int>(model.pixels)));
    const auto shift = static_cast<std::size_t>(random_int(random, 0, 1000));
    const auto sample = static_cast<std::size_t>(random_int(random, 0, static_cast<int>(model.samples) - 1));
    const auto mask = static_cast<unsigned>(random_int(random, 0, 15));
    for (std::size_t i = 0; i < count; ++i) {
        pixel[i] =
            static_cast<std::uint32_t>((i * 7 + shift) % model.pixels);  // 7 and the number of pixels are coprime
        alive[i] = random_int(random, 0, 2) != 0 ? ~0u : 0u;
        for (std::size_t c = 0; c < 4; ++c) codes[c][i] = static_cast<std::uint32_t>(random()) & bits;
        for (std::size_t c = 0; c < model.channels; ++c)
            if (alive[i] != 0 && (mask >> c & 1u) != 0) model.at(pixel[i], c, sample) = codes[c][i];
    }
    storage.scatter(pixel, alive, static_cast<int>(count), static_cast<int>(sample), mask, codes);
}

void random_fill(Random& random, TargetStorage& storage, Model& model) {
    const std::uint32_t bits = stored_bits(storage.format());
    std::array<std::uint32_t, 4> codes{};
    codes.fill(static_cast<std::uint32_t>(random()) & bits);
    if (random_int(random, 0, 1) != 0)  // different values per channel
        for (std::uint32_t& code : codes) code = static_cast<std::uint32_t>(random()) & bits;
    const auto mask = static_cast<unsigned>(random_int(random, 0, 255));
    storage.fill(codes, mask);
    for (std::size_t p = 0; p < model.pixels; ++p)
        for (std::size_t c = 0; c < model.channels; ++c)
            for (std::size_t s = 0; s < model.samples; ++s)
                if ((mask >> s & 1u) != 0) model.at(p, c, s) = codes[c];
}

std::size_t gather_differences(const TargetStorage& storage, Model& model) {
    std::size_t wrong = 0;
    Lanes<std::uint32_t> pixel{};
    for (std::size_t i = 0; i < model.pixels; ++i) pixel[i] = static_cast<std::uint32_t>(model.pixels - 1 - i);
    for (std::size_t s = 0; s < model.samples; ++s) {
        ColorCodes codes{};
        storage.gather(pixel, static_cast<int>(model.pixels), static_cast<int>(s), codes);
        for (std::size_t i = 0; i < model.pixels; ++i)
            for (std::size_t c = 0; c < model.channels; ++c) wrong += codes[c][i] != model.at(pixel[i], c, s) ? 1 : 0;
    }
    return wrong;
}

}  // namespace

TEST_CASE("a target of any format and number of samples returns the stored values channel by channel") {
    Random random{401};
    for (const Format format : all_formats)
        for (int samples = 1; samples <= 8; ++samples) {
            TargetStorage storage{format, samples, 45};
            Model model{45, static_cast<std::size_t>(info(format).channels), static_cast<std::size_t>(samples)};
            std::size_t wrong = differences(storage, model);  // a new target contains zeros
            for (int step = 0; step < 12; ++step) {
                if (random_int(random, 0, 3) == 0) random_fill(random, storage, model);
                random_scatter(random, storage, model);
                wrong += differences(storage, model) + gather_differences(storage, model);
            }
            INFO(info(format).name << ", " << samples << " samples");
            CHECK(wrong == 0);
        }
}

TEST_CASE("depth and stencil of a d24s8 target are filled separately") {
    TargetStorage storage{Format::d24s8, 2, 3};
    storage.fill({0x123456u, 0, 0, 0}, 0b01);
    storage.fill_stencil(7, 0b10);
    CHECK(storage.depth(0)[2] == 0x123456u);
    CHECK(storage.depth(1)[2] == 0u);
    CHECK(storage.stencil(0)[2] == 0);
    CHECK(storage.stencil(1)[2] == 7);
    CHECK(storage.code(2, 0, 0) == 0x123456u);
}

TEST_CASE("the memory of an earlier target is not visible for any kind of first write") {
    constexpr std::size_t pixels = 20;
    for (const Format format : all_formats)
        for (const int first : {0, 1, 2, 3}) {  // first write: none, one sample, all samples, a stencil
            TargetStorage earlier{Format::rgba32f, 2, 2 * pixels};
            earlier.fill({~0u, ~0u, ~0u, ~0u}, 3u);
            TargetStorage target{format, 2, pixels, earlier.give_memory()};
            const bool has_stencil = format == Format::d24s8;
            if (first == 1) target.fill({1, 1, 1, 1}, 2u);
            if (first == 2) target.fill({1, 1, 1, 1}, 3u);
            if (first == 3 && has_stencil) target.fill_stencil(1, 2u);
            std::size_t wrong = 0;
            for (std::size_t p = 0; p < pixels; ++p)
                for (const int sample : {0, 1}) {
                    const bool is_filled = first == 2 || (first == 1 && sample == 1);
                    for (int c = 0; c < std::max(1, info(format).channels); ++c)
                        wrong += target.code(p, c, sample) == (is_filled ? 1u : 0u) ? 0 : 1;
                    const std::uint32_t stencil = first == 3 && sample == 1 ? 1 : 0;
                    wrong += has_stencil && target.stencil(sample)[p] != stencil ? 1 : 0;
                }
            INFO(info(format).name << ", first " << first);
            CHECK(wrong == 0);
        }
}

TEST_CASE("a new target is zero wherever nothing was cleared and so is a copy of it") {
    constexpr std::size_t pixels = 20;
    const auto is_filled = [](const TargetStorage& target, int sample, std::uint32_t expected) {
        for (std::size_t i = 0; i < pixels; ++i)
            if (target.code(i, 0, sample) != expected) return false;
        return true;
    };
    for (const Format format : {Format::rgba8, Format::rgba16f, Format::r32f, Format::d24, Format::d24s8}) {
        const TargetStorage fresh{format, 2, pixels};
        TargetStorage part{format, 2, pixels}, whole{format, 2, pixels}, copy = fresh;
        copy = TargetStorage{format, 2, pixels};
        part.fill({7, 7, 7, 7}, 2u);
        whole.fill({7, 7, 7, 7}, 3u);
        for (const int sample : {0, 1}) {
            CHECK(is_filled(fresh, sample, 0));
            CHECK(is_filled(copy, sample, 0));
            CHECK(is_filled(part, sample, sample == 1 ? 7 : 0));
            CHECK(is_filled(whole, sample, 7));
        }
    }
    TargetStorage both{Format::d24s8, 1, pixels};
    both.fill({7, 0, 0, 0}, 1u);
    CHECK(std::all_of(both.stencil(0), both.stencil(0) + pixels, [](std::uint32_t s) { return s == 0; }));
}
