// peeling/algorithms/coherent_blend.cpp - coherent layer peeling, formulation B: one blended pass finds the nearest
// depth and the minimum before it. Each fragment that passes the LESS test moves the previous minimum from alpha to rgb
// and stores its own depth in alpha. Carr, Mech and Miller 2008, section 6;
// peeling/reference/algorithms.md 11, erratum E16.
//
// Needs      RGBA32F targets that blend, with separate factors for alpha; 8-bit stencil; a depth buffer that programs
//            can read.
// Passes     5 per iteration, and a last one that finds no fragment. n layers submitted near to far take ceil(n/128)
//            iterations, far to near ceil(n/2).
// Ties       Fragments of equal depth are all composited, the first submitted in front.
// Invariant  that of coherent_stencil, but the number of successive minima at a pixel (an 8-bit stencil counter there)
//            has no limit. After every draw alpha equals the value in the depth buffer.
#include "peeling/algorithms/entry.h"
#include "peeling/loops/coherent.h"
#include "peeling/programs/depth_float.h"

namespace strata::peeling::listing::coherent_blend {

using namespace pipeline;

namespace {

// rgb = 1 * destination alpha, which is the previous minimum; alpha = the new minimum. With the printed factors (ZERO,
// DST_ALPHA) rgb becomes the product of all previous minima: it is too small from the third update on, and peeling
// stalls at the pixel (E16).
Blend shift(bool published) {
    using enum BlendFactor;
    const BlendTerm as_printed{BlendEquation::add, zero, dst_alpha}, resolved{BlendEquation::add, dst_alpha, zero};
    return {.enabled = true, .color = published ? as_printed : resolved, .alpha = {BlendEquation::add, one, zero}};
}

DrawCounts find_nearest(CoherentPeel& peel) {
    Region& region = peel.region;
    region.clear(peel.nearest, {.depth = 1.0f});
    if (!peel.shifted.exists()) peel.shifted = region.make(Format::rgba32f);
    region.set_name(peel.shifted, "shifted");
    region.clear(peel.shifted, {.color = {1, 1, 1, 1}});
    PassState state = find_state(peel.nearest, CompareFunc::less);
    state.color[0] = peel.shifted;
    state.blend[0] = shift(peel.published);
    state.reads = {peel.reached, region.opaque_depth()};
    state.selection = select_remaining(peel);
    const DepthFormat format = region.frame().key_request().format;
    return region.draw(state, [&, format](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        keep_remaining(peel, in, loads, out);
        for (std::size_t c = 0; c < 3; ++c) std::fill_n(out.color[0][c].begin(), lanes(in), 1.0f);
        for (std::size_t i = 0; i < lanes(in); ++i) out.color[0][3][i] = depth_as_float(in.code[i], format);
    });
}

// Copies the red channel into the depth target `previous`, which the later passes share with coherent_stencil.
void find_previous(CoherentPeel& peel) {
    PassState state = find_state(peel.previous, CompareFunc::always);
    state.reads[0] = peel.shifted;
    const DepthFormat format = peel.region.frame().key_request().format;
    static_cast<void>(
        peel.region.full_screen(state, [format](const FragmentBatch& in, const Loads& loads, Outputs& out) {
            out.replaces_depth = true;
            for (std::size_t i = 0; i < lanes(in); ++i) out.depth[i] = depth_as_code(loads.color(0)[0][i], format);
        }));
}

}  // namespace

const FirstPasses passes{.geometry_passes = 1, .find_nearest = find_nearest, .find_previous = find_previous};

void run(Region& region) { peel_coherently(region, passes); }

std::vector<Algorithm> entries() {
    return {Algorithm{
        .name = "coherent_blend",
        .listed = 110,
        .paper = "Carr, Mech and Miller 2008",
        .section = "section 6 (B)",
        .summary =
            "coherent_stencil with blending into a float target in place of the passes that find the previous minimum",
        .pass_formula = "1 + 5 an iteration",
        .ties = TiePolicy::first,
        .exact = true,
        .compares_own_codes = true,
        .has_published_form = true,
        .run = run,
        .features = {float_targets, fragment_programs, separate_alpha_blend}}};
}

}  // namespace strata::peeling::listing::coherent_blend
