// tools/lab/invariance/invariance_plan.h - the cells of an invariance sweep, from a JSON plan or from options.
//
// Rule     A plan is {"common": {...}, "grids": [{...}, ...]}. A grid gives each key one value or a list of values and
//          means all their combinations; missing keys come from `common`, then from the options, then from the
//          defaults. Cells are numbered grid by grid, in the keys' own order with the last key fastest, so the order in
//          a file does not matter; a repeated cell is kept once. The whole plan is checked
//          before anything runs.
// Tests    tests/tools/lab/invariance/invariance_plan_test.cpp
#pragma once
#include <map>
#include <string>
#include <vector>

#include "peeling/invariance.h"

namespace strata::tools {

// The changes that a remedy makes to a cell; a default one changes nothing.
struct Remedy {
    float bias_constant = 0, bias_slope = 0;  // glPolygonOffset's units and factor
    pipeline::CompareEpsilon epsilon;
    std::string epsilon_text = "0";  // as given: "1e-7", or "2ulp"
    bool quantize_reference = true;
    bool depth_replace = false;  // the writing path becomes depth_replace
    friend bool operator==(const Remedy&, const Remedy&) = default;
};

// The near and far planes: the orbit's own, far / ratio and the orbit's far, or two given numbers.
struct DepthRange {
    double ratio = 0, near = 0, far = 0;  // all 0: the orbit's
    friend bool operator==(const DepthRange&, const DepthRange&) = default;
};

// none: no split. rotated: each triangle's vertices in another order. diagonal: quads split along the other diagonal.
// moved: a viewport one pixel further in x and y. clamped: with depth clamp.
enum class Split : std::uint8_t { none, rotated, diagonal, moved, clamped };

// One experiment. Its fields are the values of a plan's keys, which are listed in scenes/reference/reports.md 5.1.
struct Cell {
    std::string scene, profile = "geforce3";
    int width = 256, height = 192;
    double azimuth = 30, elevation = 20;  // degrees
    bool takes_own_view = true;           // if the scene has one; false if an orbit is specified
    std::string camera;                   // a camera of the scene or a file; empty: the orbit
    float alpha = 0.5f;
    const peeling::Algorithm* algorithm = nullptr;
    Split split = Split::none;
    std::string hypothesis = "profile";    // or one of rasterizer::depth_hypotheses, or "all" of them
    std::string vertex_path = "separate";  // as given
    peeling::VertexPaths vertex_paths;
    rasterizer::DepthPath write{}, compare{};
    pipeline::DepthFormat format = pipeline::DepthFormat::d24;
    int subpixel_bits = 0;  // 0: the profile's
    DepthRange range;
    Remedy remedy;
    // Limit on geometry passes; 0: twice as many as a peel of the true layers needs.
    int max_passes = 0;
    friend bool operator==(const Cell&, const Cell&) = default;
};

// One key of a plan, and the option of the same meaning.
struct PlanKey {
    std::string name;  // "depth_format"; the option is --depth-format
    // For messages: help for --help, and what an error lists after "expected".
    std::string help, expected;
    std::string fallback;  // comma-separated values
    // Sets the cell's field from one value. Returns false, and leaves the cell in any state, if the value is invalid.
    bool (*set)(Cell&, const std::string& text);
    bool is_list = true;  // the option takes several comma-separated values
};
[[nodiscard]] const std::vector<PlanKey>& plan_keys();  // in the order of nesting, outermost first

using KeyValues = std::map<std::string, std::vector<std::string>>;  // by a key's name

// `text` is the plan's JSON, `file` its name in messages. Throws InputError with the JSON pointer.
[[nodiscard]] std::vector<Cell> parse_plan(const std::string& text, const std::string& file, const KeyValues& options);

// Without a plan: one grid of the options.
[[nodiscard]] std::vector<Cell> cells_of(const KeyValues& options);

[[nodiscard]] std::string name_of(Split split);

// "bias:2+slope:1": the remedy as the plan spells it.
[[nodiscard]] std::string name_of(const Remedy& remedy);

}  // namespace strata::tools
