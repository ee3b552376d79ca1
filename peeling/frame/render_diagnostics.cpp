// peeling/frame/render_diagnostics.cpp - the order in which causes are checked, and their messages.
#include "peeling/frame/render_diagnostics.h"

#include <string>
#include <utility>

#include "rasterizer/set_up/geometry.h"

namespace strata::peeling {

using namespace pipeline;

void add_audit_diagnostics(const Algorithm& algorithm, const RenderOptions& options, const PassDepths& depths,
                           const AuditResult& audit, std::vector<Diagnostic>& all) {
    const auto note = [&](Fault fault, const PixelCount& where, std::string detail) {
        merge(all, {fault, where.pixels, where.first_x, where.first_y, std::move(detail)});
    };
    const bool merges = algorithm.ties == TiePolicy::merged, drops = algorithm.ties == TiePolicy::unique;
    if (audit.lost_by_ties > 0 && (merges || drops))
        note(Fault::merged_ties, audit.ties,
             std::to_string(audit.lost_by_ties) +
                 (merges ? " fragments of equal depth mixed by MAX" : " later fragments of equal depth lost"));
    if (audit.opaque_ties.pixels > 0)
        note(Fault::ties_with_opaque, audit.opaque_ties,
             std::to_string(audit.hidden_by_opaque_ties) +
                 " fragments at exactly the depth of an opaque surface: LESS hides them, LEQUAL would show them");
    const bool sorts = algorithm.order == ListOrder::objects || algorithm.order == ListOrder::back_to_front;
    const bool orders = algorithm.exact || sorts || !depths.is_invariant;
    if (!orders || audit.order_errors.value_or(0) == 0) return;
    const bool limited = options.max_passes > 0 || options.termination.rule == TerminationRule::fixed ||
                         options.termination.rule == TerminationRule::ratio;
    if (limited)
        note(Fault::truncated, audit.misordered, "the peel ended before the last layer");
    else if (algorithm.has_published_form && options.formulation == Formulation::published)
        note(Fault::as_published, audit.misordered,
             std::to_string(*audit.order_errors) + " layers lost, repeated or misplaced by the listing as printed");
    else if (algorithm.order == ListOrder::sets)
        note(Fault::out_of_order, audit.misordered, "the ordered set (--sorted) does not arrive front to back");
    else if (algorithm.order == ListOrder::objects && !algorithm.exact)
        note(Fault::out_of_order, audit.misordered, "objects or their own triangles overlap out of order");
    else if (algorithm.order == ListOrder::back_to_front)
        note(Fault::out_of_order, audit.misordered, "triangles sorted by their centroids overlap out of order");
    else if (!depths.is_invariant)
        note(Fault::unlike_depths, audit.misordered,
             std::to_string(*audit.order_errors) + " layers lost, repeated or misplaced");
    else if (needs(algorithm, Feature::float_targets) && depths.are_flushed)
        note(
            Fault::unlike_depths, audit.misordered,
            std::to_string(*audit.order_errors) + " layers lost or repeated: blending flushes denormal depths to zero");
    else if (options.termination.rule == TerminationRule::paper && algorithm.ties == TiePolicy::merged)
        note(Fault::early_end, audit.misordered, "every back layer of a pass had alpha 0 while layers were left (E14)");
}

void note_endless(const Algorithm& algorithm, const Frame& frame, const RenderOptions& options, FrameResult& result) {
    if (options.max_passes > 0 || frame.max_passes == 0 || result.passes.geometry < frame.max_passes) return;
    const std::string why =
        options.raster.sample_coverage != rasterizer::SampleCoverage{}
            ? "the program counts fragments of samples that are left out"
        : algorithm.compares_own_codes ? "a float target loses depths beyond 1 and flushes the smallest ones"
        : !frame.quantize_reference
            ? "the compared depth is not rounded like the stored one, so a fragment lies behind itself"
            : "some fragments' compared depth lies behind the depth that they stored themselves";
    merge(result.diagnostics, {Fault::endless, 0, -1, -1,
                               "stopped after " + std::to_string(frame.max_passes) +
                                   " geometry passes, more than the deepest pixel needs: " + why});
}

void note_set_up(const rasterizer::SetupCounters& counters, std::vector<Diagnostic>& all) {
    if (counters.non_finite > 0)
        merge(all, {Fault::non_finite_vertices, 0, -1, -1,
                    std::to_string(counters.non_finite) + " triangles dropped, the first is number " +
                        std::to_string(counters.first_non_finite)});
}

void note_extensions(const Algorithm& algorithm, DepthFormat format, bool quantizes, std::vector<Diagnostic>& all) {
    if (needs(algorithm, Feature::sequential_depth_units) && !algorithm.body)
        merge(all, {Fault::emulator_extension, 0, -1, -1, "STRATA_depth_units: no device had sequential depth units"});
    if (needs(algorithm, Feature::ordered_rmw))
        merge(all, {Fault::emulator_extension, 0, -1, -1,
                    "STRATA_ordered_rmw: no device's programs read what they write, in order"});
    const bool compares_in_program = algorithm.key == DepthKey::stored_code &&
                                     needs(algorithm, Feature::fragment_programs) && format != DepthFormat::d32f;
    if (compares_in_program && (quantizes || algorithm.compares_own_codes))
        merge(all,
              {Fault::depth_quantized, 0, -1, -1, "the program converts its z like a depth write before it compares"});
}

}  // namespace strata::peeling
