// Tests `strata hardware-check` on captures made here: the Clear suite's result is a uniform picture, whatever was
// drawn before (pipeline/reference/chip-fragment.md 5).
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scenes/files/image_io.h"
#include "tests/support/skip.h"
#include "tests/tools/program.h"

using namespace strata;
using namespace strata::test;
using nlohmann::ordered_json;

namespace {

// Writes SUITE/NAME.png, grey 7F7F7F7F except for `wrong` pixels of the third row, whose red is `red`.
void write_capture(const Folder& folder, const std::string& suite, const std::string& name, int wrong = 0,
                   std::uint32_t red = 0, int width = 640) {
    std::filesystem::create_directories(folder / suite);
    pipeline::Image image{pipeline::Format::rgba8, width, 480};
    std::fill(image.codes.begin(), image.codes.end(), 0x7fu);
    for (int x = 0; x < wrong; ++x) image.codes[image.index(x, 2)] = red;
    scenes::write_image(folder / (suite + "/" + name + ".png"), {.color = image});
}

}  // namespace

TEST_CASE("an equal capture is accepted and a differing one gives status 1 with a description of the difference") {
    const Folder folder;
    write_capture(folder, "captures/Clear", "C00000000_Depth_y");
    CHECK(run_strata(folder, {"hardware-check", "captures"}).status == 0);
    write_capture(folder, "captures/Clear", "C01010101_Depth_n", 3, 0x7d);
    const CommandResult ended = run_strata(folder, {"hardware-check", "captures", "--json"});
    CHECK(ended.status == 1);
    const auto pictures = ordered_json::parse(ended.out).at("pictures");
    REQUIRE(pictures.size() == 2);
    CHECK(pictures[0].at("outcome") == "equal");
    CHECK(pictures[0].at("compared") == 640 * 480);
    CHECK(pictures[1].at("outcome") == "outside");
    CHECK(pictures[1].at("differing") == 3);
    CHECK(pictures[1].at("largest") == 2);
    CHECK(pictures[1].at("first") == ordered_json::array({0, 2}));
}

TEST_CASE("unknown suites and names and those not modelled are listed and not counted") {
    const Folder folder;
    write_capture(folder, "captures/Fog", "FogExp");
    write_capture(folder, "captures/Clear", "Nonsense");
    write_capture(folder, "captures/Shade_model", "FixedLM_Quad_Smooth_First");
    const CommandResult ended = run_strata(folder, {"hardware-check", "captures", "--json"});
    CHECK(ended.status == 0);
    std::vector<std::string> outcomes;
    const auto document = ordered_json::parse(ended.out);
    for (const auto& picture : document.at("pictures")) outcomes.push_back(picture.at("outcome"));
    CHECK(outcomes == std::vector<std::string>{"unknown", "unknown", "not modelled"});
}

TEST_CASE("the folder of results holds a row for each picture and a picture of every difference") {
    const Folder folder;
    write_capture(folder, "captures/Clear", "C00000000_Depth_y");
    write_capture(folder, "captures/Clear", "C01010101_Depth_n", 3, 0x7d);
    const CommandResult ended = run_strata(folder, {"hardware-check", "captures", "--json", "-o", "report"});
    CHECK(ended.status == 1);
    CHECK(content_of(folder / "report/results.json") == ended.out);
    const auto pictures = ordered_json::parse(ended.out).at("pictures");
    CHECK(pictures.at(0).at("difference").is_null());
    CHECK(pictures.at(1).at("difference") == "Clear-C01010101_Depth_n.png");
    CHECK(pictures.at(1).at("differing") == 3);
    CHECK_THAT(pictures.at(1).at("detail").get<std::string>(), Catch::StartsWith("first at "));
    CHECK(std::filesystem::exists(folder / "report/Clear-C01010101_Depth_n.png"));
    CHECK_FALSE(std::filesystem::exists(folder / "report/Clear-C00000000_Depth_y.png"));
}

TEST_CASE("hardware-check rejects wrong input with one error message") {
    const Folder folder;
    const auto message = [&](const std::vector<std::string>& words) {
        const CommandResult ended = run_strata(folder, words);
        CHECK(ended.status == 2);
        CHECK(lines_of(ended.err).size() == 1);
        return ended.err;
    };
    CHECK(message({"hardware-check", "nowhere"}).find("nowhere") != std::string::npos);
    std::filesystem::create_directories(folder / "empty");
    CHECK(message({"hardware-check", "empty"}).find("SUITE/NAME.png") != std::string::npos);
    CHECK(message({"hardware-check", "empty", "--suite", "Claer"}).find("did you mean 'Clear'") != std::string::npos);
    write_capture(folder, "narrow/Clear", "C00000000_Depth_y", 0, 0, 320);
    CHECK(message({"hardware-check", "narrow"}).find("640 x 480") != std::string::npos);
    std::filesystem::create_directories(folder / "broken/Clear");
    std::ofstream(folder / "broken/Clear/C00000000_Depth_y.png") << "no picture";
    CHECK(message({"hardware-check", "broken"}).find("C00000000_Depth_y.png") != std::string::npos);
}

TEST_CASE("of several broken captures the first by name is reported in whatever order they are read") {
    const Folder folder;
    std::filesystem::create_directories(folder / "broken/Clear");
    const auto file = [&](const std::string& name) { return folder / ("broken/Clear/" + name + ".png"); };
    write_capture(folder, "broken/Clear", "C01010101_Depth_n");
    std::filesystem::resize_file(file("C01010101_Depth_n"), 200);
    std::ofstream(file("C00000000_Depth_y")) << "";
    std::filesystem::create_symlink("nowhere.png", file("C00010000_Depth_y"));
    for (int i = 0; i < 3; ++i) {
        const CommandResult ended = run_strata(folder, {"hardware-check", "broken"});
        CHECK(ended.status == 2);
        CHECK(lines_of(ended.err).size() == 1);
        CHECK(ended.err.find("C00000000_Depth_y.png") != std::string::npos);
        CHECK(ended.out.empty());
    }
}

TEST_CASE("folders named like pictures and names with control characters are at most listed") {
    const Folder folder;
    write_capture(folder, "captures/Clear", "C00000000_Depth_y");
    write_capture(folder, "captures/Clear", "two\nlines");
    std::filesystem::create_directories(folder / "captures/Clear/C01010101_Depth_y.png");
    std::filesystem::create_symlink("captures", folder / "captures/loop");
    const CommandResult ended = run_strata(folder, {"hardware-check", "captures"});
    CHECK(ended.status == 0);
    CHECK(ended.out.find("two?lines") != std::string::npos);
}

TEST_CASE("every unknown constant has a score on the captures that it can change") {
    const Folder folder;
    write_capture(folder, "captures/Alpha_func", "AlphaFuncNever_Enabled");
    const CommandResult ended = run_strata(folder, {"hardware-check", "captures", "--hypotheses"});
    CHECK(ended.status == 0);
    CHECK(ended.out.find("depths that are written: 0 captures can tell") != std::string::npos);
    CHECK(ended.out.find("vertex colours: 1 captures can tell") != std::string::npos);
    for (const char* name : {"vertex_color_bits=24", "perspective_color=weight_products"})
        CHECK(ended.out.find(name) != std::string::npos);
}

TEST_CASE("pictures that the profile rejects are listed and the others are compared") {
    const Folder folder;
    write_capture(folder, "captures/Clear", "C00000000_Depth_y");
    write_capture(folder, "captures/Front_face", "FrontFace_CW_CF_FaB");
    const CommandResult ended = run_strata(folder, {"hardware-check", "captures", "--profile", "geforce8", "--json"});
    const auto document = ordered_json::parse(ended.out);
    CHECK(document.at("pictures").at(0).at("outcome") == "not modelled");  // needs a 16-bit depth buffer
    CHECK(document.at("pictures").at(1).at("outcome") != "not modelled");
}

TEST_CASE("the hardware captures are within their bounds except four if they are installed") {
    const std::string captures = STRATA_CAPTURES_DIR;
    if (!std::filesystem::is_directory(captures)) {
        skip("no captures in " + captures + "; tests/tools/lab/hardware_check/hardware_digests.txt stands for them");
        return;
    }
    const Folder folder;
    const CommandResult ended = run_strata(folder, {"hardware-check", captures, "--json"});
    INFO(ended.err);
    CHECK(ended.status == 1);  // some pictures exceed their bounds, see tools/lab/hardware_check/RESULTS.md
    int equal = 0;
    std::vector<std::string> outside;
    const auto document = ordered_json::parse(ended.out);
    for (const auto& picture : document.at("pictures")) {
        equal += picture.at("outcome") == "equal";
        if (picture.at("outcome") == "outside") outside.push_back(picture.at("picture"));
    }
    CHECK(equal >= 361);
    CHECK(outside == std::vector<std::string>{"WBuf24D_ClipW-261-000_V1_ZB0_ZS1_ZB", "WBuf24D_RoofQuad_V1_ZB0_ZS1_ZB",
                                              "WBuf24F_FloorQuad_V1_ZB0_ZS0_ZB", "WBuf24F_RoofQuad_V1_ZB1_ZS0_ZB"});
}
