// tools/port/algorithms/single_pass.cpp - algorithms of one geometry pass: a depth pass, weighted averages, a count of
// fragments. weighted_average: Bavoil and Myers 2008; peeling/reference/algorithms.md 7. Half-float sums and count, as
// Strata's.
#include <fmt/format.h>

#include <cstring>
#include <memory>

#include "tools/port/algorithms/frame.h"

namespace strata::port {

namespace {

constexpr auto accumulate_text = R"(
layout(location = 0) out vec4 sums;
layout(location = 1) out float count;
vec4 premultiplied(vec4 c) {{ return {}; }}
void main() {{
    sums = premultiplied(shade());
    count = 1.0;
}}
)";

// The power by repeated squaring from the lowest bit of n, as in peeling/reference/algorithms.md 7, because pow()
// differs between drivers.
constexpr auto average_text = R"(
uniform sampler2D sums;
uniform sampler2D count;
uniform sampler2D behind_target;
layout(location = 0) out vec4 result;
float power(float base, float n) {{
    float product = 1.0;
    for (int left = int(n); left > 0; left >>= 1) {{
        if ((left & 1) != 0) product *= base;
        base *= base;
    }}
    return product;
}}
void main() {{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(sums, pixel, 0);
    float n = texelFetch(count, pixel, 0).r;
    vec3 behind = {};
    result = vec4(behind, 1.0);
    if (!(n > 0.0 && sum.a > 0.0)) return;
    as_written float transmitted = {}(1.0 - sum.a / n, n);
    as_written vec3 mixed = (sum.rgb / sum.a) * (1.0 - transmitted) + behind * transmitted;
    result.rgb = mixed;
}}
)";

// Half-float sums of premultiplied colours and alphas, and the number of fragments.
struct AverageTargets {
    JobInput input;
    PixelFormat sums_format, count_format;
    Opaque opaque;
    Handle sums, count, result, accumulate, finish, accumulate_program, finish_program;

    AverageTargets(const JobInput& in, const std::string& power)
        : input{in},
          sums_format{in.settings.sums[0] != nullptr ? *in.settings.sums[0]
                      : in.formats.color == rgba32f  ? rgba32f
                                                     : rgba16f},
          count_format{in.settings.sums[1] != nullptr ? *in.settings.sums[1]
                       : in.formats.color == rgba32f  ? r32f
                                                      : r16f},
          opaque{in, d32f},
          sums{make_texture(sums_format, in.size)},
          count{make_texture(count_format, in.size)},
          result{make_texture(picture_format(in), in.size)},
          accumulate{make_framebuffer({sums.name(), count.name()}, opaque.depth())},
          finish{make_framebuffer({result.name()})},
          accumulate_program{in.scene.make_program(fmt::format(accumulate_text, in.settings.premultiplied))},
          finish_program{make_full_screen_program(
              fmt::format(average_text,
                          in.settings.background_used ? "texelFetch(behind_target, pixel, 0).rgb" : "vec3(0.0)", power),
              {"sums", "count", "behind_target"})} {}
};

// The geometry pass: sums the fragments in front of the opaque surfaces, whose depth is binary32, in any order; or all
// fragments.
enum class Adds : std::uint8_t { visible, all };
void accumulate(const AverageTargets& t, Adds adds) {
    const GpuScene& scene = t.input.scene;
    t.opaque.draw(scene);
    glBindFramebuffer(GL_FRAMEBUFFER, t.accumulate.name());
    glClearBufferfv(GL_COLOR, 0, zero.data());
    glClearBufferfv(GL_COLOR, 1, zero.data());
    (adds == Adds::visible ? glEnable : glDisable)(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
    glUseProgram(t.accumulate_program.name());
    scene.draw();
    glDepthMask(GL_TRUE);
}

void resolve(const AverageTargets& t) {
    if (t.input.settings.sampled.layers_resolved) {
        resolve_in_place(t.sums.name(), t.sums_format, t.input.size);
        resolve_in_place(t.count.name(), t.count_format, t.input.size);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, t.finish.name());
    glDisable(GL_BLEND);
    bind({t.sums.name(), t.count.name(), t.opaque.color()});
    draw_full_screen(t.finish_program);
}

Job average_job(const std::string& name, const JobInput& input, const std::string& power, Adds adds) {
    const auto t = std::make_shared<AverageTargets>(input, power);
    return {name, [t, adds](PixelCodes& picture, int, Record* record) {
                accumulate(*t, adds);
                show_pass(record, t->input.size, "geometry",
                          {{"sums", t->sums.name(), t->sums_format}, {"count", t->count.name(), t->count_format}});
                resolve(*t);
                show_pass(record, t->input.size, "full_screen", {{"result", t->result.name(), t->input.formats.color}});
                picture = read_picture(t->result.name(), t->input);
                return 1;
            }};
}

// The target of job `depth`: depth only, no colour is written.
struct DepthTargets {
    JobInput input;
    Handle depth, framebuffer, program, query;

    explicit DepthTargets(const JobInput& in)
        : input{in},
          depth{make_texture(in.formats.depth, in.size)},
          framebuffer{make_framebuffer({}, depth.name())},
          program{in.scene.make_program("void main() {}")},
          query{make_query()} {}
};

}  // namespace

Job depth_job(const JobInput& input) {
    const auto t = std::make_shared<DepthTargets>(input);
    return {"depth", [t](PixelCodes& picture, int, Record*) {
                glBindFramebuffer(GL_FRAMEBUFFER, t->framebuffer.name());
                glDisable(GL_BLEND);
                glEnable(GL_DEPTH_TEST);
                glDepthFunc(t->input.settings.depth_func);
                glClearBufferfv(GL_DEPTH, 0, &far_plane);
                glUseProgram(t->program.name());
                // With a query, as peels have: without one softpipe steps D16 along its spans
                // (pipeline/reference/mesa-rasterizers.md 3.3).
                glBeginQuery(GL_SAMPLES_PASSED, t->query.name());
                t->input.scene.draw();
                glEndQuery(GL_SAMPLES_PASSED);
                picture = read_back(t->depth.name(), t->input.formats.depth, t->input.size);
                return 1;
            }};
}

Job weighted_average_job(const JobInput& input) {
    return average_job("weighted_average", input, "power", Adds::visible);
}
// Over all fragments, so that its sums are those of sums_job.
Job weighted_average_pow_job(const JobInput& input) {
    return average_job("weighted_average_pow", input, "pow", Adds::all);
}

// The sums themselves, before the resolve.
Job sums_job(const JobInput& input) {
    const auto t = std::make_shared<AverageTargets>(input, "power");
    return {"sums", [t](PixelCodes& picture, int, Record*) {
                accumulate(*t, Adds::all);
                picture = read_back(t->sums.name(), t->sums_format, t->input.size);
                return 1;
            }};
}

std::vector<std::uint32_t> count_fragments(const GpuScene& scene, FrameSize size) {
    // A binary32 count is exact up to 2^24 fragments per pixel.
    const Handle count = make_texture(r32f, size), framebuffer = make_framebuffer({count.name()});
    const Handle program = scene.make_program("layout(location = 0) out float count;\nvoid main() { count = 1.0; }");
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    glClearBufferfv(GL_COLOR, 0, zero.data());
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
    glUseProgram(program.name());
    scene.draw();
    const PixelCodes image = read_back(count.name(), r32f, size);
    std::vector<float> sums(size.area());
    std::memcpy(sums.data(), image.bytes.data(), image.bytes.size());
    return {sums.begin(), sums.end()};
}

}  // namespace strata::port
