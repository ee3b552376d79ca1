// tools/strata/report/survey.cpp - watches one run and notes for each fragment the pass that took it, and for each
// pixel the test that rejected most (survey.h).
#include "tools/strata/report/survey.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "peeling/as_shown.h"
#include "peeling/programs/programs.h"
#include "pipeline/frame/trace.h"
#include "pipeline/region/region.h"
#include "tools/oracle/explain/history.h"

namespace strata::tools {

namespace {

using oracle::Fate;
using pipeline::Stage;

constexpr std::size_t fates = static_cast<std::size_t>(Fate::depth_killed) + 1;

class Observing {
  public:
    Observing(const peeling::Algorithm& algorithm, const Columns& columns, const peeling::AsShown& shown)
        : algorithm_{algorithm}, columns_{columns}, shown_{shown}, killed_(columns.first.size() - 1) {
        survey_.taken.assign(columns.fragments.size(), 0);
        keys_.assign(columns.fragments.size(), 0);
        is_known_.assign(columns.fragments.size(), 0);
        keys_left_ = columns.fragments.size();
    }

    void step(const pipeline::StepEvent& event) {
        using pipeline::Step;
        if (!event.is_counted) return;
        if (event.step == Step::geometry || event.step == Step::full_screen) ++pass_;
        is_in_pass_ = false;
    }

    // Counts the lanes that were alive before this stage and are not after it.
    void stage(const pipeline::StageEvent& event) {
        if (!event.is_counted) return;
        is_in_pass_ = true;
        if (!event.is_geometry || event.sample > 0) return;
        if (event.stage == Stage::shaded) {
            before_.fill(1);
            if (keys_left_ > 0) note_keys(event.batch);
        }
        const auto killer = fate_at(event);
        for (std::size_t i = 0; i < static_cast<std::size_t>(event.batch.count); ++i) {
            const bool is_alive = event.alive[i] != 0;
            if (killer != Fate::passed && before_[i] != 0 && !is_alive)
                ++killed_[shown_.pixel(event.batch.pixel[i])][static_cast<std::size_t>(killer)];
            before_[i] = is_alive ? 1 : 0;
        }
    }

    // A step that is recorded after its pass belongs to that pass.
    void traced(const pipeline::TraceEntry& entry) {
        survey_.has_taken = true;
        const int pass = is_in_pass_ ? pass_ : pass_ - 1;
        const auto mark = static_cast<std::uint16_t>((std::clamp(pass, 0, 0x7ffe) + 1) |
                                                     (entry.side == pipeline::Side::back ? far_end : 0));
        const std::uint32_t pixel = shown_.pixel(entry.pixel);
        for (std::uint32_t f = columns_.first[pixel]; f < columns_.first[pixel + 1]; ++f) {
            const pipeline::CapturedFragment& fragment = columns_.fragments[f];
            if (entry.is_fragment ? fragment.primitive == entry.primitive : keys_[f] == entry.key)
                survey_.taken[f] = mark;
        }
    }

    [[nodiscard]] Survey finish() {
        for (const auto& counts : killed_) {
            const auto most = std::max_element(counts.begin(), counts.end());
            survey_.killer.push_back(*most == 0 ? 0 : static_cast<std::uint8_t>(most - counts.begin()));
        }
        return std::move(survey_);
    }

  private:
    // Records each fragment's key in the algorithm's own depth path, which may differ from that of `columns_`.
    void note_keys(const rasterizer::FragmentBatch& batch) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
            const std::uint32_t pixel = shown_.pixel(batch.pixel[i]);
            for (std::uint32_t f = columns_.first[pixel]; f < columns_.first[pixel + 1]; ++f) {
                if (columns_.fragments[f].primitive != batch.primitive[i] || is_known_[f] != 0) continue;
                keys_[f] = algorithm_.key == pipeline::DepthKey::shader_z ? peeling::ordered_code(batch.shader_z[i])
                                                                          : batch.code[i];
                is_known_[f] = 1;
                --keys_left_;
            }
        }
    }

    [[nodiscard]] static Fate fate_at(const pipeline::StageEvent& event) {
        switch (event.stage) {
            case Stage::shaded: return Fate::masked;
            case Stage::program: return Fate::discarded;
            case Stage::alpha_test: return Fate::alpha_killed;
            case Stage::depth_units: return Fate::depth_unit_killed;
            // If both tests are on, the event does not say which one rejected the fragment: it is counted for the depth
            // test.
            case Stage::tests:
                return event.state.stencil.enabled && !event.state.depth.enabled ? Fate::stencil_killed
                                                                                 : Fate::depth_killed;
            case Stage::written: break;
        }
        return Fate::passed;
    }

    const peeling::Algorithm& algorithm_;
    const Columns& columns_;
    const peeling::AsShown shown_;
    std::vector<std::array<std::uint32_t, fates>> killed_;
    std::vector<std::uint32_t> keys_;     // per fragment, as in trace entries
    std::vector<std::uint8_t> is_known_;  // per fragment: 1 if its key is known
    std::size_t keys_left_ = 0;
    std::array<std::uint8_t, rasterizer::batch_capacity> before_{};
    Survey survey_;
    int pass_ = 0;
    bool is_in_pass_ = false;  // true if a batch has come since the last step
};

}  // namespace

Columns columns_of(std::vector<pipeline::CapturedFragment> fragments, std::size_t pixels) {
    Columns columns;
    std::vector<std::uint32_t> order(fragments.size());
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    // Depths are floats in [-1, 1], compared as numbers.
    std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) {
        const auto &x = fragments[a], &y = fragments[b];
        return x.pixel != y.pixel ? x.pixel < y.pixel : x.shader_z < y.shader_z;
    });
    std::vector<std::uint32_t> arrived(pixels), rank(fragments.size());
    for (std::size_t f = 0; f < fragments.size(); ++f) rank[f] = arrived[fragments[f].pixel]++;
    columns.first.push_back(0);
    for (const std::uint32_t count : arrived) columns.first.push_back(columns.first.back() + count);
    for (const std::uint32_t f : order) {
        columns.fragments.push_back(fragments[f]);
        columns.arrival.push_back(rank[f]);
    }
    return columns;
}

Survey survey(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm, const Columns& columns) {
    Observing observing{algorithm, columns, {input.options, input.profile}};
    peeling::FrameRequest everything = input;
    everything.options.effects = pipeline::Effects::all;
    const pipeline::Observer observer{
        .step = [&](const pipeline::Region&, const pipeline::StepEvent& event) { observing.step(event); },
        .stage = [&](const pipeline::Region&, const pipeline::StageEvent& event) { observing.stage(event); },
        .traced = [&](const pipeline::Region&, const pipeline::TraceEntry& entry) { observing.traced(entry); }};
    oracle::observe(everything, algorithm, observer);
    return observing.finish();
}

}  // namespace strata::tools
