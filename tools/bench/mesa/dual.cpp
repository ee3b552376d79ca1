// tools/bench/mesa/dual.cpp - the nearest and the farthest layer a pass, under one MAX equation, to the last layer.
// Bavoil and Myers 2008; algorithms.md 5. Passes: 1 + max(1, ceil(N/2)), its end by a query of the pixels whose min-max
// depth is not empty. The background is black, so OVER starts from a clear.
#include <array>
#include <memory>

#include "tools/bench/mesa/job.h"

namespace strata::mesa {

namespace {

// Clear values. Min-max depths are stored as (-near, far), so that one MAX serves both; (-1, -1) is
// below any depth and means empty.
constexpr std::array<float, 4> zero{}, empty_min_max{-1, -1, 0, 0};

// The first pass: each fragment's depth as both ends. A depth of 1 is dropped, as by a test LESS against a cleared opaque depth, which
// Strata's passes make.
constexpr auto min_max_text = R"(
layout(location = 0) out vec2 min_max;
void main() {
    if (gl_FragCoord.z >= 1.0) discard;
    min_max = vec2(-gl_FragCoord.z, gl_FragCoord.z);
}
)";

// Nothing else is discarded: the front colour survives MAX by passing through (E13).
constexpr auto dual_text = R"(
layout(binding = 0) uniform sampler2D last_min_max;
layout(binding = 1) uniform sampler2D last_front;
layout(location = 0) out vec2 min_max;
layout(location = 1) out vec4 front;
layout(location = 2) out vec4 back;
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float z = gl_FragCoord.z;
    if (z >= 1.0) discard;
    vec2 range = texelFetch(last_min_max, pixel, 0).rg;
    float near = -range.x, far = range.y;
    min_max = vec2(-1.0);
    front = texelFetch(last_front, pixel, 0);
    back = vec4(0.0);
    if (z < near || z > far) return;
    if (z > near && z < far) {
        min_max = vec2(-z, z);
        return;
    }
    vec4 color = shade();
    if (z == near) {
        float transmitted = 1.0 - front.a;
        front.rgb += transmitted * (color.a * color.rgb);
        front.a = 1.0 - transmitted * (1.0 - color.a);
    } else {
        back = color;
    }
}
)";

// Blends the far layer of a pass into the back colours. A pixel without one has alpha 0 and is left
// out.
constexpr auto blend_back_text = R"(
layout(binding = 0) uniform sampler2D back;
layout(location = 0) out vec4 color;
void main() {
    color = texelFetch(back, ivec2(gl_FragCoord.xy), 0);
    if (color.a == 0.0) discard;
}
)";

// Passes one sample for each pixel that has fragments between its ends; its colour is masked.
// Counted by the query.
constexpr auto what_is_left_text = R"(
layout(binding = 0) uniform sampler2D min_max;
layout(location = 0) out vec4 color;
void main() {
    if (texelFetch(min_max, ivec2(gl_FragCoord.xy), 0).rg == vec2(-1.0)) discard;
    color = vec4(0.0);
}
)";

// The last pass: the front sum over the back colours, opaque.
constexpr auto front_over_back_text = R"(
layout(binding = 0) uniform sampler2D front;
layout(binding = 1) uniform sampler2D back;
layout(location = 0) out vec4 result;
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 near = texelFetch(front, pixel, 0);
    result = vec4(near.rgb + (1.0 - near.a) * texelFetch(back, pixel, 0).rgb, 1.0);
}
)";

// Everything that a run draws with. Pairs of targets take turns: a pass reads one of each and
// writes the other.
struct DualTargets {
    std::array<Handle, 2> min_max, front, initialize, peel;
    Handle back_dump, back, result, blend, finish, query;
    Handle min_max_program, peel_program, blend_program, left_program, finish_program;

    DualTargets(const GpuScene& scene, Size size, GLenum color)
        : min_max{make_texture(GL_RG32F, size), make_texture(GL_RG32F, size)},
          front{make_texture(color, size), make_texture(color, size)},
          back_dump{make_texture(color, size)},
          back{make_texture(color, size)},
          result{make_texture(color, size)},
          blend{make_framebuffer({back.name()})},
          finish{make_framebuffer({result.name()})},
          query{make_query()},
          min_max_program{scene.make_program(min_max_text)},
          peel_program{scene.make_program(dual_text)},
          blend_program{make_full_screen_program(blend_back_text)},
          left_program{make_full_screen_program(what_is_left_text)},
          finish_program{make_full_screen_program(front_over_back_text)} {
        for (std::size_t i = 0; i < 2; ++i) {
            initialize[i] = make_framebuffer({min_max[i].name()});
            peel[i] = make_framebuffer({min_max[i].name(), front[i].name(), back_dump.name()});
        }
    }
};

// MAX applies to all three targets of a peel, min-max depths and colours alike; no depth test takes
// part.
void use_max() {
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_MAX);
}

// Pass 0: the nearest and the farthest depth of every pixel, and empty sums.
void initialize(const GpuScene& scene, const DualTargets& t) {
    glBindFramebuffer(GL_FRAMEBUFFER, t.peel[0].name());
    glClearBufferfv(GL_COLOR, 1, zero.data());
    glBindFramebuffer(GL_FRAMEBUFFER, t.blend.name());
    glClearBufferfv(GL_COLOR, 0, zero.data());
    glBindFramebuffer(GL_FRAMEBUFFER, t.initialize[0].name());
    glClearBufferfv(GL_COLOR, 0, empty_min_max.data());
    use_max();
    glUseProgram(t.min_max_program.name());
    scene.draw();
}

// One geometry pass: fragments at the ends of `last` become colours, those between them the next
// ends.
void peel_both_ends(const GpuScene& scene, const DualTargets& t, std::size_t last) {
    glBindFramebuffer(GL_FRAMEBUFFER, t.peel[1 - last].name());
    glClearBufferfv(GL_COLOR, 0, empty_min_max.data());
    glClearBufferfv(GL_COLOR, 1, zero.data());
    glClearBufferfv(GL_COLOR, 2, zero.data());
    use_max();
    glBindTextureUnit(0, t.min_max[last].name());
    glBindTextureUnit(1, t.front[last].name());
    glUseProgram(t.peel_program.name());
    scene.draw();
}

// Blends the far layers with OVER. Answers for how many pixels min_max[`min_max`] still holds
// depths: 0 ends the peel.
std::uint64_t blend_back(const DualTargets& t, std::size_t min_max) {
    glBindFramebuffer(GL_FRAMEBUFFER, t.blend.name());
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glBindTextureUnit(0, t.back_dump.name());
    draw_full_screen(t.blend_program);
    // The query shall count and write nothing.
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glBindTextureUnit(0, t.min_max[min_max].name());
    glBeginQuery(GL_SAMPLES_PASSED, t.query.name());
    draw_full_screen(t.left_program);
    glEndQuery(GL_SAMPLES_PASSED);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    return samples_passed(t.query);
}

// Peels to the last layer, or to `max_passes` geometry passes. Answers the geometry passes.
int dual(const GpuScene& scene, const DualTargets& t, int max_passes) {
    initialize(scene, t);
    int passes = 1;
    std::size_t last = 0;
    // The exit asks for depths that are left, not for colours: it saves the empty pass that the
    // paper's own query needs for even N (E11).
    for (bool left = true; left && passes < max_passes; ++passes) {
        peel_both_ends(scene, t, last);
        last = 1 - last;
        left = blend_back(t, last) > 0;
    }
    glBindFramebuffer(GL_FRAMEBUFFER, t.finish.name());
    glDisable(GL_BLEND);
    glBindTextureUnit(0, t.front[last].name());
    glBindTextureUnit(1, t.back.name());
    draw_full_screen(t.finish_program);
    return passes;
}

}  // namespace

Job dual_job(const GpuScene& scene, Size size, const TargetFormats& formats) {
    const pipeline::Format color = formats.color;
    const auto t = std::make_shared<DualTargets>(scene, size, gl_format(color));
    return {"dual", color, [&scene, size, t, color](std::vector<std::uint32_t>& pixels, int max_passes) {
                const int passes = dual(scene, *t, max_passes);
                read_color(t->finish, size, color, pixels);
                return passes;
            }};
}

}  // namespace strata::mesa
