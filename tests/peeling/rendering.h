// tests/peeling/rendering.h - renders a test's scene in one call, and compares images with a model.
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "peeling/render.h"
#include "tests/support/fragment_scene.h"

namespace strata::testing {

struct Machine {
    std::string profile, algorithm;
};

// An execution of a frame; replay with 0 bytes rasterizes every pass, tile by tile.
struct Running {
    pipeline::Execution execution = pipeline::Execution::replay;
    std::uint64_t fragment_memory = std::uint64_t{256} << 20;
    void apply(peeling::RenderOptions& options) const {
        options.execution = execution;
        options.fragment_memory = fragment_memory;
    }
};
inline constexpr Running all_ways_of_running[]{{pipeline::Execution::literal}, {pipeline::Execution::replay, 0}, {}};

[[nodiscard]] inline peeling::RenderOptions options_for(const FragmentScene& scene) {
    peeling::RenderOptions options;
    options.width = scene.width;
    options.height = scene.height;
    options.threads = 1;
    return options;
}

[[nodiscard]] inline peeling::RenderResult render(const pipeline::DrawList& list, const pipeline::View& view,
                                                  const Machine& machine, const peeling::RenderOptions& options,
                                                  const pipeline::Instruments& instruments = {}) {
    peeling::Renderer renderer{list, view, *pipeline::find_profile(machine.profile), options};
    return renderer.render(*peeling::find_algorithm(machine.algorithm), {}, instruments);
}

[[nodiscard]] inline peeling::RenderResult render(const FragmentScene& scene, const Machine& machine,
                                                  const peeling::RenderOptions& options) {
    return render(draw_list(scene), {}, machine, options);
}

[[nodiscard]] inline peeling::RenderResult render(const FragmentScene& scene, const Machine& machine) {
    return render(scene, machine, options_for(scene));
}

// True if the frame is drawn with the same colours in every execution, with the needed effects on one thread and with
// all of them on two.
[[nodiscard]] inline bool is_alike_in_every_way(const pipeline::DrawList& list, const pipeline::View& view,
                                                const Machine& machine, const peeling::RenderOptions& asked) {
    std::vector<std::uint32_t> first;
    for (const Running& running : all_ways_of_running)
        for (const pipeline::Effects effects : {pipeline::Effects::needed, pipeline::Effects::all}) {
            peeling::RenderOptions options = asked;
            running.apply(options);
            options.effects = effects;
            options.threads = effects == pipeline::Effects::all ? 2 : 1;
            const peeling::RenderResult result = render(list, view, machine, options);
            if (result.outcome != peeling::Outcome::done) return false;
            if (first.empty()) first = {result.frame.color.codes.begin(), result.frame.color.codes.end()};
            if (!std::ranges::equal(first, result.frame.color.codes)) return false;
        }
    return !first.empty();
}

// A channel of rgba8 or rgba32f as a number.
[[nodiscard]] inline double value_in(const pipeline::Image& image, int x, int y, int c) {
    const std::uint32_t code = image.codes[image.index(x, y, c)];
    return image.format == pipeline::Format::rgba32f ? double{std::bit_cast<float>(code)} : code / 255.0;
}

[[nodiscard]] inline std::uint64_t diagnosed(const peeling::RenderResult& result, pipeline::Fault fault) {
    std::uint64_t pixels = 0;
    for (const pipeline::Diagnostic& d : result.frame.diagnostics)
        if (d.fault == fault) pixels += d.pixels;
    return pixels;
}

[[nodiscard]] inline bool has_diagnostic(const peeling::RenderResult& result, pipeline::Fault fault) {
    for (const pipeline::Diagnostic& d : result.frame.diagnostics)
        if (d.fault == fault) return true;
    return false;
}

// Number of pixels whose codes differ from `expected(pixel)`, an Rgba of the codes, and a description of the first.
struct Differences {
    std::uint64_t pixels = 0;
    std::string first;
};

template <class Expected>
[[nodiscard]] Differences differences(const pipeline::Image& image, Expected&& expected) {
    Differences found;
    for (std::size_t p = 0; p < image.codes.size() / 4; ++p) {
        const std::array<std::uint32_t, 4> wanted = expected(p);
        if (std::equal(wanted.begin(), wanted.end(), image.codes.begin() + static_cast<std::ptrdiff_t>(4 * p)))
            continue;
        if (found.pixels++ != 0) continue;
        std::ostringstream text;
        text << std::hex << "pixel 0x" << p << ": found";
        for (std::size_t c = 0; c < 4; ++c) text << ' ' << image.codes[4 * p + c];
        text << ", expected";
        for (const std::uint32_t code : wanted) text << ' ' << code;
        found.first = text.str();
    }
    return found;
}

}  // namespace strata::testing
