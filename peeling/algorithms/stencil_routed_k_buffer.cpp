// peeling/algorithms/stencil_routed_k_buffer.cpp - eight fragments per pass, each routed by the stencil test to a
// sample of its own, sorted after the passes. Myers and Bavoil 2007, compared in Carr, Mech and Miller 2008, section 2;
// peeling/reference/algorithms.md 13.
//
// Needs      8-sample colour, depth and stencil targets, sample masks; every fragment covers all samples.
// Passes     ceil(M / 8) for M fragments at the deepest pixel, at most 31. Of equal depths all are composited, the
//            first submitted in front.
// Invariant  after pass p sample s holds fragment 8 p + s of its pixel, in submission order; the last sample's stencil
//            is 0 where further fragments followed.
#include <vector>

#include "peeling/algorithms/entry.h"
#include "peeling/programs/depth_range.h"
#include "peeling/programs/fixed_passes/sample_lists.h"
#include "pipeline/region/region_shortcuts.h"

namespace strata::peeling::listing::stencil_routed_k_buffer {

using namespace pipeline;

namespace {

constexpr int pass_samples = 8;  // one fragment per sample
constexpr int most_passes = 31;  // the stencil of the last sample starts at 8 - 1 + 2 + 8 p, which must be <= 255

struct CaptureTargets {
    Target color, depth;
};

// Every fragment decrements all stencils, saturating at 0; the sample whose stencil is 2 stores it.
CaptureTargets capture(Region& region, Target stencil, int pass) {
    const CaptureTargets into{region.make(region.frame().color_format, pass_samples),
                              region.make(target_format(region.frame().key_request().format), pass_samples)};
    region.set_name(into.color, "samples_color");
    region.set_name(into.depth, "samples_depth");
    region.clear(into.depth, {.depth = 1.0f});  // the depth of a sample that stays empty: no visible fragment has it
    for (int s = 0; s < pass_samples; ++s)
        region.clear(stencil, {.stencil = static_cast<std::uint8_t>(s + 2 + pass_samples * pass)},
                     static_cast<std::uint8_t>(1u << s));
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::always, .write = true};
    state.depth_target = into.depth;
    state.stencil = {.enabled = true,
                     .front = {.func = CompareFunc::equal,
                               .ref = 2,
                               .fail = StencilOp::decr,
                               .depth_fail = StencilOp::decr,
                               .pass = StencilOp::decr},
                     .back = {}};
    state.stencil_target = stencil;
    state.color[0] = into.color;
    state.reads[0] = region.opaque_depth();
    state.needs = code_with_color;
    state.selection = {.keeps = KeptFragments::submitted,
                       .far = {KeyBound::beyond(region.opaque_depth())},
                       .first_submitted = static_cast<std::uint32_t>(pass_samples * pass)};
    static_cast<void>(region.draw(state, [](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        keep_before(in, loads.depth(0), out);  // before the stencil test: a hidden fragment takes no sample
        out.color[0] = in.color;
    }));
    return into;
}

// Pixels that have more than eight fragments left in the last pass.
Count overflowing(Region& region, Target stencil) {
    PassState state;
    state.stencil = {.enabled = true, .front = {.func = CompareFunc::equal, .ref = 0}, .back = {}};
    state.stencil_target = stencil;
    state.sample_mask = 1u << (pass_samples - 1);
    return region.full_screen(state, [](const FragmentBatch&, const Loads&, Outputs&) {}).passed;
}

// The planes of every sample that the passes have filled, in submission order.
std::vector<SamplePlanes> samples_of(const Region& region, const std::vector<CaptureTargets>& captures) {
    std::vector<SamplePlanes> samples;
    for (const CaptureTargets& c : captures)
        for (int s = 0; s < pass_samples; ++s)
            samples.push_back({region.storage(c.depth).depth(s), region.storage(c.color).texels(s)});
    return samples;
}

// A full-screen pass that loads every sample. It has more reads than a pass can name, so it runs here instead, and is
// counted in the statistics.
Target resolve(Region& region, const std::vector<CaptureTargets>& captures) {
    RegionShortcuts shortcuts{region};
    const Target result = region.make(region.frame().picture_format());
    region.set_name(result, "result");
    const std::uint32_t empty = rasterizer::max_code(region.frame().key_request().format);
    SampleLists columns{samples_of(region, captures), empty, region.profile().color_rounding()};
    const Texels background = region.storage(region.opaque_color()).texels(0);
    for (std::uint32_t pixel = 0; pixel < region.rect().area(); ++pixel) {
        shortcuts.store_pixel(result, pixel, columns.composite(pixel, background));
        if (!region.frame().trace) continue;
        for (const std::uint64_t word : columns.order())
            region.trace({pixel, static_cast<std::uint32_t>(word >> 32), 0, Side::front, false});
    }
    const auto bytes = [&](Target t) {
        return static_cast<std::uint64_t>(info(region.storage(t).format()).bytes_per_pixel) * region.rect().area();
    };
    shortcuts.count_passes({.full_screen = 1});
    shortcuts.count({.bytes_read = bytes(region.opaque_color()), .bytes_written = bytes(result)});
    for (const CaptureTargets& c : captures)
        shortcuts.count({.bytes_read = pass_samples * (bytes(c.color) + bytes(c.depth))});
    return result;
}

// The last sample's stencil has reached 0 where a fragment came after all samples were taken (algorithms.md 13).
void report_overflow(Region& region, Target stencil) {
    PixelSet lost{region};
    const std::uint32_t* const last = region.storage(stencil).stencil(pass_samples - 1);
    for (std::uint32_t pixel = 0; pixel < region.rect().area(); ++pixel)
        if (last[pixel] == 0) lost.add(pixel);
    lost.report(region, Fault::buffer_overflow,
                "more fragments than the passes have captured: the later ones are lost");
}

}  // namespace

void run(Region& region) {
    const Target stencil = region.make(Format::s8, pass_samples);
    region.set_name(stencil, "stencil");
    std::vector<CaptureTargets> captures;
    while (static_cast<int>(captures.size()) < most_passes && !region.limit_reached()) {
        region.begin_iteration();
        captures.push_back(capture(region, stencil, static_cast<int>(captures.size())));
        if (!region.any(overflowing(region, stencil), Idle::yes)) break;
    }
    if (!captures.empty()) report_overflow(region, stencil);
    region.publish(resolve(region, captures));
}

std::vector<Algorithm> entries() {
    return {Algorithm{.name = "stencil_routed_k_buffer",
                      .listed = 130,
                      .paper = "Myers and Bavoil 2007",
                      .section = "",
                      .summary = "eight fragments a pass, routed by the stencil test into samples, sorted afterwards",
                      .pass_formula = "ceil(M/8), M fragments",
                      .ties = TiePolicy::first,
                      .exact = true,
                      .compares_own_codes = true,
                      .run = run,
                      .features = {fragment_programs},
                      .samples = 8}};
}

}  // namespace strata::peeling::listing::stencil_routed_k_buffer
