// peeling/algorithms/coherent_ideal.cpp - coherent layer peeling in two passes, on hypothetical hardware that reads and
// writes several depths and a flag per sample. Carr, Mech and Miller 2008, Algorithm 2; peeling/reference/algorithms.md
// 12, errata E23, E25.
//
// Needs      STRATA_ordered_rmw: targets that the fragment program reads and writes in submission order.
// Passes     2 per iteration, 1 in the last; 3 for any n in ascending order, 2 n + 1 in descending order. Of equal
//            depths all are composited, the first submitted in front.
// Invariant  before pass 1 of an iteration everything before `peel` is composited, and nothing behind it; fragments
//            exactly at `peel` are composited by that pass.
#include "peeling/algorithms/entry.h"
#include "peeling/programs/depth_float.h"
#include "peeling/programs/depth_range.h"
#include "peeling/programs/region_programs.h"

namespace strata::peeling::listing::coherent_ideal {

using namespace pipeline;

namespace {

constexpr float below_every_depth = -1.0f;

// The channels of the register target.
enum Register : std::size_t { z1, z2, z3, out_of_order };

class IdealPeel {
  public:
    explicit IdealPeel(Region& region)
        : region_{region}, ties_{region}, published_{region.frame().formulation == Formulation::published} {
        region_.set_name(accumulated_, "accumulated");
        region_.set_name(registers_, "registers");
        region_.set_name(peel_, "peel");
        region_.clear(accumulated_, {.color = {0, 0, 0, 1}});
        const float start = published_ ? 0.0f : below_every_depth;  // zNear loses depth 0: comparison is strict (E23)
        region_.clear(registers_, {.color = {0, 0, start, 0}});
    }

    void run() {
        bool more = true, has_run = false;
        while (!region_.limit_reached(has_run ? 2 : 1)) {
            region_.begin_iteration();
            if (has_run) composite_run();
            start_iteration();
            const DrawCounts found = find_run();
            has_run = true;
            if (!(more = region_.any(found.tallied, idle()))) break;
        }
        if (more && has_run && !region_.limit_reached()) composite_run();  // a limit that still allows this pass
        ties_.report(region_);
        publish_over_background(region_, accumulated_, region_.opaque_color());
    }

  private:
    // As published, finished pixels change while others are peeled (E25). After the last iteration that a limit allows
    // there may be one more pass, and a region counts it even if it has nothing left.
    [[nodiscard]] Idle idle() const { return published_ || region_.limit_reached(2) ? Idle::no : Idle::yes; }

    [[nodiscard]] float as_float(std::uint32_t code) const noexcept { return depth_as_float(code, format_); }

    // A full-screen quad between iterations: the end of the last run becomes `peel`, and the registers start at the
    // opaque surface.
    void start_iteration() {
        PassState state;
        state.color = {registers_, peel_};
        state.reads = {registers_, region_.opaque_depth()};
        state.ordered_rmw = true;
        static_cast<void>(region_.full_screen(state, [this](const FragmentBatch& in, const Loads& loads, Outputs& out) {
            for (std::size_t i = 0; i < lanes(in); ++i) {
                const float opaque = as_float(loads.depth(1)[i]), end = loads.color(0)[z3][i];
                out.color[0][z1][i] = out.color[0][z2][i] = opaque;
                out.color[0][z3][i] =
                    published_ ? end : opaque;  // as published z3 is not reset: finished pixels start again (E25)
                out.color[0][out_of_order][i] = 0.0f;
                for (std::size_t c = 0; c < 4; ++c) out.color[1][c][i] = end;
            }
        }));
    }

    // Updates the registers of one pixel for a fragment of depth z with peel < z < z2.
    static void arrive(std::array<float, 4>& r, float z) noexcept {
        if (z < r[z1]) {
            r = {z, r[z1], z, 0.0f};
        } else if (r[out_of_order] != 0.0f) {
            r[z3] = std::min(r[z3], z);
        } else {
            if (z < r[z3]) r[out_of_order] = 1.0f;
            r[z3] = z;
        }
    }

    // Pass 1 composites the fragments at `peel`, the end of the previous run, and updates the registers with every
    // fragment between `peel` and z2. Its tally, the number of register changes, is the query.
    DrawCounts find_run() {
        PassState state = composite_state(accumulated_);
        state.color[1] = registers_;
        state.reads = {registers_, peel_, region_.opaque_depth()};
        state.ordered_rmw = true;
        state.selection = {.keeps = KeptFragments::interval,
                           .outside = Outside::writes_alike,
                           .near = {peel_, true, 0},
                           .far = {KeyBound{region_.opaque_depth(), published_}}};  // published: inclusive
        ties_.start();
        return region_.draw(state, [this](const FragmentBatch& in, const Loads& loads, Outputs& out) {
            composite_under(in, out);
            for (std::size_t i = 0; i < lanes(in); ++i) {
                std::array<float, 4> r{};
                for (std::size_t c = 0; c < 4; ++c) r[c] = loads.color(0)[c][i];
                const float z = as_float(in.code[i]), peel = loads.color(1)[0][i];
                const bool is_in_range = out.alive[i] != 0 && peel < z && z < r[z2];
                const bool ends_run = z == peel && (published_ || z < as_float(loads.depth(2)[i]));
                if (is_in_range) arrive(r, z);
                if (is_in_range) ++out.tally;
                for (std::size_t c = 0; c < 4; ++c) out.color[1][c][i] = r[c];
                if (!ends_run)
                    leave_alone(out, i);
                else if (out.alive[i] != 0)
                    ties_.add(in.pixel[i]);
            }
        });
    }

    // Writes (0, 0, 0, 0), which UNDER ignores. The fragment is not discarded, because the same pass writes its
    // registers.
    static void leave_alone(Outputs& out, std::size_t i) noexcept {
        for (std::size_t c = 0; c < 4; ++c) out.color[0][c][i] = 0.0f;
        out.side[i] = Side::none;
    }

    // Pass 2 composites the run except its end, which the next pass 1 composites.
    void composite_run() {
        PassState state = composite_state(accumulated_);
        state.reads = {registers_, peel_};
        state.selection = {
            .keeps = KeptFragments::interval, .near = {peel_, false, 0}, .far = {KeyBound{registers_, false, z3}}};
        static_cast<void>(region_.draw(state, [this](const FragmentBatch& in, const Loads& loads, Outputs& out) {
            for (std::size_t i = 0; i < lanes(in); ++i) {
                const float z = as_float(in.code[i]);
                out.alive[i] &= mask(loads.color(1)[0][i] < z && z < loads.color(0)[z3][i]);
            }
            composite_under(in, out);
        }));
    }

    Region& region_;
    BoundTies ties_;
    bool published_;
    DepthFormat format_ = region_.frame().key_request().format;
    Target accumulated_ = region_.make_color();
    Target registers_ = region_.make(Format::rgba32f), peel_ = region_.make(Format::r32f);
};

}  // namespace

void run(Region& region) { IdealPeel{region}.run(); }

std::vector<Algorithm> entries() {
    return {
        Algorithm{.name = "coherent_ideal",
                  .listed = 120,
                  .paper = "Carr, Mech and Miller 2008",
                  .section = "Algorithm 2",
                  .summary = "the same runs in two passes, by depths and a flag that the rasterizer reads and writes",
                  .pass_formula = "2 an iteration - 1",
                  .ties = TiePolicy::first,
                  .exact = true,
                  .compares_own_codes = true,
                  .has_published_form = true,
                  .run = run,
                  .features = {ordered_rmw, float_targets, fragment_programs, separate_alpha_blend},
                  .render_targets = 2}};
}

}  // namespace strata::peeling::listing::coherent_ideal
