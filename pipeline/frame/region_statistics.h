// pipeline/frame/region_statistics.h - what a region writes down while its body runs: all that the executor needs to
// put the frame together.
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
    std::uint64_t own = 0;
    Idle idle = Idle::no;
    bool answer = false;
};

// One loop of a body: its queries, its passes, and what stands around it.
struct LoopStatistics {
    std::vector<Decision> decisions;
    int iterations = 0;
    PassCount passes;  // of the first loop, those before it, too; of the last one, those behind it
};

// Answers to the queries of every loop.
using Answers = std::vector<std::vector<bool>>;

struct KeptLayer {
    Image color, depth;       // of the region's rectangle
    Side side = Side::front;  // from which end the peel took it
};

// How a run came by the fragments that its geometry passes look at, from the slowest way on: the frame is one region,
// and every pass rasterizes; so it does in each tile; passes read what was recorded of the tile; and a whole loop was
// computed from that, without passes.
enum class Path : std::uint8_t { literal, tiled, recorded, resolved };

// Of a region, and why it did not go a faster way: sentences, null where nothing was in the way.
struct PathTaken {
    bool rasterizes = false, reads_record = false, is_resolved = false;
    const char *why_rasterized = nullptr, *why_unresolved = nullptr;

    [[nodiscard]] Path path() const noexcept {
        return rasterizes ? Path::tiled : is_resolved ? Path::resolved : reads_record ? Path::recorded : Path::tiled;
    }
    [[nodiscard]] const char* why() const noexcept { return rasterizes ? why_rasterized : why_unresolved; }
};

// The passes and queries of a run as they were decided, where Instruments ask for them.
struct PassRecord {
    PassState state;
    rasterizer::FragmentNeeds needs;       // what is simulated
    rasterizer::FragmentNeeds called_for;  // what is under Effects::needed
    bool samples_textures = false;
    bool is_opaque_priming = false;
    int iteration = 0;  // 0: before the first
};

struct PassLog {
    std::vector<PassRecord> passes;
    int queries = 0;  // whose answer was asked for
};

struct RegionStatistics {
    Answers script;  // the frame's that are known already; further ones are guessed from the region's own counts
    std::vector<LoopStatistics> loops =
        std::vector<LoopStatistics>(1);  // one, unless the body says that a further one begins
    // The frame's geometry passes before each loop, where a limit counts them; else as many as the region has made.
    std::vector<int> passes_before;
    int iterations = 0;  // of all loops
    Target published;    // what the body leaves: its final colour
    std::vector<KeptLayer> layers;
    std::size_t idle_layers = 0;  // the last ones, kept while idle: empty
    std::vector<Diagnostic> diagnostics;
    PassLog pass_log;
    std::uint64_t fragments_drawn = 0;
    std::uint64_t fragments_processed = 0;  // by programs of geometry passes
    PathTaken taken;
    int geometry_passes = 0;
    bool counts = true;  // false during the emulator's own work (opaque priming, capture)
    Counters counters;   // which only literal execution tells
};

// While it lives the region's work is the emulator's own, and nothing counts it.
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
