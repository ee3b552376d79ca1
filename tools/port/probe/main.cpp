// tools/port/probe/main.cpp - strata_port_probe: a kit of scenes drawn by OpenGL, the answers written as a candidate pack.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tools/port/context.h"
#include "tools/port/npy.h"
#include "tools/port/probe/kit.h"
#include "tools/port/probe/operations.h"

// Deprecated since OpenGL 3.0, so that glcorearb.h lacks it; libOpenGL has it.
extern "C" void glAlphaFunc(GLenum func, GLclampf ref);

namespace strata::port {

namespace {

constexpr GLenum alpha_test = 0x0BC0;  // GL_ALPHA_TEST

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct Options {
    std::string kit, output, driver = "llvmpipe";
};

// Positions are in clip space already, and the colour goes through as it is: the shaders compute nothing.
constexpr auto vertex_text = R"(
layout(location = 0) in vec4 clip;
layout(location = 1) in vec4 corner_color;
out vec4 color;
void main() {
    gl_Position = clip;
    color = corner_color;
}
)";
constexpr auto fragment_text = R"(
in vec4 color;
layout(location = 0) out vec4 drawn;
void main() { drawn = color; }
)";

class Painter {
  public:
    Painter() : program_{make_program({.head = "", .vertex = vertex_text, .fragment = fragment_text, .samplers = {}})} {
        glGenVertexArrays(1, &layout_);
        glGenBuffers(1, &buffer_);
        glBindVertexArray(layout_);
        glBindBuffer(GL_ARRAY_BUFFER, buffer_);
        for (GLuint i = 0; i < 2; ++i) {
            glEnableVertexAttribArray(i);
            glVertexAttribPointer(i, 4, GL_FLOAT, GL_FALSE, 32, reinterpret_cast<const void*>(std::uintptr_t{i * 16}));
        }
        glDisable(GL_DITHER);
        glDisable(GL_CULL_FACE);
    }
    Painter(const Painter&) = delete;
    Painter& operator=(const Painter&) = delete;
    ~Painter() {
        glDeleteBuffers(1, &buffer_);
        glDeleteVertexArrays(1, &layout_);
    }

    // The whole item into the framebuffer that is bound.
    void draw(const KitItem& item) const {
        glViewport(0, 0, item.size.width, item.size.height);
        glDepthRange(double{item.depth_range[0]}, double{item.depth_range[1]});
        glDepthMask(GL_TRUE);
        glDepthFunc(GL_ALWAYS);
        (item.depth ? glEnable : glDisable)(GL_DEPTH_TEST);
        glClearColor(0, 0, 0, 0);
        glClearDepth(1.0);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        glUseProgram(program_.name());
        glBindVertexArray(layout_);
        glBindBuffer(GL_ARRAY_BUFFER, buffer_);
        // As peels are drawn: where no query counts, softpipe steps D16 along its spans (mesa-rasterizers.md 3.3).
        glBeginQuery(GL_SAMPLES_PASSED, query_.name());
        for (const KitDraw& one : item.draws) draw(one);
        glEndQuery(GL_SAMPLES_PASSED);
        glDisable(GL_BLEND);
        glDisable(GL_POLYGON_OFFSET_FILL);
    }

  private:
    static void draw(const KitDraw& one) {
        (one.blend ? glEnable : glDisable)(GL_BLEND);
        if (one.blend) {
            glBlendEquation(one.blend->equation);
            glBlendFunc(one.blend->source, one.blend->destination);
        }
        (one.polygon_offset ? glEnable : glDisable)(GL_POLYGON_OFFSET_FILL);
        if (one.polygon_offset) glPolygonOffset((*one.polygon_offset)[0], (*one.polygon_offset)[1]);
        // Once on it stays: where it can be asked for, all items have it.
        if (one.alpha_above) {
            glEnable(alpha_test);
            glAlphaFunc(GL_GREATER, *one.alpha_above);
        }
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(one.words.size() * 4), one.words.data(), GL_STREAM_DRAW);
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(one.words.size() / 8));
    }

    Handle program_, query_ = make_query();
    GLuint layout_ = 0, buffer_ = 0;
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

// What OpenGL 3.3 core promises, and what this driver says of its limits.
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

bool has_alpha_test(const KitItem& item) {
    return std::ranges::any_of(item.draws, [](const KitDraw& draw) { return draw.alpha_above.has_value(); });
}

// The items that have an alpha test, or those that have none, in both orientations.
void answer_items(const Kit& kit, bool alpha_tested, const fs::path& folder) {
    const Painter painter;
    for (const bool up : {true, false}) {
        glClipControl(up ? GL_UPPER_LEFT : GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
        for (const KitItem& item : kit.items)
            if (has_alpha_test(item) == alpha_tested) answer(item, painter, folder / (up ? "up" : "down") / item.name);
    }
}

// OpenGL 3.3 core has no alpha test: what has one is drawn in a context with what is deprecated, where the driver gives one.
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

// Operations are drawn with +y down, as in the page.
void answer_operations(const Kit& kit, const fs::path& folder, ordered_json& missing) {
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    if (!kit.operations.empty()) fs::create_directories(folder);
    for (const nlohmann::json& described : kit.operations) {
        const std::string name = described.at("name").get<std::string>();
        try {
            write_npy(folder / (name + ".npy"), draw_operation(described));
        } catch (const std::exception& error) {
            missing["operations/" + name] = error.what();
        }
    }
}

int run(const Options& options) {
    if (fs::exists(options.output)) throw std::runtime_error(options.output + ": expected no such folder, found one");
    const Kit kit = read_kit(options.kit);
    const fs::path made = options.output + ".part";
    fs::remove_all(made);
    ordered_json missing = ordered_json::object();
    answer_alpha_tests(kit, options.driver, made / "probe", missing);
    const HeadlessContext context(options.driver, 2);
    answer_items(kit, false, made / "probe");
    answer_operations(kit, made / "probe" / "operations", missing);
    ordered_json probe{{"kit", kit.digest}, {"device", device()}, {"missing", missing}};
    if (!kit.operations_digest.empty()) probe["operations"] = kit.operations_digest;
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
    strata::port::Options options;
    app.add_option("KIT", options.kit, "a folder that strata probe wrote")->required();
    app.add_option("-o,--output", options.output, "the answers: a folder that does not exist")->required();
    app.add_option("--driver", options.driver,
                   "llvmpipe, llvmpipe_sse (without fused multiply-add), softpipe, or hardware")
        ->check(CLI::IsMember(strata::port::driver_names()));
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
