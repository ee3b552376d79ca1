// tools/lab/cost/cost_plan.cpp - the choices that strata cost measures, each from the command's defaults: formats,
// paths, algorithms, numbers of passes, execution, exact steps (cost_plan.h).
#include "tools/lab/cost/cost_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "tools/request/choices.h"
#include "tools/request/option_fields.h"

namespace strata::tools {

namespace {

using Cells = std::vector<CostCell>;
using peeling::Tail;

// Adds a cell that differs from the defaults by `change`.
void add(Cells& cells, const CostBase& base, const std::string& knob, const std::string& value,
         const std::function<void(CostCell&)>& change) {
    CostCell cell{.scene = base.scene,
                  .knob = knob,
                  .value = value,
                  .opened = {},
                  .profile = base.profile,
                  .options = base.options,
                  .algorithm = base.algorithm};
    change(cell);
    cells.push_back(std::move(cell));
}

// Enables a feature that the cell's profile lacks.
void open(CostCell& cell, bool pipeline::DeviceProfile::*feature, const std::string& name) {
    if (cell.profile.*feature) return;
    cell.profile.*feature = true;
    cell.opened += (cell.opened.empty() ? "" : ", ") + name;
}

void set_depth_format(CostCell& cell, pipeline::DepthFormat format) {
    cell.options.depth = format;
    if (format == pipeline::DepthFormat::d16) open(cell, &pipeline::DeviceProfile::has_d16, "d16");
    if (format == pipeline::DepthFormat::d24) open(cell, &pipeline::DeviceProfile::has_d24, "d24");
    if (format == pipeline::DepthFormat::d32f) open(cell, &pipeline::DeviceProfile::has_d32f, "d32f");
    if (format == pipeline::DepthFormat::d16f) open(cell, &pipeline::DeviceProfile::has_d16f, "d16f");
    if (format == pipeline::DepthFormat::d24f) open(cell, &pipeline::DeviceProfile::has_d24f, "d24f");
}

void set_depth_path(CostCell& cell, rasterizer::DepthPath path) {
    using rasterizer::DepthPath;
    cell.options.depth_path = path;
    if (path == DepthPath::depth_replace) open(cell, &pipeline::DeviceProfile::has_depth_replace, "depth_replace");
    if (path == DepthPath::perspective_rq || rasterizer::is_written_by_program(path))
        open(cell, &pipeline::DeviceProfile::has_fragment_programs, "fragment programs");
    const bool is_chip = path == DepthPath::window_z || path == DepthPath::w_buffer;
    if (!is_chip || cell.profile.raster.window_z == rasterizer::WindowZ::buffer_units) return;
    cell.profile.raster.window_z = rasterizer::WindowZ::buffer_units;
    cell.opened += cell.opened.empty() ? "window_z" : ", window_z";
}

void set_color_format(CostCell& cell, pipeline::Format format) {
    cell.options.color_format = format;
    if (format != pipeline::Format::rgba8) open(cell, &pipeline::DeviceProfile::has_float_targets, "float targets");
}

void subpixel_cells(const CostBase& base, Cells& cells) {
    for (const int bits : {4, 8, 12})
        add(cells, base, "subpixel_bits", std::to_string(bits),
            [&](CostCell& cell) { cell.profile.raster.subpixel_bits = bits; });
}

void depth_cells(const CostBase& base, Cells& cells) {
    for (const auto& format : depth_formats)
        for (const auto& path : depth_paths())
            add(cells, base, "depth", format.name + " " + path.name, [&](CostCell& cell) {
                set_depth_format(cell, format.value);
                set_depth_path(cell, path.value);
            });
}

void algorithm_cells(const CostBase& base, Cells& cells) {
    for (const peeling::Algorithm& algorithm : peeling::algorithms())
        for (const auto& format : color_formats)
            add(cells, base, "algorithm", algorithm.name + " " + format.name, [&](CostCell& cell) {
                cell.algorithm = &algorithm;
                set_color_format(cell, format.value);
            });
}

void count_cells(const CostBase& base, Cells& cells) {
    for (const auto& format : count_formats)
        add(cells, base, "average_count", format.name, [&](CostCell& cell) {
            cell.algorithm = peeling::find_algorithm("weighted_average");
            cell.options.average_count = format.value;
            set_color_format(cell, pipeline::Format::rgba16f);
        });
}

// fixed:N counts geometry passes.
void peel_cells(const CostBase& base, Cells& cells) {
    for (const char* name : {"front_to_back", "dual"}) {
        const peeling::Algorithm& algorithm = *peeling::find_algorithm(name);
        for (const int passes : peel_steps(algorithm.geometry_passes(base.layers)))
            for (const auto& format : color_formats)
                add(cells, base, "peels", fmt::format("{} {} {}", name, passes, format.name), [&](CostCell& cell) {
                    cell.algorithm = &algorithm;
                    cell.options.termination = {.rule = pipeline::TerminationRule::fixed, .passes = passes};
                    set_color_format(cell, format.value);
                });
    }
}

// What the cell's algorithm needs beyond the profile.
void open_features(CostCell& cell) {
    using pipeline::DeviceProfile;
    const auto open_if = [&](pipeline::Feature feature, bool DeviceProfile::*field, const char* name) {
        if (std::ranges::find(cell.algorithm->features, feature) != cell.algorithm->features.end())
            open(cell, field, name);
    };
    open_if(pipeline::Feature::float_targets, &DeviceProfile::has_float_targets, "float targets");
    open_if(pipeline::Feature::independent_blend, &DeviceProfile::has_independent_blend, "independent blending");
    open_if(pipeline::Feature::unordered_access, &DeviceProfile::has_unordered_access, "unordered access");
    open_if(pipeline::Feature::ordered_rmw, &DeviceProfile::has_ordered_rmw, "ordered views");
    if (cell.options.algorithm.tail == Tail::weighted)
        open(cell, &DeviceProfile::has_independent_blend, "independent blending");
}

// The algorithms of few passes with what they let a caller choose, and what they are measured against. The value is
// what follows --algorithm in a command.
void transparency_cells(const CostBase& base, Cells& cells) {
    using peeling::AlgorithmOptions;
    const auto with = [&](const std::string& name, const AlgorithmOptions& choice = {}, int max_passes = 0) {
        std::string value = max_passes > 0 ? fmt::format("{} --max-passes {}", name, max_passes) : name;
        tools::PictureRequest request;
        request.render.algorithm = choice;
        for (const std::string& word : tools::words_of(request, tools::OptionGroup::algorithm)) value += ' ' + word;
        add(cells, base, "transparency", value, [&](CostCell& cell) {
            cell.algorithm = peeling::find_algorithm(name);
            cell.options.algorithm = choice;
            cell.options.max_passes = max_passes;
            open_features(cell);
        });
    };
    for (const char* name : {"a_buffer", "dual", "unsorted", "painter", "weighted_sum", "weighted_average",
                             "bucket_peel", "front_to_back_ties", "dual_ties"})
        with(name);
    using peeling::Weight;
    for (const Weight weight : {Weight::eq7, Weight::eq8, Weight::eq9, Weight::eq10, Weight::constant})
        with("weighted_blended", {.weight = weight});
    for (const char* name : {"moments", "moments_quantized"})
        for (const int moments : {4, 6, 8}) with(name, {.moments = moments});
    for (const int samples : {1, 2, 4, 8}) with("stochastic", {.stochastic_samples = samples});
    for (const char* name : {"multi_layer", "adaptive", "atomic_loop", "hybrid_transparency"})
        for (const int nodes : {2, 4, 6}) with(name, {.nodes = nodes});
    for (const int nodes : {0, 4, 8}) with("linked_list", {.pixel_nodes = nodes});
    for (const int passes : {1, 2, 4, 8})
        for (const Tail tail : {Tail::none, Tail::average, Tail::weighted})
            with("front_to_back", {.tail = tail}, passes);
}

void execution_cells(const CostBase& base, Cells& cells) {
    add(cells, base, "execution", "literal",
        [](CostCell& cell) { cell.options.execution = pipeline::Execution::literal; });
    add(cells, base, "execution", "tiled", [](CostCell& cell) { cell.options.fragment_memory = 0; });
    add(cells, base, "effects", "all", [](CostCell& cell) { cell.options.effects = pipeline::Effects::all; });
    add(cells, base, "audit", "on", [](CostCell& cell) { cell.is_timed_with_audit = true; });
}

void chain_cells(const CostBase& base, Cells& cells) {
    const auto with = [&](const std::string& knob, const std::string& value, const peeling::Chain& chain) {
        add(cells, base, knob, value, [&](CostCell& cell) { cell.chain = chain; });
    };
    with("chain", "device", peeling::device_chain);
    for (std::size_t i = 0; i < peeling::links.size(); ++i)
        with("chain", std::string(peeling::links[i].name), peeling::exact_up_to(i + 1));
    for (std::size_t i = 0; i < peeling::links.size(); ++i)
        with("alone", std::string(peeling::links[i].name), peeling::exact_alone(i));
}

}  // namespace

const std::vector<std::string>& cost_knobs() {
    static const std::vector<std::string> knobs{"default",       "subpixel_bits", "depth",     "algorithm",
                                                "average_count", "peels",         "execution", "effects",
                                                "audit",         "chain",         "alone",     "transparency"};
    return knobs;
}

std::vector<int> peel_steps(int all) {
    std::vector<int> steps;
    for (int n = 1; n < all; n = n < 8 ? n + 1 : n + n / 2) steps.push_back(n);
    steps.push_back(all);
    return steps;
}

std::vector<CostCell> cost_cells(const CostBase& base, const std::vector<std::string>& knobs) {
    Cells cells;
    add(cells, base, "default", base.algorithm->name, [](CostCell&) {});
    for (const auto part : {subpixel_cells, depth_cells, algorithm_cells, count_cells, peel_cells, execution_cells,
                            chain_cells, transparency_cells})
        part(base, cells);
    std::erase_if(cells, [&](const CostCell& cell) {
        return cell.knob != "default" && std::find(knobs.begin(), knobs.end(), cell.knob) == knobs.end();
    });
    return cells;
}

}  // namespace strata::tools
