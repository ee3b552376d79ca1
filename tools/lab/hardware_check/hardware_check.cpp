// tools/lab/hardware_check/hardware_check.cpp - strata hardware-check: compares a profile with captures of the NV2A
// chip.
//
// Rule     Captures are DIR/<suite>/<name>.png, with the names of the public captures; DIR/textures, if it exists, has
//          the images that the tests loaded. Every picture is drawn according to its name and compared outside its
//          labels. Captures that are not modelled are listed, and never counted as passed. Exit status 1 if a picture
//          is outside its bound.
// Tests    tests/tools/lab/hardware_check/hardware_check_test.cpp, tests/tools/lab/hardware_check/suites_test.cpp
#include <malloc.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "rasterizer/base/input_error.h"
#include "scenes/files/profile_json.h"
#include "tools/lab/commands.h"
#include "tools/lab/hardware_check/hardware_hypotheses.h"
#include "tools/lab/hardware_check/hardware_report.h"
#include "tools/lab/parallel_items.h"
#include "tools/strata/options/names.h"
#include "tools/strata/options/option.h"
#include "tools/strata/render/run.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

namespace hc = hardware_check;
namespace fs = std::filesystem;

// The command line. Empty texts: all suites, no folder of differences.
struct HardwareCheckOptions {
    std::string folder, suite, profile = "geforce3", output;
    bool json = false, hypotheses = false, digests = false;
};

// Names of the folder's entries that satisfy `is_wanted`, in ASCII order, because the order of a folder is arbitrary.
std::vector<std::string> sorted_names(const fs::path& folder, auto&& is_wanted) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        if (is_wanted(entry)) names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

// Every capture in the folder, suite by suite, including unknown suites.
std::vector<Capture> find_captures(const HardwareCheckOptions& options) {
    if (!fs::is_directory(options.folder)) throw InputError{options.folder, "no such folder of captures"};
    std::vector<std::string> known;
    for (const hc::Suite& suite : hc::suites()) known.emplace_back(suite.name);
    if (!options.suite.empty() && hc::find_suite(options.suite) == nullptr)
        throw InputError{"strata", "--suite", one_of(known), found_but_near(options.suite, known)};
    std::vector<Capture> captures;
    std::error_code ignored;  // a dangling link is neither a folder nor a picture
    for (const std::string& suite :
         sorted_names(options.folder, [&](const auto& e) { return e.is_directory(ignored); })) {
        if (suite == textures_folder || (!options.suite.empty() && suite != options.suite)) continue;
        const fs::path folder = fs::path(options.folder) / suite;
        const auto is_picture = [&](const auto& e) {
            return e.path().extension() == ".png" && !e.is_directory(ignored);
        };
        for (const std::string& file : sorted_names(folder, is_picture))
            captures.push_back({suite, fs::path(file).stem().string(), (folder / file).string()});
    }
    if (captures.empty()) throw InputError{options.folder, "captures", "SUITE/NAME.png", "none"};
    return captures;
}

// Every picture allocates the same few images of 5 MB. By default glibc returns each to the system and maps new pages,
// which costs a twelfth of the time.
void keep_freed_memory() { ::mallopt(M_MMAP_THRESHOLD, 1 << 30), ::mallopt(M_TRIM_THRESHOLD, 1 << 30); }

// Pictures are independent of each other; results are in the order of the captures.
std::vector<CheckedPicture> check_all(const std::vector<Capture>& captures, const pipeline::DeviceProfile& profile,
                                      WithDigests with_digests) {
    std::vector<CheckedPicture> checked(captures.size());
    for_every("checking", captures.size(),
              [&](std::size_t i) { checked[i] = check(captures[i], profile, with_digests); });
    return checked;
}

int hardware_check(const HardwareCheckOptions& options) {
    keep_freed_memory();
    const pipeline::DeviceProfile profile = scenes::load_profile(options.profile);
    const std::vector<Capture> captures = find_captures(options);
    // Scores are not a comparison that could fail, so the exit status is 0.
    if (options.hypotheses) {
        print(hypothesis_scores(captures, profile));
        return 0;
    }
    const std::vector<CheckedPicture> checked =
        check_all(captures, profile, options.digests ? WithDigests::yes : WithDigests::no);
    if (options.digests)
        print(digest_rows(checked));
    else
        print(options.json ? to_json(checked, profile) : to_text(checked, profile));
    if (!options.output.empty()) write_report(options.output, checked, profile);
    return std::all_of(checked.begin(), checked.end(), [](const auto& c) { return c.is_accepted(); }) ? 0 : 1;
}

}  // namespace

Command add_hardware_check(CLI::App& root) {
    auto* app = add_lab_command(root, "hardware-check");
    const auto options = std::make_shared<HardwareCheckOptions>();
    app->add_option("DIR", options->folder, "captures: DIR/SUITE/NAME.png, named as upstream names them")
        ->required()
        ->type_name("");
    app->add_option("--suite", options->suite, "this suite alone")->type_name("NAME");
    app->add_option("--profile", options->profile, "a built-in profile or a JSON file")
        ->capture_default_str()
        ->type_name("NAME|FILE");
    add_path(*app, options->output,
             {"-o,--output", "DIR", "folder for results.json and a picture of every difference", "a folder"});
    app->add_flag("--json", options->json, "one JSON document instead of the tables");
    app->add_flag("--hypotheses", options->hypotheses, "the score of each hypothesis that the profile names");
    app->add_flag("--digests", options->digests, "the rows of tests/tools/lab/hardware_check/hardware_digests.txt");
    app->footer(footer("  strata hardware-check captures\n"
                       "  strata hardware-check captures --suite Depth_buffer --hypotheses\n"
                       "  strata hardware-check captures -o report\n") +
                " 1 a picture is outside its bound.");
    return {app, [options] { return hardware_check(*options); }};
}

}  // namespace strata::tools
