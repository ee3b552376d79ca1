// tools/strata/compare.cpp - strata compare: how a candidate differs from a reference, by kinds of mistakes.
#include "tools/oracle/compare.h"

#include <memory>

#include "scenes/files/atomic_file.h"
#include "scenes/files/image_io.h"
#include "tools/oracle/drawings.h"
#include "tools/oracle/report.h"
#include "tools/strata/command.h"
#include "tools/strata/options/option.h"
#include "tools/strata/render/run.h"
#include "tools/strata/table.h"
#include "tools/strata/tolerances.h"

namespace strata::tools {

namespace {

// The command line.
struct CompareOptions {
    std::string reference, candidate;
    std::optional<oracle::RawLayout> layout{};
    oracle::Tolerances tolerances{};
    std::string heat, side, junit;
    bool json = false;
};

void write_png(const std::string& path, const pipeline::Image& image) {
    if (!path.empty()) scenes::write_image(path, {.color = image});
}

// Files first: what stands on standard output has been written.
int compare(const CompareOptions& options) {
    check_outputs(
        {{"--heat", options.heat, {".png"}}, {"--side", options.side, {".png"}}, {"--junit", options.junit, {".xml"}}});
    const oracle::Picture reference = oracle::read_picture(options.reference, options.layout);
    const oracle::Picture candidate = oracle::read_picture(options.candidate, options.layout);
    const oracle::Comparison found = oracle::compare(reference, candidate, options.tolerances);
    write_png(options.heat, oracle::heat_map(found));
    write_png(options.side, oracle::side_by_side(reference, candidate, found));
    if (!options.junit.empty()) scenes::write_file(options.junit, oracle::to_junit(found));
    print(options.json ? oracle::to_json(found) : oracle::to_text(found));
    return found.accepted ? 0 : 1;
}

}  // namespace

Command add_compare(CLI::App& root) {
    auto* app = root.add_subcommand("compare", "tell how a picture differs from a reference, by kinds of mistakes");
    const auto options = std::make_shared<CompareOptions>();
    app->add_option("REFERENCE", options->reference, "an .exr, .png or .npy file, or bare numbers with --layout")
        ->required()
        ->type_name("");
    app->add_option("CANDIDATE", options->candidate, "the same; the kinds of files may differ")
        ->required()
        ->type_name("");
    add_layout_option(*app, options->layout);
    add_tolerance_option(*app, options->tolerances);
    add_path(*app, options->heat, {"--heat", "FILE.png", "where which kind of difference is", "a file name"});
    add_path(*app, options->side,
             {"--side", "FILE.png", "reference, candidate and heat map side by side", "a file name"});
    add_path(*app, options->junit,
             {"--junit", "FILE.xml", "a test case a kind, for continuous integration", "a file name"});
    app->add_flag("--json", options->json, "one JSON document instead of text");
    app->footer(
        "Examples:\n"
        "  strata render teapot --size 64x64 -o teapot.exr && strata compare teapot.exr teapot.exr\n"
        "  strata render teapot --size 64x64 -o teapot.png && strata compare --json --side side.png teapot.png "
        "teapot.png\n"
        "Exit status: 0 equal or within --tolerance, 1 different, 2 bad input or usage, 3 the system failed, 130 "
        "interrupted.");
    return {app, [options] { return compare(*options); }};
}

}  // namespace strata::tools
