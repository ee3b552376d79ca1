// tools/lab/reproduce/reproduce_bavoil.cpp - Bavoil and Myers 2008: geometry passes of dual peeling, and Figure 4
// (three choices of alpha).
#include <fmt/format.h>

#include <cmath>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "scenes/camera.h"
#include "tools/lab/reproduce/figures.h"

namespace strata::tools {

namespace {

// A model with the view of all its images and counts.
struct ViewedModel {
    const Model& model;
    pipeline::View view;
};

// One run on the profile geforce8.
peeling::RenderResult render(const ViewedModel& subject, const std::string& algorithm,
                             const peeling::RenderOptions& options) {
    return peeling::Renderer(subject.model.scene.list, subject.view, *pipeline::find_profile("geforce8"), options)
        .render(*peeling::find_algorithm(algorithm));
}

// Square images on white; every alpha is multiplied by `alpha`.
peeling::RenderOptions options_for(const ReproduceOptions& options, float alpha) {
    peeling::RenderOptions render;
    render.width = render.height = options.size;
    render.threads = options.threads;
    render.alpha = alpha;
    render.background = {1, 1, 1, 1};
    return render;
}

// A row of the table of passes. dual is run with both exits: the exact one ends when nothing is left, the paper's when
// a pass blends nothing.
std::vector<std::string> pass_row(const ReproduceOptions& options, const ViewedModel& subject) {
    peeling::RenderOptions exact = options_for(options, 0.6f), paper = exact;
    paper.termination.rule = pipeline::TerminationRule::paper;
    const auto dual = render(subject, "dual", exact);
    // N is the number of layers of the deepest pixel, as the audit counts it.
    const int n = dual.audit.layers_max, passes = dual.frame.passes.geometry;
    const auto with_paper_exit = render(subject, "dual", paper);
    const auto front_to_back = render(subject, "front_to_back", exact);
    const std::string printed = fmt::format("{:g}", n / 2.0 + 1);
    return {subject.model.name,
            std::to_string(n),
            std::to_string(front_to_back.frame.passes.geometry),
            printed,
            std::to_string(passes),
            std::to_string(with_paper_exit.frame.passes.geometry),
            n % 2 == 0 ? "as printed; the paper's own query needs one empty pass more (E11)"
                       : "N is odd: the layer in the middle takes a pass of its own (E11)"};
}

// Gives each mesh vertex colours whose alpha increases linearly in y from 0.2 at the bottom of the mesh to 0.8 at its
// top. A flat mesh has 0.2.
void vary_alpha(scenes::Scene& scene) {
    for (pipeline::Mesh& mesh : scene.list.meshes) {
        float low = HUGE_VALF, high = -HUGE_VALF;
        for (const auto& p : mesh.positions) {
            low = std::fmin(low, p[1]);
            high = std::fmax(high, p[1]);
        }
        // A mesh without vertex colours gets white ones; existing colours are kept.
        mesh.colors.resize(mesh.positions.size(), {1, 1, 1, 1});
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            mesh.colors[i][3] = 0.2f + 0.6f * (high > low ? (mesh.positions[i][1] - low) / (high - low) : 0.0f);
    }
}

// Figure 4: three choices of alpha, and the difference of the two one-pass sums from dual's image.
Section alphas(const ReproduceOptions& options, const Model& model, const pipeline::View& view) {
    Section section{"Figure 4 with " + model.name,
                    "Dual peeling is exact; the other two take one pass. The paper finds the average close to it for "
                    "low and for high alpha, and "
                    "that the sum darkens above 20 %. Non-uniform: 20 % at the bottom to 80 % at the top."};
    section.sheet = {"figure4_" + model.name,
                     {"alpha", "algorithm", "largest difference from dual / 255", "mean difference / 255"},
                     {}};
    Model varied = model;
    vary_alpha(varied.scene);
    struct Column {
        const char* name;
        const Model& model;
        float alpha;
    };
    // The varied model has its alphas in its vertices, which a factor of 1.0 does not change.
    for (const Column& column : {Column{"20", model, 0.2f}, {"60", model, 0.6f}, {"non-uniform", varied, 1.0f}}) {
        const ViewedModel subject{column.model, view};
        const peeling::RenderOptions render_options = options_for(options, column.alpha);
        const auto dual = render(subject, "dual", render_options);
        for (const char* algorithm : {"dual", "weighted_average", "weighted_sum"}) {
            const auto other = render(subject, algorithm, render_options);
            const PictureDifference d = difference(other.frame.color, dual.frame.color);
            section.sheet.rows.push_back(
                {column.name, algorithm, fmt::format("{:.0f}", d.largest), fmt::format("{:.3f}", d.mean)});
            section.pictures.push_back(
                write_picture(options.folder, fmt::format("{}_{}_{}.png", model.name, column.name, algorithm),
                              fmt::format("{}, alpha {}", algorithm, column.name), other.frame.color));
        }
    }
    return section;
}

}  // namespace

// The teapot first, then the given models.
Page reproduce_bavoil(const ReproduceOptions& options, const std::vector<Model>& given) {
    std::vector<Model> models{{"teapot", scenes::load_scene("teapot", {})}};
    models.insert(models.end(), given.begin(), given.end());
    Page page{"Bavoil and Myers 2008: Order Independent Transparency with Dual Depth Peeling", page_note,
              bavoil_2008_link};
    Section passes{"Geometry passes: N/2 + 1",
                   "Printed: N/2 + 1 passes for N layers, against N of front-to-back peeling (whose last, empty "
                   "pass is counted here)."};
    passes.sheet = {
        "passes",
        {"scene", "layers N", "front_to_back", "printed N/2 + 1", "dual", "dual, the paper's exit", "why they differ"},
        {}};
    std::vector<Section> figures;
    for (const Model& model : models) {
        const ViewedModel subject{model, scenes::orbit_view(model.scene.bounds, 30, 20, 1.0)};
        passes.sheet.rows.push_back(pass_row(options, subject));
        figures.push_back(alphas(options, model, subject.view));
    }
    page.sections.push_back(std::move(passes));
    page.sections.insert(page.sections.end(), figures.begin(), figures.end());
    return page;
}

}  // namespace strata::tools
