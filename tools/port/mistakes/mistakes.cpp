// tools/port/mistakes/mistakes.cpp - the mistakes that the port makes on request: a name, the algorithm that shows it,
// a sentence, and the settings that it changes. They were listed without looking at the oracle's catalogue.
#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "tools/port/port_settings.h"

namespace strata::port {

namespace {

const std::vector<PortMistake> all{
    // Vertices and the frame
    {"flipped_rows", "front_to_back", "no glClipControl: row 0 of memory is the bottom",
     [](PortSettings& w) { w.origin = GL_LOWER_LEFT; }},
    {"other_clip_range", "front_to_back", "glClipControl sets another range of clip depths than the matrices have",
     [](PortSettings& w) { w.other_clip_depth = true; }},
    {"half_pixel", "front_to_back", "positions moved by half a pixel, as Direct3D 9 wanted it",
     [](PortSettings& w) { w.shift_px = 0.5f; }},
    {"scissor_left_on", "front_to_back", "the scissor rectangle of an earlier pass is still on",
     [](PortSettings& w) { w.scissored = true; }},
    {"culling_left_on", "front_to_back", "GL_CULL_FACE is still on for surfaces with two sides",
     [](PortSettings& w) { w.culling = Culling::always_back; }},
    {"front_culled", "dual", "the front faces are culled, everywhere",
     [](PortSettings& w) { w.culling = Culling::always_front; }},
    {"last_triangle_lost", "front_to_back", "the count of indices of each draw call is short by three",
     [](PortSettings& w) { w.indices_left_out = 3; }},
    {"colors_in_bytes", "front_to_back", "vertex colours are uploaded as normalised bytes",
     [](PortSettings& w) { w.colors_in_bytes = true; }},
    {"flat_colors", "front_to_back", "colours are `flat`: those of the last corner of each triangle",
     [](PortSettings& w) { w.interpolation = "flat"; }},
    {"no_perspective", "front_to_back", "colours are `noperspective`",
     [](PortSettings& w) { w.interpolation = "noperspective"; }},
    {"sides_exchanged", "front_to_back", "the colours of front and back are exchanged",
     [](PortSettings& w) { w.is_front = "!gl_FrontFacing"; }},
    {"all_samplers_at_unit_0", "dual", "no glUniform1i: every sampler reads texture unit 0",
     [](PortSettings& w) { w.units_set = false; }},
    {"neighbour_texel", "front_to_back",
     "half a pixel is added to gl_FragCoord, which has it already: the depth of the neighbour is read",
     [](PortSettings& w) { w.texel = "ivec2(gl_FragCoord.xy + 0.5)"; }},
    // Depth
    {"less_equal", "front_to_back", "GL_LEQUAL for GL_LESS: the last of equal depths wins",
     [](PortSettings& w) { w.depth_func = GL_LEQUAL; }},
    {"nearest_again", "front_to_back", "a fragment at the peeled depth is kept: every pass finds the same layer",
     [](PortSettings& w) { w.behind = "z >= peeled"; }},
    {"depth_epsilon", "front_to_back", "0.001 is added to the peeled depth against \"z-fighting\"",
     [](PortSettings& w) { w.behind = "z > peeled + 0.001"; }},
    {"depth_16", "front_to_back", "the depth buffers have 16 bits", [](PortSettings& w) { w.depth = &d16; }},
    {"half_min_max", "dual", "the min-max depths are half floats", [](PortSettings& w) { w.min_max = rg16f; }},
    {"min_max_cleared_to_0", "dual", "the min-max depths are cleared to (0, 0)",
     [](PortSettings& w) { w.empty_min_max = {}; }},
    {"opaque_ignored", "front_to_back", "no test against the opaque depth: hidden surfaces shine through",
     [](PortSettings& w) { w.opaque_tested = false; }},
    // Colours and blending
    {"straight_layers", "front_to_back", "layers are not multiplied with their alpha",
     [](PortSettings& w) { w.premultiplied = "c"; }},
    {"alpha_twice", "front_to_back", "layers are multiplied by their alpha in the shader and again by the blend",
     [](PortSettings& w) { w.premultiplied = "vec4(c.rgb * c.a * c.a, c.a)"; }},
    {"back_premultiplied", "dual", "dual's far layer is premultiplied and then blended with GL_SRC_ALPHA",
     [](PortSettings& w) { w.back_layer = "vec4(color.rgb * color.a, color.a)"; }},
    {"cleared_to_opaque", "front_to_back", "the accumulated alpha is cleared to 0, as colours are",
     [](PortSettings& w) { w.transmittance_start = 0; }},
    {"under_not_separate", "front_to_back", "glBlendFunc(GL_DST_ALPHA, GL_ONE) for alpha as well",
     [](PortSettings& w) {
         w.under = {GL_DST_ALPHA, GL_ONE, GL_DST_ALPHA, GL_ONE};
     }},
    {"over_for_under", "front_to_back", "layers from the nearest on are blended with OVER's factors",
     [](PortSettings& w) {
         w.under = {GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE_MINUS_SRC_ALPHA};
     }},
    {"factors_exchanged", "dual", "the factors of OVER are exchanged",
     [](PortSettings& w) {
         w.over = {GL_ONE_MINUS_SRC_ALPHA, GL_SRC_ALPHA};
     }},
    {"front_discarded", "dual", "fragments between the ends are discarded: the front colour of the pixel is lost",
     [](PortSettings& w) { w.at_neither_end = "discard"; }},
    {"min_for_max", "dual", "GL_MIN for GL_MAX", [](PortSettings& w) { w.min_max_equation = GL_MIN; }},
    {"alpha_squared", "weighted_average", "sums of colours times alpha squared",
     [](PortSettings& w) { w.premultiplied = "vec4(c.rgb * c.a, c.a) * c.a"; }},
    {"sums_in_bytes", "weighted_average", "the sums are kept in 8 bits, and saturate",
     [](PortSettings& w) { w.sums[0] = &rgba8; }},
    {"count_in_a_byte", "weighted_average", "fragments are counted in 8 normalised bits, and saturate at 1",
     [](PortSettings& w) { w.sums[1] = &r8; }},
    {"background_lost", "front_to_back", "the result is composited over black instead of the background",
     [](PortSettings& w) { w.background_used = false; }},
    {"srgb_twice", "front_to_back", "the finished picture is encoded to sRGB again",
     [](PortSettings& w) { w.encoded_again = true; }},
    {"red_for_blue", "front_to_back", "the picture is read back as GL_BGRA",
     [](PortSettings& w) { w.channel_order = GL_BGRA; }},
    // Passes
    {"last_layer_lost", "front_to_back", "the loop ends before the last layer is composited",
     [](PortSettings& w) { w.passes_left_out = 1; }},
    {"query_above_1", "front_to_back", "the peel ends where a pass draws one sample",
     [](PortSettings& w) { w.query_limit = 1; }},
    {"not_swapped", "dual", "the two min-max targets are not swapped", [](PortSettings& w) { w.swaps = false; }},
    {"stencil_wraps", "coherent_stencil", "GL_INCR_WRAP for GL_INCR",
     [](PortSettings& w) { w.stencil_increment = GL_INCR_WRAP; }},
    {"stencil_cleared", "coherent_stencil", "the stencil is cleared before the second pass, as before every other one",
     [](PortSettings& w) { w.stencil_kept = false; }},
    {"shadow_sense", "depth_units", "GL_LESS for GL_GREATER in the shadow compare",
     [](PortSettings& w) { w.shadow_compare = GL_LESS; }},
};

const std::vector<PortMistake> of_samples{
    {"layers_resolved", "front_to_back", "every layer and the background are resolved, then composited once per pixel",
     [](PortSettings& w) { w.sampled.layers_resolved = w.sampled.opaque_resolved = true; }},
    {"peels_sample_0", "front_to_back", "texelFetch(..., 0): the peel compares all samples with the depth of sample 0",
     [](PortSettings& w) { w.sampled.loads.geometry = "0"; }},
    {"composites_sample_0", "front_to_back", "the full-screen passes load sample 0 for all samples",
     [](PortSettings& w) { w.sampled.loads.full_screen = "0"; }},
    {"no_sample_shading", "front_to_back", "programs run once per pixel, at its centre, and load sample 0",
     [](PortSettings& w) { w.sampled.shading = ShadingRate::pixel; }},
    {"list_of_pixel", "linked_list", "a fragment is stored once per pixel, without its coverage mask",
     [](PortSettings& w) { w.sampled.shading = ShadingRate::pixel; }},
    {"alpha_to_coverage", "weighted_average", "GL_SAMPLE_ALPHA_TO_COVERAGE left enabled by an earlier foliage pass",
     [](PortSettings& w) { w.sampled.alpha_to_coverage = true; }},
    {"mask_left_set", "front_to_back", "GL_SAMPLE_MASK of an earlier pass is still on, with samples 0 and 1",
     [](PortSettings& w) { w.sampled.mask = 3; }},
    {"shows_sample_0", "dual", "the picture is sample 0, not the resolve of all",
     [](PortSettings& w) { w.sampled.shown = 0; }},
    {"resolved_in_linear_light", "dual", "the picture of sRGB values is resolved with GL_FRAMEBUFFER_SRGB",
     [](PortSettings& w) { w.sampled.resolves_linear_light = true; }},
    {"opaque_resolved", "dual", "the opaque picture is resolved before the transparent one is composited over it",
     [](PortSettings& w) { w.sampled.opaque_resolved = true; }},
    {"opaque_depth_of_sample_0", "dual", "all samples are tested against the opaque depth of sample 0",
     [](PortSettings& w) { w.sampled.first_opaque_depth = true; }},
};

}  // namespace

const std::vector<PortMistake>& mistakes() { return all; }
const std::vector<PortMistake>& sampled_mistakes() { return of_samples; }

PortSettings settings_with(const std::string& names) {
    PortSettings settings;
    std::istringstream words(names);
    for (std::string word; std::getline(words, word, ',');) {
        const auto is_named = [&](const PortMistake& m) { return word == m.name; };
        const bool is_of_samples = std::ranges::any_of(of_samples, is_named);
        const std::vector<PortMistake>& list = is_of_samples ? of_samples : all;
        const auto found = std::ranges::find_if(list, is_named);
        if (found == list.end())
            throw std::invalid_argument("--mistake: expected a name that --mistakes lists, found '" + word + "'");
        found->make(settings);
    }
    return settings;
}

}  // namespace strata::port
