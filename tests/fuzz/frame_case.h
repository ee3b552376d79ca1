// tests/fuzz/frame_case.h - makes a small frame and several ways to run it from any bytes. Equal bytes make an equal
// case; missing bytes count as 0, which is the plainest choice.
#pragma once
#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "peeling/render.h"
#include "rasterizer/base/simd.h"

namespace strata::fuzz {

// Settings that no result may depend on.
struct ExecutionWay {
    pipeline::Execution execution = pipeline::Execution::literal;
    Simd simd = Simd::best;
    int tile_size = 32;
    pipeline::Effects effects = pipeline::Effects::needed;
    bool trust_idle = true;
    bool check_selections = false;  // first runs passes that visit every fragment as well, and compares
    std::uint64_t fragment_memory = std::uint64_t{256} << 20;
};

struct FrameCase {
    std::string algorithm;            // "depth_pass" is Renderer::depth_pass
    pipeline::DeviceProfile profile;  // a built-in one, possibly with changed rules
    peeling::RenderOptions options;
    pipeline::DrawList list;
    pipeline::View view;
    std::vector<ExecutionWay> ways;  // the first is the definition: literal
};

// Makes the frame that of a pixel's centre.
inline void leave_samples(rasterizer::RasterState& state) {
    const rasterizer::RasterState plain;
    state.sample.reset();
    state.interpolation = plain.interpolation;
    state.sample_coverage = plain.sample_coverage;
    state.sample_count = state.sample_number = 0;
}

[[nodiscard]] FrameCase make_case(std::span<const std::uint8_t> bytes);

void print(std::ostream& out, const ExecutionWay& way);
void print(std::ostream& out, const FrameCase& frame);

}  // namespace strata::fuzz
