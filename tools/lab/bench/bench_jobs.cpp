// tools/lab/bench/bench_jobs.cpp - runs each job until its time is known: warm-up frames, then Google Benchmark's
// repetitions; counts one frame's fragments and passes (bench_jobs.h).
#include "tools/lab/bench/bench_jobs.h"

#include <benchmark/benchmark.h>

#include <chrono>

#include "peeling/render.h"
#include "tools/strata/progress.h"

namespace strata::tools {

namespace {

// Collects the times from Google Benchmark, whose own report is not printed.
class TimeCollector : public benchmark::BenchmarkReporter {
  public:
    explicit TimeCollector(std::vector<BenchResult>& results) : results_{results} {}

    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
            // Families are numbered in the order of registration, which is that of the results.
            BenchResult& result = results_[static_cast<std::size_t>(run.family_index)];  // in order of registration
            result.seconds.push_back(run.real_accumulated_time);                         // time of its single iteration
            result.geometry_seconds.push_back(run.counters.at("geometry_seconds").value);
        }
    }

  private:
    std::vector<BenchResult>& results_;
};

// Runs the job until the runs have taken `seconds`; 0: no run. Ends at once if the job is refused.
void warm_up(const BenchJob& job, double seconds) {
    for (double spent = 0; spent < seconds;) {
        const BenchRun run = run_once(job);
        if (!run.refusal.empty()) return;
        spent += run.seconds;
    }
}

// One iteration is one run, timed by run_once(): the benchmark's own clock would include the code around it.
void run_job(benchmark::State& state, BenchResult& result) {
    for ([[maybe_unused]] auto iteration : state) {
        result.last = run_once(result.job);
        if (result.is_refused()) {
            state.SkipWithError(result.last.refusal.c_str());
            break;
        }
        state.SetIterationTime(result.last.seconds);
    }
    state.counters["geometry_seconds"] = result.last.geometry_seconds;
}

[[nodiscard]] peeling::RenderOptions options_of(const BenchJob& job) {
    peeling::RenderOptions options = job.scene->options.render;
    options.execution = job.execution;
    options.effects = job.effects;
    if (job.is_never_replayed) options.fragment_memory = 0;
    options.audit = false;
    options.nearest_depth = false;
    options.simd = job.simd;
    return options;
}

}  // namespace

std::string algorithm_name(const BenchJob& job) { return job.algorithm == nullptr ? "depth" : job.algorithm->name; }

peeling::RenderResult run_algorithm(const BenchJob& job, const peeling::RenderOptions& options,
                                    const pipeline::Instruments& instruments) {
    const Session& session = job.scene->session;
    peeling::Renderer renderer(session.request(options));
    return job.algorithm == nullptr ? renderer.depth_pass({}, instruments)
                                    : renderer.render(*job.algorithm, {}, instruments);
}

BenchRun run_once(const BenchJob& job) {
    const peeling::RenderOptions options = options_of(job);
    const auto start = std::chrono::steady_clock::now();
    peeling::RenderResult result = run_algorithm(job, options, {.once_more = job.once_more});
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;

    BenchRun run;
    if (result.refusal) {
        run.refusal = result.refusal->message(job.scene->session.profile);
        return run;
    }
    run.seconds = taken.count();
    run.geometry_seconds = result.seconds.geometry;
    run.geometry_passes = result.frame.passes.geometry;
    run.visited = result.frame.work.visited;
    run.iterations = result.frame.iterations;
    // A depth pass has no colours; its image is the depths.
    run.picture = std::move(result.frame.color.codes.empty() ? result.frame.depth : result.frame.color);
    return run;
}

std::optional<pipeline::Counters> count(const BenchJob& job) {
    peeling::RenderOptions options = options_of(job);
    options.counters = true;
    return run_algorithm(job, options).frame.counters;
}

std::vector<BenchResult> measure(const std::vector<BenchJob>& jobs, const Repetitions& repetitions) {
    std::vector<BenchResult> results;
    for (const BenchJob& job : jobs)
        results.push_back({.job = job, .last = {}, .digest = {}, .seconds = {}, .geometry_seconds = {}});
    Progress progress("bench");
    const double runs = static_cast<double>(jobs.size()) * repetitions.timed;
    double done = 0;
    benchmark::ClearRegisteredBenchmarks();
    for (BenchResult& result : results) {
        // The repetitions of a job run one after another and are counted by `left`: the first one warms up, the last
        // one takes the digest.
        const auto body = [&result, &progress, &done, runs, &repetitions,
                           left = repetitions.timed](benchmark::State& state) mutable {
            if (left == repetitions.timed) warm_up(result.job, repetitions.warm_up);
            run_job(state, result);
            if (--left == 0)
                result.digest = pipeline::digest(result.last.picture);  // last, because it empties the caches
            // Only one image at a time is in memory.
            result.last.picture = {};
            progress.show(++done / runs);
        };
        benchmark::RegisterBenchmark(algorithm_name(result.job).c_str(), body)
            ->UseManualTime()
            ->Iterations(1)
            ->Repetitions(repetitions.timed);
    }
    TimeCollector collector(results);
    benchmark::RunSpecifiedBenchmarks(&collector, nullptr, ".");
    for (BenchResult& result : results)
        if (repetitions.counters && !result.is_refused()) result.last.counters = count(result.job);
    return results;
}

}  // namespace strata::tools
