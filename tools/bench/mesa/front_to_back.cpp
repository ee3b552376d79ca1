// tools/bench/mesa/front_to_back.cpp - one layer a pass, nearest first, to the last layer.
// Everitt 2001, Bavoil and Myers 2008; algorithms.md 4. Passes: N + 1, its end by an occlusion query of the peel.
#include <array>
#include <memory>

#include "tools/bench/mesa/job.h"

namespace strata::mesa {

namespace {

// Clear values: no colour; and no colour with all light still transmitted, which alpha holds in the
// accumulated target.
constexpr std::array<float, 4> zero{}, transparent{0, 0, 0, 1};

// Layers are premultiplied, as UNDER needs them.
constexpr auto peel_first_text = R"(
layout(location = 0) out vec4 layer;
void main() {
    vec4 color = shade();
    layer = vec4(color.rgb * color.a, color.a);
}
)";

// A depth as the driver stores and reads it back: code times the binary32 reciprocal of the greatest code, which for d24 is another
// float than the quotient. Compared raw, a fragment would lie behind itself and the peel would never end.
std::string stored_text(pipeline::Format depth) {
    const std::string greatest = depth == pipeline::Format::d16 ? "65535.0" : "16777215.0";
    const std::string stored =
        depth == pipeline::Format::d32f ? "z" : "roundEven(z * " + greatest + ") * (1.0 / " + greatest + ")";
    return "float stored(float z) { return " + stored + "; }\n";
}

// As the first pass, but without what is not behind the depth peeled before. Equal depths are one
// layer.
constexpr auto peel_next_text = R"(
layout(binding = 0) uniform sampler2D peeled;
layout(location = 0) out vec4 layer;
void main() {
    if (stored(gl_FragCoord.z) <= texelFetch(peeled, ivec2(gl_FragCoord.xy), 0).r) discard;
    vec4 color = shade();
    layer = vec4(color.rgb * color.a, color.a);
}
)";

constexpr auto copy_text = R"(
layout(binding = 0) uniform sampler2D source;
layout(location = 0) out vec4 copied;
void main() { copied = texelFetch(source, ivec2(gl_FragCoord.xy), 0); }
)";

constexpr auto opaque_copy_text = R"(
layout(binding = 0) uniform sampler2D source;
layout(location = 0) out vec4 copied;
void main() { copied = vec4(texelFetch(source, ivec2(gl_FragCoord.xy), 0).rgb, 1.0); }
)";

// Everything that a run draws with. The two depth buffers take turns: a pass tests against one and
// reads the other.
struct PeelTargets {
    std::array<Handle, 2> depth, peel;
    Handle layer, accumulated, result, under, finish, query;
    Handle first_program, next_program, under_program, finish_program;

    PeelTargets(const GpuScene& scene, Size size, const TargetFormats& formats)
        : depth{make_texture(gl_format(formats.depth), size), make_texture(gl_format(formats.depth), size)},
          layer{make_texture(gl_format(formats.color), size)},
          accumulated{make_texture(gl_format(formats.color), size)},
          result{make_texture(gl_format(formats.color), size)},
          under{make_framebuffer({accumulated.name()})},
          finish{make_framebuffer({result.name()})},
          query{make_query()},
          first_program{scene.make_program(peel_first_text)},
          next_program{scene.make_program(stored_text(formats.depth) + peel_next_text)},
          under_program{make_full_screen_program(copy_text)},
          finish_program{make_full_screen_program(opaque_copy_text)} {
        for (std::size_t i = 0; i < 2; ++i) peel[i] = make_framebuffer({layer.name()}, depth[i].name());
    }
};

// Pass number `pass`: the nearest layer behind that of the pass before. Returns the samples that it drew.
std::uint64_t peel_layer(const GpuScene& scene, const PeelTargets& t, int pass) {
    constexpr float far = 1.0f;
    const std::size_t nearest = static_cast<std::size_t>(pass) % 2;
    glBindFramebuffer(GL_FRAMEBUFFER, t.peel[nearest].name());
    glClearBufferfv(GL_COLOR, 0, zero.data());
    glClearBufferfv(GL_DEPTH, 0, &far);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glBindTextureUnit(0, t.depth[1 - nearest].name());
    glUseProgram((pass == 0 ? t.first_program : t.next_program).name());
    glBeginQuery(GL_SAMPLES_PASSED, t.query.name());
    scene.draw();
    glEndQuery(GL_SAMPLES_PASSED);
    return samples_passed(t.query);
}

// UNDER: the layer is multiplied with the transmittance in destination alpha, which then shrinks by
// 1 - alpha.
void blend_under(const PeelTargets& t) {
    glBindFramebuffer(GL_FRAMEBUFFER, t.under.name());
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFuncSeparate(GL_DST_ALPHA, GL_ONE, GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
    glBindTextureUnit(0, t.layer.name());
    draw_full_screen(t.under_program);
}

// Peels to the last layer, or to `max_passes` geometry passes. Answers the geometry passes, the
// empty last one included.
int front_to_back(const GpuScene& scene, const PeelTargets& t, int max_passes) {
    glBindFramebuffer(GL_FRAMEBUFFER, t.under.name());
    glClearBufferfv(GL_COLOR, 0, transparent.data());
    int passes = 0;
    while (passes < max_passes && peel_layer(scene, t, passes++) > 0) blend_under(t);
    glBindFramebuffer(GL_FRAMEBUFFER, t.finish.name());
    glDisable(GL_BLEND);
    glBindTextureUnit(0, t.accumulated.name());
    draw_full_screen(t.finish_program);
    return passes;
}

}  // namespace

Job front_to_back_job(const GpuScene& scene, Size size, const TargetFormats& formats) {
    const auto t = std::make_shared<PeelTargets>(scene, size, formats);
    return {"front_to_back", formats.color,
            [&scene, size, t, color = formats.color](std::vector<std::uint32_t>& pixels, int max_passes) {
                const int passes = front_to_back(scene, *t, max_passes);
                read_color(t->finish, size, color, pixels);
                return passes;
            }};
}

}  // namespace strata::mesa
