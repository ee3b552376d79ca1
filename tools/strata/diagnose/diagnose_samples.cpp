#include "tools/strata/diagnose/diagnose_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "peeling/sample_hazard.h"
#include "rasterizer/base/input_error.h"
#include "tools/strata/progress.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

using peeling::Multisampling;
using pipeline::Image;
using pipeline::LoadedSample;
using rasterizer::Interpolation;

// A port that draws samples wrongly in one way.
struct SampleMistake {
    const char* name;
    const char* does;
    Interpolation interpolation = Interpolation::sample;
    LoadedSample loads = LoadedSample::own, composites = LoadedSample::own;
    bool is_single = false;        // draws one sample, at the pixel's centre
    bool covers_by_alpha = false;  // leaves alpha to coverage on
};
constexpr std::array sample_mistakes{
    SampleMistake{.name = "no_samples", .does = "draws one sample a pixel", .is_single = true},
    SampleMistake{.name = "resolve_before_compositing",
                  .does = "resolves every layer before it composites it",
                  .composites = LoadedSample::resolved},
    SampleMistake{.name = "sample_0_for_all",
                  .does = "loads sample 0 in every program",
                  .loads = LoadedSample::zero,
                  .composites = LoadedSample::zero},
    SampleMistake{.name = "peel_loads_sample_0",
                  .does = "compares with sample 0's depth in every peel",
                  .loads = LoadedSample::zero},
    SampleMistake{.name = "peel_loads_resolved",
                  .does = "compares with the resolved depth in every peel",
                  .loads = LoadedSample::resolved},
    SampleMistake{.name = "alpha_to_coverage_on",
                  .does = "leaves alpha to coverage on, so that alpha counts twice",
                  .covers_by_alpha = true},
    SampleMistake{.name = "pixel_shading",
                  .does = "runs programs once a pixel, so that samples near an edge peel a layer twice or not at all",
                  .interpolation = Interpolation::centre},
    SampleMistake{.name = "pixel_shading_loads_sample_0",
                  .does = "runs programs once a pixel and compares with sample 0's depth",
                  .interpolation = Interpolation::centre,
                  .loads = LoadedSample::zero},
    SampleMistake{.name = "pixel_shading_loads_resolved",
                  .does = "runs programs once a pixel and compares with the resolved depth",
                  .interpolation = Interpolation::centre,
                  .loads = LoadedSample::resolved},
    SampleMistake{.name = "centroid_shading",
                  .does = "runs programs once a pixel, at the centroid",
                  .interpolation = Interpolation::centroid}};

struct SampleFinding {
    const SampleMistake* mistake = nullptr;
    std::uint64_t agreeing = 0;   // pixels like the candidate's
    std::uint64_t explained = 0;  // of those, pixels that are wrong
};

// The candidate's colours, of the type that the picture has.
const oracle::Target& colors_of(const oracle::Picture& candidate, pipeline::Format format) {
    const auto colors = std::ranges::find(candidate.targets, oracle::Meaning::color, &oracle::Target::meaning);
    if (colors == candidate.targets.end() || colors->channels < 3 || colors->code != oracle::code_of(format))
        throw InputError(candidate.file, "colours",
                         fmt::format("three or four channels of {}, as the frame has; --color-format chooses",
                                     oracle::name(oracle::code_of(format))),
                         colors == candidate.targets.end() ? "none" : std::string{oracle::name(colors->code)});
    return *colors;
}

bool is_like(const oracle::Target& colors, const Image& picture, std::size_t pixel) {
    for (std::size_t c = 0; c < 3; ++c)
        if (colors.codes[pixel * static_cast<std::size_t>(colors.channels) + c] !=
            picture.codes[pixel * static_cast<std::size_t>(picture.channels()) + c])
            return false;
    return true;
}

// Empty where the profile has no such port.
Image picture_of(const RunOptions& options, const Session& session, const SampleMistake& mistake) {
    peeling::RenderOptions render = options.render;
    render.audit = render.nearest_depth = false;
    render.raster.interpolation = mistake.interpolation;
    render.raster.sample_coverage.by_alpha = mistake.covers_by_alpha;
    const Multisampling sampling{.samples = mistake.is_single ? 1 : options.samples,
                                 .resolve = options.resolve,
                                 .loads = mistake.loads,
                                 .composites = mistake.composites};
    peeling::SampledRenderer renderer{session.scene.list, session.view, session.profile, render, sampling};
    peeling::RenderResult result = renderer.render(*options.algorithms[0]);
    return result.refusal ? Image{} : std::move(result.frame.color);
}

// All wrong pixels lie where samples of a pixel have different fragments.
bool is_on_edges(const RunOptions& options, const Session& session, const std::vector<bool>& wrong) {
    const auto edges = peeling::sample_edges(session.scene.list, session.view, session.profile, options.render,
                                             *options.algorithms[0], {.samples = options.samples});
    for (std::size_t p = 0; p < wrong.size(); ++p)
        if (wrong[p] && edges[p] == peeling::SampleEdge::inside) return false;
    return true;
}

std::string to_text(const std::vector<SampleFinding>& findings, std::uint64_t wrong, std::uint64_t pixels,
                    bool edges_only) {
    if (wrong == 0) return fmt::format("right: all {} pixels\n", pixels);
    std::string text = fmt::format("wrong: {} of {} pixels{}\n", wrong, pixels, edges_only ? ", edges only" : "");
    for (const auto& [mistake, agreeing, explained] : findings)
        if (agreeing == pixels) text += fmt::format("{}: the port {}\n", mistake->name, mistake->does);
    if (!findings.empty() && findings.front().agreeing == pixels) return text;
    text += "no known mistake of multisampling; nearest:\n";
    for (std::size_t i = 0; i < std::min<std::size_t>(3, findings.size()); ++i)
        text += fmt::format("  {}: {} of the wrong pixels, {} of all\n", findings[i].mistake->name,
                            findings[i].explained, findings[i].agreeing);
    return text;
}

std::string to_json(const std::vector<SampleFinding>& findings, std::uint64_t wrong, std::uint64_t pixels,
                    bool edges_only) {
    nlohmann::ordered_json document{{"pixels", pixels}, {"wrong", wrong}, {"edges_only", edges_only}};
    document["findings"] = nlohmann::ordered_json::array();
    for (const auto& [mistake, agreeing, explained] : findings)
        document["findings"].push_back(
            {{"mistake", mistake->name}, {"does", mistake->does}, {"agreeing", agreeing}, {"explained", explained}});
    return document.dump(2) + '\n';
}

}  // namespace

int diagnose_samples(const RunOptions& options, const Session& session, const oracle::Picture& candidate, bool json) {
    const Image right = picture_of(options, session, {.name = "right", .does = ""});
    if (right.codes.empty())
        throw InputError("strata diagnose", "--samples", "a number that the profile and the algorithm have",
                         std::to_string(options.samples));
    const oracle::Target& colors = colors_of(candidate, right.format);
    const std::uint64_t pixels = colors.pixels();
    std::vector<bool> wrong(pixels);
    for (std::size_t p = 0; p < pixels; ++p) wrong[p] = !is_like(colors, right, p);
    const auto wrong_pixels = static_cast<std::uint64_t>(std::ranges::count(wrong, true));
    std::vector<SampleFinding> findings;
    Progress bar("mistakes of multisampling");
    for (const SampleMistake& mistake : sample_mistakes) {
        const Image picture = wrong_pixels == 0 ? Image{} : picture_of(options, session, mistake);
        bar.show(static_cast<double>(&mistake - sample_mistakes.data() + 1) / sample_mistakes.size());
        if (picture.codes.empty() || picture == right) continue;
        SampleFinding finding{&mistake};
        for (std::size_t p = 0; p < pixels; ++p) {
            if (!is_like(colors, picture, p)) continue;
            ++finding.agreeing;
            finding.explained += wrong[p] ? 1 : 0;
        }
        findings.push_back(finding);
    }
    std::ranges::stable_sort(findings, std::ranges::greater{}, &SampleFinding::agreeing);
    const bool edges_only = wrong_pixels > 0 && is_on_edges(options, session, wrong);
    print(json ? to_json(findings, wrong_pixels, pixels, edges_only)
               : to_text(findings, wrong_pixels, pixels, edges_only));
    return wrong_pixels == 0 ? 0 : 1;
}

}  // namespace strata::tools
