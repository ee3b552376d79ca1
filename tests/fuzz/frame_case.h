// tests/fuzz/frame_case.h - a small frame and several ways to run it, made of any bytes. Equal bytes make an equal
// case; bytes that are missing count as 0, and 0 stands for the plainest choice.
#pragma once
#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "peeling/render.h"
#include "rasterizer/base/simd.h"

namespace strata::fuzz {

// What no result may depend on.
struct Way {
    pipeline::Execution execution = pipeline::Execution::literal;
    Simd simd = Simd::best;
    int tile_size = 32;
    pipeline::Effects effects = pipeline::Effects::needed;
    bool trust_idle = true;
    bool check_selections = false;  // beforehand: passes visit every fragment, too, and compare
    std::uint64_t fragment_memory = std::uint64_t{256} << 20;
};

struct FrameCase {
    std::string algorithm;            // "depth_pass" is Renderer::depth_pass
    pipeline::DeviceProfile profile;  // a built-in one, some of whose rules may have other values
    peeling::RenderOptions options;
    pipeline::DrawList list;
    pipeline::View view;
    std::vector<Way> ways;  // the first is the definition: literal
};

[[nodiscard]] FrameCase make_case(std::span<const std::uint8_t> bytes);

void print(std::ostream& out, const Way& way);
void print(std::ostream& out, const FrameCase& frame);

}  // namespace strata::fuzz
