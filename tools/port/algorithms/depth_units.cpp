// tools/port/algorithms/depth_units.cpp - one layer per pass, with a shadow comparison as the second depth test; layers
// are composited at the end. Everitt 2001, Listing 1 with the depth texture of its shadow mapping;
// peeling/reference/algorithms.md 2. Passes: N + 1.
#include <fmt/format.h>

#include <memory>

#include "tools/port/algorithms/frame.h"

namespace strata::port {

namespace {

// The depth texture's comparison tells whether the fragment is behind the layer peeled before. Its coordinates are the
// centre of the fragment's own texel.
constexpr auto peel_text = R"(
uniform sampler2DShadow peeled_depth;
layout(location = 0) out vec4 layer;
void main() {{
#ifdef PEELS
    vec2 middle = (vec2(TEXEL) + 0.5) * vec2({}, {});
    if (texture(peeled_depth, vec3(middle, stored(gl_FragCoord.z))) == 0.0) discard;
#endif
    layer = shade();
}}
)";

constexpr auto copy_text = R"(
uniform sampler2D source;
layout(location = 0) out vec4 copied;
void main() { copied = texelFetch(source, ivec2(gl_FragCoord.xy), 0); }
)";

// A saved layer: colours that are not premultiplied, and depths for the next pass's comparison.
struct SavedLayer {
    Handle color, depth, framebuffer;
    explicit SavedLayer(const JobInput& in)
        : color{make_texture(in.formats.color, in.size)},
          depth{make_texture(in.formats.depth, in.size)},
          framebuffer{make_framebuffer({color.name()}, depth.name())} {
        glBindTexture(GL_TEXTURE_2D, depth.name());
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, static_cast<GLint>(in.settings.shadow_compare));
    }
};

struct UnitTargets {
    JobInput input;
    Opaque opaque;
    Handle result, composite, query, first_program, next_program, copy_program;
    FinalQuad finish;

    explicit UnitTargets(const JobInput& in)
        : input{in},
          opaque{in, in.formats.depth},
          result{make_texture(in.formats.color, in.size)},
          composite{make_framebuffer({result.name()})},
          query{make_query()},
          copy_program{make_full_screen_program(copy_text, {"source"})},
          finish{in, "0.0"} {
        const std::string text = fmt::format(peel_text, 1.0 / in.size.width, 1.0 / in.size.height);
        first_program = in.scene.make_program(text);
        next_program =
            in.scene.make_program("#define PEELS\n" + stored_text(in.formats.depth) + text, {"peeled_depth"});
    }
};

// Draws the nearest layer behind `peeled`, which is null in the first pass. Returns the samples that passed.
std::uint64_t peel(const UnitTargets& t, const SavedLayer* peeled, const SavedLayer& to) {
    t.opaque.copy_depth_to(to.framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, to.framebuffer.name());
    glClearBufferfv(GL_COLOR, 0, zero.data());
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(t.input.settings.depth_func);
    bind({peeled == nullptr ? 0 : peeled->depth.name()});
    glUseProgram((peeled == nullptr ? t.first_program : t.next_program).name());
    glBeginQuery(GL_SAMPLES_PASSED, t.query.name());
    t.input.scene.draw();
    glEndQuery(GL_SAMPLES_PASSED);
    return samples_passed(t.query);
}

// OVER, from the farthest layer to the nearest. A pixel without such a layer has alpha 0.
void composite(const UnitTargets& t, const std::vector<SavedLayer>& layers, std::size_t left_out, Record* record) {
    if (t.input.settings.background_used) {
        t.opaque.copy_color_to(t.composite);
    } else {
        glBindFramebuffer(GL_FRAMEBUFFER, t.composite.name());
        glClearBufferfv(GL_COLOR, 0, zero.data());
    }
    for (std::size_t i = layers.size() - std::min(layers.size(), left_out); i-- > 0;) {
        glBindFramebuffer(GL_FRAMEBUFFER, t.composite.name());
        glEnable(GL_BLEND);
        glBlendEquation(GL_FUNC_ADD);
        glBlendFunc(t.input.settings.over[0], t.input.settings.over[1]);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);  // the final alpha stays 1
        bind({layers[i].color.name()});
        draw_full_screen(t.copy_program);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        show_pass(record, t.input.size, "full_screen", {{"result", t.result.name(), t.input.formats.color}});
    }
}

int depth_units(const UnitTargets& t, int max_passes, PixelCodes& picture, Record* record) {
    const TargetFormats& formats = t.input.formats;
    t.opaque.draw(t.input.scene);
    std::vector<SavedLayer> layers;
    for (bool left = true; left && static_cast<int>(layers.size()) < max_passes;) {
        SavedLayer layer(t.input);
        const std::uint64_t drawn = peel(t, layers.empty() ? nullptr : &layers.back(), layer);
        left = drawn > t.input.settings.query_limit;
        layers.push_back(std::move(layer));
        const SavedLayer& last = layers.back();
        const std::string number = layers.size() > 1 ? fmt::format(".{}", layers.size() - 1) : "";
        show_pass(record, t.input.size, "geometry",
                  {{"layer" + number, last.color.name(), formats.color},
                   {"nearest" + number, last.depth.name(), formats.depth}},
                  drawn);
        if (record != nullptr && drawn > 0)
            record->layers.push_back({read_back(last.color.name(), formats.color, t.input.size),
                                      read_back(last.depth.name(), formats.depth, t.input.size)});
    }
    const auto lost = static_cast<std::size_t>(t.input.settings.passes_left_out);
    composite(t, layers, lost > 0 ? lost + 1 : 0, record);
    t.finish.draw(t.result.name(), t.result.name(), picture, nullptr);
    return static_cast<int>(layers.size());
}

}  // namespace

Job depth_units_job(const JobInput& input) {
    const auto t = std::make_shared<UnitTargets>(input);
    return {"depth_units", [t](PixelCodes& picture, int max_passes, Record* record) {
                return depth_units(*t, max_passes, picture, record);
            }};
}

}  // namespace strata::port
