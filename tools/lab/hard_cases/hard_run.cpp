// tools/lab/hard_cases/hard_run.cpp - decides the verdict on one algorithm and hard case: stable, degrades, breaks or
// failed, from audits, diagnostics and every other execution of the frame (hard_run.h).
#include "tools/lab/hard_cases/hard_run.h"

#include <fmt/format.h>

#include <cmath>

#include "peeling/audit/image_error.h"
#include "peeling/audit/region_trace.h"
#include "peeling/registry.h"
#include "peeling/render.h"
#include "rasterizer/base/simd.h"
#include "tools/lab/hard_cases/hard_truth.h"
#include "tools/request/choices.h"

namespace strata::tools {

using namespace pipeline;

std::string_view name_of(HardVerdict verdict) noexcept {
    switch (verdict) {
        case HardVerdict::refused: return "refused";
        case HardVerdict::stable: return "stable";
        case HardVerdict::degrades: return "degrades gracefully";
        case HardVerdict::breaks: return "breaks as the hardware did";
        case HardVerdict::failed: break;
    }
    return "failed";
}

bool explains_misplaced(Fault fault) noexcept {
    switch (fault) {
        case Fault::endless:
        case Fault::early_end:
        case Fault::truncated:
        case Fault::as_published:
        case Fault::buffer_overflow:
        case Fault::stencil_saturated:
        case Fault::unlike_depths:
        case Fault::out_of_order: return true;
        case Fault::half_saturated:
        case Fault::merged_ties:
        case Fault::depth_quantized:
        case Fault::non_finite_vertices:
        case Fault::count_limit:
        case Fault::equal_at_bound:
        case Fault::ties_with_opaque:
        case Fault::non_finite_target:
        case Fault::emulator_extension: break;
    }
    return false;
}

peeling::RenderOptions hard_options(const scenes::HardCase& hard, std::optional<DepthFormat> depth) {
    peeling::RenderOptions options;
    options.width = hard.width;
    options.height = hard.height;
    options.threads = 1;
    options.depth = depth;
    options.raster.depth_near = hard.depth_near;
    options.raster.depth_far = hard.depth_far;
    return options;
}

// A renderer with settings that must not change a bit of the result.
struct HardCaseRenderer::Way {
    std::string name;
    std::unique_ptr<peeling::Renderer> renderer;
};

namespace {

using NamedOptions = std::pair<std::string, peeling::RenderOptions>;

// True if images are so large that each way of running takes seconds.
bool is_huge(const scenes::HardCase& hard) {
    return static_cast<std::int64_t>(hard.width) * hard.height > std::int64_t{1} << 24;
}

// All settings that are not the default, in one run.
NamedOptions all_else(peeling::RenderOptions options) {
    options.execution = Execution::literal;
    options.threads = 2;
    options.effects = Effects::all;
    options.simd = Simd::scalar;
    return {"literal threads=2 effects=all simd=scalar", options};
}

// True if a literal run takes seconds, because a peel draws all triangles for each layer.
bool is_deep(const scenes::HardCase& hard, const scenes::Scene& scene) {
    constexpr std::size_t many = std::size_t{1} << 20;
    return scene.list.meshes[0].indices.size() / 3 * static_cast<std::size_t>(hard.counts.layers) > many;
}

// Names and settings, the default first.
std::vector<NamedOptions> ways_of(const scenes::HardCase& hard, const scenes::Scene& scene,
                                  const peeling::RenderOptions& options) {
    std::vector<NamedOptions> ways{{"default", options}};
    if (is_huge(hard) || is_deep(hard, scene)) return ways.push_back(all_else(options)), ways;
    const auto add = [&](std::string name) -> peeling::RenderOptions& {
        return ways.emplace_back(std::move(name), options).second;
    };
    add("literal").execution = Execution::literal;
    peeling::RenderOptions& threads = add("threads=2");
    threads.threads = 2;
    threads.tile_size = 8;
    add("effects=all").effects = Effects::all;
    for (const Simd simd : available_simd()) add("simd=" + std::string{name_of(simds, simd)}).simd = simd;
    return ways;
}

std::uint64_t nan_values(const Image& image) {
    std::uint64_t found = 0;
    if (image.format == Format::rgba8) return found;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < image.channels(); ++c)
                if (std::isnan(peeling::channel_value(image, x, y, c))) ++found;
    return found;
}

bool is_alike(const peeling::RenderResult& a, const peeling::RenderResult& b) {
    return a.frame.color == b.frame.color && a.frame.depth == b.frame.depth && a.audit == b.audit &&
           a.frame.diagnostics == b.frame.diagnostics && a.frame.passes.geometry == b.frame.passes.geometry;
}

bool has(const std::vector<Diagnostic>& all, Fault fault) {
    return std::any_of(all.begin(), all.end(), [&](const Diagnostic& d) { return d.fault == fault; });
}

// True if a diagnostic that explains misplaced fragments has exactly that many pixels.
bool is_named(const std::vector<Diagnostic>& all, std::uint64_t pixels) {
    return std::any_of(all.begin(), all.end(),
                       [&](const Diagnostic& d) { return explains_misplaced(d.fault) && d.pixels == pixels; });
}

// Raises the verdict; it is never lowered.
void say(HardRow& row, HardVerdict verdict, std::string reason) {
    row.verdict = std::max(row.verdict, verdict);
    row.reasons.push_back(std::move(reason));
}

void judge_sequence(HardRow& row, const peeling::Algorithm& algorithm, const peeling::AuditResult& audit) {
    const Composited& found = row.found;
    if (found.wrong_pixels > 0)
        say(row, is_named(row.diagnostics, found.wrong_pixels) ? HardVerdict::breaks : HardVerdict::failed,
            fmt::format("{} lost, {} repeated, {} misplaced at {} pixels", found.lost, found.repeated, found.misplaced,
                        found.wrong_pixels));
    const bool is_ordered = algorithm.ties != peeling::TiePolicy::none;
    if (is_ordered && audit.order_errors.value_or(0) == 0 && found.wrong_pixels > 0)
        say(row, HardVerdict::failed, "the audit found no order error");
    const bool drops = algorithm.ties == peeling::TiePolicy::unique || algorithm.ties == peeling::TiePolicy::merged;
    if (!drops) return;
    const auto named = std::find_if(row.diagnostics.begin(), row.diagnostics.end(),
                                    [](const Diagnostic& d) { return d.fault == Fault::merged_ties; });
    const std::uint64_t pixels = named == row.diagnostics.end() ? 0 : named->pixels;
    if (pixels != found.tied_pixels)
        say(row, HardVerdict::failed,
            fmt::format("{} pixels with ties, and merged_ties says {}", found.tied_pixels, pixels));
    if (found.lost_by_ties > 0)
        say(row, HardVerdict::breaks,
            fmt::format("{} fragments lost by ties at {} pixels", found.lost_by_ties, found.tied_pixels));
}

// Exact algorithms must keep the bound. Others may exceed it if a fault or their definition explains it.
void judge_picture(HardRow& row, const scenes::HardCase& hard, const peeling::Algorithm& algorithm) {
    const bool saturated =
        has(row.diagnostics, Fault::half_saturated) || has(row.diagnostics, Fault::stencil_saturated);
    if (row.nan_values > 0 && !hard.is_non_finite)
        say(row, saturated ? HardVerdict::breaks : HardVerdict::failed,
            fmt::format("{} values of the picture are NaN", row.nan_values));
    if (row.difference_at_ties > row.bound && algorithm.ties != peeling::TiePolicy::unique &&
        algorithm.ties != peeling::TiePolicy::merged)
        say(row, HardVerdict::degrades,
            fmt::format("{:.1f}/255 from the truth where keys are equal", row.difference_at_ties));
    if (row.difference <= row.bound) return;
    // A device that computes its planes in steps may order fragments differently than the truth, whose planes are
    // exact.
    const std::string reason =
        fmt::format("{:.1f}/255 from the truth{}", row.difference, row.steps_planes ? ", whose planes are exact" : "");
    if (saturated || row.found.wrong_pixels > 0)
        say(row, HardVerdict::breaks, reason);
    else
        say(row, algorithm.exact && !row.steps_planes ? HardVerdict::failed : HardVerdict::degrades, reason);
}

void judge_geometry(HardRow& row, const scenes::HardCase& hard, const peeling::Algorithm& algorithm) {
    // Fragments discarded by an alpha test are no loss of geometry.
    if (row.found.visible != hard.counts.fragments && !algorithm.kills_alpha_zero)
        say(row, HardVerdict::degrades,
            fmt::format("{} fragments, exact geometry has {}", row.found.visible, hard.counts.fragments));
    if (row.found.layers != hard.counts.layers && !algorithm.kills_alpha_zero)
        say(row, HardVerdict::degrades,
            fmt::format("{} layers, exact geometry has {}", row.found.layers, hard.counts.layers));
}

}  // namespace

void judge(HardRow& row, const scenes::HardCase& hard, const peeling::Algorithm& algorithm,
           const peeling::AuditResult& audit) {
    for (const std::string& way : row.unlike) say(row, HardVerdict::failed, "other bits with " + way);
    judge_sequence(row, algorithm, audit);
    judge_picture(row, hard, algorithm);
    judge_geometry(row, hard, algorithm);
}

HardCaseRenderer::HardCaseRenderer(const scenes::HardCase& hard, const DeviceProfile& profile, DepthFormat depth)
    : hard_{hard},
      profile_{profile},
      scene_{make_hard_case({}, hard)},
      options_{hard_options(hard, depth)},
      truth_{std::make_unique<const HardTruth>(scene_, profile_, options_)} {
    for (auto& [name, options] : ways_of(hard, scene_, options_))
        ways_.push_back({name, std::make_unique<peeling::Renderer>(scene_.list, *scene_.own_view, profile_, options)});
}

HardCaseRenderer::~HardCaseRenderer() = default;

std::vector<std::string> HardCaseRenderer::unlike_ways(const peeling::Algorithm& algorithm,
                                                       const peeling::RenderResult& first) {
    std::vector<std::string> unlike;
    for (std::size_t i = 1; i < ways_.size(); ++i)
        if (!is_alike(first, ways_[i].renderer->render(algorithm))) unlike.push_back(ways_[i].name);
    return unlike;
}

namespace {

HardRow refused(std::string message) {
    HardRow row;
    row.refusal = std::move(message);
    row.verdict = HardVerdict::refused;
    return row;
}

// The reason why the case is not run with the algorithm; empty: it is.
std::string reason_to_leave_out(const scenes::HardCase& hard, const peeling::Algorithm& algorithm) {
    const bool is_one_pass = algorithm.geometry_passes != nullptr && algorithm.geometry_passes(2) == 1;
    if (!is_huge(hard) || is_one_pass) return "";
    return fmt::format("a frame of {} x {} pixels is for algorithms of one geometry pass; {} takes {}", hard.width,
                       hard.height, algorithm.name, algorithm.pass_formula);
}

}  // namespace

std::vector<std::string> ways_of(const scenes::HardCase& hard) {
    std::vector<std::string> names;
    for (const auto& [name, options] : ways_of(hard, make_hard_case({}, hard), hard_options(hard, {})))
        names.push_back(name);
    return names;
}

HardRow HardCaseRenderer::run(const peeling::Algorithm& algorithm) {
    if (const std::string reason = reason_to_leave_out(hard_, algorithm); !reason.empty()) return refused(reason);
    peeling::Renderer& renderer = *ways_.front().renderer;
    const peeling::RenderResult result = renderer.render(algorithm);
    if (result.refusal) return refused(result.refusal->message(profile_));
    HardRow row;
    std::vector<peeling::RegionTrace> traces;
    static_cast<void>(renderer.render_traced(algorithm, traces));
    const peeling::FrameFragments fragments = renderer.fragments(algorithm);
    const bool tests_codes =
        profile_.alpha_test == AlphaTestPrecision::unorm8 || renderer.color_format() == Format::rgba8;
    const ComposedFrame composed{algorithm, hard_.width, tests_codes, fragments, traces};
    row.found = composited(composed);
    row.diagnostics = result.frame.diagnostics;
    const HardTruth::Difference difference = truth_->difference(composed, result.frame.color);
    row.difference = difference.elsewhere;
    row.difference_at_ties = difference.at_ties;
    row.bound = renderer.color_format() == Format::rgba8 ? hard_.bound : 1;
    row.nan_values = nan_values(result.frame.color);
    row.unlike = unlike_ways(algorithm, result);
    row.digest = digest(result.frame.color);
    row.steps_planes = profile_.raster.plane_rule != rasterizer::PlaneRule::exact;
    judge(row, hard_, algorithm, result.audit);
    return row;
}

peeling::RenderResult picture_of(const scenes::HardCase& hard, const DeviceProfile& profile,
                                 const peeling::Algorithm& algorithm) {
    const scenes::Scene scene = make_hard_case({}, hard);
    peeling::Renderer renderer{scene.list, *scene.own_view, profile, hard_options(hard, {})};
    return renderer.render(algorithm);
}

}  // namespace strata::tools
