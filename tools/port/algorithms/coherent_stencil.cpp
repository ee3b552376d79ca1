// tools/port/algorithms/coherent_stencil.cpp - runs of fragments that are submitted in depth order, found by counting
// in the stencil buffer. Carr, Mech and Miller 2008, section 5; peeling/reference/algorithms.md 10. Passes: 1 + 6 per
// iteration; it ends by a query of the first.
#include <fmt/format.h>

#include <memory>

#include "tools/port/algorithms/frame.h"

namespace strata::port {

namespace {

// Keeps a range of depths; each pass has another condition.
constexpr auto find_text = R"(
uniform sampler2D first_depth;
uniform sampler2D second_depth;
void main() {{
    float z = stored(gl_FragCoord.z);
    float first = texelFetch(first_depth, TEXEL, 0).r, second = texelFetch(second_depth, TEXEL, 0).r;
    if (!({})) discard;
    if (hidden(z)) discard;
}}
)";

constexpr auto composite_text = R"(
uniform sampler2D first_depth;
uniform sampler2D second_depth;
layout(location = 0) out vec4 layer;
vec4 premultiplied(vec4 c) {{ return {}; }}
void main() {{
    float z = stored(gl_FragCoord.z);
    float first = texelFetch(first_depth, TEXEL, 0).r, second = texelFetch(second_depth, TEXEL, 0).r;
    if (!({})) discard;
    if (hidden(z)) discard;
    layer = premultiplied(shade());
}}
)";

// The end of the run: the least of the fragments submitted earlier, of those that interrupt it, and of the opaque
// surface. It is stored in a colour, because a 24-bit depth that is read and written through gl_FragDepth may change
// its code.
constexpr auto reached_text = R"(
uniform sampler2D previous_depth;
uniform sampler2D breaker_depth;
uniform sampler2D opaque;
layout(location = 0) out float reached;
void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    reached = min(min(texelFetch(previous_depth, pixel, 0).r, texelFetch(breaker_depth, pixel, 0).r),
                  texelFetch(opaque, pixel, 0).r);
}
)";

// A depth with a stencil. OpenGL stores both in one texture, so the stencil is transferred by copies.
struct DepthStencil {
    Handle texture, framebuffer;
    explicit DepthStencil(const JobInput& in)
        : texture{make_depth_stencil(in.formats.depth, in.size)},
          framebuffer{make_stencil_framebuffer(texture.name())} {}
};

struct CoherentTargets {
    JobInput input;
    Opaque opaque;
    DepthStencil nearest, previous, last_in_order, breaker;
    Handle reached, reach, accumulated, composite, query;
    Handle find_all, find_left, find_run, set_reached, composite_run, composite_end;
    FinalQuad finish;

    explicit CoherentTargets(const JobInput& in)
        : input{in},
          opaque{in, in.formats.depth},
          nearest{in},
          previous{in},
          last_in_order{in},
          breaker{in},
          reached{make_texture(r32f, in.size)},
          reach{make_framebuffer({reached.name()})},
          accumulated{make_texture(in.formats.color, in.size)},
          composite{make_framebuffer({accumulated.name()})},
          query{make_query()},
          find_all{program(find_text, "true")},
          find_left{program(find_text, "z > first")},
          find_run{program(find_text, "z >= first && z < second")},
          set_reached{make_full_screen_program(reached_text, {"previous_depth", "breaker_depth", "opaque"})},
          composite_run{composite_program("z >= first && z < second")},
          composite_end{composite_program("z == first")},
          finish{in, "front.a"} {}

  private:
    [[nodiscard]] Handle with_samplers(const std::string& text) const {
        return input.scene.make_program(stored_text(input.formats.depth) + opaque.hidden_text() + text,
                                        {"first_depth", "second_depth", "opaque_depth"});
    }
    [[nodiscard]] Handle program(const char* text, const std::string& kept) const {
        return with_samplers(fmt::format(fmt::runtime(text), kept));
    }
    [[nodiscard]] Handle composite_program(const std::string& kept) const {
        return with_samplers(fmt::format(composite_text, input.settings.premultiplied, kept));
    }
};

// Clears the depth, and the stencil to 0 or to another target's stencil.
void start(const CoherentTargets& t, const DepthStencil& to, float depth, const DepthStencil* stencil_of) {
    const FrameSize size = t.input.size;
    if (stencil_of == nullptr) {
        glBindFramebuffer(GL_FRAMEBUFFER, to.framebuffer.name());
        glClearBufferfi(GL_DEPTH_STENCIL, 0, depth, 0);
        return;
    }
    glBindFramebuffer(GL_READ_FRAMEBUFFER, stencil_of->framebuffer.name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to.framebuffer.name());
    glBlitFramebuffer(0, 0, size.width, size.height, 0, 0, size.width, size.height, GL_STENCIL_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, to.framebuffer.name());
    glClearBufferfv(GL_DEPTH, 0, &depth);
}

// A depth and stencil test for both faces. Operations: if the stencil test fails, if the depth test fails, if both
// pass.
struct Test {
    GLenum depth, stencil;
    GLint reference;
    std::array<GLenum, 3> operations;
};
void use(const Test& test) {
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(test.depth);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(test.stencil, test.reference, 0xff);
    glStencilOp(test.operations[0], test.operations[1], test.operations[2]);
}

// Draws the geometry with the program, which reads two depths and the opaque one. Returns the samples that passed.
std::uint64_t draw(const CoherentTargets& t, const Handle& program, GLuint first, GLuint second) {
    bind({first, second, t.opaque.depth()});
    glUseProgram(program.name());
    glBeginQuery(GL_SAMPLES_PASSED, t.query.name());
    t.input.scene.draw();
    glEndQuery(GL_SAMPLES_PASSED);
    return samples_passed(t.query);
}

void show(const CoherentTargets& t, const std::string& kind, const DepthStencil& stencil,
          std::optional<std::uint64_t> query, Record* record) {
    const PixelFormat& depth = t.input.formats.depth;
    show_pass(record, t.input.size, kind,
              {{"nearest", t.nearest.texture.name(), depth},
               {"previous", t.previous.texture.name(), depth},
               {"last_in_order", t.last_in_order.texture.name(), depth},
               {"breaker", t.breaker.texture.name(), depth},
               {depth == d32f ? "reached" : "reached_as_float", t.reached.name(), r32f},
               {"stencil", stencil.texture.name(), s8},
               {"accumulated", t.accumulated.name(), t.input.formats.color}},
              query);
}

// P1: the nearest remaining fragment; the stencil counts the updates of the depth.
std::uint64_t find_nearest(const CoherentTargets& t, bool from_the_start, Record* record) {
    start(t, t.nearest, far_plane, nullptr);
    use({GL_LESS, GL_ALWAYS, 0, {GL_KEEP, GL_KEEP, t.input.settings.stencil_increment}});
    const std::uint64_t found = draw(t, from_the_start ? t.find_all : t.find_left, t.reached.name(), 0);
    show(t, "geometry", t.nearest, found, record);
    return found;
}

// P2 to P4 and the quad: the fragments submitted before the nearest one, the run that starts there, and the fragments
// that interrupt it.
void find_run(const CoherentTargets& t, bool from_the_start, Record* record) {
    start(t, t.previous, far_plane, t.input.settings.stencil_kept ? &t.nearest : nullptr);
    use({GL_LESS, GL_LESS, 1, {GL_KEEP, GL_KEEP, GL_DECR}});
    draw(t, from_the_start ? t.find_all : t.find_left, t.reached.name(), 0);
    show(t, "geometry", t.previous, {}, record);
    start(t, t.last_in_order, 0.0f, nullptr);
    use({GL_GREATER, GL_GREATER, 128, {GL_KEEP, GL_INVERT, t.input.settings.stencil_increment}});
    draw(t, t.find_run, t.nearest.texture.name(), t.previous.texture.name());
    show(t, "geometry", t.last_in_order, {}, record);
    start(t, t.breaker, far_plane, &t.last_in_order);
    use({GL_LESS, GL_EQUAL, 255, {t.input.settings.stencil_increment, GL_KEEP, GL_KEEP}});
    draw(t, t.find_run, t.nearest.texture.name(), t.previous.texture.name());
    show(t, "geometry", t.breaker, {}, record);
    glDisable(GL_STENCIL_TEST);
    glBindFramebuffer(GL_FRAMEBUFFER, t.reach.name());
    glDisable(GL_BLEND);
    bind({t.previous.texture.name(), t.breaker.texture.name(), t.opaque.depth()});
    draw_full_screen(t.set_reached);
    show(t, "full_screen", t.breaker, {}, record);
}

// P5 and P6: the run, then the fragments exactly at its end.
void composite(const CoherentTargets& t, Record* record) {
    glBindFramebuffer(GL_FRAMEBUFFER, t.composite.name());
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    const auto& factors = t.input.settings.under;
    glBlendFuncSeparate(factors[0], factors[1], factors[2], factors[3]);
    const std::uint64_t run = draw(t, t.composite_run, t.nearest.texture.name(), t.reached.name());
    show(t, "geometry", t.breaker, run, record);
    glFlush();  // ends the pass: otherwise softpipe would keep blending in the same tiles, unrounded
                // (pipeline/reference/fragment-stages.md 9.5)
    glBindFramebuffer(GL_FRAMEBUFFER, t.composite.name());
    const std::uint64_t end = draw(t, t.composite_end, t.reached.name(), 0);
    show(t, "geometry", t.breaker, end, record);
}

int coherent_stencil(const CoherentTargets& t, int max_passes, PixelCodes& picture, Record* record) {
    t.opaque.draw(t.input.scene);
    const std::array<float, 4> transparent{0, 0, 0, t.input.settings.transmittance_start};
    glBindFramebuffer(GL_FRAMEBUFFER, t.composite.name());
    glClearBufferfv(GL_COLOR, 0, transparent.data());
    glBindFramebuffer(GL_FRAMEBUFFER, t.reach.name());
    glClearBufferfv(GL_COLOR, 0, zero.data());
    for (const DepthStencil* target : {&t.previous, &t.last_in_order, &t.breaker}) start(t, *target, 0.0f, nullptr);
    int passes = 1;
    bool from_the_start = true;
    while (find_nearest(t, from_the_start, record) > t.input.settings.query_limit && passes + 6 <= max_passes) {
        find_run(t, from_the_start, record);
        composite(t, record);
        from_the_start = false;
        passes += 6;
    }
    glDisable(GL_STENCIL_TEST);
    t.finish.draw(t.accumulated.name(), t.opaque.color(), picture, record);
    return passes;
}

}  // namespace

Job coherent_stencil_job(const JobInput& input) {
    const auto t = std::make_shared<CoherentTargets>(input);
    return {"coherent_stencil", [t](PixelCodes& picture, int max_passes, Record* record) {
                return coherent_stencil(*t, max_passes, picture, record);
            }};
}

}  // namespace strata::port
