// tools/strata/report/report_data.h - collects the contents of a report page: a JSON document, and the blobs that it
// refers to.
//
// Rule     The page has at most `most_bytes`. Contents that exceed it are left out and listed in `left_out`: fragments
//          behind the nearest K of every pixel; whole histories outside a rectangle. Pictures are always complete.
// Tests    tests/tools/strata/report/report_test.cpp
#pragma once
#include <nlohmann/json.hpp>

#include "tools/strata/render/run.h"
#include "tools/strata/report/blobs.h"

namespace strata::tools {

inline constexpr std::size_t most_bytes = std::size_t{8} << 20;

struct ReportData {
    nlohmann::ordered_json document;
    Blobs blobs;
    bool has_run = false;  // at least one algorithm was not refused
};

// The data of the pixels in `region`. Counts and statistics are those of the whole frame.
[[nodiscard]] ReportData report_data(const RunOptions& options, const Session& session, const rasterizer::Rect& region);

}  // namespace strata::tools
