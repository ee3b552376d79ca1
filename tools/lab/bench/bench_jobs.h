// tools/lab/bench/bench_jobs.h - what `strata bench` times: one algorithm in one way of running it, from the scene
// in memory to finished pixels in memory. Loading is outside, and so is whatever compares or writes. A job is timed
// warm: its first frames, which make the process's memory grow, are not counted, as strata_port_beside's are not.
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
    // An effect that --per-effect has simulated once more, to measure it; none in a benchmark.
    pipeline::Effect once_more = pipeline::Effect::none;
    // True: fragment memory 0, whatever the scene's options say.
    bool is_never_replayed = false;
};

// One repetition.
struct BenchRun {
    // Why the profile cannot run the job; empty: it ran.
    std::string refusal;
    // Of the whole run, and of its part from transform to bins.
    double seconds = 0, geometry_seconds = 0;
    int geometry_passes = 0, iterations = 0;
    std::optional<pipeline::Counters> counters{};  // of a run of its own, where they were asked for
    std::uint64_t visited = 0;                     // fragments that programs ran on, in all passes that were no resolve
    pipeline::Image picture;                       // the depths for `depth`
};

struct BenchResult {
    BenchJob job;
    BenchRun last;                                  // without its picture
    std::string digest;                             // of that picture
    std::vector<double> seconds, geometry_seconds;  // one a repetition, in the order in which they ran
    [[nodiscard]] bool is_refused() const noexcept { return !last.refusal.empty(); }
};

[[nodiscard]] std::string algorithm_name(const BenchJob& job);

// Set-up and passes with these options: what a job does between the clock's start and its stop.
[[nodiscard]] peeling::RenderResult run_algorithm(const BenchJob& job, const peeling::RenderOptions& options,
                                                  const pipeline::Instruments& instruments = {});

[[nodiscard]] BenchRun run_once(const BenchJob& job);
// Literal execution's of this job, in a run that is not timed.
[[nodiscard]] std::optional<pipeline::Counters> count(const BenchJob& job);

// Of each job.
struct Repetitions {
    int timed = 5;
    double warm_up = 0.3;   // seconds that it runs before, at least once; 0: not at all
    bool counters = false;  // and once more, to count
};

// Google Benchmark runs every job as often; progress is shown on a terminal.
[[nodiscard]] std::vector<BenchResult> measure(const std::vector<BenchJob>& jobs, const Repetitions& repetitions);

}  // namespace strata::tools
