// peeling/closed/front_to_back_closed.cpp - front-to-back peeling as a closed form: pass i composites the i-th depth of
// every pixel. It runs by default in place of the passes of peeling/algorithms/front_to_back.cpp, which are its
// definition: it leaves their bits, counters, queries and trace. tests/peeling/execution_test.cpp and
// sequences_test.cpp compare the two.
//
// Declines   where closed_form.h says: then the passes run.
// Ties       the first arrival of a depth is its layer; the others are never seen.
// Counters   pass i discards what lies at or before depth i - 1 (behind a pixel's last layer: at or before the opaque surface), and
//            the depth test passes whatever is nearer than all that came before it and still counts. Fragment f does so in
//            the passes whose threshold lies in [depth of m, depth of f), where m is the farthest of the earlier arrivals that
//            are not behind f: from no depth at all (pass 1) if there is none.
#include <algorithm>

#include "peeling/closed/arrivals.h"
#include "peeling/closed/block_course.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

// The counts of the passes, summed over pixels. Index i is pass i, from 1.
struct PassTallies {
    std::vector<std::uint64_t> first_passed,
        no_longer_passed;                  // fragments that begin, and cease, to pass the depth test there
    std::vector<std::uint64_t> discarded;  // by pixels that have a layer i - 1
    std::vector<std::uint64_t> exhausted;  // discarded from there on by pixels that have none

    void make_room(std::size_t passes) {
        if (exhausted.size() > passes) return;
        for (auto* const tally : {&first_passed, &no_longer_passed, &discarded, &exhausted})
            tally->resize(2 * passes + 1);
    }
};

// Finds the tallies of columns. Untied columns of one height differ only in their order of arrival, so most of their
// counts are made once a height, in `finish`.
class ColumnTallies {
  public:
    explicit ColumnTallies(PassTallies& tallies) : tallies_{tallies} {}

    void add(const ColumnBlock& block) {
        tallies_.make_room(block.height + 2);
        if (columns_.size() <= block.height) columns_.resize(block.height + 1);
        if (thresholds_.size() <= block.height * block_lanes) thresholds_.resize((block.height + 1) * block_lanes);
        before_.resize(block.height * block_lanes);
        find_arrived_before(block, before_.data());
        for (std::size_t lane = 0; lane < static_cast<std::size_t>(block.count); ++lane) {
            if (block.has_ties[lane] != 0) {
                add_tied(block, lane);
                continue;
            }
            const std::uint32_t n = block.visible[lane];
            ++columns_[n];
            tallies_.exhausted[n + 2] += block.at_surface[lane];
        }
        add_untied(block);
    }

    // Adds the counts that all untied columns of n fragments share, whatever their order of arrival.
    void finish() {
        for (std::size_t n = 0; n < columns_.size(); ++n) {
            for (std::size_t k = 1; k <= n; ++k) {
                tallies_.discarded[k + 1] += k * columns_[n];
                tallies_.no_longer_passed[k + 1] += columns_[n];
            }
            tallies_.exhausted[n + 2] += n * columns_[n];
        }
        for (std::size_t i = 0; i < thresholds_.size(); ++i)
            tallies_.first_passed[i / block_lanes + 1] += thresholds_[i];
    }

  private:
    // Without branches, and lane by lane, so that no count waits for the one before it.
    void add_untied(const ColumnBlock& block) {
        LaneWords heights;
        for (std::size_t lane = 0; lane < block_lanes; ++lane)
            heights[lane] = block.has_ties[lane] != 0 ? 0 : block.visible[lane];
        for (std::uint32_t k = 0; k < block.height; ++k)
            for (std::size_t lane = 0; lane < block_lanes; ++lane)
                thresholds_[before_[k * block_lanes + lane] * block_lanes + lane] += k < heights[lane] ? 1 : 0;
    }

    // A column with equal depths, counted fragment by fragment. Its thresholds are depths and not fragments:
    // depth_number_ tells the number of a fragment's depth, from 1.
    void add_tied(const ColumnBlock& block, std::size_t lane) {
        const std::uint32_t n = block.visible[lane];
        depth_number_.resize(n);
        std::uint32_t depths = 0;
        for (std::uint32_t k = 0; k < n; ++k) {
            const bool is_new = k == 0 || block.key(lane, k) != block.key(lane, k - 1);
            if (is_new && k > 0) tallies_.discarded[depths + 1] += k;  // at or before depth `depths`
            depths += is_new ? 1 : 0;
            depth_number_[k] = depths;
        }
        tallies_.discarded[depths + 1] += n;
        tallies_.exhausted[depths + 2] += n + block.at_surface[lane];
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t before = before_[k * block_lanes + lane];
            const std::uint32_t threshold = before > 0 ? depth_number_[before - 1] : 0;
            if (threshold == depth_number_[k]) continue;
            ++tallies_.first_passed[threshold + 1];
            ++tallies_.no_longer_passed[depth_number_[k] + 1];
        }
    }

    PassTallies& tallies_;
    std::vector<std::uint64_t> columns_;  // untied ones, by height
    // Of their fragments: sixteen counts, one a lane, for every number of depths after which so many begin to pass.
    std::vector<std::uint64_t> thresholds_;
    std::vector<std::uint32_t> before_;        // by place in the block
    std::vector<std::uint32_t> depth_number_;  // by place in a column: its depth, from 1
};

void trace_layers(Region& region, const ColumnBlock& block, std::uint32_t most) {
    if (!region.frame().trace) return;
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(block.count); ++lane) {
        const std::uint32_t end = block.visible[lane];
        std::uint32_t layers = 0;
        for (std::uint32_t k = 0; k < end && layers < most; k = block.end_of_depth(lane, k, end), ++layers)
            region.trace({static_cast<std::uint32_t>(block.first + lane), block.key(lane, k), 0, Side::front, false});
    }
}

// Everything that one iteration counts; called with 1, 2, 3 ...
class PassCounters {
  public:
    PassCounters(const Region& region, const RegionFragments& fragments, const PassTallies& tallies)
        : tallies_{tallies},
          fragments_{fragments},
          area_{region.rect().area()},
          color_{bytes_per_pixel(region.frame().color_format)},
          depth_{bytes_per_pixel(target_format(region.frame().key_request().format))} {}

    [[nodiscard]] Counters of(std::size_t pass) {
        passed_ += at(tallies_.first_passed, pass) - at(tallies_.no_longer_passed, pass);
        exhausted_ += at(tallies_.exhausted, pass);
        const std::uint64_t discarded = at(tallies_.discarded, pass) + exhausted_;
        const std::uint64_t arriving = fragments_.rasterized - fragments_.masked - discarded;
        const Counters fates{.fragments_rasterized = fragments_.rasterized,
                             .discarded = discarded,
                             .alpha_killed = fragments_.masked,
                             .blended = passed_};
        const Counters draw = of_loads(depth_, pass > 1 ? fragments_.rasterized : 0) +
                              of_depth_test(depth_, arriving, passed_, true) + of_color(color_, passed_, false);
        const Counters quad = of_loads(color_ + 2 * depth_, area_) + of_color(color_, area_, true);
        return fates + of_clear(color_, area_) + of_copy(depth_, area_) + draw + quad;
    }
    [[nodiscard]] std::uint64_t passed() const noexcept { return passed_; }  // in the latest pass

  private:
    [[nodiscard]] static std::uint64_t bytes_per_pixel(Format format) {
        return static_cast<std::uint64_t>(info(format).bytes_per_pixel);
    }
    [[nodiscard]] static std::uint64_t at(const std::vector<std::uint64_t>& tally, std::size_t i) {
        return i < tally.size() ? tally[i] : 0;
    }

    const PassTallies& tallies_;
    RegionFragments fragments_;
    std::uint64_t area_, color_, depth_;
    std::uint64_t passed_ = 0, exhausted_ = 0;
};

// Goes through the passes as the algorithm does, with the same questions in the same order; only the books are written.
void count_passes(Region& region, const RegionFragments& fragments, const PassTallies& tallies) {
    PassCounters counters{region, fragments, tallies};
    for (std::size_t pass = 1; !region.limit_reached(); ++pass) {
        region.begin_iteration();
        RegionShortcuts{region}.book(counters.of(pass), {.geometry = 1, .full_screen = 1, .copies = 1});
        if (!region.any(RegionShortcuts::query_of(counters.passed()), Idle::when_zero)) break;
    }
}

// One walk over the blocks gives colours and tallies; the counters follow once it is sure that all fragments fitted.
template <class Course>
bool composite_layers(Region& region) {
    PassTallies tallies;
    ColumnTallies columns{tallies};
    const BlockRules rules = block_rules(region.frame(), 0);
    Course course{region, FrontAlpha::lets_through, rules};
    const auto fragments = for_each_block(region, [&](const ColumnBlock& block) {
        columns.add(block);
        course.run(block, peel_front);
        trace_layers(region, block, rules.most_passes);
    });
    if (!fragments) return false;
    columns.finish();
    const auto color = static_cast<std::uint64_t>(info(region.frame().color_format).bytes_per_pixel);
    RegionShortcuts{region}.book(of_clear(color, region.rect().area()), {});  // the accumulated colour's clear
    count_passes(region, *fragments, tallies);
    course.publish();
    return true;
}

}  // namespace

bool front_to_back_closed(Region& region) {
    if (!peels_by_columns(region.frame())) return false;
    return has_float_blocks(region.frame()) ? composite_layers<FloatCourse>(region)
                                            : composite_layers<Rgba8Course>(region);
}

}  // namespace strata::peeling
