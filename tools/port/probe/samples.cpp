#include "tools/port/probe/samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>

#include "tools/port/gl/npy.h"

namespace strata::port {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

Handle make_sampled_texture(GLenum sized, FrameSize size, int samples) {
    GLuint name = 0;
    glGenTextures(1, &name);
    Handle handle{name, [](GLuint n) { glDeleteTextures(1, &n); }};
    glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, name);
    glTexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, samples, sized, size.width, size.height, GL_TRUE);
    return handle;
}

Handle make_sampled_framebuffer(const Handle& color, const Handle& depth) {
    GLuint name = 0;
    glGenFramebuffers(1, &name);
    Handle handle{name, [](GLuint n) { glDeleteFramebuffers(1, &n); }};
    glBindFramebuffer(GL_FRAMEBUFFER, name);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D_MULTISAMPLE, color.name(), 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D_MULTISAMPLE, depth.name(), 0);
    return handle;
}

bool is_plain(const KitItem& item) {
    return !has_alpha_test(item) &&
           std::ranges::none_of(item.draws, [](const KitDraw& draw) { return draw.blend.has_value(); });
}

void answer(const KitItem& item, const Painter& painter, int samples, const fs::path& folder) {
    const SampledTarget target(item.size, samples);
    KitItem drawn = item;
    drawn.depth = d32f;
    painter.draw(drawn);
    fs::create_directories(folder);
    for (int k = 0; k < target.samples(); ++k) {
        write_npy(folder / fmt::format("sample.{}.color.npy", k), target.color(k));
        write_npy(folder / fmt::format("sample.{}.depth.npy", k), target.depth(k));
    }
    check_errors(item.name);
}

}  // namespace

SampledTarget::SampledTarget(FrameSize size, int samples)
    : size_{size},
      color_{make_sampled_texture(GL_RGBA8, size, samples)},
      depth_{make_sampled_texture(GL_DEPTH_COMPONENT32F, size, samples)},
      framebuffer_{make_sampled_framebuffer(color_, depth_)} {
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error(fmt::format("OpenGL: no target of {} samples per pixel", samples));
    glGetIntegerv(GL_SAMPLES, &samples_);
}

ordered_json SampledTarget::positions() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    ordered_json all = ordered_json::array();
    for (GLuint k = 0; k < static_cast<GLuint>(samples_); ++k) {
        std::array<float, 2> position{};
        glGetMultisamplefv(GL_SAMPLE_POSITION, k, position.data());
        all.push_back(position);
    }
    return all;
}

PixelCodes SampledTarget::color(int sample) const { return read_sample(color_.name(), sample, rgba8, size_); }
PixelCodes SampledTarget::depth(int sample) const { return read_sample(depth_.name(), sample, r32f, size_); }

ordered_json answer_samples(const Kit& kit, const Painter& painter, int samples, const std::string& folder) {
    const SampledTarget target({1, 1}, samples);
    const ordered_json answer_of{{"samples", target.samples()}, {"positions", target.positions()}};
    for (const bool up : {true, false})
        for (const KitItem& item : kit.items) {
            if (!is_plain(item)) continue;
            glClipControl(up ? GL_UPPER_LEFT : GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
            answer(item, painter, samples, fs::path(folder) / (up ? "up" : "down") / item.name);
        }
    return answer_of;
}

}  // namespace strata::port
