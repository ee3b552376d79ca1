// Tests `strata report` against other commands on the same scene, and pixel by pixel against the histories of explain.
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <set>

#include "scenes/camera.h"
#include "scenes/files/profile_json.h"
#include "scenes/scene.h"
#include "tests/support/skip.h"
#include "tests/tools/program.h"
#include "tools/oracle/explain/history.h"
#include "tools/oracle/picture/picture.h"
#include "tools/strata/report/report_page.h"
#include "tools/strata/report/survey.h"

using namespace strata;
using namespace strata::test;

namespace {

// The parsed page.
struct UnpackedReport {
    nlohmann::json document;
    std::vector<std::string> blobs;
    std::string page;
};

std::string between(const std::string& text, const std::string& begin, const std::string& end, std::size_t from = 0) {
    const std::size_t first = text.find(begin, from) + begin.size();
    return text.substr(first, text.find(end, first) - first);
}

UnpackedReport report_of(const Folder& folder, const std::string& options) {
    const CommandResult ended = shell(folder, "strata report " + options + " -o out");
    INFO(ended.err);
    REQUIRE(ended.status == 0);
    UnpackedReport report{{}, {}, content_of(folder / "out/report.html")};
    report.document = nlohmann::json::parse(between(report.page, "id=\"data\">", "</script>"));
    const std::string mark = "class=\"blob\">";
    for (std::size_t at = report.page.find(mark); at != std::string::npos; at = report.page.find(mark, at + 1))
        report.blobs.push_back(between(report.page, mark, "</script>", at));
    return report;
}

std::vector<std::uint8_t> from_base64(const std::string& text) {
    std::vector<std::uint8_t> bytes;
    std::uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        if (c == '=') break;
        const int digit = c >= 'a' ? c - 'a' + 26 : c >= 'A' ? c - 'A' : c >= '0' ? c - '0' + 52 : c == '+' ? 62 : 63;
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        held += 6;
        if (held >= 8) bytes.push_back(static_cast<std::uint8_t>(bits >> (held -= 8)));
    }
    return bytes;
}

// Values of `size` bytes each, reassembled from their byte planes.
std::vector<std::uint32_t> words_of(const UnpackedReport& report, const nlohmann::json& blob, std::size_t size) {
    const std::vector<std::uint8_t> packed = from_base64(report.blobs.at(blob.get<std::size_t>()));
    std::vector<std::uint8_t> bytes(std::size_t{64} << 20);
    uLongf length = static_cast<uLongf>(bytes.size());
    REQUIRE(::uncompress(bytes.data(), &length, packed.data(), static_cast<uLong>(packed.size())) == Z_OK);
    std::vector<std::uint32_t> words(length / size);
    for (std::size_t plane = 0; plane < size; ++plane)
        for (std::size_t i = 0; i < words.size(); ++i)
            words[i] |= std::uint32_t{bytes[plane * words.size() + i]} << (8 * plane);
    return words;
}

// The same scene, loaded by the test.
struct ReportScene {
    scenes::Scene scene;
    pipeline::View view;
    pipeline::DeviceProfile profile;
    peeling::RenderOptions options;
};

ReportScene report_scene(const std::string& name, const std::string& profile) {
    ReportScene made{
        .scene = scenes::load_scene(name, {}), .view = {}, .profile = scenes::load_profile(profile), .options = {}};
    made.options.width = 14, made.options.height = 12;
    made.view = scenes::orbit_view(made.scene.bounds, 30, 20, 14.0 / 12);
    return made;
}

}  // namespace

TEST_CASE("the pictures of a report have the codes and digests of render in every format") {
    const std::string format = GENERATE("rgba8", "rgba16f", "rgba32f");
    const Folder folder;
    const std::string options = "teapot --size 30x20 --algorithm dual,weighted_average --color-format " + format;
    const UnpackedReport report = report_of(folder, options);
    REQUIRE(shell(folder, "strata render " + options + " -o out.exr --stats stats.json").status == 0);
    const nlohmann::json stats = nlohmann::json::parse(content_of(folder / "stats.json"));
    REQUIRE(report.document["algorithms"].size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        const nlohmann::json& entry = report.document["algorithms"][i];
        CHECK(entry["picture"]["digest"] == stats[i]["digest"]["color"]);
        CHECK(entry["stats"]["geometry_passes"] == stats[i]["geometry_passes"]);
        CHECK(entry["stats"]["max_difference_from_a_buffer"] == stats[i]["max_difference_from_a_buffer"]);
        const auto picture =
            oracle::read_picture(folder / ("out." + entry["name"].get<std::string>() + ".exr")).targets.at(0);
        CHECK(words_of(report, entry["picture"]["codes"], 4) == picture.codes);
    }
}

TEST_CASE("a report of several samples has the picture of each and the resolved one and the fragments of sample 0") {
    const Folder folder;
    const std::string options = "teapot --size 30x20 --algorithm dual,weighted_average --samples 4";
    const UnpackedReport report = report_of(folder, options);
    REQUIRE(shell(folder, "strata render " + options + " --stats stats.json").status == 0);
    const nlohmann::json stats = nlohmann::json::parse(content_of(folder / "stats.json"));
    for (std::size_t i = 0; i < 2; ++i) {
        const nlohmann::json& entry = report.document["algorithms"][i];
        CHECK(entry["picture"]["digest"] == stats[i]["digest"]["color"]);
        CHECK(entry["stats"]["order_errors"] == stats[i]["order_errors"]);
        CHECK(entry["stats"]["max_difference_from_a_buffer"] == stats[i]["max_difference_from_a_buffer"]);
        REQUIRE(entry["samples"].size() == 4);
        for (std::size_t sample = 0; sample < 4; ++sample) {
            const std::string command = "strata render " + options + " --sample " + std::to_string(sample);
            REQUIRE(shell(folder, command + " -o one.exr").status == 0);
            const auto one =
                oracle::read_picture(folder / ("one." + entry["name"].get<std::string>() + ".exr")).targets.at(0);
            CHECK(words_of(report, entry["samples"][sample]["codes"], 4) == one.codes);
        }
    }
    CHECK_THAT(report.document["left_out"][0].get<std::string>(),
               Catch::Contains("fragments and histories of samples 1 to 3"));
    REQUIRE(shell(folder, "rm -r out").status == 0);
    const UnpackedReport first = report_of(folder, options + " --sample 0");
    for (const char* const blob : {"z", "primitive"})
        CHECK(words_of(report, report.document["fragments"][blob], 4) ==
              words_of(first, first.document["fragments"][blob], 4));
    CHECK(report.document["algorithms"][0]["picture"]["digest"] !=
          first.document["algorithms"][0]["picture"]["digest"]);
}

TEST_CASE("the fragments of a report are complete and in order from near to far in each pixel") {
    const Folder folder;
    const UnpackedReport report = report_of(folder, "random:triangles=60 --size 24x20 --algorithm a_buffer");
    const nlohmann::json& f = report.document["fragments"];
    const auto count = words_of(report, f["count"], 2), z = words_of(report, f["z"], 4),
               arrival = words_of(report, f["arrival"], 4);
    CHECK(count == words_of(report, f["all"], 2));
    CHECK(report.document["left_out"].empty());
    std::size_t at = 0;
    for (const std::uint32_t in_pixel : count) {
        std::set<std::uint32_t> ranks;
        for (std::size_t k = 0; k < in_pixel; ++k, ++at) {
            if (k > 0) CHECK(std::bit_cast<float>(z[at - 1]) <= std::bit_cast<float>(z[at]));
            ranks.insert(arrival[at]);
        }
        CHECK((ranks.empty() || (ranks.size() == in_pixel && *ranks.rbegin() == in_pixel - 1)));
    }
    CHECK(at == z.size());
    const nlohmann::json stats = nlohmann::json::parse(
        shell(folder, "strata render random:triangles=60 --size 24x20 --algorithm a_buffer --counters --stats -")
            .out)[0];
    CHECK(z.size() == stats["counters"]["fragments_rasterized"].get<std::size_t>());
}

TEST_CASE("a region's report has the same values as that of the whole frame at its pixels") {
    const Folder folder;
    const std::string options = "random:triangles=60 --size 24x20 --algorithm dual";
    const UnpackedReport whole = report_of(folder, options), part = report_of(folder, options + " --region 6,4,10,9");
    CHECK(part.document["width"] == 10);
    CHECK(part.document["height"] == 9);
    CHECK(part.document["origin"] == nlohmann::json{6, 4});
    CHECK(part.document["frame"] == nlohmann::json{24, 20});
    CHECK(part.document["left_out"][0] == "pixels of the frame outside columns 6 to 15 and rows 4 to 12");
    const auto &of_whole = whole.document["algorithms"][0], &of_part = part.document["algorithms"][0];
    CHECK(of_part["stats"] == of_whole["stats"]);
    CHECK(of_part["picture"]["digest"] == of_whole["picture"]["digest"]);
    const auto both = [&](const nlohmann::json& a, const nlohmann::json& b, std::size_t size) {
        return std::pair{words_of(whole, a, size), words_of(part, b, size)};
    };
    const auto& f = whole.document["fragments"];
    const auto& g = part.document["fragments"];
    const auto codes = both(of_whole["picture"]["codes"], of_part["picture"]["codes"], 4);
    const auto killers = both(of_whole["killer"], of_part["killer"], 1), counts = both(f["count"], g["count"], 2);
    const auto depths = both(f["z"], g["z"], 4), taken = both(of_whole["taken"], of_part["taken"], 2);
    std::vector<std::uint32_t> first{0};
    for (const std::uint32_t count : counts.first) first.push_back(first.back() + count);
    std::size_t pixel = 0, next = 0, wrong = 0;
    for (std::size_t y = 4; y < 13; ++y)
        for (std::size_t x = 6; x < 16; ++x, ++pixel) {
            const std::size_t there = 24 * y + x;
            for (std::size_t c = 0; c < 4; ++c)
                wrong += codes.second[4 * pixel + c] != codes.first[4 * there + c] ? 1 : 0;
            wrong += killers.second[pixel] != killers.first[there] ? 1 : 0;
            wrong += counts.second[pixel] != counts.first[there] ? 1 : 0;
            for (std::uint32_t k = first[there]; k < first[there + 1]; ++k, ++next)
                wrong += depths.second.at(next) != depths.first[k] || taken.second.at(next) != taken.first[k] ? 1 : 0;
        }
    CHECK(wrong == 0);
    CHECK(next == depths.second.size());
    CHECK(next > 50);
    CHECK(part.page.size() < whole.page.size());
    const CommandResult beyond =
        run_strata(folder, {"report", "teapot", "--size", "16x16", "--region", "8,8,9,8", "-o", "x"});
    CHECK(beyond.err ==
          "strata: --region: expected pixels within the frame of 16x16, found columns 8 to 16 and rows 8 to 15\n");
    CHECK(run_strata(folder, {"report", "teapot", "--region", "8,8,0,8", "-o", "x"}).status == 2);
}

TEST_CASE("the passes and ends at which fragments are peeled are those of every pixel's history") {
    const auto [scene, profile, name] =
        GENERATE(table<std::string, std::string, std::string>({{"teapot", "geforce8", "dual"},
                                                               {"random:triangles=40", "ideal", "front_to_back"},
                                                               {"random:triangles=40", "geforce3", "depth_units"},
                                                               {"random:triangles=40", "geforce3", "shadow_map"},
                                                               {"volume-beam:slices=6", "ideal", "coherent_stencil"},
                                                               {"volume-beam:slices=6", "ideal", "dual_independent"},
                                                               {"random:triangles=40", "ideal", "unsorted"}}));
    INFO(name << " of " << scene << " on " << profile);
    const ReportScene made = report_scene(scene, profile);
    const peeling::FrameRequest input{made.scene.list, made.view, made.profile, made.options};
    const peeling::Algorithm& algorithm = *peeling::find_algorithm(name);
    peeling::Renderer renderer(made.scene.list, made.view, made.profile, made.options);
    const tools::Columns columns =
        tools::columns_of(renderer.fragments(*peeling::find_algorithm("a_buffer")).all, 14 * 12);
    const tools::Survey survey = tools::survey(input, algorithm, columns);
    CHECK(survey.has_taken);
    using Taken = std::set<std::tuple<std::uint32_t, int, bool>>;  // primitive, pass, true at the far end
    std::size_t taken_in_all = 0;
    for (const oracle::History& history : oracle::explain(input, algorithm, {0, 0, 14, 12})) {
        Taken told, found;
        for (const oracle::Line& line : history.lines)
            if (line.kind == oracle::LineKind::taken)
                for (const int f : line.fragments)
                    told.insert({history.fragments[static_cast<std::size_t>(f)].primitive, line.pass,
                                 line.side == pipeline::Side::back});
        const auto pixel = static_cast<std::size_t>(history.y * 14 + history.x);
        // A fragment that a failing peel composites twice is listed with its last pass.
        std::map<std::uint32_t, std::pair<int, bool>> last;
        for (const auto& [primitive, pass, is_far] : told) last[primitive] = {pass, is_far};
        told.clear();
        for (const auto& [primitive, step] : last) told.insert({primitive, step.first, step.second});
        for (std::uint32_t f = columns.first[pixel]; f < columns.first[pixel + 1]; ++f)
            if (const std::uint16_t mark = survey.taken[f]; mark != 0)
                found.insert({columns.fragments[f].primitive, (mark & 0x7fff) - 1, (mark & tools::far_end) != 0});
        CHECK(found == told);
        taken_in_all += found.size();
    }
    CHECK(taken_in_all > 20);
}

TEST_CASE("the test that a report lists as rejecting most fragments is the one that does in the pixel's history") {
    const auto [profile, name] = GENERATE(table<std::string, std::string>({{"geforce3", "depth_units"},
                                                                           {"ideal", "front_to_back"},
                                                                           {"ideal", "coherent_stencil"},
                                                                           {"geforce3", "shadow_map"}}));
    INFO(name << " on " << profile);
    const ReportScene made = report_scene("random:triangles=40", profile);
    const peeling::FrameRequest input{made.scene.list, made.view, made.profile, made.options};
    const peeling::Algorithm& algorithm = *peeling::find_algorithm(name);
    peeling::Renderer renderer(made.scene.list, made.view, made.profile, made.options);
    const tools::Columns columns =
        tools::columns_of(renderer.fragments(*peeling::find_algorithm("a_buffer")).all, 14 * 12);
    const tools::Survey survey = tools::survey(input, algorithm, columns);
    int killed_pixels = 0;
    for (const oracle::History& history : oracle::explain(input, algorithm, {0, 0, 14, 12})) {
        std::array<int, 7> counts{};
        for (const oracle::Line& line : history.lines)
            if (line.kind == oracle::LineKind::fragment && line.fate != oracle::Fate::passed)
                ++counts[static_cast<std::size_t>(line.fate == oracle::Fate::stencil_killed && line.state.depth.enabled
                                                      ? oracle::Fate::depth_killed
                                                      : line.fate)];
        const std::uint8_t found = survey.killer[static_cast<std::size_t>(history.y * 14 + history.x)];
        const int most = *std::ranges::max_element(counts);
        CHECK(counts[found] == most);
        CHECK((found == 0) == (most == 0));
        killed_pixels += most > 0 ? 1 : 0;
    }
    CHECK(killed_pixels > 10);
}

TEST_CASE("a report of at most 8 MiB loads nothing and is reproducible and lists what it omits", "[long][slow]") {
    const auto [options, leaves_out] = GENERATE(table<std::string, bool>(
        {{"teapot --algorithm dual,a_buffer", false},
         {"volume-beam:slices=64 --algorithm weighted_average,a_buffer --color-format rgba32f --profile ideal", true},
         {STRATA_MODELS_DIR "/bunny.glb --alpha 0.5 --algorithm dual,a_buffer", false}}));
    const bool has_scene = options[0] != '/' || std::filesystem::exists(STRATA_MODELS_DIR "/bunny.glb");
    if (!has_scene) {
        skip("no bunny.glb in " STRATA_MODELS_DIR);
        return;
    }
    const Folder folder;
    const UnpackedReport report = report_of(folder, options);
    CHECK(report.page.size() <= std::size_t{8} << 20);
    for (const std::string outside : {"http:", "https:", "src=", "@import", "url(", "fetch("})
        CHECK(report.page.find(outside) == std::string::npos);
    std::string messages;
    for (const auto& message : report.document["left_out"]) messages += message.get<std::string>();
    CHECK((messages.find("of 647242 fragments, which lie behind the nearest") != std::string::npos) == leaves_out);
    if (!leaves_out) CHECK(report_of(folder, options).page == report.page);
}

TEST_CASE("no name in a scene can terminate the data of a page") {
    CHECK(tools::script_safe({{"name", "a</script><script>alert(1)"}}).find('<') == std::string::npos);
    CHECK(nlohmann::json::parse(tools::script_safe({{"name", "</script>\xff"}}))["name"] == "</script>\xef\xbf\xbd");
}

TEST_CASE("report requires a folder and writes nothing and says so where every algorithm is rejected") {
    const Folder folder;
    CHECK(run_strata(folder, {"report", "teapot"}).err ==
          "strata: -o is missing: the page, FILE.html, or a folder for it\n");
    const UnpackedReport some =
        report_of(folder, "teapot --size 16x12 --profile geforce3 --algorithm dual,depth_units");
    CHECK(some.document["algorithms"][0]["refusal"].get<std::string>().find("geforce3 has no ") != std::string::npos);
    CHECK(some.document["algorithms"][1]["refusal"].is_null());
    const CommandResult none = run_strata(
        folder, {"report", "teapot", "--size", "16x12", "--profile", "geforce3", "--algorithm", "dual", "-o", "none"});
    CHECK(none.status == 2);
    CHECK(none.err.find("strata: dual: profile geforce3 has no ") == 0);
    CHECK_FALSE(std::filesystem::exists(folder / "none"));
}

TEST_CASE("report -o FILE.html writes the page in a new folder and any other name is a folder for report.html") {
    const Folder folder;
    const std::string report = "strata report planes:count=2 --size 16x12 --algorithm dual ";
    const CommandResult file = shell(folder, report + "-o new/page.html"),
                        in_folder = shell(folder, report + "--output out");
    CHECK(file.status == 0);
    CHECK(file.out.starts_with("new/page.html: "));
    CHECK(in_folder.out.starts_with("out/report.html: "));
    CHECK(content_of(folder / "new/page.html") == content_of(folder / "out/report.html"));
    CHECK(content_of(folder / "new/page.html").find("planes:count=2") != std::string::npos);
}
