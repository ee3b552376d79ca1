// tools/strata/report/report_data.h - everything that a page shows of a scene: a JSON document, and the blobs that it
// points at.
//
// Rule     The page holds at most `most_bytes`. What does not fit is left out, and `left_out` says what: fragments
//          behind the nearest K of every pixel; whole histories outside a rectangle. Pictures are always whole.
// Tests    tests/tools/report_test.cpp
#pragma once
#include <nlohmann/json.hpp>

#include "tools/strata/render/run.h"
#include "tools/strata/report/blobs.h"

namespace strata::tools {

inline constexpr std::size_t most_bytes = std::size_t{8} << 20;

struct ReportData {
    nlohmann::ordered_json document;
    Blobs blobs;
    bool has_run = false;  // at least one algorithm did
};

// Of these pixels of the frame. Counts and statistics are the whole frame's.
[[nodiscard]] ReportData report_data(const RunOptions& options, const Session& session, const rasterizer::Rect& region);

}  // namespace strata::tools
