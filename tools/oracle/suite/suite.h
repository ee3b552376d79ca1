// tools/oracle/suite/suite.h - the standard set of small scenes: each known mistake changes the image of at least
// one of them.
//
// Rule     An entry is a command: a built-in scene, an algorithm, a profile and the options that affect the image.
//          Frames are small, so that a port's author can run all of them at once and examine every pixel.
// Tests    tests/tools/oracle/emulations/catalogue_test.cpp
#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "scenes/scene.h"
#include "tools/oracle/passes/passes.h"

namespace strata::oracle {

struct SuiteScene {
    std::string name{};  // "showroom.dual"
    std::string why{};   // its purpose in the suite, as one sentence
    std::string scene{}, algorithm{}, profile = "geforce8";
    int width = 64, height = 64;
    int samples = 1;        // per pixel
    std::string options{};  // command-line options other than scene, algorithm, profile, size and samples
    void (*set)(peeling::RenderOptions& options) = nullptr;  // the same options for the library
};

[[nodiscard]] std::span<const SuiteScene> suite();
[[nodiscard]] const SuiteScene* find_suite_scene(std::string_view name);

// A scene of the suite, ready to run.
struct OpenScene {
    scenes::Scene scene;
    pipeline::View view;
    pipeline::DeviceProfile profile;
    peeling::RenderOptions options;
    const peeling::Algorithm* algorithm = nullptr;
    [[nodiscard]] peeling::FrameRequest input() const { return {scene.list, view, profile, options}; }
};
[[nodiscard]] OpenScene open(const SuiteScene& scene);

// "strata render showroom --algorithm dual --size 64x64 --background 0.2,0.3,0.5"
[[nodiscard]] std::string command_of(const SuiteScene& scene, std::string_view verb = "render");

}  // namespace strata::oracle
