// Infers random devices from their answers, as a sweep with a row per device: probe_round_trips [--first N] [--count N]
// [--unseen N] [-o FOLDER] [--shard K/N]. Prints a line per device with the fields that differ, true and found value;
// exits with status 1 if an inferred profile draws one of 20 unseen scenes, starting at number `unseen`, differently.
#include <CLI/CLI.hpp>
#include <chrono>

#include "tests/tools/lab/probe/round_trip.h"
#include "tools/lab/sweep/csv.h"
#include "tools/lab/sweep/sweep.h"

using namespace strata::probe;
using namespace strata::tools;
using nlohmann::ordered_json;

namespace {

ordered_json line_of(int number, const RoundTrip& trip) {
    const Difference& d = trip.unseen;
    return {{"device", number},
            {"outcome", "done"},
            {"equal", trip.is_equal()},
            {"kit_differ", trip.found.tally.all - trip.found.tally.equal},
            {"kit", trip.found.tally.all},
            {"pixels", d.pixels},
            {"coverage_differ", d.coverage},
            {"depth_differ", d.depth},
            {"color_differ", d.color},
            {"refused_by_one", trip.refused_by_one},
            {"open", fmt::format("{}", fmt::join(trip.open_but_visible, " "))},
            {"other_values", other_values_of(trip)}};
}

MeasuredRow measured(std::size_t row, int number, const std::vector<Item>& unseen) {
    const auto start = std::chrono::steady_clock::now();
    const RoundTrip trip =
        round_trip(random_profile(number), unseen, number % 2 == 0 ? YDirection::up : YDirection::down);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return {line_of(number, trip), {{"row", row}, {"seconds", seconds}}, seconds};
}

std::string csv_of(const Lines& lines) {
    return csv_of_columns({"/device", "/equal", "/kit_differ", "/kit", "/pixels", "/coverage_differ", "/depth_differ",
                           "/color_differ", "/refused_by_one", "/open", "/other_values"},
                          lines);
}

std::string summary_of(const Lines& lines) {
    std::string text;
    for (const ordered_json& line : lines) text += json_text(line) + '\n';
    const auto equal = std::ranges::count_if(lines, [](const ordered_json& line) { return line["equal"].get<bool>(); });
    const auto whole =
        std::ranges::count_if(lines, [](const ordered_json& line) { return line["kit_differ"].get<int>() == 0; });
    return text + fmt::format(
                      "{} of {} devices are inferred with every pixel of 20 unseen scenes; {} with every pixel "
                      "of the kit\n",
                      equal, lines.size(), whole);
}

}  // namespace

int main(int argc, char** argv) {
    int first = 0, count = 200, number_of_unseen = 100;
    std::string folder;
    Shard shard;
    CLI::App app;
    app.add_option("--first", first);
    app.add_option("--count", count);
    app.add_option("--unseen", number_of_unseen);
    app.add_option("-o,--output", folder);
    add_shard_option(app, shard);
    CLI11_PARSE(app, argc, argv);
    const std::vector<Item> unseen = unseen_scenes(number_of_unseen, 20);
    const Sweep sweep{.name = "random devices",
                      .rows = static_cast<std::size_t>(count),
                      .description = {},
                      .measure = [&](std::size_t row) { return measured(row, first + static_cast<int>(row), unseen); },
                      .csv = csv_of,
                      .summary = [](const Lines& lines, const Lines&) { return summary_of(lines); },
                      .timing_class = {},
                      .has_failed =
                          [](const Lines& lines) {
                              return std::ranges::any_of(
                                  lines, [](const ordered_json& line) { return !line["equal"].get<bool>(); });
                          }};
    return run_sweep(sweep, folder, shard);
}
