#include "pipeline/frame/region_books.h"

namespace strata::pipeline {

// A body may go on after the frame's answer was no. Its work then still belongs to the iteration of that answer.
void RegionBooks::join_tail() {
    const auto last = static_cast<std::size_t>(iterations);
    if (records.size() <= last + 1) return;
    records[last].counters += records.back().counters;
    records[last].passes += records.back().passes;
    records.pop_back();
}

void RegionBooks::begin_iteration() {
    join_tail();
    counted_record = records.size();
    records.emplace_back();
    ++iterations;
    ++loops.back().iterations;
}

void RegionBooks::end_iterations() {
    join_tail();
    counted_record = records.size();
    records.emplace_back();
}

}  // namespace strata::pipeline
