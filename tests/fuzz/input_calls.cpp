// tests/fuzz/input_calls.cpp - decodes bytes into a sequence of renderer calls; each call on a reused renderer must
// return what it returns on a new one.
#include <algorithm>
#include <array>
#include <bit>
#include <fstream>
#include <random>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "pipeline/device/check.h"
#include "pipeline/device/profile.h"
#include "rasterizer/base/input_error.h"
#include "tests/fuzz/byte_source.h"
#include "tests/fuzz/frame_case.h"
#include "tests/fuzz/inputs.h"
#include "tests/support/difference.h"

namespace strata::fuzz {

namespace {

enum class Call : std::uint8_t { render, depth_pass, fragments, checked };

struct Asked {
    Call call;
    const peeling::Algorithm* algorithm;
};

// Result of a call: a picture, fragments, or an error message.
struct Answer {
    peeling::RenderResult result{};
    std::vector<std::array<std::uint32_t, 9>> fragments{};
    std::string refused{};
};

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }

Answer answer(peeling::Renderer& renderer, const Asked& asked) try {
    switch (asked.call) {
        case Call::render: return {.result = renderer.render(*asked.algorithm)};
        case Call::depth_pass: return {.result = renderer.depth_pass()};
        case Call::checked: return {.result = renderer.render(*asked.algorithm, {}, {.trust_idle = false})};
        case Call::fragments: break;
    }
    Answer found;
    for (const auto& one : renderer.fragments(*asked.algorithm).all)
        found.fragments.push_back({one.pixel, one.primitive, one.code, one.exact_code, bits(one.shader_z),
                                   bits(one.color.r), bits(one.color.g), bits(one.color.b), bits(one.color.a)});
    return found;
} catch (const InputError& error) {
    return {.refused = error.what()};
} catch (const pipeline::Refused& error) {
    return {.refused = error.what()};
}

std::vector<Asked> calls_of(ByteSource& bytes) {
    const auto& algorithms = peeling::algorithms();
    std::vector<Asked> calls(static_cast<std::size_t>(2 + bytes.below(5)));
    for (Asked& one : calls) {
        one.call = bytes.pick(std::array{Call::render, Call::render, Call::depth_pass, Call::fragments, Call::checked});
        one.algorithm = &algorithms[static_cast<std::size_t>(bytes.below(static_cast<int>(algorithms.size())))];
    }
    return calls;
}

}  // namespace

void try_calls(Bytes data) {
    constexpr std::size_t call_bytes = 16;
    ByteSource bytes{data.first(std::min(call_bytes, data.size()))};
    const auto calls = calls_of(bytes);
    FrameCase frame = make_case(data.subspan(std::min(call_bytes, data.size())));
    const ExecutionWay& way = frame.ways.back();
    frame.options.execution = way.execution;
    frame.options.tile_size = way.tile_size;
    frame.options.fragment_memory = way.fragment_memory;
    const auto made = [&] { return peeling::Renderer{frame.list, frame.view, frame.profile, frame.options}; };
    peeling::Renderer one = made();
    for (const Asked& asked : calls) {
        peeling::Renderer own = made();
        const Answer found = answer(one, asked), expected = answer(own, asked);
        require(found.refused == expected.refused, "a renderer refuses what a fresh one refuses");
        require(found.fragments == expected.fragments, "a renderer has the fragments of a fresh one");
        require(testing::difference(found.result, expected.result).empty(), "a renderer draws what a fresh one draws");
    }
}

void write_calls(const std::filesystem::path& folder) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        std::mt19937_64 random{seed};
        std::ofstream file(folder / std::to_string(seed), std::ios::binary);
        for (int i = 0; i < 400; ++i) file.put(static_cast<char>(random() >> 32));
    }
}

}  // namespace strata::fuzz
