// pipeline/geforce3/texture_shader_state.cpp - decides which stages are consistent, and which coordinates they read
// (NV_texture_shader 3.8.13.2).
#include "pipeline/geforce3/texture_shader.h"

namespace strata::pipeline {
namespace {

enum class Result : std::uint8_t { none, texel, scalar };  // the result of a stage that a later stage can use

// True if there is a texture and its target is that of the operation.
bool is_complete(const BoundTexture& texture, TextureTarget target) {
    if (texture.color != nullptr) return texture.color->target == target;
    if (texture.hilo != nullptr) return texture.hilo->target == target;
    return texture.is_depth() && texture.compare.target == target;
}

bool is_dot(ShaderOp op) {
    return op == ShaderOp::dot_product || op == ShaderOp::dot_product_texture_2d ||
           op == ShaderOp::dot_product_texture_rectangle || op == ShaderOp::dot_product_depth_replace;
}

bool is_lookup(ShaderOp op) {
    return op == ShaderOp::texture_2d || op == ShaderOp::texture_rectangle || op == ShaderOp::dot_product_texture_2d ||
           op == ShaderOp::dot_product_texture_rectangle;
}

TextureTarget target_of(ShaderOp op) {
    return op == ShaderOp::texture_2d || op == ShaderOp::dot_product_texture_2d ? TextureTarget::two_d
                                                                                : TextureTarget::rectangle;
}

Result result_of(ShaderOp op) {
    if (is_lookup(op)) return Result::texel;
    return op == ShaderOp::dot_product ? Result::scalar : Result::none;
}

// `before` has the operations of earlier stages in effect: a stage that is not consistent provides nothing to later
// ones.
bool is_consistent(const ShaderStages& stages, const ShaderOps& before, std::size_t stage) {
    const ShaderStage& s = stages[stage];
    if (is_lookup(s.op) && !is_complete(s.texture, target_of(s.op))) return false;
    if (!is_dot(s.op)) return true;
    const bool has_input = s.previous >= 0 && static_cast<std::size_t>(s.previous) < stage &&
                           result_of(before[static_cast<std::size_t>(s.previous)]) == Result::texel;
    if (s.op == ShaderOp::dot_product) return has_input;
    // A comparison needs an r, which a dependent lookup does not have.
    return has_input && result_of(before[stage - 1]) == Result::scalar && !s.texture.is_depth();
}

}  // namespace

ShaderOps consistent_operations(const ShaderStages& stages) {
    ShaderOps ops{};
    for (std::size_t stage = 0; stage < stages.size(); ++stage)
        ops[stage] = is_consistent(stages, ops, stage) ? stages[stage].op : ShaderOp::none;
    return ops;
}

bool replaces_depth(const ShaderOps& ops) noexcept {
    for (const ShaderOp op : ops)
        if (op == ShaderOp::dot_product_depth_replace) return true;
    return false;
}

// Coordinates that no operation uses are not interpolated (pipeline/reference/texture-shader.md 8).
rasterizer::UnitMask coordinates_of(const ShaderStages& stages, const ShaderOps& ops) noexcept {
    constexpr unsigned s = 1, t = 2, r = 4, q = 8;
    unsigned mask = 0;
    for (std::size_t stage = 0; stage < ops.size(); ++stage) {
        const BoundTexture& texture = stages[stage].texture;
        const bool compares_r = texture.is_depth() && texture.reference == CompareReference::r_over_q;
        unsigned own = 0;
        switch (ops[stage]) {
            case ShaderOp::none: break;
            case ShaderOp::texture_2d:
            case ShaderOp::texture_rectangle: own = s | t | q | (compares_r ? r : 0u); break;
            case ShaderOp::pass_through:
            case ShaderOp::cull_fragment: own = s | t | r | q; break;
            case ShaderOp::dot_product:
            case ShaderOp::dot_product_texture_2d:
            case ShaderOp::dot_product_texture_rectangle:
            case ShaderOp::dot_product_depth_replace: own = s | t | r; break;
        }
        mask |= own << (4 * stage);
    }
    return static_cast<rasterizer::UnitMask>(mask);
}

}  // namespace strata::pipeline
