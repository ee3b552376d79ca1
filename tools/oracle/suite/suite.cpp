// tools/oracle/suite/suite.cpp - the scenes of the suite, each with its purpose, its options and its command
// (suite.h).
#include "tools/oracle/suite/suite.h"

#include <fmt/format.h>

#include <algorithm>

#include "peeling/registry.h"
#include "scenes/camera.h"

namespace strata::oracle {

namespace {

using peeling::RenderOptions;
using pipeline::DepthFormat;
using pipeline::Format;

constexpr const char* blue = "--background 0.2,0.3,0.5";
void on_blue(RenderOptions& o) { o.background = {0.2f, 0.3f, 0.5f, 1}; }

SuiteScene showroom(const std::string& algorithm, const std::string& why, const std::string& profile = "geforce8") {
    return {.name = "showroom." + algorithm,
            .why = why,
            .scene = "showroom",
            .algorithm = algorithm,
            .profile = profile,
            .options = blue,
            .set = on_blue};
}

// Up to some dozens of fragments a pixel, some of them of one depth.
void add_fixed_passes(std::vector<SuiteScene>& all) {
    const auto add = [&](const char* algorithm, const char* why, const char* profile, int triangles = 120) {
        all.push_back({.name = std::string{"random."} + algorithm,
                       .why = why,
                       .scene = fmt::format("random:seed=7,triangles={}", triangles),
                       .algorithm = algorithm,
                       .profile = profile,
                       .width = 32,
                       .height = 32,
                       .options = "--color-format rgba8 --background 0.2,0.3,0.5",
                       .set = [](RenderOptions& o) {
                           on_blue(o);
                           o.color_format = Format::rgba8;
                       }});
    };
    add("weighted_blended", "one pass, sums weighted by alpha and depth", "geforce8_dx101");
    add("moments", "two passes, transmittance by moments of depth", "geforce8");
    add("stochastic", "two passes, fragments on samples by a hash", "geforce8_dx101");
    add("bucket_peel", "depths in sixteen buckets", "geforce8");
    add("linked_list", "all fragments of a pixel in a list", "ideal", 400);
    add("multi_layer", "four layers, merged as fragments come", "ideal");
    add("atomic_loop", "the four nearest depths, the rest blended behind", "ideal");
    add("hybrid_transparency", "the four nearest fragments, the rest averaged", "ideal");
}

void add_samples(std::vector<SuiteScene>& all) {
    const auto add = [&](const char* name, const char* algorithm, const char* why, const char* profile = "geforce8") {
        all.push_back({.name = name,
                       .why = why,
                       .scene = "random:seed=7,triangles=60",
                       .algorithm = algorithm,
                       .profile = profile,
                       .width = 32,
                       .height = 32,
                       .samples = 4,
                       .options = blue,
                       .set = on_blue});
    };
    add("samples.front_to_back", "front_to_back", "four samples per pixel: edges where they have different layers");
    add("samples.dual", "dual", "the same, where the depths that are compared are colours");
    add("samples.unsorted", "unsorted", "the same without programs that load a sample");
    add("samples.llvmpipe", "front_to_back", "the same, where alpha to coverage rounds up", "llvmpipe");
}

std::vector<SuiteScene> scenes_of_suite() {
    std::vector<SuiteScene> all{
        showroom("dual", "dual depth peeling over everything"),
        showroom("front_to_back", "one layer a pass, D32F"),
        showroom("depth_units", "one layer a pass by a second depth test"),
        showroom("dual_independent", "dual peeling with a blend function a target", "geforce8_dx101"),
        showroom("weighted_average", "one pass, fp16 sums and counts"),
        showroom("weighted_sum", "one pass, fp16 sums"),
        showroom("layer_peel", "a pass finds a layer, another one composites it"),
        showroom("coherent_stencil", "runs of fragments counted in the stencil"),
        showroom("stencil_routed_k_buffer", "eight fragments a pass, routed by the stencil"),
        showroom("shadow_map_depth_replace", "one layer a pass by a shadow comparison", "geforce3"),
    };
    const auto add = [&](const char* name, const char* why, const std::string& algorithm, const std::string& options,
                         void (*set)(RenderOptions&)) {
        SuiteScene scene = showroom(algorithm, why);
        scene.name = name;
        scene.options = options;
        scene.set = set;
        all.push_back(scene);
    };
    add("float.dual", "binary32 colours: every rounding shows", "dual", "--color-format rgba32f",
        [](RenderOptions& o) { o.color_format = Format::rgba32f; });
    add("half.front_to_back", "fp16 colours over D24", "front_to_back",
        "--color-format rgba16f --depth-format d24 --background 0.2,0.3,0.5", [](RenderOptions& o) {
            on_blue(o);
            o.color_format = Format::rgba16f;
            o.depth = DepthFormat::d24;
        });
    add("two_layers.front_to_back", "a port that is asked for two layers alone", "front_to_back",
        "--max-passes 2 --background 0.2,0.3,0.5", [](RenderOptions& o) {
            on_blue(o);
            o.max_passes = 2;
        });
    add("offset.front_to_back", "a polygon offset, which must not be forgotten", "front_to_back",
        "--polygon-offset 4,64 --depth-format d24", [](RenderOptions& o) {
            o.raster.polygon_offset = {true, 4, 64};
            o.depth = DepthFormat::d24;
        });
    all.push_back({.name = "deep.stencil_routed_k_buffer",
                   .why = "300 layers: counts in the stencil meet the end of their range",
                   .scene = "volume-beam:slices=300",
                   .algorithm = "stencil_routed_k_buffer",
                   .width = 8,
                   .height = 8,
                   .options = blue,
                   .set = on_blue});
    all.push_back({.name = "planes.front_to_back",
                   .why = "eight planes a depth code apart: the last bit of every depth shows",
                   .scene = "hard:case=planes-8-close",
                   .algorithm = "front_to_back",
                   .width = 32,
                   .height = 32,
                   .options = blue,
                   .set = on_blue});
    all.push_back({.name = "random.stencil_routed_k_buffer",
                   .why = "up to some dozens of fragments a pixel, routed by the stencil",
                   .scene = "random:seed=7,triangles=400",
                   .algorithm = "stencil_routed_k_buffer",
                   .width = 32,
                   .height = 32,
                   .options = blue,
                   .set = on_blue});
    all.push_back({.name = "random.dual",
                   .why = "triangles of all sizes, facings and alphas, with ties",
                   .scene = "random:seed=7,triangles=120",
                   .algorithm = "dual",
                   .width = 48,
                   .height = 48,
                   .options = blue,
                   .set = on_blue});
    all.push_back({.name = "random.front_to_back",
                   .why = "the same, where of equal depths the first one stays",
                   .scene = "random:seed=7,triangles=120",
                   .algorithm = "front_to_back",
                   .width = 48,
                   .height = 48,
                   .options = blue,
                   .set = on_blue});
    add_fixed_passes(all);
    add_samples(all);
    return all;
}

}  // namespace

std::span<const SuiteScene> suite() {
    static const std::vector<SuiteScene> all = scenes_of_suite();
    return all;
}

const SuiteScene* find_suite_scene(std::string_view name) {
    const auto all = suite();
    const auto found = std::ranges::find(all, name, &SuiteScene::name);
    return found == all.end() ? nullptr : &*found;
}

OpenScene open(const SuiteScene& of) {
    constexpr double azimuth = 30, elevation = 20;  // in degrees: the command's defaults
    OpenScene opened{.scene = scenes::load_scene(of.scene, {}),
                     .view = {},
                     .profile = *pipeline::find_profile(of.profile),
                     .options = {},
                     .algorithm = peeling::find_algorithm(of.algorithm)};
    opened.options.sampling.samples = of.samples;
    opened.options.width = of.width;
    opened.options.height = of.height;
    if (of.set != nullptr) of.set(opened.options);
    opened.view = opened.scene.own_view.value_or(
        scenes::orbit_view(opened.scene.bounds, azimuth, elevation, double(of.width) / of.height));
    return opened;
}

std::string command_of(const SuiteScene& of, std::string_view verb) {
    const std::string samples = of.samples == 1 ? "" : fmt::format(" --samples {}", of.samples);
    return fmt::format("strata {} {} --algorithm {} --profile {} --size {}x{}{}{}{}", verb, of.scene, of.algorithm,
                       of.profile, of.width, of.height, samples, of.options.empty() ? "" : " ", of.options);
}

}  // namespace strata::oracle
