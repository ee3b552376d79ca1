// Tests pixel shading and loads of other samples against a model that peels one pixel's samples with plain numbers: the
// captured fragments of every sample, and nothing of the pipeline.
#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>

#include "peeling/audit/region_trace.h"
#include "peeling/render.h"
#include "pipeline/device/sample_points.h"
#include "rasterizer/rules/depth_code.h"
#include "tests/peeling/rendering.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata::testing;
using strata::peeling::find_algorithm;
using strata::peeling::FrameFragments;
using strata::peeling::Multisampling;
using strata::peeling::Outcome;
using strata::peeling::RegionTrace;
using strata::peeling::Renderer;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::pipeline::find_profile;
using strata::pipeline::Image;
using strata::pipeline::LoadedSample;
using strata::rasterizer::Interpolation;

constexpr std::size_t model_samples = 4;
constexpr int model_size = 24;

[[nodiscard]] RenderOptions model_options(Interpolation interpolation) {
    RenderOptions options;
    options.width = options.height = model_size;
    options.threads = 1;
    options.depth = strata::pipeline::DepthFormat::d24;
    options.raster.interpolation = interpolation;
    return options;
}

// One fragment at one sample.
struct ModelFragment {
    std::uint32_t code = 0;      // as the sample stores it
    std::uint32_t compared = 0;  // as the program compares it: the code of the pixel's depth
};
struct ModelPixel {
    std::array<std::vector<ModelFragment>, model_samples> fragments;
    std::array<std::uint32_t, model_samples> opaque{};
};

[[nodiscard]] FrameFragments captured(const TriangleScene& scene, RenderOptions options, std::size_t sample,
                                      const char* algorithm = "front_to_back") {
    const auto& profile = *find_profile("geforce8_dx101");
    strata::pipeline::set_sample(options.raster, profile.sample_positions, model_samples, sample);
    options.sampling = {};
    Renderer renderer{scene.list, scene.view, profile, options};
    return renderer.fragments(*find_algorithm(algorithm));
}

// The code that a program compares is that of the depth at the pixel; d24 codes of binary32 depths, to nearest.
[[nodiscard]] std::uint32_t d24_code(float z) {
    const double limited = z > 0 ? (z < 1 ? double{z} : 1.0) : 0.0;
    return static_cast<std::uint32_t>(limited * 16777215.0 + 0.5);
}

[[nodiscard]] std::vector<ModelPixel> model_pixels(const TriangleScene& scene, const RenderOptions& options) {
    std::vector<ModelPixel> pixels(model_size * model_size);
    for (std::size_t s = 0; s < model_samples; ++s) {
        const FrameFragments found = captured(scene, options, s);
        for (const auto& f : found.all) pixels[f.pixel].fragments[s].push_back({f.code, d24_code(f.shader_z)});
        for (std::size_t p = 0; p < pixels.size(); ++p) pixels[p].opaque[s] = found.opaque[p];
    }
    return pixels;
}

// What each sample composites, in order: stored codes.
using Sequences = std::array<std::vector<std::uint32_t>, model_samples>;

template <class Value>
[[nodiscard]] Value loaded(LoadedSample rule, const std::array<Value, model_samples>& stored, std::size_t own) {
    if (rule == LoadedSample::own) return stored[own];
    return rule == LoadedSample::zero ? stored[0] : *std::min_element(stored.begin(), stored.end());
}

// Pass after pass: the nearest fragment by the sample's code among those whose compared code is beyond the loaded one.
[[nodiscard]] Sequences peeled_front_to_back(const ModelPixel& pixel, LoadedSample rule, int passes) {
    Sequences sequences;
    std::array<std::uint32_t, model_samples> peeled{};
    for (int pass = 0; pass < passes; ++pass) {
        std::array<std::uint32_t, model_samples> nearest = pixel.opaque;
        for (std::size_t s = 0; s < model_samples; ++s) {
            for (const ModelFragment& f : pixel.fragments[s])
                if (pass == 0 || f.compared > loaded(rule, peeled, s)) nearest[s] = std::min(nearest[s], f.code);
            if (nearest[s] < pixel.opaque[s]) sequences[s].push_back(nearest[s]);
        }
        peeled = nearest;
    }
    return sequences;
}

// Calls visit(pixel, sample, entry) for every composited fragment.
template <class Visit>
void for_each_entry(const std::vector<RegionTrace>& traces, const Visit& visit) {
    for (const RegionTrace& region : traces)
        for (const auto& entry : region.entries) {
            const auto width = static_cast<std::uint32_t>(region.rect.width()),
                       area = static_cast<std::uint32_t>(region.rect.area());
            const auto x = static_cast<std::uint32_t>(region.rect.x0) + entry.pixel % area % width;
            const auto y = static_cast<std::uint32_t>(region.rect.y0) + entry.pixel % area / width;
            visit(y * model_size + x, entry.pixel / area, entry);
        }
}

[[nodiscard]] std::vector<Sequences> traced(const std::vector<RegionTrace>& traces) {
    std::vector<Sequences> sequences(model_size * model_size);
    for_each_entry(
        traces, [&](std::size_t pixel, std::size_t s, const auto& entry) { sequences[pixel][s].push_back(entry.key); });
    return sequences;
}

// Calls check(options, rule, results, traces) for each shading and load rule.
template <class Check>
void for_each_rule(const TriangleScene& scene, const char* algorithm, const Check& check) {
    for (const Interpolation interpolation : {Interpolation::sample, Interpolation::centre, Interpolation::centroid}) {
        RenderOptions options = model_options(interpolation);
        for (const LoadedSample rule : {LoadedSample::own, LoadedSample::zero, LoadedSample::resolved}) {
            options.sampling = {.samples = 4, .loads = rule};
            options.keep_samples = true;
            Renderer renderer{scene.list, scene.view, *find_profile("geforce8_dx101"), options};
            std::vector<RegionTrace> traces;
            const RenderResult result = renderer.render_traced(*find_algorithm(algorithm), traces);
            REQUIRE(result.outcome == strata::peeling::Outcome::done);
            INFO(static_cast<int>(interpolation) << ' ' << static_cast<int>(rule));
            check(options, rule, result, traces);
        }
    }
}

}  // namespace

TEST_CASE("front to back under every load rule composites at each sample what a model of its fragments does") {
    const TriangleScene scene = random_triangles(4501, 30);
    for_each_rule(scene, "front_to_back", [&](const auto& options, auto rule, const auto& result, const auto& traces) {
        const std::vector<ModelPixel> pixels = model_pixels(scene, options);
        const std::vector<Sequences> drawn = traced(traces);
        std::uint64_t wrong = 0, composited = 0, unlike = 0;
        for (std::size_t p = 0; p < pixels.size(); ++p) {
            const Sequences right = peeled_front_to_back(pixels[p], LoadedSample::own, 40);
            for (std::size_t s = 0; s < model_samples; ++s) {
                const int passes = result.frame.passes.geometry;
                const auto model = peeled_front_to_back(pixels[p], rule, passes)[s];
                wrong += model == drawn[p][s] ? 0 : 1;
                composited += model.size();
                unlike += model == right[s] ? 0 : 1;
            }
        }
        CHECK(wrong == 0);
        CHECK(composited > 1000);
        if (rule != LoadedSample::own) CHECK(unlike > 100);
    });
}

namespace {

// Dual peeling of a pixel in plain numbers: what each sample composites at one end, depths in order.
struct DualPixel {
    std::array<std::vector<float>, model_samples> depths;  // in submission order
    std::array<float, model_samples> opaque{};
};
struct DualEnds {
    float minus_near = -1, far = -1;
};
struct DualSequences {
    Sequences front, back;  // depths by their order
};

[[nodiscard]] DualEnds loaded_ends(LoadedSample rule, const std::array<DualEnds, model_samples>& stored,
                                   std::size_t own) {
    if (rule == LoadedSample::own) return stored[own];
    if (rule == LoadedSample::zero) return stored[0];
    DualEnds sum{0, 0};  // the mean in binary32, sample by sample
    for (const DualEnds& ends : stored) sum.minus_near += ends.minus_near, sum.far += ends.far;
    return {sum.minus_near * 0.25f, sum.far * 0.25f};
}

[[nodiscard]] DualSequences peeled_dual(const DualPixel& pixel, LoadedSample rule, int passes) {
    DualSequences sequences;
    std::array<DualEnds, model_samples> ends{};
    for (int pass = 0; pass < passes; ++pass) {
        std::array<DualEnds, model_samples> next{};
        for (std::size_t s = 0; s < model_samples; ++s) {
            const DualEnds range = loaded_ends(rule, ends, s);
            for (const float z : pixel.depths[s]) {
                const bool is_visible = z < loaded(rule, pixel.opaque, s);
                const bool is_inside = is_visible && z >= -range.minus_near && z <= range.far;
                if (pass > 0 && is_inside && z == -range.minus_near) {
                    sequences.front[s].push_back(strata::rasterizer::ordered_code(z));
                } else if (pass > 0 && is_inside && z == range.far) {
                    sequences.back[s].push_back(strata::rasterizer::ordered_code(z));
                } else if (pass == 0 ? is_visible : is_inside) {
                    next[s] = {std::max(next[s].minus_near, -z), std::max(next[s].far, z)};
                }
            }
        }
        ends = next;
    }
    return sequences;
}

[[nodiscard]] std::vector<DualPixel> dual_pixels(const TriangleScene& scene, const RenderOptions& options) {
    std::vector<DualPixel> pixels(model_size * model_size);
    for (std::size_t s = 0; s < model_samples; ++s) {
        const FrameFragments found = captured(scene, options, s, "dual_independent");
        for (const auto& f : found.all) pixels[f.pixel].depths[s].push_back(f.shader_z);
        for (std::size_t p = 0; p < pixels.size(); ++p) pixels[p].opaque[s] = std::bit_cast<float>(found.opaque[p]);
    }
    return pixels;
}

[[nodiscard]] std::vector<DualSequences> traced_ends(const std::vector<RegionTrace>& traces) {
    std::vector<DualSequences> sequences(model_size * model_size);
    for_each_entry(traces, [&](std::size_t pixel, std::size_t s, const auto& entry) {
        DualSequences& at = sequences[pixel];
        (entry.side == strata::pipeline::Side::front ? at.front : at.back)[s].push_back(entry.key);
    });
    return sequences;
}

}  // namespace

TEST_CASE("dual under every load rule composites at both ends what a model of its fragments does") {
    const TriangleScene scene = random_triangles(4502, 30);
    const auto check = [&](const auto& options, auto rule, const auto& result, const auto& traces) {
        const std::vector<DualPixel> pixels = dual_pixels(scene, options);
        const std::vector<DualSequences> drawn = traced_ends(traces);
        std::uint64_t wrong = 0, composited = 0, unlike = 0;
        for (std::size_t p = 0; p < pixels.size(); ++p) {
            const DualSequences right = peeled_dual(pixels[p], LoadedSample::own, 40);
            for (std::size_t s = 0; s < model_samples; ++s) {
                const DualSequences model = peeled_dual(pixels[p], rule, result.frame.passes.geometry);
                wrong += model.front[s] == drawn[p].front[s] && model.back[s] == drawn[p].back[s] ? 0 : 1;
                composited += model.front[s].size() + model.back[s].size();
                unlike += model.front[s] == right.front[s] && model.back[s] == right.back[s] ? 0 : 1;
            }
        }
        CHECK(wrong == 0);
        if (rule != LoadedSample::resolved) CHECK(composited > 500);  // a mean is at no fragment, if all differ
        if (rule != LoadedSample::own) CHECK(unlike > 100);
    };
    for_each_rule(scene, "dual_independent", check);
}

// 33 triangles over all of 64x64 pixels: every sample has 33 x 64 x 64 fragments, each of which takes 16 bytes in a
// trace; traces have half of the memory, which is at least 16 MiB.
TEST_CASE("the audit of samples that load one another is the same in parts") {
    constexpr std::uint64_t enough = std::uint64_t{33} * 64 * 64 * model_samples * 16 * 2;
    static_assert(enough > strata::peeling::least_audit_memory);
    TriangleScene scene;
    scene.list.materials = {{.name = "glass", .alpha_mode = strata::pipeline::AlphaMode::blend, .unlit = true}};
    strata::pipeline::Mesh mesh;
    for (int layer = 0; layer < 33; ++layer)
        for (const auto& [x, y] : {std::pair{-1.0f, -1.0f}, {3.0f, -1.0f}, {-1.0f, 3.0f}}) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
            mesh.positions.push_back({x, y, static_cast<float>(layer) / 64.0f});
            mesh.colors.push_back({1, 1, 1, 0.5f});
        }
    scene.list.meshes = {mesh};
    scene.list.instances = {{.mesh = 0, .material = 0}};
    RenderOptions options = model_options(Interpolation::sample);
    options.width = options.height = 64;
    options.sampling = {.samples = model_samples, .loads = LoadedSample::zero};
    const auto audited = [&](std::uint64_t memory, bool audits, const char* algorithm) {
        options.fragment_memory = memory;
        options.audit = audits;
        Renderer renderer{scene.list, scene.view, *find_profile("geforce8_dx101"), options};
        return renderer.render(*find_algorithm(algorithm)).audit;
    };
    for (const char* algorithm : {"painter", "front_to_back"}) {
        const auto all = audited(2 * enough, true, algorithm);
        CHECK(all.order_errors == 0u);
        CHECK(all.fragments_max == 33);
        CHECK(audited(0, true, algorithm) == all);
        CHECK(audited(0, false, algorithm).fragments_max == 0);
    }
}
