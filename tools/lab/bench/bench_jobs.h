// tools/lab/bench/bench_jobs.h - the jobs of `strata bench`: one algorithm in one way of running it, from the scene in
// memory to finished pixels in memory. Loading, comparing and writing are not timed. A job is timed warm: its first
// frames, during which the process allocates memory, are not counted, as in strata_port_beside.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "pipeline/formats/image.h"
#include "pipeline/frame/counters.h"
#include "pipeline/frame/instruments.h"
#include "tools/strata/render/run.h"

namespace strata::peeling {
struct RenderResult;
}

namespace strata::tools {

// A scene that is loaded once for all its jobs.
struct BenchScene {
    RunOptions options;
    Session session;
};

struct BenchJob {
    const BenchScene* scene = nullptr;
    // Null: the job `depth`, one opaque depth pass.
    const peeling::Algorithm* algorithm = nullptr;
    pipeline::Execution execution = pipeline::Execution::replay;
    Simd simd = Simd::scalar;
    pipeline::Effects effects = pipeline::Effects::needed;
    // An effect that --per-effect simulates once more to measure it; none in a benchmark.
    pipeline::Effect once_more = pipeline::Effect::none;
    // True: fragment memory 0, whatever the scene's options say.
    bool is_never_replayed = false;
};

// One repetition.
struct BenchRun {
    // Why the profile cannot run the job; empty if it ran.
    std::string refusal;
    // Of the whole run, and of its part from the transform to the bins.
    double seconds = 0, geometry_seconds = 0;
    int geometry_passes = 0, iterations = 0;
    std::optional<pipeline::Counters> counters{};  // from a separate run, if requested
    std::uint64_t visited = 0;                     // fragments for which programs ran, in all passes except resolves
    pipeline::Image picture;                       // the depths for the job `depth`
};

struct BenchResult {
    BenchJob job;
    BenchRun last;                                  // without its image
    std::string digest;                             // of the last run's image
    std::vector<double> seconds, geometry_seconds;  // one per repetition, in order
    [[nodiscard]] bool is_refused() const noexcept { return !last.refusal.empty(); }
};

[[nodiscard]] std::string algorithm_name(const BenchJob& job);

// Set-up and passes with these options: the part of a job that is timed.
[[nodiscard]] peeling::RenderResult run_algorithm(const BenchJob& job, const peeling::RenderOptions& options,
                                                  const pipeline::Instruments& instruments = {});

[[nodiscard]] BenchRun run_once(const BenchJob& job);
// The counters of the job's literal execution, in a run that is not timed.
[[nodiscard]] std::optional<pipeline::Counters> count(const BenchJob& job);

// The runs of each job.
struct Repetitions {
    int timed = 5;
    double warm_up = 0.3;   // seconds of warm-up runs, at least one run; 0: none
    bool counters = false;  // also make a run with counters
};

// Google Benchmark runs every job the same number of times; progress is shown on a terminal.
[[nodiscard]] std::vector<BenchResult> measure(const std::vector<BenchJob>& jobs, const Repetitions& repetitions);

}  // namespace strata::tools
