// tools/lab/hardware_check/hardware_check.cpp - strata hardware-check: compares a profile with captures of the NV2A
// chip.
//
// Rule     Captures are DIR/<suite>/<name>.png, with the names of the public captures; DIR/textures, if it exists, has
//          the images that the tests loaded. Every picture is drawn according to its name and compared outside its
//          labels. Captures that are not modelled are listed, and never counted as passed. Exit status 1 if a picture
//          is outside its bound.
//          A hypothesis is one value of an undetermined constant of the profile. It is scored on the captures of those
//          suites that depend on its subject (rasterizer::HypothesisSubject): captures of depth compare depths, all
//          others colours. There is one table per subject; its first row is the unmodified profile on the same
//          captures.
// Tests    tests/tools/lab/hardware_check/hardware_check_test.cpp, tests/tools/lab/hardware_check/suites_test.cpp
#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "rasterizer/base/input_error.h"
#include "rasterizer/rules/hypotheses.h"
#include "scenes/files/profile_json.h"
#include "tools/lab/commands.h"
#include "tools/lab/hardware_check/hardware_report.h"
#include "tools/lab/parallel_items.h"
#include "tools/request/names.h"
#include "tools/strata/options/option.h"
#include "tools/strata/render/run.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

namespace hc = hardware_check;
using rasterizer::NamedHypothesis;
using Subject = rasterizer::HypothesisSubject;

// A subject and the heading of its table, in the order of the output.
struct Titled {
    Subject subject;
    std::string_view title;
};
constexpr Titled subjects[] = {{Subject::window_depth, "depths that are written"},
                               {Subject::texture_depth, "depths made of r and q, or compared with a texel"},
                               {Subject::color, "vertex colours"},
                               {Subject::coordinates, "texture coordinates"}};

// One capture's comparison under every hypothesis; empty if the capture cannot distinguish them.
using Verdicts = std::vector<hc::CaptureComparison>;

bool has(hc::Subjects set, Subject subject) { return (set >> static_cast<unsigned>(subject) & 1) != 0; }

// True if a picture of this suite, in this reading, depends on the subject. Depth pictures never depend on colours, nor
// colours on written depths, whatever the suite's list; and if depths are interpolated without division, depth values
// do not depend on coordinates.
bool can_tell(const hc::Suite& suite, hc::CaptureFormat reading, Subject subject) {
    const bool shows_depth = reading == hc::CaptureFormat::depth16 || reading == hc::CaptureFormat::depth24;
    if (subject == (shows_depth ? Subject::color : Subject::window_depth)) return false;
    if (shows_depth && subject == Subject::coordinates && has(suite.determines, Subject::window_depth)) return false;
    return has(suite.determines, subject);
}

// Draws the capture once under each hypothesis, with the rest of the profile as given.
Verdicts verdicts_of(const Capture& capture, const pipeline::DeviceProfile& profile, Subject subject,
                     const std::vector<NamedHypothesis>& hypotheses) {
    const hc::Suite* const suite = hc::find_suite(capture.suite);
    if (suite == nullptr || suite->determines == 0) return {};
    const hc::Drawing given = drawn(capture, profile);
    if (!given.picture || !can_tell(*suite, given.picture->reading, subject)) return {};
    const pipeline::Image image = read_capture(capture.path);
    Verdicts verdicts;
    for (const NamedHypothesis& hypothesis : hypotheses) {
        pipeline::DeviceProfile varied = profile;
        varied.raster = hypothesis.rules;
        verdicts.push_back(hc::compare(*drawn(capture, varied).picture, image, capture.path));
    }
    return verdicts;
}

// The rules as given first, then every value of every undetermined constant of this subject.
std::vector<NamedHypothesis> hypotheses_on(Subject subject, const rasterizer::RasterRules& rules) {
    std::vector<NamedHypothesis> chosen = rasterizer::depth_hypotheses(rules);
    const std::vector<NamedHypothesis> others = rasterizer::interpolation_hypotheses(rules);
    // Both lists begin with the rules as given: one of the two is omitted.
    chosen.insert(chosen.end(), others.begin() + 1, others.end());
    chosen.erase(std::remove_if(chosen.begin() + 1, chosen.end(),
                                [&](const NamedHypothesis& h) { return h.subject != subject; }),
                 chosen.end());
    return chosen;
}

// One row per hypothesis: the captures that are equal, the captures within their bound, and differing pixels over all
// captures.
Table table_of(const std::vector<NamedHypothesis>& hypotheses, const std::vector<Verdicts>& verdicts) {
    Table table{{{"hypothesis"},
                 {"equal", Align::right},
                 {"within bound", Align::right},
                 {"pixels off", Align::right},
                 {"largest", Align::right}},
                {}};
    for (std::size_t h = 0; h < hypotheses.size(); ++h) {
        std::uint64_t equal = 0, within = 0, differing = 0;
        std::uint32_t largest = 0;
        for (const Verdicts& of_capture : verdicts) {
            // This capture cannot distinguish them.
            if (of_capture.empty()) continue;
            const hc::CaptureComparison& c = of_capture[h];
            equal += c.differing == 0;
            within += c.within_bound;
            differing += c.differing;
            largest = std::max(largest, c.largest);
        }
        table.rows.push_back({hypotheses[h].name, fmt::to_string(equal), fmt::to_string(within),
                              fmt::to_string(differing), fmt::to_string(largest)});
    }
    return table;
}

// Returns one text table per subject: equal captures, captures within the bound of their suite, differing pixels and
// the largest difference.
std::string hypothesis_scores(const std::vector<Capture>& captures, const pipeline::DeviceProfile& profile) {
    std::string text;
    for (const Titled& each : subjects) {
        const std::vector<NamedHypothesis> hypotheses = hypotheses_on(each.subject, profile.raster);
        std::vector<Verdicts> verdicts(captures.size());
        for_every("checking", captures.size(),
                  [&](std::size_t i) { verdicts[i] = verdicts_of(captures[i], profile, each.subject, hypotheses); });
        const auto telling =
            std::count_if(verdicts.begin(), verdicts.end(), [](const Verdicts& v) { return !v.empty(); });
        text += fmt::format("{}{}: {} captures can tell\n", text.empty() ? "" : "\n", each.title, telling);
        if (telling > 0) text += to_text(table_of(hypotheses, verdicts));
    }
    return text;
}

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
