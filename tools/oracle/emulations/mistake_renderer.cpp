// tools/oracle/emulations/mistake_renderer.cpp - renders the scene rightly and with each mistake, and finds how many
// passes the right run takes (mistake_renderer.h).
#include "tools/oracle/emulations/mistake_renderer.h"

#include <algorithm>
#include <stdexcept>

#include "peeling/render.h"
#include "peeling/sample_hazard.h"
#include "pipeline/device/check.h"
#include "tools/oracle/emulations/catalogue.h"

namespace strata::oracle {

namespace {

// The result of run(); empty if the device lacks a feature that the mistake needs, or cannot run such a pass.
auto made(auto&& run) -> std::optional<decltype(run())> {
    try {
        return run();
    } catch (const pipeline::Refused&) {
    } catch (const std::logic_error&) {
    }
    return std::nullopt;
}

// Empty if the run alters no step.
std::optional<pipeline::Alteration> alteration_of(const AlteredRun& e) {
    return e.alterations.empty() ? std::nullopt : std::optional{combined(e)};
}

using Targets = std::vector<TargetImage>;

// The published target with the changes to the finished image applied, because a port may make them in its last pass.
// It keeps its name.
Targets finished(const PassReport& last, const PassReport& published, const AlteredRun& e) {
    Targets targets;
    for (const NamedImage& target : last.targets) {
        if (e.afterwards.empty() || target.image.codes != published.targets[0].image.codes) continue;
        Picture picture{.file = "", .targets = {as_target(target.image, target.name)}};
        for (const auto& change : e.afterwards) change(picture);
        targets.push_back(std::move(picture.targets[0]));
    }
    return targets;
}

}  // namespace

MistakeRenderer::MistakeRenderer(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm, Depths depths,
                                 int limit)
    : input_{input}, algorithm_{algorithm}, depths_{depths}, limit_{limit} {
    right_ = run(altered_run(), &right_run_);
    find_enough_passes();
}

MistakeRenderer MistakeRenderer::within(const rasterizer::Rect& part) const {
    MistakeRenderer some{*this};
    auto& scissor = some.input_.options.raster.scissor;
    scissor = scissor ? rasterizer::intersection(*scissor, part) : part;
    some.right_ = some.run(some.altered_run());
    return some;
}

AlteredRun MistakeRenderer::altered_run() const {
    AlteredRun e{.list = &input_.list, .view = input_.view, .profile = input_.profile, .options = input_.options};
    e.algorithm = &algorithm_;
    e.right = right_run_;
    e.options.audit = e.options.keep_layers = false;
    e.options.nearest_depth = depths_ == Depths::made;
    return e;
}

Picture MistakeRenderer::run(const AlteredRun& e, RightRun* counted) const {
    peeling::RenderOptions options = e.options;
    options.keep_samples = static_cast<bool>(e.resolve);
    peeling::Renderer renderer{*e.list, e.view, e.profile, options};
    const std::optional<pipeline::Alteration> alteration = alteration_of(e);
    peeling::RenderResult result =
        renderer.render(*e.algorithm, {}, {.alteration = alteration ? &*alteration : nullptr});
    if (result.outcome == peeling::Outcome::refused) throw pipeline::Refused{e.profile, *std::move(result.refusal)};
    if (counted != nullptr) {
        counted->passes = static_cast<int>(result.frame.passes.geometry);
        counted->is_endless = std::ranges::find(result.frame.diagnostics, pipeline::Fault::endless,
                                                &pipeline::Diagnostic::fault) != result.frame.diagnostics.end();
    }
    if (!result.frame.samples.empty()) result.frame.color = e.resolve(result.frame.samples);
    Picture picture{.file = "", .targets = {as_target(result.frame.color, "color")}};
    picture.targets[0].alpha_form = AlphaForm::premultiplied;
    if (depths_ == Depths::made) picture.targets.push_back(as_target(result.frame.depth, "depth"));
    for (const auto& change : e.afterwards) change(picture);
    return picture;
}

// An iteration has at most seven passes, and the last one of most peels finds nothing, so fewer than eight runs
// suffice.
void MistakeRenderer::find_enough_passes() {
    right_run_.enough_passes = right_run_.passes;
    for (int passes = right_run_.passes - 1; passes >= 1; --passes) {
        AlteredRun e = altered_run();
        e.options.max_passes = passes;
        if (run(e).targets[0].codes != right_.targets[0].codes) return;
        right_run_.enough_passes = passes;
    }
}

std::optional<AlteredRun> MistakeRenderer::altered_run(std::span<const Mistake* const> mistakes) const {
    AlteredRun e = altered_run();
    const int given_limit = e.options.max_passes;
    for (const Mistake* mistake : mistakes)
        if ((mistake->part == ChangedPart::samples && e.options.sampling.samples == 1) || !mistake->make(e))
            return std::nullopt;
    const bool is_limited =
        e.options.max_passes != given_limit || e.options.termination.rule == pipeline::TerminationRule::fixed;
    const int limit = limit_ > 0 ? limit_ : right_run_.is_endless ? right_run_.passes : 2 * right_run_.passes + 8;
    const bool shades_pixels = e.options.raster.interpolation != rasterizer::Interpolation::sample;
    const bool is_of_samples = e.options.sampling.loads_others() || (e.options.sampling.samples > 1 && shades_pixels);
    const bool limits_itself = is_of_samples && e.alterations.empty() && limit_ == 0;
    if (!is_limited && !limits_itself && given_limit == 0 && right_run_.passes > 1) e.options.max_passes = limit;
    return e;
}

std::vector<bool> MistakeRenderer::edges() const {
    std::vector<bool> edges;
    if (input_.options.sampling.samples == 1) return edges;
    for (const peeling::SampleEdge edge : peeling::sample_edges(input_, algorithm_))
        edges.push_back(edge != peeling::SampleEdge::inside);
    return edges;
}

std::optional<Picture> MistakeRenderer::with(std::span<const Mistake* const> mistakes) const {
    const std::optional<AlteredRun> e = altered_run(mistakes);
    return e ? made([&] { return run(*e); }) : std::nullopt;
}

std::optional<PassAgreement> MistakeRenderer::compare_passes(std::span<const Mistake* const> mistakes,
                                                             const std::vector<PassPicture>& candidate) const {
    const std::optional<AlteredRun> e = altered_run(mistakes);
    if (!e) return std::nullopt;
    const std::optional<pipeline::Alteration> alteration = alteration_of(*e);
    return made([&] {
        PassEvidence evidence{candidate};
        std::optional<PassReport> last;
        const auto add = [&](PassReport&& pass) {
            if (last)
                evidence.add(*last, pass.kind == ReportedPassKind::published ? finished(*last, pass, *e) : Targets{});
            last = std::move(pass);
        };
        passes({*e->list, e->view, e->profile, e->options}, *e->algorithm, add, alteration ? &*alteration : nullptr);
        return evidence.found();
    });
}

std::optional<Picture> MistakeRenderer::with(const Mistake& mistake) const {
    const Mistake* const one[] = {&mistake};
    return with(one);
}

pipeline::Image color_image(const Picture& picture) {
    using pipeline::Format;
    const TargetImage& colors = picture.targets[0];
    const Format format = colors.code == Code::unorm8 ? Format::rgba8
                          : colors.code == Code::half ? Format::rgba16f
                                                      : Format::rgba32f;
    pipeline::Image image{format, colors.width, colors.height};
    image.codes.assign(colors.codes.begin(), colors.codes.end());
    return image;
}

Picture changed(const Picture& picture, const Mistake& mistake) {
    AlteredRun e;
    static_cast<void>(mistake.make(e));
    Picture result = picture;
    for (const auto& change : e.afterwards) change(result);
    return result;
}

}  // namespace strata::oracle
