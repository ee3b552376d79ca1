// peeling/algorithms/fixed_passes/k_buffer.cpp - keeps four fragments per pixel sorted by depth during one pass; a
// fifth causes the nearest to be composited. Bavoil et al. 2007, compared in Carr, Mech and Miller 2008, section 2;
// peeling/reference/algorithms.md 14.
//
// Needs      STRATA_ordered_rmw (real devices had read-modify-write hazards here), six float render targets.
// Passes     1. Correct if no fragment is preceded by more than four deeper visible ones. Of equal depths the first
//            submitted is in front.
// Invariant  a pixel's entries are sorted by depth, ties in submission order, and behind everything composited unless a
//            fault is reported.
#include <array>

#include "peeling/algorithms/entry.h"
#include "peeling/programs/depth_float.h"
#include "peeling/programs/depth_range.h"
#include "peeling/programs/fixed_passes/pixel_lists.h"
#include "peeling/programs/region_programs.h"

namespace strata::peeling::listing::k_buffer {

using namespace pipeline;

namespace {

constexpr std::size_t k = 4;      // entries: a colour target each, and one target for their depths
constexpr float no_entry = 2.0f;  // beyond every depth

struct Entry {
    float depth = no_entry;
    Rgba color{};  // not premultiplied
    std::uint8_t samples = 1;
};

class KBuffer {
  public:
    KBuffer(Region& region, ListGranularity granularity)
        : region_{region}, lists_{region, granularity}, overflow_{region}, pushed_out_(lists_.count(), -1.0f) {
        region_.set_name(accumulated_, "accumulated");
        region_.set_name(depths_, "depths");
        region_.clear(accumulated_, {.color = {0, 0, 0, 1}});
        region_.clear(depths_, {.color = {no_entry, no_entry, no_entry, no_entry}});
        for (Target& color : colors_) {
            color = lists_.make(Format::rgba32f);
            region_.set_name(color, "entry");
        }
        if (!lists_.are_pixels()) return;
        masks_ = lists_.make(Format::rgba32f);
        region_.set_name(masks_, "masks");
    }

    void run() {
        region_.begin_iteration();
        insert_all();
        for (std::size_t i = 0; i < k; ++i) composite_entry(i);
        overflow_.report(region_, Fault::buffer_overflow,
                         "a fragment came after more than 4 deeper ones: composited too late");
        publish_over_background(region_, accumulated_, region_.opaque_color());
    }

  private:
    // The geometry pass: the program reads and writes the four entries of its pixel in submission order.
    void insert_all() {
        PassState state = composite_state(accumulated_);
        state.color[1] = state.reads[1] = depths_;
        state.color[2 + k] = state.reads[2 + k] = masks_;
        for (std::size_t i = 0; i < k; ++i) state.color[2 + i] = state.reads[2 + i] = colors_[i];
        state.ordered_rmw = true;
        lists_.see_visible(state);
        static_cast<void>(region_.draw(state, [this](const FragmentBatch& in, const Loads& loads, Outputs& out) {
            lists_.keep_visible(in, loads, out);
            for (std::size_t i = 0; i < lanes(in); ++i)
                if (out.alive[i] != 0) insert(in, loads, out, i);
        }));
    }

    // Inserts the fragment behind all entries of less or equal depth, and composites the nearest entry if there are now
    // k + 1.
    void insert(const FragmentBatch& in, const Loads& loads, Outputs& out, std::size_t i) {
        std::array<Entry, k + 1> entries;
        for (std::size_t e = 0; e < k; ++e) {
            entries[e].depth = loads.color(1)[e][i];
            for (std::size_t c = 0; c < 4; ++c) entries[e].color[c] = loads.color(2 + static_cast<int>(e))[c][i];
            if (lists_.are_pixels()) entries[e].samples = static_cast<std::uint8_t>(loads.color(2 + k)[e][i]);
        }
        Entry fragment{depth_as_float(in.code[i], format_),
                       {in.color[0][i], in.color[1][i], in.color[2][i], in.color[3][i]},
                       lists_.samples_of(out, i)};
        if (fragment.depth < pushed_out_[in.pixel[i]]) overflow_.add(in.pixel[i]);
        std::size_t slot = k;
        for (; slot > 0 && entries[slot - 1].depth > fragment.depth; --slot) entries[slot] = entries[slot - 1];
        entries[slot] = fragment;
        const bool is_full = entries[k].depth != no_entry;
        push_out(in.pixel[i], is_full ? entries[0] : Entry{}, out, i);
        const std::size_t first = is_full ? 1 : 0;
        for (std::size_t e = 0; e < k; ++e) {
            out.color[1][e][i] = entries[first + e].depth;
            for (std::size_t c = 0; c < 4; ++c) out.color[2 + e][c][i] = entries[first + e].color[c];
            if (lists_.are_pixels()) out.color[2 + k][e][i] = static_cast<float>(entries[first + e].samples);
        }
    }

    // An empty entry has colour and alpha 0, which UNDER ignores. pushed_out_ is the greatest depth composited so far:
    // a nearer fragment that is drawn later is composited too late, which is reported.
    void push_out(std::uint32_t pixel, const Entry& entry, Outputs& out, std::size_t i) {
        for (std::size_t c = 0; c < 3; ++c) out.color[0][c][i] = entry.color[c] * entry.color[3];
        out.color[0][3][i] = entry.color[3];
        if (lists_.are_pixels()) out.samples[i] = entry.samples;
        if (entry.depth == no_entry) return;
        pushed_out_[pixel] = std::max(pushed_out_[pixel], entry.depth);
        if (!region_.frame().trace) return;
        lists_.for_each_element(pixel, entry.samples, [&](std::uint32_t element) {
            region_.trace({element, depth_as_code(entry.depth, format_), 0, Side::front, false});
        });
    }

    // One full-screen quad per entry, near to far; pixels whose entry is empty are discarded.
    void composite_entry(std::size_t e) {
        PassState state = composite_state(accumulated_);
        state.reads = {depths_, colors_[e], masks_};
        static_cast<void>(
            region_.full_screen(state, [this, e](const FragmentBatch& in, const Loads& loads, Outputs& out) {
                premultiply(loads.color(1), out.color[0], lanes(in));
                out.traced = true;
                for (std::size_t i = 0; i < lanes(in); ++i) {
                    const float depth = loads.color(0)[e][i];
                    out.alive[i] &= mask(depth != no_entry && is_at(loads, e, i, in.pixel[i]));
                    out.side[i] = Side::front;
                    out.key[i] = depth_as_code(depth, format_);
                }
            }));
    }

    // True if entry e has the sample of this element.
    [[nodiscard]] bool is_at(const Loads& loads, std::size_t e, std::size_t i, std::uint32_t element) const noexcept {
        return !lists_.are_pixels() || (static_cast<std::uint8_t>(loads.color(2)[e][i]) & lists_.bit_of(element)) != 0;
    }

    Region& region_;
    ListElements lists_;
    PixelSet overflow_;
    std::vector<float> pushed_out_;  // per list, the greatest depth composited before the end of the pass
    DepthFormat format_ = region_.frame().key_request().format;
    Target accumulated_ = region_.make_color(), depths_ = lists_.make(Format::rgba32f), masks_{};
    std::array<Target, k> colors_;
};

}  // namespace

void run(Region& region, const ListingInputs& inputs) { KBuffer{region, inputs.options.list_granularity}.run(); }

std::vector<Algorithm> entries() {
    return {
        Algorithm{.name = "k_buffer",
                  .listed = 140,
                  .paper = "Bavoil et al. 2007",
                  .section = "",
                  .summary = "the four nearest fragments so far, sorted as they come; the fifth pushes the nearest out",
                  .pass_formula = "1",
                  .ties = TiePolicy::first,
                  .has_lists = true,
                  .compares_own_codes = true,
                  .geometry_passes = one_pass,
                  .run_with = run,
                  .features = {ordered_rmw, float_targets, fragment_programs, separate_alpha_blend},
                  .render_targets = 6}};
}

}  // namespace strata::peeling::listing::k_buffer
