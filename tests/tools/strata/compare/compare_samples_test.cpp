// Tests `strata compare SCENE PICTURE --samples N` with resolved pictures that `strata render` draws.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

namespace {

using namespace strata::test;

const std::string sampled_scene = "random:seed=3,triangles=60";

void draw(const Folder& folder, const std::string& options) {
    REQUIRE(shell(folder, "strata render " + sampled_scene +
                              " --size 32x24 --samples 4 --background 0.2,0.3,0.5 --no-audit -q -o port.png " + options)
                .status == 0);
}

[[nodiscard]] CommandResult judged(const Folder& folder, std::vector<std::string> with,
                                   const std::string& background = "0.2,0.3,0.5") {
    std::vector<std::string> compare{"compare", sampled_scene,  "port.png", "--samples",
                                     "4",       "--background", background};
    compare.insert(compare.end(), with.begin(), with.end());
    return run_strata(folder, compare);
}

}  // namespace

TEST_CASE("a resolved picture is judged by the rules of another profile where those given do not explain it") {
    const Folder folder;
    draw(folder, "--profile llvmpipe --algorithm front_to_back");
    CHECK(judged(folder, {"--profile", "llvmpipe"}).out.find("by the rules of profile") == std::string::npos);
    const CommandResult other = judged(folder, {"--profile", "ideal"});
    INFO(other.out << other.err);
    CHECK(other.status == 0);
    CHECK(other.out.starts_with("right: the mean of the samples at all 768 pixels, "));
    CHECK(other.out.find("\n  by the rules of profile llvmpipe; by those of ideal it would be wrong at ") !=
          std::string::npos);
}

TEST_CASE("a resolved picture is judged by other sample positions of the profile that is given") {
    const Folder folder;
    auto own = nlohmann::json::parse(run_strata(folder, {"list", "profiles", "ideal", "--json"}).out);
    own["sample_positions"] = "nv20";
    std::ofstream{folder / "own.json"} << own;
    draw(folder, "--profile own.json --algorithm depth_units");
    const CommandResult found = judged(folder, {"--profile", "ideal", "--json"});
    INFO(found.out << found.err);
    CHECK(found.status == 0);
    CHECK(nlohmann::json::parse(found.out)["rules"] == "the sample positions \"nv20\"");
}

TEST_CASE("a resolved picture is right with the origin at either corner and with either shading if no option says so") {
    const Folder folder;
    const std::pair<std::string, std::string> made_with[] = {{"2", "--origin lower-left"},
                                                             {"4", "--shading pixel"},
                                                             {"4", "--origin lower-left --shading pixel"},
                                                             {"8", "--origin lower-left"}};
    for (const auto& [samples, more] : made_with) {
        const std::string options = " --size 24x33 --profile ideal --color-format rgba8 --samples " + samples;
        REQUIRE(shell(folder, "strata render " + sampled_scene + options +
                                  " --algorithm dual --no-audit -q -o port.png " + more)
                    .status == 0);
        const CommandResult found = shell(folder, "strata compare " + sampled_scene + " port.png" + options);
        INFO(samples << ' ' << more << ": " << found.out << found.err);
        CHECK(found.status == 0);
        CHECK(found.out.find("\n  by the rules of profile ideal with " + more +
                             "; by those given it would be wrong ") != std::string::npos);
    }
}

TEST_CASE("the own picture with pixel shading is right and one changed pixel of it is wrong") {
    const Folder folder;
    const std::string options = " --size 64x48 --samples 2 --shading pixel";
    REQUIRE(shell(folder, "strata golden showroom" + options + " --algorithm dual -q -o pack").status == 0);
    const std::string picture = "pack/expected/dual/picture.npy";
    const CommandResult own = shell(folder, "strata compare showroom " + picture + options);
    INFO(own.out << own.err);
    CHECK(own.status == 0);
    CHECK(own.out.starts_with("right: equal to the picture of dual at all 3072 pixels\n"));
    std::ifstream file{folder / picture, std::ios::binary};
    std::string bytes{std::istreambuf_iterator<char>{file}, {}};
    bytes[bytes.size() - 4 * (64 * 20 + 32)] ^= 0x40;
    std::ofstream{folder / "changed.npy", std::ios::binary} << bytes;
    const CommandResult changed = shell(folder, "strata compare showroom changed.npy" + options);
    INFO(changed.out << changed.err);
    CHECK(changed.status == 1);
    CHECK(changed.out.starts_with("wrong: "));
}

TEST_CASE("with pixel shading the values of a pixel's centre or centroid are those that count") {
    const Folder folder;
    for (const std::string place : {"centre", "centroid"}) {
        draw(folder,
             "--profile ideal --algorithm depth_units --color-format rgba8 --shading pixel --interpolate " + place);
        const CommandResult right =
            judged(folder, {"--profile", "ideal", "--shading", "pixel", "--interpolate", place});
        INFO(place << ": " << right.out << right.err);
        CHECK(right.status == 0);
        const CommandResult unstated = judged(folder, {"--profile", "ideal"});
        CHECK(unstated.status == 0);
        CHECK(unstated.out.find("by the rules of profile ideal with --shading pixel") != std::string::npos);
        // Its program multiplies by alphas beyond 1 before they are clamped.
        draw(folder, "--profile ideal --algorithm dual --color-format rgba8 --shading pixel --interpolate " + place);
        CHECK(judged(folder, {"--profile", "ideal", "--shading", "pixel", "--interpolate", place}).status == 0);
    }
}

TEST_CASE("the alpha of a resolved picture is compared if its colours are right") {
    const Folder folder;
    draw(folder, "--profile ideal --algorithm front_to_back --color-format rgba8");
    CHECK(judged(folder, {"--profile", "ideal"}).out.find("alpha is right") == std::string::npos);
    REQUIRE(shell(folder, "strata render " + sampled_scene +
                              " --size 32x24 --samples 4 --background none --profile ideal --color-format rgba8 "
                              "--no-audit -q -o port.png")
                .status == 0);
    const CommandResult right = judged(folder, {"--profile", "ideal"}, "none");
    INFO(right.out << right.err);
    CHECK(right.status == 0);
    CHECK(right.out.find("\n  alpha is right at all pixels\n") != std::string::npos);
    const CommandResult wrong = judged(folder, {"--profile", "ideal", "--report", "page.html"}, "0,0,0,1");
    INFO(wrong.out << wrong.err);
    CHECK(wrong.status == 1);
    CHECK(content_of(folder / "page.html").find("grey if alpha alone is wrong") != std::string::npos);
    CHECK(wrong.out.starts_with("wrong: alpha is not the mean of the samples' alphas at "));
    CHECK(judged(folder, {"--profile", "ideal", "--channels", "rgb"}, "0,0,0,1").status == 0);
}
