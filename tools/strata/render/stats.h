// tools/strata/render/stats.h - what a run says about itself: a JSON object an algorithm. Every key is always present.
// Source: reports.md 1. Tests: tests/tools/stats_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "peeling/render.h"
#include "rasterizer/base/simd.h"

namespace strata::tools {

// One algorithm's run without its pixels.
struct RunSummary {
    const peeling::Algorithm* algorithm = nullptr;
    peeling::RenderResult result;  // frame.color, depth and layers may be gone
    std::string color_digest, depth_digest;
};

// Settings that all runs of a command share.
struct RunContext {
    std::string profile;
    int width = 0, height = 0;
    pipeline::Execution execution = pipeline::Execution::replay;
    Simd simd = Simd::best;  // as asked for: rows do not name the machine
    std::uint64_t fragment_memory = 0;
    bool audited = true;       // false: whatever comes from the audit is null
    double total_seconds = 0;  // of the process
};

// A refused run has empty digests, zeros for counts, and says why in "refusal", which is null for every other run.
[[nodiscard]] nlohmann::ordered_json to_row(const RunSummary& run, const RunContext& context);

// How a run came by its fragments, and why not by a faster way.
[[nodiscard]] std::string path_sentence(const RunSummary& run);

// The document of --stats (reports.md 1), with its newline.
[[nodiscard]] std::string to_json(const std::vector<RunSummary>& runs, const RunContext& context);

// A table for people, with the diagnostics and refusals below it.
[[nodiscard]] std::string to_table(const std::vector<RunSummary>& runs, const RunContext& context);

}  // namespace strata::tools
