// tools/port/algorithms/dual.cpp - the nearest and the farthest layer per pass, under one MAX equation, to the last
// layer. Bavoil and Myers 2008; peeling/reference/algorithms.md 5. Passes: 1 + max(1, ceil(N/2)); it ends by a query of
// the pixels whose min-max depth is not empty.
#include <fmt/format.h>

#include <memory>

#include "tools/port/algorithms/frame.h"

namespace strata::port {

namespace {

// The first pass: each fragment's depth as both ends. Min-max depths are stored as (-near, far), so that one MAX serves
// both; (-1, -1) is below any depth and means empty.
constexpr auto min_max_text = R"(
layout(location = 0) out vec2 min_max;
void main() {
    float z = gl_FragCoord.z;
    if (hidden(z)) discard;
    min_max = vec2(-z, z);
}
)";

// Nothing is discarded: the front colour is kept under MAX because every fragment writes it (E13).
constexpr auto dual_text = R"(
uniform sampler2D last_min_max;
uniform sampler2D last_front;
layout(location = 0) out vec2 min_max;
layout(location = 1) out vec4 front;
layout(location = 2) out vec4 back;
void main() {{
    float z = gl_FragCoord.z;
    vec2 range = texelFetch(last_min_max, TEXEL, 0).rg;
    float near = -range.x, far = range.y;
    min_max = vec2(-1.0);
    front = texelFetch(last_front, TEXEL, 0);
    back = vec4(0.0);
    if (hidden(z) || z < near || z > far) return;
    if (z > near && z < far) {{
        min_max = vec2(-z, z);
        {};
    }}
    vec4 color = shade();
    if (z == near) {{
        as_written float transmitted = 1.0 - front.a;
        as_written vec4 sum = vec4(front.rgb + transmitted * (color.a * color.rgb), 1.0 - transmitted * (1.0 - color.a));
        front = sum;
    }} else {{
        back = {};
    }}
}}
)";

// Blends the far layer of a pass into the back colours. A pixel without one has alpha 0 and is discarded.
constexpr auto blend_back_text = R"(
uniform sampler2D back;
layout(location = 0) out vec4 color;
void main() {
    color = texelFetch(back, ivec2(gl_FragCoord.xy), 0);
    if (color.a == 0.0) discard;
}
)";

// Passes one sample per pixel that has fragments between its ends; colour writes are masked. The query counts the
// samples.
constexpr auto what_is_left_text = R"(
uniform sampler2D min_max;
layout(location = 0) out vec4 color;
void main() {
    if (texelFetch(min_max, ivec2(gl_FragCoord.xy), 0).rg == vec2(-1.0)) discard;
    color = vec4(0.0);
}
)";

// The targets and programs of a run. Pairs of targets alternate: a pass reads one of each and writes the other.
struct DualResources {
    JobInput input;
    Opaque opaque;
    std::array<Handle, 2> min_max, front, initialize, peel;
    Handle back_dump, back, blend, query;
    Handle min_max_program, peel_program, blend_program, left_program;
    FinalQuad finish;

    explicit DualResources(const JobInput& in)
        : input{in},
          opaque{in, d32f},
          min_max{make_texture(in.settings.min_max, in.size), make_texture(in.settings.min_max, in.size)},
          front{make_texture(in.formats.color, in.size), make_texture(in.formats.color, in.size)},
          back_dump{make_texture(in.formats.color, in.size)},
          back{make_texture(in.formats.color, in.size)},
          blend{make_framebuffer({back.name()})},
          query{make_query()},
          min_max_program{
              in.scene.make_program(opaque.hidden_text() + min_max_text, {"unused_0", "unused_1", "opaque_depth"})},
          peel_program{in.scene.make_program(
              opaque.hidden_text() + fmt::format(dual_text, in.settings.at_neither_end, in.settings.back_layer),
              {"last_min_max", "last_front", "opaque_depth"})},
          blend_program{make_full_screen_program(blend_back_text, {"back"})},
          left_program{make_full_screen_program(what_is_left_text, {"min_max"})},
          finish{in, "1.0 - front.a"} {
        for (std::size_t i = 0; i < 2; ++i) {
            initialize[i] = make_framebuffer({min_max[i].name()});
            peel[i] = make_framebuffer({min_max[i].name(), front[i].name(), back_dump.name()});
        }
    }
};

// MAX applies to all three targets of a peel, min-max depths and colours alike; there is no depth test.
void use_max(GLenum equation) {
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(equation);
}

// Pass 0: the nearest and the farthest depth of every pixel, and empty sums.
void initialize(const DualResources& t, Record* record) {
    t.opaque.draw(t.input.scene);
    glBindFramebuffer(GL_FRAMEBUFFER, t.peel[0].name());
    glClearBufferfv(GL_COLOR, 1, zero.data());
    if (t.input.settings.background_used) {
        t.opaque.copy_color_to(t.blend);
    } else {
        glBindFramebuffer(GL_FRAMEBUFFER, t.blend.name());
        glClearBufferfv(GL_COLOR, 0, zero.data());
    }
    glBindFramebuffer(GL_FRAMEBUFFER, t.initialize[0].name());
    glClearBufferfv(GL_COLOR, 0, t.input.settings.empty_min_max.data());
    use_max(t.input.settings.min_max_equation);
    bind({0, 0, t.opaque.depth()});
    glUseProgram(t.min_max_program.name());
    t.input.scene.draw();
    show_pass(record, t.input.size, "geometry",
              {{"min_max", t.min_max[0].name(), t.input.settings.min_max},
               {"front", t.front[0].name(), t.input.formats.color},
               {"back", t.back.name(), t.input.formats.color}});
}

// One geometry pass: fragments at the ends of `last` become colours, those between them determine the next ends.
void peel_both_ends(const DualResources& t, std::size_t last) {
    glBindFramebuffer(GL_FRAMEBUFFER, t.peel[1 - last].name());
    glClearBufferfv(GL_COLOR, 0, t.input.settings.empty_min_max.data());
    glClearBufferfv(GL_COLOR, 1, zero.data());
    glClearBufferfv(GL_COLOR, 2, zero.data());
    use_max(t.input.settings.min_max_equation);
    bind({t.min_max[last].name(), t.front[last].name(), t.opaque.depth()});
    glUseProgram(t.peel_program.name());
    t.input.scene.draw();
}

// Blends the far layers with OVER. Returns the number of pixels for which min_max[`min_max`] still contains depths: 0
// ends the peel.
std::uint64_t blend_back(const DualResources& t, std::size_t min_max) {
    if (t.input.settings.sampled.layers_resolved)
        resolve_in_place(t.back_dump.name(), t.input.formats.color, t.input.size);
    glBindFramebuffer(GL_FRAMEBUFFER, t.blend.name());
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(t.input.settings.over[0], t.input.settings.over[1]);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);  // the back colours have no alpha of their own
    bind({t.back_dump.name()});
    draw_full_screen(t.blend_program);
    // The query only counts; nothing is written.
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    bind({t.min_max[min_max].name()});
    glBeginQuery(GL_SAMPLES_PASSED, t.query.name());
    draw_full_screen(t.left_program);
    glEndQuery(GL_SAMPLES_PASSED);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    return samples_passed(t.query);
}

// Records the targets after a pass.
void show(const DualResources& t, const std::string& kind, std::optional<std::uint64_t> query, Record* record) {
    const PixelFormat &color = t.input.formats.color, &min_max = t.input.settings.min_max;
    show_pass(record, t.input.size, kind,
              {{"min_max", t.min_max[0].name(), min_max},
               {"min_max.1", t.min_max[1].name(), min_max},
               {"front", t.front[0].name(), color},
               {"front.1", t.front[1].name(), color},
               {"back_layer", t.back_dump.name(), color},
               {"back", t.back.name(), color}},
              query);
}

// Peels to the last layer, or to `max_passes` geometry passes. Returns the number of geometry passes.
int dual(const DualResources& t, int max_passes, PixelCodes& picture, Record* record) {
    initialize(t, record);
    int passes = 1;
    std::size_t last = 0;
    // The exit asks for remaining depths, not for colours, which saves the empty pass that the paper's own query needs
    // for even N (E11).
    for (bool left = true; left && passes < max_passes; ++passes) {
        peel_both_ends(t, last);
        show(t, "geometry", {}, record);
        const std::uint64_t still = blend_back(t, 1 - last);
        left = still > t.input.settings.query_limit;
        show(t, "full_screen", still, record);
        if (t.input.settings.swaps) last = 1 - last;
    }
    if (t.input.settings.sampled.layers_resolved)
        resolve_in_place(t.front[last].name(), t.input.formats.color, t.input.size);
    t.finish.draw(t.front[last].name(), t.back.name(), picture, record);
    return passes;
}

}  // namespace

Job dual_job(const JobInput& input) {
    const auto t = std::make_shared<DualResources>(input);
    return {"dual", [t](PixelCodes& picture, int max_passes, Record* record) {
                const int lost = t->input.settings.passes_left_out;
                if (lost > 0) max_passes = dual(*t, max_passes, picture, nullptr) - lost;
                return dual(*t, max_passes, picture, record);
            }};
}

}  // namespace strata::port
