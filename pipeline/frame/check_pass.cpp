// pipeline/frame/check_pass.cpp - two kinds of rejection. A pass that no device could run is a programming error:
// std::logic_error (pipeline/reference/devices.md 9.3). A pass for which this profile lacks something is an outcome:
// Refused (devices.md 9.2).
#include "pipeline/frame/check_pass.h"

#include <algorithm>
#include <span>
#include <stdexcept>

namespace strata::pipeline {

namespace {

void require(bool holds, const char* what) {
    if (!holds) throw std::logic_error(std::string{"pass state: "} + what);
}

// True if the pass may write `t`. A write mask of 0 does not make a target readable: whether a pass is legal must not
// depend on write masks.
bool is_written(const PassState& state, Target t) {
    return std::find(state.color.begin(), state.color.end(), t) != state.color.end() ||
           (state.depth.enabled && state.depth.write && state.depth_target == t) ||
           (state.stencil.enabled && state.stencil_target == t);
}

void check_targets(const PassState& state, const std::vector<TargetStorage>& targets) {
    const auto format = [&](Target t) { return targets.at(static_cast<std::size_t>(t.id)).format(); };
    require(!state.depth.enabled || (state.depth_target.exists() && is_depth(format(state.depth_target))),
            "a depth test needs a depth target");
    require(!state.stencil.enabled || (state.stencil_target.exists() && has_stencil(format(state.stencil_target))),
            "a stencil test needs a stencil target");
    for (const Target t : state.color)
        require(!t.exists() || is_color(format(t)), "a colour output needs a colour target");
    int samples = 0;
    // A fragment covers the same samples of every target, so their sample counts must agree (fragment-stages.md 10.3).
    const auto agrees = [&](Target t) {
        const int own = targets.at(static_cast<std::size_t>(t.id)).samples();
        require(samples == 0 || own == samples, "targets of one pass have one number of samples");
        samples = own;
    };
    for (const Target t : {state.depth_target, state.stencil_target})
        if (t.exists()) agrees(t);
    for (const Target t : state.color)
        if (t.exists()) agrees(t);
    for (const DepthUnit& unit : std::span{state.depth_units}.first(static_cast<std::size_t>(state.depth_unit_count))) {
        require(unit.depth.exists() && is_depth(format(unit.depth)), "a depth unit needs a depth target");
        agrees(unit.depth);
    }
    // A texture lookup may reach any pixel, so an order among the fragments of one pixel cannot make a feedback loop
    // safe.
    for (const Target t : state.textures) {
        require(!t.exists() || is_depth(format(t)), "texture units sample depth targets");
        require(!t.exists() || !is_written(state, t), "a texture is sampled and written at once (a feedback loop)");
    }
    for (const Target t : state.reads)
        require(!t.exists() || state.ordered_rmw || !is_written(state, t),
                "a target is read and written at once (a feedback loop) without ordered_rmw");
}

// Stencil and depth writes would need an order of a pixel's samples, and a selection is of samples.
void check_once_a_pixel(const PassState& state) {
    require(!state.once_a_pixel || (!state.alpha.enabled && !state.stencil.enabled && !state.depth.write &&
                                    state.depth_unit_count == 0 && !state.replaces_depth && state.primitives.empty() &&
                                    state.sample_mask == 0xff && state.selection.keeps == KeptFragments::everything),
            "a pass once a pixel tests depth alone, without a write");
    require(!state.once_a_pixel || (!state.needs.texcoord && !state.needs.facing && !state.needs.exact_code &&
                                    !state.needs.reference && !state.needs.has_extras()),
            "the program of a pass once a pixel reads colour and depth");
}

void refuse_if(const DeviceProfile& profile, std::optional<Refusal> lacking) {
    if (lacking) throw Refused{profile, *std::move(lacking)};
}

}  // namespace

void check_pass(const DeviceProfile& profile, const PassState& state, const std::vector<TargetStorage>& targets) {
    check_targets(state, targets);
    check_once_a_pixel(state);
    // The checks are in the order of devices.md 9.2: if several features are missing, the first is reported. Outputs
    // without a target are not blended and not checked.
    std::vector<Blend> blends;
    for (std::size_t k = 0; k < state.color.size(); ++k) {
        if (!state.color[k].exists()) continue;
        refuse_if(profile, check(profile, targets[static_cast<std::size_t>(state.color[k].id)].format()));
        blends.push_back(state.blend[k]);
    }
    require(std::ranges::all_of(blends, [&](const Blend& b) { return b.logic_op == blends.front().logic_op; }),
            "targets of one pass have one logical operation");
    refuse_if(profile, check(profile, std::span<const Blend>{blends}));
    if (state.stencil.enabled) refuse_if(profile, check(profile, state.stencil));
    if (state.depth_unit_count > 0) refuse_if(profile, check(profile, Feature::sequential_depth_units));
    if (state.ordered_rmw) refuse_if(profile, check(profile, Feature::ordered_rmw));
}

}  // namespace strata::pipeline
