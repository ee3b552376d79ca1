// tools/bench/mesa/single_pass.cpp - one walk over the triangles: a depth pass, weighted averages, a count of
// fragments. weighted_average: Bavoil and Myers 2008; algorithms.md 7. Half-float sums and count, as Strata's.
#include <array>
#include <bit>
#include <memory>

#include "tools/bench/mesa/job.h"

namespace strata::mesa {

namespace {

constexpr std::array<float, 4> zero{};

// The targets of job `depth`: depth alone, no colour is written.
struct DepthTargets {
    Handle depth, framebuffer, program;

    DepthTargets(const GpuScene& scene, Size size, GLenum format)
        : depth{make_texture(format, size)},
          framebuffer{make_framebuffer({}, depth.name())},
          program{scene.make_program("void main() {}")} {}
};

// The targets of job `weighted_average`: half-float sums of premultiplied colours and alphas, and
// the number of fragments.
struct AverageTargets {
    Handle sums, count, result, accumulate, finish, accumulate_program, finish_program;

    AverageTargets(const GpuScene& scene, Size size, pipeline::Format color)
        : sums{make_texture(color == pipeline::Format::rgba32f ? GL_RGBA32F : GL_RGBA16F, size)},
          count{make_texture(color == pipeline::Format::rgba32f ? GL_R32F : GL_R16F, size)},
          result{make_texture(gl_format(color), size)},
          accumulate{make_framebuffer({sums.name(), count.name()})},
          finish{make_framebuffer({result.name()})},
          accumulate_program{scene.make_program(R"(
layout(location = 0) out vec4 sums;
layout(location = 1) out float count;
void main() {
    vec4 color = shade();
    sums = vec4(color.rgb * color.a, color.a);
    count = 1.0;
}
)")},
          finish_program{make_full_screen_program(R"(
layout(binding = 0) uniform sampler2D sums;
layout(binding = 1) uniform sampler2D count;
layout(location = 0) out vec4 result;
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(sums, pixel, 0);
    float n = texelFetch(count, pixel, 0).r;
    vec3 average = sum.a > 0.0 ? sum.rgb / sum.a : vec3(0.0);
    float transmitted = n > 0.0 ? pow(1.0 - sum.a / n, n) : 1.0;
    result = vec4(average * (1.0 - transmitted), 1.0);  // over black
}
)")} {}
};

// The geometry pass: everything is added up, in any order, without depth test.
void accumulate(const GpuScene& scene, const AverageTargets& t) {
    glBindFramebuffer(GL_FRAMEBUFFER, t.accumulate.name());
    glClearBufferfv(GL_COLOR, 0, zero.data());
    glClearBufferfv(GL_COLOR, 1, zero.data());
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
    glUseProgram(t.accumulate_program.name());
    scene.draw();
}

}  // namespace

// The binary32 depths are read back as they are: a word is their bits. Codes of fixed point are the upper bits of a word.
Job depth_job(const GpuScene& scene, Size size, const TargetFormats& formats) {
    const pipeline::Format format = formats.depth;
    const auto t = std::make_shared<DepthTargets>(scene, size, gl_format(format));
    return {"depth", format, [&scene, size, t, format](std::vector<std::uint32_t>& pixels, int) {
                constexpr float far = 1.0f;
                glBindFramebuffer(GL_FRAMEBUFFER, t->framebuffer.name());
                glDisable(GL_BLEND);
                glEnable(GL_DEPTH_TEST);
                glClearBufferfv(GL_DEPTH, 0, &far);
                glUseProgram(t->program.name());
                scene.draw();
                pixels.resize(size.area());
                glReadPixels(0, 0, size.width, size.height, GL_DEPTH_COMPONENT,
                             format == pipeline::Format::d32f ? GL_FLOAT : GL_UNSIGNED_INT, pixels.data());
                const unsigned unused = format == pipeline::Format::d16 ? 16 : format == pipeline::Format::d24 ? 8 : 0;
                for (std::uint32_t& word : pixels) word >>= unused;
                return 1;
            }};
}

Job weighted_average_job(const GpuScene& scene, Size size, const TargetFormats& formats) {
    const pipeline::Format color = formats.color;
    const auto t = std::make_shared<AverageTargets>(scene, size, color);
    return {"weighted_average", color, [&scene, size, t, color](std::vector<std::uint32_t>& pixels, int) {
                accumulate(scene, *t);
                glBindFramebuffer(GL_FRAMEBUFFER, t->finish.name());
                glDisable(GL_BLEND);
                glBindTextureUnit(0, t->sums.name());
                glBindTextureUnit(1, t->count.name());
                draw_full_screen(t->finish_program);
                read_color(t->finish, size, color, pixels);
                return 1;
            }};
}

// The sums themselves, before the driver's own pow makes a colour of them.
Job sums_job(const GpuScene& scene, Size size, const TargetFormats& formats) {
    const pipeline::Format sums =
        formats.color == pipeline::Format::rgba32f ? pipeline::Format::rgba32f : pipeline::Format::rgba16f;
    const auto t = std::make_shared<AverageTargets>(scene, size, formats.color);
    return {"sums", sums, [&scene, size, t, sums](std::vector<std::uint32_t>& pixels, int) {
                accumulate(scene, *t);
                read_color(t->accumulate, size, sums, pixels);
                return 1;
            }};
}

std::vector<std::uint32_t> count_fragments(const GpuScene& scene, Size size) {
    // A binary32 count is exact up to 2^24 fragments a pixel.
    const Handle count = make_texture(GL_R32F, size), framebuffer = make_framebuffer({count.name()});
    const Handle program = scene.make_program("layout(location = 0) out float count;\nvoid main() { count = 1.0; }");
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    glClearBufferfv(GL_COLOR, 0, zero.data());
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
    glUseProgram(program.name());
    scene.draw();
    std::vector<float> sums(size.area());
    glReadPixels(0, 0, size.width, size.height, GL_RED, GL_FLOAT, sums.data());
    return {sums.begin(), sums.end()};
}

}  // namespace strata::mesa
