// tools/port/algorithms/weighted.cpp - sums of weighted colours, resolved with the transmittance of all fragments:
// weighted_blended (McGuire and Bavoil 2013, equation 10; peeling/reference/algorithms.md 18) and moments of four
// powers (Muenstermann et al. 2018; peeling/reference/algorithms.md 22). Passes: 1 and 2.
#include <fmt/format.h>

#include <memory>

#include "tools/port/algorithms/frame.h"
#include "tools/port/algorithms/moment_text.h"

namespace strata::port {

namespace {

// The program computes the window depth in binary32.
constexpr auto weigh_text = R"(
layout(location = 0) out vec4 sums;
layout(location = 1) out float revealage;
void main() {
    vec4 c = shade();
    as_written float behind = 1.0 - gl_FragCoord.z;
    as_written float weight = c.a * max(0.01, 3000.0 * (behind * behind * behind));
    as_written vec3 color = c.rgb * c.a * weight;
    as_written float alpha = c.a * weight;
    sums = vec4(color, alpha);
    revealage = c.a;
}
)";

// `through` is a GLSL expression of `left`, the value of the second target.
constexpr auto resolve_text = R"(
uniform sampler2D sums;
uniform sampler2D left_target;
uniform sampler2D behind_target;
layout(location = 0) out vec4 result;
void main() {{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(sums, pixel, 0);
    float left = texelFetch(left_target, pixel, 0).r;
    vec3 behind = {};
    result = vec4(behind, 1.0);
    if (!(sum.a > 0.0)) return;
    as_written float through = {};
    as_written vec3 mixed = (sum.rgb / sum.a) * (1.0 - through) + behind * through;
    result.rgb = mixed;
}}
)";

PixelFormat sums_format(const JobInput& in) { return in.formats.color == rgba32f ? rgba32f : rgba16f; }

// The last quad of both algorithms, over the opaque colour.
struct ResolvePass {
    JobInput input;
    Handle result, framebuffer, program;

    ResolvePass(const JobInput& in, const std::string& functions, const std::string& through)
        : input{in},
          result{make_texture(in.formats.color, in.size)},
          framebuffer{make_framebuffer({result.name()})},
          program{make_full_screen_program(
              functions +
                  fmt::format(resolve_text,
                              in.settings.background_used ? "texelFetch(behind_target, pixel, 0).rgb" : "vec3(0.0)",
                              through),
              {"sums", "left_target", "behind_target"})} {}

    void draw(GLuint sums, GLuint left, GLuint behind, PixelCodes& picture, Record* record) const {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
        glDisable(GL_BLEND);
        bind({sums, left, behind});
        draw_full_screen(program);
        show_pass(record, input.size, "full_screen", {{"result", result.name(), input.formats.color}});
        picture = read_picture(result.name(), input);
    }
};

// Begins a pass over the visible fragments that adds to its targets.
void begin_sums(const Handle& framebuffer) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
}
void draw_sums(const GpuScene& scene, const Handle& program) {
    glUseProgram(program.name());
    scene.draw();
    glDepthMask(GL_TRUE);
}

struct BlendedTargets {
    JobInput input;
    PixelFormat format, revealage_format;
    Opaque opaque;
    Handle sums, revealage, framebuffer, program;
    ResolvePass resolve;

    explicit BlendedTargets(const JobInput& in)
        : input{in},
          format{sums_format(in)},
          revealage_format{format == rgba32f ? r32f : r16f},
          opaque{in, d32f},
          sums{make_texture(format, in.size)},
          revealage{make_texture(revealage_format, in.size)},
          framebuffer{make_framebuffer({sums.name(), revealage.name()}, opaque.depth())},
          program{in.scene.make_program(weigh_text)},
          resolve{in, "", "left"} {}
};

void draw_blended(const BlendedTargets& t, PixelCodes& picture, Record* record) {
    constexpr std::array<float, 4> all_through{1, 1, 1, 1};
    t.opaque.draw(t.input.scene);
    begin_sums(t.framebuffer);
    glClearBufferfv(GL_COLOR, 0, zero.data());
    glClearBufferfv(GL_COLOR, 1, all_through.data());
    glBlendFunci(1, GL_ZERO, GL_ONE_MINUS_SRC_COLOR);
    draw_sums(t.input.scene, t.program);
    show_pass(record, t.input.size, "geometry",
              {{"sums", t.sums.name(), t.format}, {"revealage", t.revealage.name(), t.revealage_format}});
    t.resolve.draw(t.sums.name(), t.revealage.name(), t.opaque.color(), picture, record);
}

struct MomentResources {
    JobInput input;
    PixelFormat format;
    Opaque opaque;
    Handle total, powers, sums, build, accumulate, build_program, accumulate_program;
    ResolvePass resolve;

    MomentResources(const JobInput& in, const std::string& log_exp)
        : input{in},
          format{sums_format(in)},
          opaque{in, d32f},
          total{make_texture(r32f, in.size)},
          powers{make_texture(rgba32f, in.size)},
          sums{make_texture(format, in.size)},
          build{make_framebuffer({total.name(), powers.name()}, opaque.depth())},
          accumulate{make_framebuffer({sums.name()}, opaque.depth())},
          build_program{in.scene.make_program(log_exp + build_moments_text)},
          accumulate_program{
              in.scene.make_program(log_exp + std::string{share_text} + accumulate_moments_text, {"total", "powers"})},
          resolve{in, log_exp, "left >= minus_log(5.9604644775390625e-8) ? 0.0 : exp_of_minus(left)"} {}
};

void draw_moments(const MomentResources& t, PixelCodes& picture, Record* record) {
    t.opaque.draw(t.input.scene);
    begin_sums(t.build);
    glClearBufferfv(GL_COLOR, 0, zero.data());
    glClearBufferfv(GL_COLOR, 1, zero.data());
    draw_sums(t.input.scene, t.build_program);
    show_pass(record, t.input.size, "geometry",
              {{"total", t.total.name(), r32f}, {"moments", t.powers.name(), rgba32f}});
    begin_sums(t.accumulate);
    glClearBufferfv(GL_COLOR, 0, zero.data());
    bind({t.total.name(), t.powers.name()});
    draw_sums(t.input.scene, t.accumulate_program);
    show_pass(record, t.input.size, "geometry", {{"sums", t.sums.name(), t.format}});
    t.resolve.draw(t.sums.name(), t.total.name(), t.opaque.color(), picture, record);
}

Job moments_of(const std::string& name, const JobInput& input, const char* log_exp) {
    const auto t = std::make_shared<MomentResources>(input, log_exp);
    return {name, [t](PixelCodes& picture, int, Record* record) {
                draw_moments(*t, picture, record);
                return 2;
            }};
}

}  // namespace

Job weighted_blended_job(const JobInput& input) {
    const auto t = std::make_shared<BlendedTargets>(input);
    return {"weighted_blended", [t](PixelCodes& picture, int, Record* record) {
                draw_blended(*t, picture, record);
                return 1;
            }};
}

Job moments_job(const JobInput& input) { return moments_of("moments", input, log_exp_text); }
Job moments_log_job(const JobInput& input) { return moments_of("moments_log", input, driver_log_exp_text); }

}  // namespace strata::port
