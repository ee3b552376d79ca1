// tools/probe/operation.h - what a device computes in a shader, bit by bit: a function of four words, what it is given, and what
// rules would give. Plain values.
//
// Rule     `body` is GLSL that both GLSL ES 3.00 and GLSL 4.20 take: a function `highp uvec4 operation(highp uvec4 a)`, and a
//          sampler `table` if there is a texture. It runs once for each input, in a fragment's program or in a vertex's; its result
//          is the answer, four words, of which the first `lanes` count. Inputs come from a texture, so that no compiler folds them.
//          Into a target of 8-bit sRGB go floats, and the answer is the four bytes, a word each.
// Tests    tests/tools/probe/operations_test.cpp
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace strata::probe {

using Words = std::array<std::uint32_t, 4>;

// Where the function runs: `invariant_vertex` declares what comes out of it invariant.
enum class Stage : std::uint8_t { fragment, vertex, invariant_vertex };

// Looked up at level 0, clamped to its edge.
struct OperationTexture {
    // "rgba8", "srgb8", "r32f", "d16", "d24" or "d32f".
    std::string format{};
    int width = 1, height = 1;
    // A word a texel, row by row: four bytes of a colour from the lowest on, a depth's code, or the bits of a float.
    std::vector<std::uint32_t> texels{};
    bool is_linear = false;  // GL_LINEAR in place of GL_NEAREST
    bool compares = false;   // a sampler2DShadow, GL_LEQUAL
};

// A rule that a device could follow.
struct Hypothesis {
    std::string name{};
    std::function<Words(const Words&)> result{};
};

struct Operation {
    // As files are called: "divide".
    std::string name{};
    // What its answer tells, for people.
    std::string asks{};
    Stage stage = Stage::fragment;
    std::string body{};
    std::vector<Words> inputs{};
    int lanes = 1;
    // How far answers are off is told in units in the last place (of results that are no denormals).
    bool in_units = false;
    std::optional<OperationTexture> texture{};
    bool into_srgb = false;
    // The first is the definition: what a device that is a profile answers.
    std::vector<Hypothesis> hypotheses{};
};

// An answer for each input, or why there is none.
struct OperationReply {
    std::optional<std::vector<Words>> words{};
    std::string refusal{};
    friend bool operator==(const OperationReply&, const OperationReply&) = default;
};
using OperationReplies = std::map<std::string, OperationReply>;

// All of them. Names are unique; the same bits on every machine.
[[nodiscard]] const std::vector<Operation>& operations();
// Parts of the list (operations_*.cpp).
void add_arithmetic(std::vector<Operation>& all);
void add_conversions(std::vector<Operation>& all);
void add_lookups(std::vector<Operation>& all);
void add_transforms(std::vector<Operation>& all);

// Of a device whose rule is number `hypothesis` of each operation's, or the last where there are fewer.
[[nodiscard]] OperationReplies answers_by(std::size_t hypothesis);

}  // namespace strata::probe
