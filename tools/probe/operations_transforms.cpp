// tools/probe/operations_transforms.cpp - a matrix times a position in a vertex's program: by which products and sums, and whether the
// same in another program.
#include "rasterizer/base/fused.h"
#include "tools/probe/operation_numbers.h"

namespace strata::probe {

namespace {

// Column by column, 24 bits of each.
constexpr std::array<std::array<std::uint32_t, 4>, 4> matrix{{{0x3f3504f3, 0xbeb504f3, 0x3eb33333, 0x3d888889},
                                                              {0x3ecccccd, 0x3f4ccccd, 0xbf19999a, 0xbdcccccd},
                                                              {0xbf0ccccd, 0x3f266666, 0x3f333333, 0x3e4ccccd},
                                                              {0x3e19999a, 0xbe99999a, 0x40133333, 0x3fa66666}}};

std::string matrix_text() {
    std::string text;
    for (const auto& column : matrix) {
        text += text.empty() ? "" : ", ";
        text += "uintBitsToFloat(uvec4(";
        for (std::size_t row = 0; row < 4; ++row) text += (row == 0 ? "" : ", ") + std::to_string(column[row]) + "u";
        text += "))";
    }
    return "mat4(" + text + ")";
}

// `more`: what else the program does with the position.
std::string transform(const std::string& more) {
    return "highp uvec4 operation(highp uvec4 a) {\n"
           "    highp vec4 v = uintBitsToFloat(a);\n"
           "    highp mat4 m = " +
           matrix_text() + ";\n    highp vec4 p = m * v;\n" + more + "    return floatBitsToUint(p);\n}\n";
}

float product_of(std::size_t row, std::size_t column, const Words& v) {
    return as_float(matrix[column][row]) * as_float(v[column]);
}

// Each of the four results by `sum` of its row.
template <class Sum>
Hypothesis by(const char* name, Sum&& sum) {
    return {name, [sum](const Words& v) {
                Words result{};
                for (std::size_t row = 0; row < 4; ++row) result[row] = as_word(sum(row, v));
                return result;
            }};
}

float fused(std::size_t row, std::size_t column, const Words& v, float addend) {
    return rasterizer::fused_multiply_add(as_float(matrix[column][row]), as_float(v[column]), addend);
}

std::vector<Hypothesis> sums() {
    return {by("products rounded, added from x to w",
               [](std::size_t r, const Words& v) {
                   return ((product_of(r, 0, v) + product_of(r, 1, v)) + product_of(r, 2, v)) + product_of(r, 3, v);
               }),
            by("products rounded, added from w to x",
               [](std::size_t r, const Words& v) {
                   return ((product_of(r, 3, v) + product_of(r, 2, v)) + product_of(r, 1, v)) + product_of(r, 0, v);
               }),
            by("products rounded, added in pairs",
               [](std::size_t r, const Words& v) {
                   return (product_of(r, 0, v) + product_of(r, 1, v)) + (product_of(r, 2, v) + product_of(r, 3, v));
               }),
            by("fused from x to w",
               [](std::size_t r, const Words& v) {
                   return fused(r, 3, v, fused(r, 2, v, fused(r, 1, v, product_of(r, 0, v))));
               }),
            by("fused from w to x", [](std::size_t r, const Words& v) {
                return fused(r, 0, v, fused(r, 1, v, fused(r, 2, v, product_of(r, 3, v))));
            })};
}

Operation transformed(const char* name, const char* asks, Stage stage, const std::string& more) {
    Operation operation{
        .name = name, .asks = asks, .stage = stage, .body = transform(more), .lanes = 4, .in_units = true};
    Dice dice{51};
    for (int i = 0; i < 1024; ++i) {
        Words v{};
        for (std::size_t c = 0; c < 3; ++c)
            v[c] = as_word(static_cast<float>(static_cast<int>(dice.next() >> 8) - (1 << 23)) * 0x1p-21f);
        v[3] = as_word(i % 2 == 0 ? 1.0f : 0.5f + dice.unit());
        operation.inputs.push_back(v);
    }
    operation.hypotheses = sums();
    return operation;
}

// Uses the position, in a branch that no input takes, so that no compiler may leave it out.
constexpr auto lighting =
    "    highp float light = max(dot(normalize(v.xyz + vec3(1.0)), p.xyz), 0.0) + dot(p, v);\n"
    "    if (a.w == 0xffffffffu) p.x += light;\n";

}  // namespace

void add_transforms(std::vector<Operation>& all) {
    all.push_back(transformed("transform", "the sums of a matrix times a position", Stage::vertex, ""));
    all.push_back(transformed("transform-invariant", "the same, declared invariant", Stage::invariant_vertex, ""));
    all.push_back(transformed("transform-lit", "the same beside lighting", Stage::vertex, lighting));
    all.push_back(transformed("transform-lit-invariant", "the same beside lighting, declared invariant",
                              Stage::invariant_vertex, lighting));
}

}  // namespace strata::probe
