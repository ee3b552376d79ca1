// tools/port/probe/main.cpp - strata_port_probe: draws a kit of scenes with OpenGL and writes the answers as a
// candidate pack.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "tools/port/gl/context.h"
#include "tools/port/gl/npy.h"
#include "tools/port/probe/kit.h"
#include "tools/port/probe/painter.h"

namespace strata::port {

namespace {

// A multisampled texture, RGBA8 with a D32F depth, bound for drawing; contents undefined.
class SampledTarget {
  public:
    // Throws std::runtime_error if OpenGL does not support such a target.
    SampledTarget(FrameSize size, int samples);

    // Samples per pixel: at least the requested number.
    [[nodiscard]] int samples() const noexcept { return samples_; }
    // x and y of each sample in pixels, from the pixel's corner with the least window coordinates; multiples of 1/16 on
    // most devices.
    [[nodiscard]] nlohmann::ordered_json positions() const;
    // The codes of one sample of each pixel.
    [[nodiscard]] PixelCodes color(int sample) const;
    [[nodiscard]] PixelCodes depth(int sample) const;

  private:
    FrameSize size_;
    int samples_ = 0;
    Handle color_, depth_, framebuffer_;
};

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

// Draws the kit's scenes without blending and without an alpha test, with that many samples per pixel and in both
// orientations, into FOLDER/ORIENTATION/SCENE/sample.K.color.npy and .depth.npy. Returns {"samples": n, "positions":
// [[x, y], ...]}.
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

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct ProbePortOptions {
    std::string kit, output, driver = "llvmpipe";
    std::vector<int> samples;
};

// Draws one item and writes its targets.
void answer(const KitItem& item, const Painter& painter, const fs::path& folder) {
    const Handle color = make_texture(item.color, item.size);
    const Handle depth = item.depth ? make_texture(*item.depth, item.size) : Handle{};
    const Handle target = make_framebuffer({color.name()}, depth.name());
    glBindFramebuffer(GL_FRAMEBUFFER, target.name());
    painter.draw(item);
    fs::create_directories(folder);
    write_npy(folder / "color.npy", read_back(color.name(), item.color, item.size));
    if (item.depth) write_npy(folder / "depth.npy", read_back(depth.name(), *item.depth, item.size));
    check_errors(item.name);
}

int limit(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

// The features of OpenGL 3.3 core, and the limits that this driver reports.
ordered_json device() {
    ordered_json features;
    for (const char* name : {"has_d16", "has_d24", "has_d32f", "has_float_targets", "has_fragment_programs",
                             "has_separate_alpha_blend", "has_two_sided_stencil", "has_depth_clamp"})
        features[name] = true;
    for (const char* name : {"has_d16f", "has_d24f", "has_narrow_surfaces", "has_depth_replace", "has_signed_blend"})
        features[name] = false;
    features["has_independent_blend"] = limit(GL_MAJOR_VERSION) >= 4;
    features["max_render_targets"] = limit(GL_MAX_DRAW_BUFFERS);
    features["max_texture_units"] = limit(GL_MAX_TEXTURE_IMAGE_UNITS);
    features["max_viewport_px"] = limit(GL_MAX_VIEWPORT_DIMS);
    features["max_samples"] = limit(GL_MAX_SAMPLES);
    return features;
}

// The items with an alpha test, or those without, in both orientations.
void answer_items(const Kit& kit, bool alpha_tested, const fs::path& folder) {
    const Painter painter;
    for (const bool up : {true, false}) {
        glClipControl(up ? GL_UPPER_LEFT : GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
        for (const KitItem& item : kit.items)
            if (has_alpha_test(item) == alpha_tested) answer(item, painter, folder / (up ? "up" : "down") / item.name);
    }
}

// OpenGL 3.3 core has no alpha test: items with one are drawn in a compatibility context, if the driver provides one.
void answer_alpha_tests(const Kit& kit, const std::string& driver, const fs::path& folder, ordered_json& missing) {
    if (std::ranges::none_of(kit.items, has_alpha_test)) return;
    try {
        const HeadlessContext context(driver, 2, ContextKind::compatible);
        answer_items(kit, true, folder);
    } catch (const std::exception& error) {
        for (const KitItem& item : kit.items)
            for (const char* const orientation : {"up/", "down/"})
                if (has_alpha_test(item)) missing[orientation + item.name] = error.what();
    }
}

// The requested multisampled answers, by number of samples.
void answer_multisampled(const Kit& kit, const std::vector<int>& numbers, const fs::path& folder) {
    if (numbers.empty()) return;
    const Painter painter;
    ordered_json answers = ordered_json::array();
    for (const int samples : numbers)
        answers.push_back(answer_samples(kit, painter, samples, (folder / std::to_string(samples)).string()));
    std::ofstream(folder / "samples.json") << answers.dump(1) << "\n";
}

int run(const ProbePortOptions& options) {
    if (fs::exists(options.output)) throw std::runtime_error(options.output + ": expected no such folder, found one");
    const Kit kit = read_kit(options.kit);
    const fs::path made = options.output + ".part";
    fs::remove_all(made);
    ordered_json missing = ordered_json::object();
    answer_alpha_tests(kit, options.driver, made / "probe", missing);
    const HeadlessContext context(options.driver, 2);
    answer_items(kit, false, made / "probe");
    answer_multisampled(kit, options.samples, made / "samples");
    const ordered_json probe{{"kit", kit.digest}, {"device", device()}, {"missing", missing}};
    const ordered_json document{{"format", "strata-candidate"},
                                {"version", 1},
                                {"made_by", "strata_port_probe, " + context.renderer()},
                                {"probe", probe}};
    std::ofstream(made / "candidate.json") << document.dump(1) << "\n";
    fs::rename(made, options.output);
    return 0;
}

}  // namespace

}  // namespace strata::port

int main(int count, char** words) {
    CLI::App app{"Draws the scenes of a kit by OpenGL and writes the answers.", "strata_port_probe"};
    strata::port::ProbePortOptions options;
    app.add_option("KIT", options.kit, "a folder that strata probe wrote")->required();
    app.add_option("-o,--output", options.output, "the answers: a folder that does not exist")->required();
    app.add_option("--driver", options.driver,
                   "llvmpipe, llvmpipe_sse (without fused multiply-add), softpipe, or hardware")
        ->check(CLI::IsMember(strata::port::driver_names()));
    app.add_option("--samples", options.samples,
                   "also draw with so many samples per pixel, numbers with commas between: ANSWERS/samples")
        ->delimiter(',')
        ->check(CLI::Range(2, 32));
    try {
        app.parse(count, words);
        return strata::port::run(options);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "strata_port_probe: %s\n", error.what());
        return 2;
    }
}
