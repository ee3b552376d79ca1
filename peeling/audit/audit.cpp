// peeling/audit/audit.cpp - schedules which parts of a frame are audited when, and with how much memory (audit.h).
#include "peeling/audit/audit.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "peeling/audit/image_error.h"
#include "peeling/audit/pixel_audit.h"
#include "peeling/programs/fragment_lists.h"
#include "pipeline/fragments/tile_parts.h"
#include "pipeline/frame/effects.h"
#include "pipeline/region/region.h"
#include "pipeline/region/region_scratch.h"
#include "pipeline/region/region_shortcuts.h"
#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/input_error.h"
#include "rasterizer/base/parallel.h"

namespace strata::peeling {

using namespace pipeline;
using rasterizer::Rect;

namespace in_parts {

// A region, or some rows of it, or part of a row: of all samples, or of one.
struct AuditPart : RegionArea {
    std::optional<std::size_t> sample{};
};

// The results for some parts of the frame, and the parts that did not fit into the memory.
struct Looked {
    AuditResult found;
    std::vector<AuditPart> left;
    void add(Looked&& other) {
        merge(found, other.found);
        left.insert(left.end(), other.left.begin(), other.left.end());
    }
};

}  // namespace in_parts

using namespace in_parts;

namespace {

// A count of 0 has no first pixel to move.
void move(PixelCount& count, int dx, int dy) {
    if (count.pixels == 0) return;
    count.first_x += dx;
    count.first_y += dy;
}

// The requested sum is what this pixel's fragment lists need, doubled because traces have the other half.
[[noreturn]] void throw_too_deep(const AuditPart& pixel, std::uint32_t fragments, std::uint64_t bytes) {
    const std::uint64_t list_bytes = fragments * AuditMemory::bytes_per_fragment * 2;
    const std::uint64_t needed = list_bytes > bytes ? list_bytes : 2 * bytes;  // the length of the trace is not known
    throw InputError("audit", "--fragment-memory",
                     "at least " + std::to_string(needed) + " bytes for the audit of pixel (" +
                         std::to_string(pixel.rect.x0) + ", " + std::to_string(pixel.rect.y0) + "), which has " +
                         std::to_string(fragments) + " fragments, or --no-audit",
                     std::to_string(bytes));
}

// The picture of a sample, whose pixels the audit compares.
const Image& picture_of(const FrameResult& result, std::size_t sample) {
    return result.samples.empty() ? result.color : result.samples[sample];
}

}  // namespace

struct Audit::Impl {
    const Frame& frame;
    const Body& body;
    const Algorithm& algorithm;
    std::uint64_t bytes;
    AuditMemory shared, alone;  // for one of all workers, and for a worker that runs alone
    int threads;
    Frame still;               // the frame without passes and trace, for reading its fragments
    RegionScratchPool pool{};  // scratch memory for `still`; the fragment lists below as well
    std::mutex free_lists_mutex{};
    std::vector<FragmentLists> free_fragment_lists{};
    std::vector<RegionArea> places{};  // the regions; the tiles of a frame that is one region
    std::vector<Looked> found_at{};    // indexed as `places`

    Impl(const Frame& f, const Body& b, const Algorithm& a, std::uint64_t memory, int t)
        : frame{f},
          body{b},
          algorithm{a},
          bytes{memory},
          shared{bytes, thread_count(t)},
          alone{bytes, 1},
          threads{t},
          still{f} {
        still.replay = {};
        still.trace = false;
    }

    // Called when the frame begins, and again if it is repeated as a whole: earlier results are discarded.
    void begin(std::span<const RegionArea> regions) {
        places.assign(regions.begin(), regions.end());
        if (places[0].extent == Extent::frame) places = tile_parts(still, threads);
        found_at.assign(places.size(), {});
    }

    [[nodiscard]] bool has_order() const { return algorithm.ties != TiePolicy::none; }
    [[nodiscard]] AuditedPixel pixel_at(const Region& region, std::uint32_t element, const FrameResult& result,
                                        std::uint32_t at_opaque) const {
        const auto width = static_cast<std::uint32_t>(region.rect().width()),
                   area = static_cast<std::uint32_t>(region.rect().area());
        const std::uint32_t pixel = element % area;
        AuditedPixel at{.x = region.rect().x0 + static_cast<int>(pixel % width),
                        .y = region.rect().y0 + static_cast<int>(pixel / width),
                        .sample = element / area,
                        .background = region.targets().color(region.opaque_color(), element),
                        .at_opaque = at_opaque};
        const Image& color = picture_of(result, at.sample);
        for (int c = 0; c < 4; ++c)
            at.shown[static_cast<std::size_t>(c)] =
                channel_value(color, at.x - frame.rect().x0, at.y - frame.rect().y0, c);
        return at;
    }

    // Audits all pixels of a part whose fragments fit, range by range.
    [[nodiscard]] Looked look_at(const AuditPart& part, const PixelTraces* traces, const FrameResult& result,
                                 const AuditMemory& memory) {
        RegionStatistics statistics;
        Region region{still, part, statistics, {}, &pool};
        const std::vector<std::uint32_t> coverage = coverage_of(region);
        PixelAudit pixels{frame, algorithm};
        Looked looked;
        FragmentLists fragment_lists = take_fragment_lists();
        const std::size_t area = part.rect.area(), first = part.sample.value_or(0) * area,
                          last = part.sample ? first + area : coverage.size();
        PixelRange range{0, static_cast<std::uint32_t>(first)};
        while (range.last < last) {
            range = next_range(std::span{coverage}.first(last), part.rect.width(), range.last, memory.fragments());
            if (coverage[range.first] > memory.fragments()) {
                const auto pixel = static_cast<std::uint32_t>(range.first % area);
                looked.left.push_back(
                    {{rect_of({pixel, pixel + 1}, part.rect), part.tile, Extent::tile}, range.first / area});
                continue;
            }
            list_visible(region, range, coverage, Counting::silent, fragment_lists);
            for (std::uint32_t p = range.first; p < range.last; ++p)
                pixels.look_at(fragment_lists.of(p), traces,
                               pixel_at(region, p, result, fragment_lists.at_opaque[p - range.first]));
        }
        looked.found = pixels.found();
        const std::scoped_lock lock{free_lists_mutex};
        free_fragment_lists.push_back(std::move(fragment_lists));
        return looked;
    }

    // Returns a free FragmentLists or a new one. They are kept for reuse, so that memory is seldom allocated.
    [[nodiscard]] FragmentLists take_fragment_lists() {
        const std::scoped_lock lock{free_lists_mutex};
        if (free_fragment_lists.empty()) return {};
        FragmentLists fragment_lists = std::move(free_fragment_lists.back());
        free_fragment_lists.pop_back();
        return fragment_lists;
    }

    // Called when a region has ended: a tile, or the whole frame, which is audited tile by tile.
    void look_at(Region& region, std::size_t number, const FrameResult& result) {
        // An algorithm without an order has no trace and needs none. An incomplete trace of one with an order is
        // useless, and finish() runs the tile again.
        const bool is_traced = !has_order() || RegionShortcuts{region}.trace().is_complete();
        std::optional<PixelTraces> traces;
        if (has_order() && is_traced) traces.emplace(RegionShortcuts{region}.trace(), region.rect(), region.elements());
        const auto look_at_place = [&](std::size_t place) {
            const AuditPart part{places[place]};
            found_at[place] =
                is_traced ? look_at(part, traces ? &*traces : nullptr, result, shared) : Looked{{}, {part}};
        };
        // Each region has its own element of `found_at`, so workers need no lock.
        if (region.rect() == places[number].rect) return look_at_place(number);
        parallel_for(places.size(), threads, look_at_place);
    }

    // A tile whose result the executor copied from tile `like` gets the audit results of that tile, moved to its own
    // position.
    void copy(std::size_t like, std::size_t number) {
        const RegionArea &from = places[like], &to = places[number];
        const int dx = to.rect.x0 - from.rect.x0, dy = to.rect.y0 - from.rect.y0;
        Looked& there = found_at[number] = found_at[like];
        move(there.found.ties, dx, dy);
        move(there.found.misordered, dx, dy);
        move(there.found.opaque_ties, dx, dy);
        for (AuditPart& part : there.left) {
            const auto [x0, y0, x1, y1] = part.rect;
            part = {{{x0 + dx, y0 + dy, x1 + dx, y1 + dy}, to.tile, to.extent}, part.sample};
        }
    }

    // Runs a part again, split into as many parts as the memory requires. Single pixels that do not fit are returned.
    // Parts are taken from the end of `open`, so that at most the halves of one descent are waiting at a time.
    [[nodiscard]] Looked run_again(const AuditPart& part, const FrameResult& result, const AuditMemory& memory,
                                   RegionScratchPool& scratch) {
        Frame again = frame;
        again.trace = has_order();
        again.trace_bytes = memory.trace_bytes();
        // Only the trace is needed; the frame has already stored the user's other results.
        again.keep_layers = again.nearest_depth = false;
        Looked looked;
        std::vector<AuditPart> open{part};
        while (!open.empty()) {
            const AuditPart next = open.back();
            open.pop_back();
            RegionStatistics statistics;
            // The queries return the frame's answers: a part by itself might get other answers and end earlier.
            statistics.script = result.answers;
            Region region{again, next, statistics, {}, &scratch};
            const bool fits = run_traced(region);
            if (fits) {
                std::optional<PixelTraces> traces;
                if (has_order()) traces.emplace(RegionShortcuts{region}.trace(), next.rect, region.elements());
                looked.add(look_at(next, traces ? &*traces : nullptr, result, memory));
            } else if (next.rect.area() == 1) {
                looked.left.push_back(next);
            } else {
                for (const Rect& half : halves(next.rect))
                    open.push_back({{half, next.tile, next.extent}, next.sample});
            }
        }
        return looked;
    }

    // False if the trace does not fit; if the coverage already shows that, nothing is run.
    [[nodiscard]] bool run_traced(Region& region) {
        if (!has_order()) return true;
        std::uint64_t fragments = 0;
        for (const std::uint32_t of_pixel : coverage_of(region)) fragments += of_pixel;
        // The trace is estimated as one entry per fragment; a single pixel is run whatever the estimate.
        if (region.rect().area() > 1 && fragments * sizeof(TraceEntry) > region.frame().trace_bytes) return false;
        body(region);
        return RegionShortcuts{region}.trace().is_complete();
    }

    [[nodiscard]] Looked run_all_again(const std::vector<AuditPart>& parts, const FrameResult& result,
                                       const AuditMemory& memory) {
        RegionScratchPool scratch;
        std::vector<Looked> looked(parts.size());
        parallel_for(parts.size(), memory.workers,
                     [&](std::size_t i) { looked[i] = run_again(parts[i], result, memory, scratch); });
        Looked all;
        for (Looked& one : looked) all.add(std::move(one));
        return all;
    }

    // A part that is left is one pixel.
    [[noreturn]] void throw_too_large(const AuditPart& left) {
        RegionStatistics statistics;
        Region region{still, left, statistics, {}, &pool};
        throw_too_deep(left, std::ranges::max(coverage_of(region)), bytes);
    }

    [[nodiscard]] AuditResult finish(const FrameResult& result) {
        Looked all;
        for (Looked& looked : found_at) all.add(std::move(looked));
        try {
            // First all workers with their shares, then one worker after another with all of the memory for the
            // remaining parts.
            for (const AuditMemory& memory : {shared, alone})
                all.add(run_all_again(std::exchange(all.left, {}), result, memory));
        } catch (const NeedsFrame&) {
            throw InputError(
                "audit", "--fragment-memory",
                "more memory for the trace of the whole frame (its lookups read beyond their tiles), or --no-audit",
                std::to_string(bytes));
        }
        if (!all.left.empty()) throw_too_large(all.left.front());
        // A frame without pixels has 0 order errors rather than "no order".
        if (has_order() && !all.found.order_errors) all.found.order_errors = 0;
        return all.found;
    }
};

Audit::Audit(const Frame& frame, const Body& body, const Algorithm& algorithm, std::uint64_t bytes, int threads)
    : impl_{std::make_unique<Impl>(frame, body, algorithm, bytes, threads)} {}

Audit::~Audit() = default;

RegionCallbacks Audit::callbacks() {
    return {.begun = [this](std::span<const RegionArea> regions) { impl_->begin(regions); },
            .ended = [this](Region& region, std::size_t number,
                            const FrameResult& result) { impl_->look_at(region, number, result); },
            .alike = [this](std::size_t like, std::size_t region) { impl_->copy(like, region); }};
}

AuditResult Audit::finish(const FrameResult& result) {
    const FloatEnvironment ours;
    return impl_->finish(result);
}

}  // namespace strata::peeling
