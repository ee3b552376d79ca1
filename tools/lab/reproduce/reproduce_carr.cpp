// tools/lab/reproduce/reproduce_carr.cpp - Carr, Mech and Miller 2008: Table 1 (models) and Figures 1 and 3
// (slices and a cone).
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "scenes/camera.h"
#include "tools/lab/bench/spread.h"
#include "tools/lab/reproduce/figures.h"
#include "tools/strata/progress.h"

namespace strata::tools {

namespace {

// The cost of one algorithm for one picture.
struct Run {
    int iterations = 0, passes = 0;
    // Rasterized in all geometry passes.
    std::uint64_t fragments = 0;
    // Of all passes, without loading and set-up: of four runs if a run is short, else of one.
    Spread seconds{};
    pipeline::Image color{};
};

// Seconds; a shorter run is repeated, because its time varies.
constexpr double short_run = 1.0;

// Literal execution: every pass rasterizes all its geometry, as the paper's hardware did. `paper_exit`: iterations end
// as in the paper, by queries during compositing.
Run run(const scenes::Scene& scene, const pipeline::View& view, const std::string& algorithm,
        peeling::RenderOptions options, bool paper_exit) {
    options.execution = pipeline::Execution::literal;
    // The paper's times include neither comparison nor nearest depth.
    options.audit = options.nearest_depth = false;
    if (paper_exit) options.termination.rule = pipeline::TerminationRule::paper;
    // coherent_ideal needs more than the hardware of the paper had.
    const char* const profile = algorithm == "coherent_ideal" ? "ideal" : "geforce8";
    peeling::Renderer renderer(scene.list, view, *pipeline::find_profile(profile), options);
    const peeling::Algorithm& chosen = *peeling::find_algorithm(algorithm);
    const auto result = renderer.render(chosen);
    std::vector<double> seconds{result.seconds.passes};
    while (seconds.size() < least_runs && result.seconds.passes < short_run)
        seconds.push_back(renderer.render(chosen).seconds.passes);
    return {result.frame.iterations, result.frame.passes.geometry, result.frame.counters->fragments_rasterized,
            spread_of(seconds), result.frame.color};
}

// Two decimals, or "-" if b is 0.
std::string ratio(double a, double b) { return b > 0 ? fmt::format("{:.2f}", a / b) : "-"; }

// The speed relative to the baseline; "noise" if the runs overlap, or, if one of the times is of a single long run, if
// they are within a factor of 2.
std::string times_faster(const Spread& baseline, const Spread& own) {
    const double times = baseline.median / own.median;
    const bool is_single = baseline.runs == 1 || own.runs == 1;
    if (&baseline == &own) return "1";
    return (is_single ? times < 0.5 || times > 2 : is_apart(baseline, own)) ? ratio(baseline.median, own.median)
                                                                            : "noise";
}

peeling::RenderOptions options_for(const ReproduceOptions& options, int size) {
    peeling::RenderOptions render;
    render.width = render.height = size;
    render.threads = options.threads;
    return render;
}

// ---- Figures 1 and 3

// Pixels per side, small enough that literal peels of 1024 slices take a reasonable time.
constexpr int beam_size = 32;
const std::array beam_algorithms{"layer_peel", "hybrid", "coherent_stencil", "coherent_blend", "coherent_ideal"};

// The paper's value for a row of the table, and the reason why ours differs.
struct Printed {
    std::string figure, why;
};

// Empty texts for rows that the paper does not have. `iterations` are ours: if they agree no reason is needed.
Printed printed_of(int slices, const std::string& algorithm, int iterations) {
    constexpr auto other_times = "times are this computer's, not a GeForce 8800's; passes and fragments are counted";
    constexpr auto counted = "the stencil counts to 128 (E20): ceil(n/128) iterations for n slices, two for the cone";
    const bool is_stencil = algorithm == "coherent_stencil";
    if (slices > 256 && (is_stencil || algorithm == "coherent_blend")) return {"as many passes as for 256", counted};
    if (slices != 256) return {};
    if (algorithm == "layer_peel")
        return {"257 iterations",
                iterations == 257 ? "" : "256 slices, two layers of the cone, and an empty iteration"};
    if (algorithm == "hybrid") return {"3 iterations, 62 or 52 times faster", other_times};
    if (is_stencil) return {"about 6 times slower than hybrid", std::string(counted) + "; " + other_times};
    return {};
}

constexpr auto beam_text =
    "volume-beam:slices=N,order=near at {0}x{0}; slices arrive front to back, the cone of two layers after them. The "
    "paper, for 256 slices: layer peeling 257 iterations, hybrid 3 and 62 times faster (Figure 1; 52 in section 8), "
    "coherent about 6 times slower than hybrid; of Figure 3 only the curves' shapes are described: hybrid and coherent "
    "constant in passes and linear in time, layer peeling linear in passes and worse in time. Fragments are counted "
    "over "
    "all geometry passes.";

// One point of Figures 1 and 3.
struct Measured {
    int slices;
    std::string algorithm;
    Run run;
};

// Every algorithm on every number of slices.
std::vector<Measured> run_beams(const ReproduceOptions& options) {
    std::vector<Measured> runs;
    Progress progress("slices");
    for (const int slices : {16, 32, 64, 128, 256, 512, 1024}) {
        progress.show(slices / 1024.0);
        const scenes::Scene scene = scenes::load_scene(fmt::format("volume-beam:slices={},order=near", slices), {});
        const auto view = scenes::orbit_view(scene.bounds, 30, 20, 1.0);
        for (const std::string algorithm : beam_algorithms)
            runs.push_back({slices, algorithm, run(scene, view, algorithm, options_for(options, beam_size), false)});
    }
    return runs;
}

// One curve per algorithm; `value` selects the value of a run.
template <class Value>
Chart chart_of(const std::vector<Measured>& runs, const std::string& name, const std::string& label, Value value) {
    Chart chart{"figure3_" + name, "slices", label};
    for (const std::string algorithm : beam_algorithms) {
        Curve curve{algorithm};
        for (const Measured& m : runs)
            if (m.algorithm == algorithm) curve.points.push_back({double(m.slices), value(m.run)});
        chart.curves.push_back(std::move(curve));
    }
    return chart;
}

// The table, three charts and an image. Rows of one number of slices are consecutive, layer_peel's first, because the
// others are compared with it.
Section beam(const ReproduceOptions& options) {
    Section section{"Figures 1 and 3: the slices of a volume, and a cone", fmt::format(beam_text, beam_size)};
    section.sheet = {"figure3",
                     {"slices", "algorithm", "iterations", "geometry passes", "fragments", "of layer_peel's fragments",
                      "times faster than layer_peel", "the paper", "why they differ"},
                     {}};
    const std::vector<Measured> runs = run_beams(options);
    const Run* baseline = nullptr;
    for (const Measured& m : runs) {
        const Run& r = m.run;
        // beam_algorithms begins with layer_peel, so its row precedes the rows that are divided by it.
        if (m.algorithm == "layer_peel") baseline = &r;
        const Printed printed = printed_of(m.slices, m.algorithm, r.iterations);
        section.sheet.rows.push_back({std::to_string(m.slices), m.algorithm, std::to_string(r.iterations),
                                      std::to_string(r.passes), std::to_string(r.fragments),
                                      ratio(double(r.fragments), double(baseline->fragments)),
                                      times_faster(baseline->seconds, r.seconds), printed.figure, printed.why});
    }
    section.charts = {
        chart_of(runs, "passes", "geometry passes", [](const Run& r) { return double(r.passes); }),
        chart_of(runs, "fragments", "fragments of all passes", [](const Run& r) { return double(r.fragments); }),
        chart_of(runs, "time", "milliseconds on this computer", [](const Run& r) { return 1e3 * r.seconds.median; })};
    const scenes::Scene scene = scenes::load_scene("volume-beam:slices=64,order=near", {});
    peeling::RenderOptions large = options_for(options, options.size);
    large.alpha = 0.1f;
    const Run picture = run(scene, scenes::orbit_view(scene.bounds, 30, 20, 1.0), "hybrid", large, false);
    section.pictures.push_back(write_picture(
        options.folder, "beam.png", "64 slices and the cone, by hybrid, every alpha times 0.1", picture.color));
    return section;
}

// ---- Table 1

// A row of the paper's Table 1, and our view.
struct PaperRow {
    const char* model;
    const char* view;
    // Iterations as printed: of the two coherent formulations, which agree, and of layer peeling.
    int coherent, layers;
    // Frame rates as printed, of formulation A, formulation B and layer peeling.
    double a_fps, b_fps, layer_fps;
    // Degrees of our orbit: the paper does not give its view.
    double azimuth, elevation;
    // The reason why ours differs, for the last column.
    const char* why;
};

constexpr auto other_model =
    "another model than the paper's (faces, holes), and view, size and number of buckets are not printed";
// A model belongs to a row if its file's name begins with the row's.
constexpr std::array paper_rows{
    PaperRow{"engine", "Figure 4", 7, 22, 22, 23, 21, 30, 20, other_model},
    PaperRow{
        "dragon", "front", 3, 14, 51, 53, 35, 0, 0,
        "Stanford's res2 with 202,520 faces, the paper's has 150K; view, size and number of buckets are not printed"},
    PaperRow{
        "dragon", "side", 3, 14, 51, 53, 35, 90, 0,
        "Stanford's res2 with 202,520 faces, the paper's has 150K; view, size and number of buckets are not printed"},
    PaperRow{"lucy", "end on", 3, 22, 37, 41, 15, 0, 90, other_model},
    PaperRow{"lucy", "front", 3, 12, 36, 40, 27, 0, 0, other_model},
    PaperRow{"sponza", "end on", 3, 26, 36, 40, 12, 90, 0,
             "Crytek's Sponza with 262,267 triangles, the paper's has 66K; we look from outside its bounds, and "
             "coordinates lie on a coarse grid: ties"},
    PaperRow{"sponza", "front", 3, 16, 56, 50, 35, 0, 0,
             "Crytek's Sponza with 262,267 triangles, the paper's has 66K; we look from outside its bounds, and "
             "coordinates lie on a coarse grid: ties"},
    PaperRow{"car", "front", 11, 36, 0.28, 0.34, 0.27, 0, 0, other_model},
    PaperRow{"building", "front", 20, 50, 0.71, 0.83, 0.86, 0, 0, other_model},
};

// Iterations and geometry passes.
std::string counts(int iterations, int passes) { return fmt::format("{} it, {} g", iterations, passes); }

// The rows of one view: three orders of triangles with four algorithms each. `in_paper` is false for a model that the
// paper does not have: then `paper` only has the view.
void add_rows(const ReproduceOptions& options, const Model& model, const PaperRow& paper, bool in_paper,
              Section& section) {
    peeling::RenderOptions render = options_for(options, options.size);
    render.alpha = 0.3f;
    const auto view = scenes::orbit_view(model.scene.bounds, paper.azimuth, paper.elevation, 1.0);
    const auto add = [&](const std::string& order, const peeling::Sort& sort) {
        render.sort = sort;
        const Run layer = run(model.scene, view, "layer_peel", render, false);
        const auto row = [&](const std::string& algorithm, const Run& r, int iterations, int passes, double fps) {
            // `iterations` is 0 for an algorithm that the paper did not time. coherent_ideal counts no empty iteration.
            const bool is_paper = in_paper && iterations > 0, counts_empty = algorithm != "coherent_ideal";
            std::string why;
            // The paper's query ends with one more, empty iteration, which is not a difference.
            if (is_paper && counts_empty && r.iterations - 1 == iterations)
                why = "the last iteration, which finds nothing, is counted here";
            else if (is_paper && r.iterations != iterations)
                why = order == "as listed" ? "triangles as the file has them; the paper sorts" : paper.why;
            const double paper_speed = is_paper ? fps / paper.layer_fps : 0,
                         speed = layer.seconds.median / r.seconds.median;
            // A difference of up to 5 % is not explained: the printed rates have two digits.
            if (is_paper && std::abs(speed - paper_speed) > 0.05 * paper_speed)
                why += std::string(why.empty() ? "" : "; ") + "speed: of this computer, where passes cost by fragments";
            section.sheet.rows.push_back(
                {model.name, paper.view, order, algorithm, is_paper ? counts(iterations, passes) : "",
                 counts(r.iterations, r.passes), is_paper ? ratio(fps, paper.layer_fps) : "",
                 times_faster(layer.seconds, r.seconds), ratio(double(r.fragments), double(layer.fragments)), why});
        };
        // Geometry passes per iteration: layer_peel 2, formulation A 6, formulation B 5
        // (peeling/reference/algorithms.md 9, 10.2 and 11).
        row("layer_peel", layer, paper.layers, 2 * paper.layers, paper.layer_fps);
        row("coherent_stencil", run(model.scene, view, "coherent_stencil", render, true), paper.coherent,
            6 * paper.coherent, paper.a_fps);
        row("coherent_blend", run(model.scene, view, "coherent_blend", render, true), paper.coherent,
            5 * paper.coherent, paper.b_fps);
        row("coherent_ideal", run(model.scene, view, "coherent_ideal", render, false), 0, 0, 0);
        // The unsorted list has no image: except for ties, layer_peel's does not depend on the order.
        if (order != "as listed")
            section.pictures.push_back(write_picture(options.folder,
                                                     fmt::format("{}_{}.png", model.name, section.pictures.size()),
                                                     fmt::format("{}, {}", model.name, paper.view), layer.color));
    };
    add("bucket:1024", {.rule = peeling::SortRule::bucket, .buckets = 1024});
    add("exact", {.rule = peeling::SortRule::exact});
    add("as listed", {});
}

// Table 1 for the given models; without models only its text.
Section table(const ReproduceOptions& options, const std::vector<Model>& models) {
    Section section{"Table 1: models",
                    fmt::format("{0}x{0}, every alpha 0.3. it: iterations, g: geometry passes. Coherent peels end by "
                                "the paper's query, which counts an empty "
                                "iteration; layer_peel ends when its first pass finds nothing, one geometry pass "
                                "earlier than two an iteration. Speeds are relative to layer_peel's (medians of three "
                                "where a run takes less than {1:g} s); the paper's are a GeForce 8800's frame rates.",
                                options.size, short_run)};
    section.sheet = {"table1",
                     {"model", "view", "order of triangles", "algorithm", "paper", "ours", "paper: speed to layer_peel",
                      "ours: speed", "fragments to layer_peel's", "why they differ"},
                     {}};
    Progress progress("models");
    for (const Model& model : models) {
        progress.show(static_cast<double>(&model - models.data()) / static_cast<double>(models.size()));
        bool in_paper = false;
        for (const PaperRow& row : paper_rows)
            if (model.name.starts_with(row.model)) {
                in_paper = true;
                add_rows(options, model, row, true, section);
            }
        if (!in_paper) add_rows(options, model, {"", "30,20", 0, 0, 0, 0, 0, 30, 20, ""}, false, section);
    }
    if (models.empty()) section.text += " No model was given on the command line.";
    return section;
}

}  // namespace

Page reproduce_carr(const ReproduceOptions& options, const std::vector<Model>& models) {
    return {"Carr, Mech and Miller 2008: Coherent Layer Peeling",
            page_note,
            carr_2008_link,
            {beam(options), table(options, models)}};
}

}  // namespace strata::tools
