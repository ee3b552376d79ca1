// tools/lab/bench/bench_report.cpp - the times of jobs as a table and as JSON, and the ratio of two jobs if their runs
// do not overlap (bench_report.h).
#include "tools/lab/bench/bench_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "rasterizer/base/input_error.h"
#include "scenes/files/text_file.h"
#include "tools/request/choices.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

using nlohmann::ordered_json;

// As given, without its folder.
std::string scene_name(const BenchJob& job) {
    const std::string& scene = job.scene->options.scene;
    return scenes::is_procedural(scene) ? scene : std::filesystem::path(scene).filename().string();
}

// The keys that identify a job; jobs of two runs are compared if all of them agree.
ordered_json words_of(const BenchJob& job) {
    const peeling::RenderOptions& render = job.scene->options.render;
    return {{"scene", scene_name(job)},
            {"algorithm", algorithm_name(job)},
            {"execution", name_of(executions, job.execution)},
            {"simd", name_of(simds, job.simd)},
            {"effects", name_of(effects, job.effects)},
            {"threads", render.threads},
            {"fragment_memory", render.fragment_memory},
            {"size", fmt::format("{}x{}", render.width, render.height)},
            {"profile", job.scene->session.profile.name}};
}

// One line that is unique for a job; a baseline is looked up by it. The memory is omitted if it is the default.
std::string name_of_words(const ordered_json& words) {
    const std::uint64_t memory = words.at("fragment_memory");
    std::string name;
    for (const char* key : {"scene", "algorithm", "execution", "simd", "effects", "size", "profile"})
        name += words.at(key).get<std::string>() + ' ';
    name += fmt::format("threads={}", words.at("threads").get<int>());
    return memory == peeling::RenderOptions{}.fragment_memory ? name
                                                              : name + fmt::format(" fragment_memory={}", memory);
}

std::string name_of_job(const BenchJob& job) { return name_of_words(words_of(job)); }

// The passes' fragments in literal execution, which is the same work for every way of running. 0 if they were not
// counted.
double fragments(const BenchResult& r) {
    return r.last.counters ? static_cast<double>(r.last.counters->fragments_rasterized) : 0;
}

double bytes_per_fragment(const BenchResult& r) {
    const pipeline::Counters counters = r.last.counters.value_or(pipeline::Counters{});
    return static_cast<double>(counters.bytes_read + counters.bytes_written) / fragments(r);
}

// A value per fragment, or null and "-" if fragments were not counted.
ordered_json per_fragment(const BenchResult& r, double value) {
    return fragments(r) > 0 ? ordered_json(value) : ordered_json(nullptr);
}
std::string per_fragment(const BenchResult& r, double value, int digits) {
    return fragments(r) > 0 ? fmt::format("{:.{}f}", value, digits) : "-";
}

// The keys of a job as scenes/reference/reports.md 2 lists them, in that order.
ordered_json to_json(const BenchResult& result, const Baseline& baseline) {
    const Spread spread = spread_of(result.seconds);
    ordered_json job = words_of(result.job);
    job["geometry_passes"] = result.last.geometry_passes;
    job["fragments"] =
        result.last.counters ? ordered_json(result.last.counters->fragments_rasterized) : ordered_json(nullptr);
    job["visited"] = result.last.visited;
    job["seconds"] = {
        {"median", spread.median}, {"min", spread.least}, {"max", spread.greatest}, {"all", result.seconds}};
    // The part from the transform to the bins.
    job["geometry_seconds"] = spread_of(result.geometry_seconds).median;
    job["fragments_per_second"] =
        result.last.counters ? ordered_json(fragments(result) / spread.median) : ordered_json(nullptr);
    job["ns_per_fragment_pass"] = per_fragment(result, spread.median * 1e9 / fragments(result));
    job["bytes_per_fragment"] = per_fragment(result, bytes_per_fragment(result));
    job["digest"] = result.digest;
    if (const auto old = baseline.find(name_of_job(result.job)); old != baseline.end())
        job["ratio"] = old->second.median / spread.median;
    else
        job["ratio"] = nullptr;
    return job;
}

// The row of to_table(): milliseconds, millions of fragments per second, nanoseconds and bytes per fragment.
std::vector<std::string> cells(const BenchResult& result) {
    const BenchJob& job = result.job;
    const Spread spread = spread_of(result.seconds);
    return {scene_name(job),
            algorithm_name(job),
            name_of(executions, job.execution),
            name_of(simds, job.simd),
            name_of(effects, job.effects),
            fmt::format("{}", result.last.geometry_passes),
            result.last.counters ? fmt::format("{}", result.last.counters->fragments_rasterized) : "-",
            fmt::format("{:.2f}", spread.median * 1e3),
            fmt::format("{:.2f}..{:.2f}", spread.least * 1e3, spread.greatest * 1e3),
            fmt::format("{:.2f}", spread_of(result.geometry_seconds).median * 1e3),
            per_fragment(result, fragments(result) / spread.median / 1e6, 1),
            per_fragment(result, spread.median * 1e9 / fragments(result), 2),
            per_fragment(result, bytes_per_fragment(result), 1)};
}

// The quotient of two medians, or a note that the runs overlap and the quotient means nothing.
std::string ratio(const Spread& a, const Spread& b) {
    return is_apart(a, b) ? fmt::format("{:.2f}", a.median / b.median) : "noise";
}

// An explanation of the word "noise", if the table contains it.
std::string about_noise(const Table& table) {
    for (const auto& row : table.rows)
        if (row.back().find("noise") != std::string::npos)
            return "noise: fewer than four runs, or some run of the one takes as long as some run of the other\n";
    return "";
}

// Parses `seconds` of a job in a document of --json.
Spread spread_in(const ordered_json& seconds) {
    return {seconds.at("median"), seconds.at("min"), seconds.at("max"), seconds.at("all").size()};
}

// One row per scene, algorithm, instruction set and effects; one column of milliseconds per execution, then the ratio
// of each to replay.
std::string side_by_side(const std::vector<BenchResult>& results) {
    std::map<std::string, std::map<pipeline::Execution, Spread>> rows;
    std::vector<std::string> order;
    std::set<pipeline::Execution> used;
    for (const BenchResult& r : results) {
        if (r.is_refused()) continue;
        const std::string name = fmt::format("{} {} {} {}", scene_name(r.job), algorithm_name(r.job),
                                             name_of(simds, r.job.simd), name_of(effects, r.job.effects));
        if (!rows.contains(name)) order.push_back(name);
        rows[name][r.job.execution] = spread_of(r.seconds);
        used.insert(r.job.execution);
    }
    // With a single execution there is nothing to compare.
    if (used.size() < 2) return "";
    Table table{{{"ms"}}, {}};
    for (const auto execution : used) table.columns.push_back({name_of(executions, execution), Align::right});
    table.columns.push_back({"ratio", Align::right});
    for (const std::string& name : order) {
        std::vector<std::string> row{name}, ratios;
        // The executions are in the order of their enum, in which replay is last.
        const Spread last = rows[name][*used.rbegin()];
        for (const auto execution : used) {
            const Spread& own = rows[name][execution];
            row.push_back(fmt::format("{:.2f}", own.median * 1e3));
            ratios.push_back(execution == *used.rbegin() ? "1" : ratio(own, last));
        }
        row.push_back(fmt::format("{}", fmt::join(ratios, " : ")));
        table.rows.push_back(row);
    }
    return '\n' + to_text(table) + about_noise(table);
}

}  // namespace

Baseline load_baseline(const std::string& path) {
    // 64 MiB is far more than the document of a run with every job.
    const auto document = ordered_json::parse(scenes::read_text_file(path, std::size_t{64} << 20), nullptr, false);
    const InputError unusable(path, "--baseline", "what strata bench --json wrote", "something else");
    if (!document.is_object() || !document.contains("jobs")) throw unusable;
    Baseline baseline;
    try {
        for (const ordered_json& job : document.at("jobs")) baseline[name_of_words(job)] = spread_in(job.at("seconds"));
    } catch (const ordered_json::exception&) {
        throw unusable;
    }
    return baseline;
}

ordered_json to_json(const std::vector<BenchResult>& results, const Baseline& baseline) {
    std::vector<std::string> scenes;
    ordered_json jobs = ordered_json::array(), refused = ordered_json::array();
    for (const BenchResult& result : results) {
        const std::string scene = scene_name(result.job);
        if (std::find(scenes.begin(), scenes.end(), scene) == scenes.end()) scenes.push_back(scene);
        if (!result.is_refused()) {
            jobs.push_back(to_json(result, baseline));
            continue;
        }
        ordered_json words = words_of(result.job);
        words["reason"] = result.last.refusal;
        refused.push_back(words);
    }
    return {{"scene", fmt::format("{}", fmt::join(scenes, " "))}, {"jobs", jobs}, {"refused", refused}};
}

std::string to_table(const std::vector<BenchResult>& results) {
    Table table{{{"scene"}, {"algorithm"}, {"execution"}, {"simd"}, {"effects"}}, {}};
    for (const char* title : {"passes", "fragments", "median ms", "min..max", "geometry ms", "Mfragments/s",
                              "ns/fragment", "bytes/fragment"})
        table.columns.push_back({title, Align::right});
    std::set<std::string> refused;
    for (const BenchResult& result : results) {
        if (result.is_refused())
            refused.insert(fmt::format("refused: {}: {}\n", algorithm_name(result.job), result.last.refusal));
        else
            table.rows.push_back(cells(result));
    }
    return fmt::format("{}{}{}", to_text(table), fmt::join(refused, ""), side_by_side(results));
}

std::string to_ratios(const std::vector<BenchResult>& results, const Baseline& baseline) {
    Table table{{{"job"}, {"old ms", Align::right}, {"new ms", Align::right}, {"old/new", Align::right}}, {}};
    std::string lonely;
    std::set<std::string> met;
    for (const BenchResult& result : results) {
        if (result.is_refused()) continue;
        const std::string name = name_of_job(result.job);
        met.insert(name);
        const auto old = baseline.find(name);
        const Spread now = spread_of(result.seconds);
        if (old == baseline.end())
            lonely += "not in the baseline: " + name + '\n';
        else
            table.rows.push_back({name, fmt::format("{:.2f}", old->second.median * 1e3),
                                  fmt::format("{:.2f}", now.median * 1e3), ratio(old->second, now)});
    }
    for (const auto& [name, seconds] : baseline)
        if (!met.contains(name)) lonely += "only in the baseline: " + name + '\n';
    return '\n' + to_text(table) + about_noise(table) + lonely;
}

std::vector<std::string> differing(const std::vector<BenchResult>& results) {
    std::map<std::string, std::string> first;  // the first digest of a scene and algorithm
    std::vector<std::string> names;
    for (const BenchResult& result : results) {
        if (result.is_refused()) continue;
        const auto [place, is_new] =
            first.try_emplace(scene_name(result.job) + ' ' + algorithm_name(result.job), result.digest);
        if (!is_new && place->second != result.digest) names.push_back(name_of_job(result.job));
    }
    return names;
}

}  // namespace strata::tools
