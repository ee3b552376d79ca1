// tests/pipeline/region/both_ways.h - runs one body literally, which never selects a fragment and never walks a row,
// and by tiles. Returns for each the codes in all of its targets, its diagnostics, or the message with which it was
// rejected.
#pragma once
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "pipeline/device/check.h"
#include "tests/pipeline/frames.h"

namespace strata::testing {

struct RunResult {
    std::vector<std::uint32_t> codes;  // of the whole frame, ordered by target, channel and sample
    std::vector<pipeline::Diagnostic> diagnostics;
    std::uint64_t visited = 0;
    std::string refusal;
};

// Copies the codes of a region's targets to their positions in the frame.
inline void collect(pipeline::Region& region, std::vector<std::uint32_t>& codes) {
    const auto& whole = region.frame().rect();
    const auto& own = region.rect();
    std::size_t plane = 0;
    for (int t = 0; t < region.targets().count(); ++t) {
        const pipeline::TargetStorage& storage = region.storage({t});
        for (int channel = 0; channel < std::max(1, info(storage.format()).channels); ++channel)
            for (int sample = 0; sample < storage.samples(); ++sample, ++plane) {
                codes.resize(std::max(codes.size(), (plane + 1) * whole.area()));
                for (std::size_t p = 0; p < own.area(); ++p) {
                    const std::size_t x = static_cast<std::size_t>(own.x0) + p % static_cast<std::size_t>(own.width());
                    const std::size_t y = static_cast<std::size_t>(own.y0) + p / static_cast<std::size_t>(own.width());
                    codes[plane * whole.area() + y * static_cast<std::size_t>(whole.width()) + x] =
                        storage.code(p, channel, sample);
                }
            }
    }
}

[[nodiscard]] inline RunResult run_one_way(const pipeline::Frame& frame, const pipeline::Body& body,
                                           pipeline::Execution execution, const pipeline::Instruments& instruments) {
    RunResult left;
    pipeline::RegionCallbacks callbacks;
    callbacks.ended = [&](pipeline::Region& region, std::size_t, const pipeline::FrameResult&) {
        collect(region, left.codes);
    };
    try {
        const pipeline::FrameResult result = run(frame, body, execution, 1, {}, instruments, callbacks);
        left.diagnostics = result.diagnostics;
        left.visited = result.work.visited;
    } catch (const pipeline::Refused& refused) {
        left.refusal = refused.what();
    } catch (const std::logic_error& broken) {
        left.refusal = broken.what();
    }
    return left;
}

// Name of the first result in which tiled execution differs from literal execution; empty if there is none.
[[nodiscard]] inline std::string difference_of(const RunResult& literal, const RunResult& tiled) {
    if (literal.refusal != tiled.refusal) return "'" + literal.refusal + "' against '" + tiled.refusal + "'";
    if (!literal.refusal.empty()) return {};
    if (literal.codes != tiled.codes) return "codes";
    if (!(literal.diagnostics == tiled.diagnostics)) return "diagnostics";
    return {};
}

}  // namespace strata::testing
