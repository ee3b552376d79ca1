// peeling/algorithms/fixed_passes/moments.cpp - pass 1 sums power moments of the absorbance over depth, pass 2 weights
// each fragment by the transmittance in front of it that the moments imply. Muenstermann et al. 2018, "Moment-Based
// Order-Independent Transparency", sections 3 and 4; peeling/reference/algorithms.md 22.
//
// Needs      binary32 additive blending, up to three render targets. moments_quantized: STRATA_ordered_rmw, because no
//            blend adds transformed 16-bit moments.
// Passes     2. An approximation: the transmittance of all fragments together is exact except for rounding, its
//            distribution over depth is reconstructed from the moments.
// Invariant  with the absorbance A = -log(1 - a) and z = 2 d - 1, where d is the window depth: after pass 1, total =
//            sum of A, moments = sums of A z, A z^2 ...
#include <array>

#include "peeling/algorithms/entry.h"
#include "peeling/programs/fixed_passes/moment_bound.h"
#include "peeling/programs/fixed_passes/moment_quantization.h"
#include "peeling/programs/fixed_passes/weighted.h"
#include "peeling/programs/sums.h"
#include "rasterizer/base/log_exp.h"

namespace strata::peeling::listing::moments {

using namespace pipeline;

namespace {

constexpr float least_through = 0x1p-24f;  // least transmittance of a fragment: that of an opaque one, 0, has no finite
                                           // absorbance

// The moments of a fixed distribution, of which a small share is mixed into those of every pixel, so that rounding
// cannot make the Hankel matrix indefinite; and the share.
constexpr std::array<double, 8> fixed_4{0, 0.375, 0, 0.375}, fixed_6{0, 0.48, 0, 0.451, 0, 0.45},
    fixed_8{0, 0.75, 0, 0.67666666666666664, 0, 0.63, 0, 0.60030303030303034}, fixed_4_quantized{0, 0.628, 0, 0.628},
    fixed_6_quantized{0, 0.5566, 0, 0.489, 0, 0.47869382},
    fixed_8_quantized{0, 0.42474916387959866, 0, 0.22407802675585284, 0, 0.15369230769230768, 0, 0.12900440529089119};
enum class MomentStorage : std::uint8_t { sums, quantized };
struct Bias {
    const std::array<double, 8>& of;
    double share;
};
Bias bias_of(const AlgorithmOptions& options, MomentStorage stored) {
    const bool is_16 = stored == MomentStorage::quantized;
    const auto by_count = [&](const auto& four, const auto& six, const auto& eight) -> const auto& {
        return options.moments == 4 ? four : options.moments == 6 ? six : eight;
    };
    const float usual = is_16 ? by_count(6e-5f, 6e-4f, 2.5e-3f) : by_count(5e-7f, 5e-6f, 5e-5f);
    return {
        is_16 ? by_count(fixed_4_quantized, fixed_6_quantized, fixed_8_quantized) : by_count(fixed_4, fixed_6, fixed_8),
        static_cast<double>(options.moment_bias.value_or(usual))};
}

struct MomentTargets {
    int moments = 4;
    MomentStorage stored = MomentStorage::sums;
    Target total{};
    std::array<Target, 2> powers{};  // A z, A z^2 ...: four in the first, the others in the second
    [[nodiscard]] std::size_t targets() const noexcept { return moments > 4 ? 2 : 1; }
};

MomentTargets make_targets(Region& region, int count, MomentStorage stored) {
    MomentTargets t{count, stored, region.make(Format::r32f), {region.make(Format::rgba32f)}};
    if (count > 4) t.powers[1] = region.make(count == 6 ? Format::rg32f : Format::rgba32f);
    region.set_name(t.total, "total");
    region.clear(t.total, {});
    for (std::size_t i = 0; i < t.targets(); ++i) {
        region.set_name(t.powers[i], "moments");
        region.clear(t.powers[i], {});
    }
    return t;
}

PassState visible_state(const Region& region) {
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = false};
    state.depth_target = region.opaque_depth();
    state.needs.code = false;
    return state;
}

float place_of(const Frame& frame, float shader_z) noexcept {
    return 2.0f * depth_behind_near(is_reversed(frame), shader_z) - 1.0f;
}

// Pass 1, in binary32: each power is the previous one times z.
void add_moments(Region& region, const MomentTargets& t) {
    PassState state = visible_state(region);
    state.color = {t.total, t.powers[0], t.powers[1]};
    state.blend = {blend_mode::sum, blend_mode::sum, t.targets() > 1 ? blend_mode::sum : Blend{}};
    const Frame& frame = region.frame();
    static_cast<void>(region.draw(state, [&](const FragmentBatch& in, const Loads&, Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const float absorbance = minus_log(std::max(1.0f - in.color[3][i], least_through));
            const float z = place_of(frame, in.shader_z[i]);
            for (std::size_t c = 0; c < 4; ++c) out.color[0][c][i] = absorbance;
            float power = 1.0f;
            for (std::size_t m = 0; m < 4 * t.targets(); ++m) {
                power = power * z;
                out.color[1 + m / 4][m % 4][i] = absorbance * power;
            }
        }
    }));
}

// Pass 1 with 16 bits a moment: the program reads the total and the moments of its pixel and writes the new ones, in
// submission order.
void add_quantized_moments(Region& region, const MomentTargets& t) {
    PassState state = visible_state(region);
    state.color = {t.total, t.powers[0], t.powers[1]};
    state.reads = {t.total, t.powers[0], t.powers[1]};
    state.ordered_rmw = true;
    const Frame& frame = region.frame();
    const auto count = static_cast<std::size_t>(t.moments);
    static_cast<void>(region.draw(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const float absorbance = minus_log(std::max(1.0f - in.color[3][i], least_through));
            const float total = loads.color(0)[0][i];
            MomentValues stored{};
            for (std::size_t m = 0; m < count; ++m) stored[m] = loads.color(static_cast<int>(1 + m / 4))[m % 4][i];
            if (total + absorbance > 0.0f)
                stored = with_fragment(stored, count, total, absorbance, place_of(frame, in.shader_z[i]));
            for (std::size_t c = 0; c < 4; ++c) out.color[0][c][i] = total + absorbance;
            for (std::size_t m = 0; m < 4 * t.targets(); ++m) out.color[1 + m / 4][m % 4][i] = stored[m];
        }
    }));
}

// The normalized moments at lane i; those of powers 1, 2 ... begin at index 1.
Moments load_moments(const MomentTargets& t, const Loads& loads, std::size_t i) {
    const auto count = static_cast<std::size_t>(t.moments);
    MomentValues values{};
    for (std::size_t m = 0; m < count; ++m) values[m] = loads.color(static_cast<int>(1 + m / 4))[m % 4][i];
    if (t.stored == MomentStorage::quantized) values = restored(values, count);
    Moments b{1};
    for (std::size_t m = 0; m < count; ++m)
        b[m + 1] = static_cast<double>(t.stored == MomentStorage::sums ? values[m] / loads.color(0)[0][i] : values[m]);
    return b;
}

// The transmittance in front of depth z at lane i.
float through(const MomentTargets& t, const Loads& loads, std::size_t i, float z, const Bias& bias,
              double overestimation) {
    const float total = loads.color(0)[0][i];
    if (!(total > 0.0f)) return 1.0f;
    Moments b = load_moments(t, loads, i);
    for (std::size_t m = 0; m < static_cast<std::size_t>(t.moments); ++m)
        b[m + 1] = (1.0 - bias.share) * b[m + 1] + bias.share * bias.of[m];
    const double share = share_before(b, static_cast<std::size_t>(t.moments), static_cast<double>(z), overestimation);
    return exp_of_minus(total * static_cast<float>(share));
}

// Pass 2 sums (c w, w), where w is alpha times the transmittance in front of the fragment.
void accumulate(Region& region, const MomentTargets& t, const AlgorithmOptions& options, Target sums) {
    region.clear(sums, {});
    PassState state = visible_state(region);
    state.color[0] = sums;
    state.blend[0] = blend_mode::sum;
    state.reads = {t.total, t.powers[0], t.powers[1]};
    const Frame& frame = region.frame();
    const Bias bias = bias_of(options, t.stored);
    static_cast<void>(region.draw(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const float z = place_of(frame, in.shader_z[i]);
            const float weight =
                in.color[3][i] * through(t, loads, i, z, bias, static_cast<double>(options.overestimation));
            for (std::size_t c = 0; c < 3; ++c) out.color[0][c][i] = in.color[c][i] * weight;
            out.color[0][3][i] = weight;
        }
    }));
}

// Resolves the sums. The transmittance over the background is exp(-total), or 0 if the total is at least the absorbance
// of an opaque fragment.
void composite(Region& region, Target sums, Target total, Target result) {
    PassState state;
    state.color[0] = result;
    state.reads = {sums, total, region.opaque_color()};
    static_cast<void>(region.full_screen(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        Lanes<float> all;
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const float absorbance = loads.color(1)[0][i];
            all[i] = absorbance >= minus_log(least_through) ? 0.0f : exp_of_minus(absorbance);
        }
        resolve_weighted(loads.color(0), loads.color(0)[3], all, loads.color(2), out.color[0], lanes(in));
    }));
}

void run_with(Region& region, const ListingInputs& inputs, MomentStorage stored) {
    const MomentTargets t = make_targets(region, inputs.options.moments, stored);
    const Target sums = make_sums(region);
    const Target result = region.make(region.frame().picture_format());
    region.set_name(sums, "sums");
    region.set_name(result, "result");
    region.begin_iteration();
    if (stored == MomentStorage::sums)
        add_moments(region, t);
    else
        add_quantized_moments(region, t);
    accumulate(region, t, inputs.options, sums);
    composite(region, sums, t.total, result);
    region.publish(result);
}

void run(Region& region, const ListingInputs& inputs) { run_with(region, inputs, MomentStorage::sums); }
void run_quantized(Region& region, const ListingInputs& inputs) { run_with(region, inputs, MomentStorage::quantized); }

}  // namespace

std::vector<Algorithm> entries() {
    const Algorithm moments{
        .name = "moments",
        .listed = 220,
        .paper = "Muenstermann et al. 2018",
        .section = "Moment-Based Order-Independent Transparency",
        .summary = "absorbance as 4, 6 or 8 power moments of depth, then colours by what they are seen through",
        .pass_formula = "2",
        .ties = TiePolicy::none,
        .key = DepthKey::shader_z,
        .geometry_passes = two_passes,
        .run_with = run,
        .features = {float_targets, fragment_programs},
        .render_targets = 2};
    Algorithm quantized = moments;
    quantized.name = "moments_quantized";
    quantized.listed = 221;
    quantized.summary = "moments in 16 bits each, transformed before they are rounded";
    quantized.run_with = run_quantized;
    quantized.features = {float_targets, fragment_programs, ordered_rmw};
    return {moments, quantized};
}

}  // namespace strata::peeling::listing::moments
