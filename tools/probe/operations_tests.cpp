// tools/probe/operations_tests.cpp - operations for facing, stencil operations, and the invariance of positions between
// two shaders.
#include <algorithm>
#include <utility>

#include "tools/probe/operations_parts.h"
#include "tools/probe/random_generator.h"

namespace strata::probe {

namespace {

// One triangle around the middle of every pixel, in both windings, from one pixel to a quarter in size, so that it has
// an area with four subpixel bits.
Operation facing() {
    Operation o{.name = "test.facing", .question = "which turn is the front?", .width = 16};
    o.result = ResultKind::words;
    o.programs = one_pass("result = uvec4(gl_FrontFacing ? 1u : 2u, 0u, 0u, 0u);");
    RandomGenerator random{821};
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const bool turned = (random.next() >> 16 & 1u) != 0;
            const float reach = 0x1p-4f / static_cast<float>(1 << random.below(3));
            const float at_x = (static_cast<float>(x) + 0.5f) / 8.0f - 1.0f;
            const float at_y = (static_cast<float>(y) + 0.5f) / 8.0f - 1.0f;
            std::array<std::array<float, 4>, 3> corners{{{at_x - reach, at_y - reach, 0.0f, 1.0f},
                                                         {at_x + reach, at_y - reach, 0.0f, 1.0f},
                                                         {at_x, at_y + reach, 0.0f, 1.0f}}};
            if (turned) std::swap(corners[1], corners[2]);
            o.corners.insert(o.corners.end(), corners.begin(), corners.end());
            o.inputs.push_back(one_word(turned ? 2 : 1));
        }
    o.hypotheses = {{"counterclockwise is the front", [](const Texel& t) { return one_word(t[0]); }},
                    {"clockwise is the front", [](const Texel& t) { return one_word(3 - t[0]); }},
                    {"all are", [](const Texel&) { return one_word(1); }}};
    return o;
}

constexpr std::uint32_t stencil_reference = 0xa5;

// KEEP, ZERO, REPLACE, INCR, DECR, INVERT, INCR_WRAP, DECR_WRAP.
std::uint32_t after(std::uint32_t op, std::uint32_t value, bool wraps) {
    const std::array<std::uint32_t, 8> all{value,
                                           0,
                                           stencil_reference,
                                           wraps ? (value + 1) & 255 : std::min(value + 1, 255u),
                                           wraps ? (value + 255) & 255 : std::max(value, 1u) - 1,
                                           ~value & 255,
                                           (value + 1) & 255,
                                           (value + 255) & 255};
    return all[op];
}

Hypothesis stencil_as(std::string name, bool wraps) {
    return {std::move(name), [wraps](const Texel& t) { return one_word(after(t[1], t[0], wraps) >> t[3] & 1); }};
}

// Inputs: the stencil before, the operation, the case in which it applies (0 the stencil test fails, 1 the depth test
// fails, 2 both pass), and the bit that is shown.
Operation stencil() {
    Operation o{.name = "test.stencil", .question = "do INCR and DECR end at 255 and 0?", .width = 8 * 4 * 3};
    o.result = ResultKind::words;
    o.stencil = true;
    o.corners = whole_picture();
    o.programs = one_pass("result = uvec4(1u, 0u, 0u, 0u);");
    for (std::uint32_t bit = 0; bit < 8; ++bit)
        for (std::uint32_t op = 0; op < 8; ++op)
            for (const std::uint32_t value : {0u, 1u, 254u, 255u})
                for (std::uint32_t when = 0; when < 3; ++when) o.inputs.push_back({value, op, when, bit});
    o.hypotheses = {stencil_as("as OpenGL says", false), stencil_as("INCR and DECR wrap", true)};
    return o;
}

// Corners multiplied by a matrix whose elements use all bits. The second shader computes more of the position.
std::vector<ShaderPair> placed_twice(const std::string& declared, const std::string& second) {
    const std::string matrix =
        "const highp mat4 m = mat4(0.9713, 0.0312, 0.1177, 0.0531, -0.0271, 0.9617, 0.0713, 0.0317,"
        " 0.0137, 0.0219, 0.3331, 0.0119, 0.0173, -0.0231, 0.0477, 1.0371);\n";
    const std::string head = "layout(location = 0) in highp vec4 clip;\n" + declared + matrix;
    const std::string out = "layout(location = 0) out highp uvec4 result;\n";
    return {
        {head + "void main() { gl_Position = m * clip; }", out + "void main() { result = uvec4(0u); }"},
        {head + "out highp vec4 other;\nvoid main() { " + second +
             " other = vec4(gl_Position.xyz * gl_Position.w + clip.xyz, dot(m[1], clip)); }",
         out +
             "in highp vec4 other;\nvoid main() { result = uvec4(1u, floatBitsToUint(other.x + other.w), 0u, 0u); }"}};
}

// A grid of triangles over the picture; every pixel has one depth.
Operation invariance(const std::string& name, const std::string& declared, const std::string& second) {
    Operation o{.name = name, .question = "does a second shader place the corners alike?"};
    o.result = ResultKind::words;
    o.programs = placed_twice(declared, second);
    o.inputs.assign(64 * 64, Texel{});
    RandomGenerator random{822};
    std::array<std::array<std::array<float, 4>, 18>, 18> grid{};
    for (int y = 0; y < 18; ++y)
        for (int x = 0; x < 18; ++x) {
            const float shift_x = random.between(-0.05f, 0.05f), shift_y = random.between(-0.05f, 0.05f);
            const float depth = random.between(-0.9f, 0.9f), w = random.between(0.9f, 1.1f);
            grid[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] = {
                (static_cast<float>(x) / 6.0f - 1.5f) * 1.25f + shift_x,
                (static_cast<float>(y) / 6.0f - 1.5f) * 1.25f + shift_y, depth, w};
        }
    for (std::size_t y = 0; y + 1 < 18; ++y)
        for (std::size_t x = 0; x + 1 < 18; ++x)
            for (const auto& [dx, dy] : {std::pair{0u, 0u}, {1u, 0u}, {0u, 1u}, {1u, 0u}, {1u, 1u}, {0u, 1u}})
                o.corners.push_back(grid[y + dy][x + dx]);
    o.hypotheses = {{"alike in every pixel", [](const Texel&) { return one_word(1); }}};
    return o;
}

}  // namespace

void add_tests(std::vector<Operation>& list) {
    constexpr auto same = "gl_Position = m * clip;";
    constexpr auto in_steps = "gl_Position = m[0] * clip.x + m[1] * clip.y + m[2] * clip.z + m[3] * clip.w;";
    list.push_back(facing());
    list.push_back(stencil());
    list.push_back(invariance("invariance.declared", "invariant gl_Position;\n", same));
    list.push_back(invariance("invariance.undeclared", "", same));
    list.push_back(invariance("invariance.written-otherwise", "", in_steps));
}

}  // namespace strata::probe
