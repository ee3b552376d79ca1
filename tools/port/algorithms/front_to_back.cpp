// tools/port/algorithms/front_to_back.cpp - one layer per pass, nearest first, to the last layer. Everitt 2001, Bavoil
// and Myers 2008; peeling/reference/algorithms.md 4. Passes: N + 1; it ends by an occlusion query of the peel.
#include <fmt/format.h>

#include <memory>

#include "tools/port/algorithms/frame.h"

namespace strata::port {

namespace {

// Layers are premultiplied, as UNDER needs them. After the first pass, fragments not behind the depth peeled before are
// discarded: equal depths are one layer.
constexpr auto peel_text = R"(
uniform sampler2D peeled_depth;
layout(location = 0) out vec4 layer;
vec4 premultiplied(vec4 c) {{ return {}; }}
void main() {{
#ifdef PEELS
    float z = stored(gl_FragCoord.z), peeled = texelFetch(peeled_depth, TEXEL, 0).r;
    if (!({})) discard;
#endif
    layer = premultiplied(shade());
}}
)";

constexpr auto copy_text = R"(
uniform sampler2D source;
layout(location = 0) out vec4 copied;
void main() { copied = texelFetch(source, ivec2(gl_FragCoord.xy), 0); }
)";

// The targets and programs of a run. The two depth buffers alternate: a pass tests against one and reads the other.
struct PeelTargets {
    JobInput input;
    Opaque opaque;
    std::array<Handle, 2> depth, peel;
    Handle layer, accumulated, under, query, first_program, next_program, under_program;
    FinalQuad finish;

    explicit PeelTargets(const JobInput& in)
        : input{in},
          opaque{in, in.formats.depth},
          depth{make_texture(in.formats.depth, in.size), make_texture(in.formats.depth, in.size)},
          layer{make_texture(in.formats.color, in.size)},
          accumulated{make_texture(in.formats.color, in.size)},
          under{make_framebuffer({accumulated.name()})},
          query{make_query()},
          under_program{make_full_screen_program(copy_text, {"source"})},
          finish{in, "front.a"} {
        const std::string text = fmt::format(peel_text, in.settings.premultiplied, in.settings.behind);
        first_program = in.scene.make_program(text);
        next_program =
            in.scene.make_program("#define PEELS\n" + stored_text(in.formats.depth) + text, {"peeled_depth"});
        for (std::size_t i = 0; i < 2; ++i) peel[i] = make_framebuffer({layer.name()}, depth[i].name());
    }
    // The depth that pass number `pass` writes.
    [[nodiscard]] std::size_t nearest(int pass) const {
        return input.settings.swaps ? static_cast<std::size_t>(pass) % 2 : 0;
    }
};

// Pass number `pass`: draws the nearest layer behind that of the previous pass. Returns the samples that passed.
std::uint64_t peel_layer(const PeelTargets& t, int pass) {
    const std::size_t nearest = t.nearest(pass);
    t.opaque.copy_depth_to(t.peel[nearest]);
    glBindFramebuffer(GL_FRAMEBUFFER, t.peel[nearest].name());
    glClearBufferfv(GL_COLOR, 0, zero.data());
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(t.input.settings.depth_func);
    bind({t.depth[1 - nearest].name()});
    glUseProgram((pass == 0 ? t.first_program : t.next_program).name());
    glBeginQuery(GL_SAMPLES_PASSED, t.query.name());
    t.input.scene.draw();
    glEndQuery(GL_SAMPLES_PASSED);
    return samples_passed(t.query);
}

// UNDER: the layer is multiplied by the transmittance in destination alpha, which is then multiplied by 1 - alpha.
void blend_under(const PeelTargets& t) {
    if (t.input.settings.sampled.layers_resolved) resolve_in_place(t.layer.name(), t.input.formats.color, t.input.size);
    glBindFramebuffer(GL_FRAMEBUFFER, t.under.name());
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    const auto& factors = t.input.settings.under;
    glBlendFuncSeparate(factors[0], factors[1], factors[2], factors[3]);
    bind({t.layer.name()});
    draw_full_screen(t.under_program);
}

// The depth of the first pass is the pack's nearest.1; the other one does not exist before the second.
void show(const PeelTargets& t, const std::string& kind, int pass, std::optional<std::uint64_t> query, Record* record) {
    const TargetFormats& formats = t.input.formats;
    const NamedTexture layer{"layer", t.layer.name(), formats.color},
        accumulated{"accumulated", t.accumulated.name(), formats.color},
        first{"nearest.1", t.depth[0].name(), formats.depth}, second{"nearest", t.depth[1].name(), formats.depth};
    if (pass == 0)
        show_pass(record, t.input.size, kind, {layer, first, accumulated}, query);
    else
        show_pass(record, t.input.size, kind, {layer, first, second, accumulated}, query);
}

// Peels to the last layer, or to `max_passes` geometry passes. Returns the number of geometry passes, including the
// empty last one.
int front_to_back(const PeelTargets& t, int max_passes, PixelCodes& picture, Record* record) {
    t.opaque.draw(t.input.scene);
    const std::array<float, 4> transparent{0, 0, 0, t.input.settings.transmittance_start};
    glBindFramebuffer(GL_FRAMEBUFFER, t.under.name());
    glClearBufferfv(GL_COLOR, 0, transparent.data());
    int passes = 0;
    for (bool left = true; left && passes < max_passes; ++passes) {
        const std::uint64_t drawn = peel_layer(t, passes);
        left = drawn > t.input.settings.query_limit;
        show(t, "geometry", passes, drawn, record);
        if (left) blend_under(t);
        show(t, "full_screen", passes, {}, record);  // blended for an empty layer, too, which is neutral
        if (keeps_layers(record) && drawn > 0)
            record->layers.push_back(
                {read_back(t.layer.name(), t.input.formats.color, t.input.size),
                 read_back(t.depth[t.nearest(passes)].name(), t.input.formats.depth, t.input.size)});
    }
    t.finish.draw(t.accumulated.name(), t.opaque.color(), picture, record);
    return passes;
}

}  // namespace

Job front_to_back_job(const JobInput& input) {
    const auto t = std::make_shared<PeelTargets>(input);
    return {"front_to_back", [t](PixelCodes& picture, int max_passes, Record* record) {
                // A port that loses its last layer knows the number of layers: the empty pass is not one.
                const int lost = t->input.settings.passes_left_out;
                if (lost > 0) max_passes = front_to_back(*t, max_passes, picture, nullptr) - 1 - lost;
                return front_to_back(*t, max_passes, picture, record);
            }};
}

}  // namespace strata::port
