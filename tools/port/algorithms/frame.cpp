// tools/port/algorithms/frame.cpp - draws the opaque scene, blends the finished front over it, and reads the picture
// back (frame.h).
#include "tools/port/algorithms/frame.h"

#include <fmt/format.h>

namespace strata::port {

void set_window(FrameSize size, const PortSettings& settings, GLenum clip_depth) {
    const GLenum other = clip_depth == GL_ZERO_TO_ONE ? GL_NEGATIVE_ONE_TO_ONE : GL_ZERO_TO_ONE;
    glViewport(0, 0, size.width, size.height);
    glClipControl(settings.origin, settings.other_clip_depth ? other : clip_depth);
    (settings.scissored ? glEnable : glDisable)(GL_SCISSOR_TEST);
    glScissor(0, 0, size.width * 3 / 4, size.height);
}

Opaque::Opaque(const JobInput& input, const PixelFormat& depth)
    : size_{input.size},
      format_{depth},
      color_format_{input.formats.color},
      background_{input.background},
      exists_{input.scene.has(Surfaces::opaque)},
      settings_{input.settings},
      color_{make_texture(input.formats.color, input.size)},
      depth_{make_texture(depth, input.size)},
      framebuffer_{make_framebuffer({color_.name()}, depth_.name())},
      program_{input.scene.make_program("layout(location = 0) out vec4 color;\n"
                                        "void main() { color = vec4(shade().rgb, 1.0); }\n")} {}

void Opaque::draw(const GpuScene& scene) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glClearBufferfv(GL_COLOR, 0, background_.data());
    glClearBufferfv(GL_DEPTH, 0, &settings_.farthest);
    if (!exists_) return;
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(settings_.farthest == 0 ? GL_GREATER : GL_LESS);
    glUseProgram(program_.name());
    scene.draw(Surfaces::opaque);
    if (!settings_.opaque_tested) glClearBufferfv(GL_DEPTH, 0, &settings_.farthest);
    if (settings_.sampled.opaque_resolved) resolve_in_place(color_.name(), color_format_, size_);
    if (settings_.sampled.first_opaque_depth) share_first_depth(depth_.name(), size_);
}

void Opaque::copy_depth_to(const Handle& framebuffer) const {
    if (!exists_) {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
        glClearBufferfv(GL_DEPTH, 0, &settings_.farthest);
        return;
    }
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer.name());
    glBlitFramebuffer(0, 0, size_.width, size_.height, 0, 0, size_.width, size_.height, GL_DEPTH_BUFFER_BIT,
                      GL_NEAREST);
}

void Opaque::copy_color_to(const Handle& framebuffer) const {
    if (!exists_) {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
        glClearBufferfv(GL_COLOR, 0, background_.data());
        return;
    }
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer.name());
    glBlitFramebuffer(0, 0, size_.width, size_.height, 0, 0, size_.width, size_.height, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
}

std::string Opaque::hidden_text() const {
    const std::string far = format_ == d32f ? "1.0" : "stored(1.0)";
    return exists_ ? "uniform sampler2D opaque_depth;\n"
                     "bool hidden(float z) { return z >= texelFetch(opaque_depth, TEXEL, 0).r; }\n"
                   : "bool hidden(float z) { return z >= " + far + "; }\n";
}

FinalQuad::FinalQuad(const JobInput& input, const std::string& through)
    : input_{input},
      target_{make_texture(picture_format(input), input.size)},
      framebuffer_{make_framebuffer({target_.name()})},
      program_{make_full_screen_program(
          fmt::format(R"(
uniform sampler2D front_target;
uniform sampler2D behind_target;
layout(location = 0) out vec4 result;
void main() {{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 front = texelFetch(front_target, pixel, 0);
    vec3 behind = {};
    as_written vec3 mixed = front.rgb + ({}) * behind;
    result = vec4(mixed, 1.0);
}}
)",
                      input.settings.background_used ? "texelFetch(behind_target, pixel, 0).rgb" : "vec3(0.0)",
                      through),
          {"front_target", "behind_target"})} {}

void FinalQuad::draw(GLuint front, GLuint behind, PixelCodes& picture, Record* record) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glDisable(GL_BLEND);
    const bool encodes = glIsEnabled(GL_FRAMEBUFFER_SRGB) == GL_TRUE;
    if (input_.settings.encoded_again) glEnable(GL_FRAMEBUFFER_SRGB);
    bind({front, behind});
    draw_full_screen(program_);
    if (!encodes) glDisable(GL_FRAMEBUFFER_SRGB);
    show_pass(record, input_.size, "full_screen", {{"result", target_.name(), input_.formats.color}});
    picture = read_picture(target_.name(), input_);
}

PixelFormat picture_format(const JobInput& input) {
    const bool is_encoded = input.settings.encoded_again || input.settings.sampled.resolves_linear_light;
    return is_encoded && input.formats.color == rgba8 ? srgb8 : input.formats.color;
}

PixelCodes read_picture(GLuint texture, const JobInput& input) {
    PixelFormat read = picture_format(input);
    read.external = input.settings.channel_order;
    PixelCodes picture = read_back(texture, read, input.size);
    picture.format = input.formats.color;
    return picture;
}

std::string stored_text(const PixelFormat& depth) {
    const std::string greatest = depth == d16 ? "65535.0" : "16777215.0";
    const std::string stored = depth == d32f ? "z" : "roundEven(z * " + greatest + ") * (1.0 / " + greatest + ")";
    return "float stored(float z) { z = clamp(z, 0.0, 1.0); return " + stored + "; }\n";
}

}  // namespace strata::port
