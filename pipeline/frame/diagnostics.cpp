// pipeline/frame/diagnostics.cpp - merges diagnostics of regions into those of the frame (diagnostics.h).
#include "pipeline/frame/diagnostics.h"

#include <algorithm>
#include <tuple>

namespace strata::pipeline {

void merge(std::vector<Diagnostic>& all, const Diagnostic& one) {
    const auto same = std::find_if(all.begin(), all.end(),
                                   [&](const Diagnostic& d) { return d.fault == one.fault && d.detail == one.detail; });
    if (same == all.end()) {
        const auto later = std::find_if(all.begin(), all.end(), [&](const Diagnostic& d) {
            return std::tie(d.fault, d.detail) > std::tie(one.fault, one.detail);
        });
        all.insert(later, one);
        return;
    }
    same->pixels += one.pixels;
    if (std::tie(one.first_y, one.first_x) < std::tie(same->first_y, same->first_x)) {
        same->first_x = one.first_x;
        same->first_y = one.first_y;
    }
}

}  // namespace strata::pipeline
