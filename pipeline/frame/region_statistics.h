// pipeline/frame/region_statistics.h - what a region (a tile, or the whole frame in literal execution) records while
// the algorithm's body runs on it: everything that the executor needs to assemble the frame.
//
// Rule     `script` and `passes_before` come from the executor, everything else from the region.
// Tests    tests/pipeline/region/executor_test.cpp
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "pipeline/formats/image.h"
#include "pipeline/frame/counters.h"
#include "pipeline/frame/diagnostics.h"
#include "pipeline/frame/pass.h"

namespace strata::pipeline {

struct Decision {
    std::uint64_t own = 0;  // fragments that this region counted
    Idle idle = Idle::no;   // the query's promise (execution.md 4.2)
    bool answer = false;
};

// One loop of an algorithm's body: the decisions of its queries, and its passes.
struct LoopStatistics {
    std::vector<Decision> decisions;
    int iterations = 0;
    PassCount passes;  // the first loop includes the passes before it, the last one those after it
};

// The answers to the queries of every loop.
using Answers = std::vector<std::vector<bool>>;

struct PeeledLayer {
    Image color, depth;       // of the region's rectangle
    Side side = Side::front;  // the end from which the peel took it
};

// How a run obtained the fragments of its geometry passes, from the slowest path to the fastest. literal: the frame is
// one region, and every pass rasterizes. tiled: every pass rasterizes in each tile. recorded: passes read the tile's
// record. resolved: a whole loop was computed from the record, without passes.
enum class Path : std::uint8_t { literal, tiled, recorded, resolved };

// The path of a region other than literal. why() is the reason, as text, why it did not take a faster one; null if it
// took the fastest.
struct PathTaken {
    bool rasterizes = false, reads_record = false, is_resolved = false;
    const char *why_rasterized = nullptr, *why_unresolved = nullptr;

    [[nodiscard]] Path path() const noexcept {
        return rasterizes ? Path::tiled : is_resolved ? Path::resolved : reads_record ? Path::recorded : Path::tiled;
    }
    [[nodiscard]] const char* why() const noexcept { return rasterizes ? why_rasterized : why_unresolved; }
};

// The state of every pass of a run and the number of its queries, if Instruments::log_passes requests them.
struct PassRecord {
    PassState state;
    rasterizer::FragmentNeeds needs;       // the values that this run computes
    rasterizer::FragmentNeeds called_for;  // those that it would compute under Effects::needed
    bool samples_textures = false;
    bool is_opaque_priming = false;
    int iteration = 0;  // 0: before the first
};

struct PassLog {
    std::vector<PassRecord> passes;
    int queries = 0;  // number of queries whose answer was requested
};

struct RegionStatistics {
    Answers script;  // input: the query results that are known for the whole frame; later queries are
                     // answered from the region's own count
    std::vector<LoopStatistics> loops = std::vector<LoopStatistics>(1);  // one, unless the body begins further ones
    // The frame's geometry passes before each loop, if a limit counts them; otherwise those of the region.
    std::vector<int> passes_before;
    int iterations = 0;  // of all loops
    Target published;    // the final colour of the body
    std::vector<PeeledLayer> layers;
    std::size_t idle_layers =
        0;  // number of last entries of `layers` that were kept after the loop became idle; they are empty
    std::vector<Diagnostic> diagnostics;
    PassLog pass_log;
    std::uint64_t fragments_drawn = 0;
    std::uint64_t fragments_processed = 0;  // by programs of geometry passes
    PathTaken taken;
    int geometry_passes = 0;
    bool counts = true;  // false during the emulator's own work (opaque priming, capture)
    Counters counters;   // only from literal execution
};

// While it exists, the region's work is the emulator's own and is not counted.
class UncountedWork {
  public:
    explicit UncountedWork(RegionStatistics& statistics) noexcept
        : statistics_{statistics}, before_{std::exchange(statistics.counts, false)} {}
    UncountedWork(const UncountedWork&) = delete;
    UncountedWork& operator=(const UncountedWork&) = delete;
    ~UncountedWork() { statistics_.counts = before_; }

  private:
    RegionStatistics& statistics_;
    bool before_;
};

}  // namespace strata::pipeline
