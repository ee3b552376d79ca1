// tools/strata/render/stats.h - the statistics of a command: one JSON object per algorithm. Every key is always
// present. Source: scenes/reference/reports.md 1. Tests: tests/tools/strata/render/stats_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "peeling/render.h"
#include "tools/request/picture_request.h"

namespace strata::tools {

// The result of one algorithm without its pixels.
struct RunSummary {
    const peeling::Algorithm* algorithm = nullptr;
    peeling::RenderResult result;  // frame.color, depth and layers may be moved out
    std::string color_digest, depth_digest;
};

// What all algorithms of a command share.
struct RunContext {
    std::string profile;
    const PictureRequest& request;
    double total_seconds = 0;  // seconds since the start of the process
};

// One row. A refused algorithm has empty digests, zero counts and its reason in "refusal", which is null otherwise.
[[nodiscard]] nlohmann::ordered_json to_row(const RunSummary& run, const RunContext& context);

// A sentence that says how the fragments were obtained, and why a faster path was not used.
[[nodiscard]] std::string path_text(const RunSummary& run);

// The document of --stats (scenes/reference/reports.md 1), with its newline.
[[nodiscard]] std::string to_json(const std::vector<RunSummary>& runs, const RunContext& context);

// A table for the terminal, with the diagnostics and refusals below it.
[[nodiscard]] std::string to_table(const std::vector<RunSummary>& runs, const RunContext& context);

}  // namespace strata::tools
