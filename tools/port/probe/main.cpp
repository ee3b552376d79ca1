// tools/port/probe/main.cpp - strata_port_probe: draws a kit of scenes with OpenGL and writes the answers as a
// candidate pack.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tools/port/gl/context.h"
#include "tools/port/gl/npy.h"
#include "tools/port/probe/kit.h"
#include "tools/port/probe/painter.h"
#include "tools/port/probe/samples.h"

namespace strata::port {

namespace {

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
