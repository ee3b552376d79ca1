// Tests what `strata compare` and `strata diagnose` say of a picture that was made with an option of the view which the
// command lacks, on pictures that `strata render` draws with it.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <tuple>

#include "tests/tools/program.h"

using namespace strata::test;

namespace {

struct Forgotten {
    std::string made_with, given, second_line;
};

std::string second_line(const CommandResult& found) {
    const std::vector<std::string> lines = lines_of(found.out);
    return lines.size() > 1 ? lines[1] : "";
}

CommandResult compared(const Folder& folder, const Forgotten& option) {
    REQUIRE(shell(folder, "strata render teapot --size 48x36 -q -o port.png " + option.made_with).status == 0);
    return shell(folder, "strata compare teapot port.png " + option.given);
}

}  // namespace

TEST_CASE("a forgotten option of the view is named with what makes the picture right") {
    const Folder folder;
    for (const Forgotten& option : {
             Forgotten{"--samples 4", "", "  looks forgotten: --samples 4; with it the picture is right"},
             Forgotten{"--samples 8", "--background 0,0,0",
                       "  looks forgotten: --samples 8; with it the picture is right"},
             Forgotten{"--samples 2 --origin lower-left --profile ideal", "--profile ideal",
                       "  looks forgotten: --samples 2; with it the picture is right"},
             Forgotten{"--samples 4 --background 1,1,1", "",
                       "  looks forgotten: --background 1,1,1 --samples 4; with it the picture is right"},
         }) {
        const CommandResult found = compared(folder, option);
        INFO(option.made_with << ": " << found.out << found.err);
        CHECK(found.status == 1);
        CHECK(second_line(found) == option.second_line);
        CHECK(compared(folder, {option.made_with, option.made_with, ""}).status == 0);
    }
}

TEST_CASE("another width or size of lines and points, another mode of polygons, and linear light are named") {
    const Folder folder;
    for (const auto& [scene, given, option] : {std::tuple{"random:triangles=12", "", "--polygon-mode line"},
                                               {"random:triangles=12", "", "--polygon-mode point"},
                                               {"random:triangles=9", "--polygon-mode line", "--line-width 4"},
                                               {"splats:points=60", "", "--point-size 5"},
                                               {"random:triangles=12", "", "--color-space linear"}}) {
        const std::string view = fmt::format("{} --size 40x30 {} ", scene, given);
        REQUIRE(shell(folder, fmt::format("strata render {} {} -q -o port.png", view, option)).status == 0);
        const CommandResult found = shell(folder, "strata compare " + view + " port.png");
        INFO(scene << option << ": " << found.out << found.err);
        CHECK(found.status == 1);
        CHECK(second_line(found) == fmt::format("  looks forgotten: {}; with it the picture is right", option));
    }
}

TEST_CASE("options of lines and lights that the picture lacks are named") {
    const Folder folder;
    for (const auto& [scene, option, name] :
         {std::tuple{"wireframe:tessellation=3", "--line-stipple 1,0x5555", "--line-stipple"},
          {"teapot:tessellation=4", "--lights directional,-1,-1,-0.5", "--lights"}}) {
        REQUIRE(shell(folder, fmt::format("strata render {} --size 40x30 -q -o port.png", scene)).status == 0);
        const CommandResult found =
            shell(folder, fmt::format("strata compare {} --size 40x30 port.png {}", scene, option));
        INFO(scene << option << ": " << found.out << found.err);
        CHECK(found.status == 1);
        CHECK(second_line(found) == fmt::format("  without {} the picture is right", name));
    }
}

TEST_CASE("a picture without linear light is told as that, and nothing of its background") {
    const Folder folder;
    const std::string view = "random:triangles=12 --size 40x30 --background 0.2,0.4,0.1";
    REQUIRE(shell(folder, "strata render " + view + " -q -o port.png").status == 0);
    const CommandResult found = shell(folder, "strata compare " + view + " port.png --color-space linear");
    INFO(found.out);
    CHECK(found.status == 1);
    CHECK(second_line(found) == "  without --color-space linear the picture is right");
    CHECK(found.out.find("--background") == std::string::npos);
}

TEST_CASE("a picture of infinite colours is infinitely far from the right one") {
    const Folder folder;
    const CommandResult drawn =
        shell(folder,
              "strata render planes:count=2 --size 8x6 --profile ideal --algorithm weighted_blended --weight "
              "1/0 -o port.exr");
    INFO(drawn.out);
    CHECK(drawn.status == 0);
    CHECK(drawn.out.find(" inf ") != std::string::npos);
    CHECK(drawn.out.find("times white") == std::string::npos);
}

TEST_CASE("a forgotten --alpha is named by its number by compare and diagnose, and one too much", "[long]") {
    const Folder folder;
    for (const Forgotten& option : {
             Forgotten{"--alpha 0.5", "", "  looks forgotten: --alpha 0.5; with it the picture is right"},
             Forgotten{"--alpha 0.35 --background 1,1,1", "",
                       "  looks forgotten: --background 1,1,1 --alpha 0.35; with it the picture is right"},
             Forgotten{"--alpha 0.6", "--alpha 0.9", "  looks forgotten: --alpha 0.6; with it the picture is right"},
             Forgotten{"", "--alpha 0.9", "  without --alpha the picture is right"},
         }) {
        REQUIRE(
            shell(folder, "strata render teapot --size 48x36 -q -o port.png --algorithm a_buffer " + option.made_with)
                .status == 0);
        for (const std::string command : {"compare", "diagnose"}) {
            const CommandResult found = shell(folder, "strata " + command + " teapot port.png " + option.given);
            INFO(command << option.made_with << ": " << found.out << found.err);
            CHECK(found.status == 1);
            CHECK(second_line(found) == option.second_line);
        }
    }
}

TEST_CASE("a picture from another camera is named as such with the view that it was compared with") {
    const Folder folder;
    const CommandResult found = compared(folder, {"--orbit 200,60 --background 1,1,1", "", ""});
    INFO(found.out);
    CHECK(found.status == 1);
    CHECK(found.out.find("another camera, size or scene? ") != std::string::npos);
    CHECK(found.out.find("compared with: --orbit 30,20, background 0,0,0\n") != std::string::npos);
}

TEST_CASE("of a wrong picture that records its command compare and diagnose say which option differs") {
    const Folder folder;
    REQUIRE(shell(folder, "strata render teapot --size 64x48 -q --alpha 0.5 -o port.png").status == 0);
    for (const std::string command : {"compare", "diagnose"}) {
        const CommandResult found = shell(folder, "strata " + command + " teapot port.png");
        INFO(found.out << found.err);
        CHECK(found.status == 1);
        CHECK(found.err.find("port.png: made by a command with --alpha 0.5 (here: none); give " + command) !=
              std::string::npos);
        CHECK(shell(folder, "strata " + command + " teapot port.png --alpha 0.5").err.empty());
    }
}

TEST_CASE("diagnose says which option looks forgotten without leads and nothing of a right picture") {
    const Folder folder;
    REQUIRE(shell(folder, "strata render planes:count=3 --size 40x30 --samples 4 -q -o port.png").status == 0);
    const CommandResult found = shell(folder, "strata diagnose planes:count=3 port.png --algorithm front_to_back");
    INFO(found.out);
    CHECK(found.out.find("looks forgotten: --samples 4; with it the picture is right") != std::string::npos);
    CHECK(found.out.find("  lead: ") == std::string::npos);
    const CommandResult compared = shell(folder, "strata compare planes:count=3 port.png");
    CHECK(compared.out.find("looks forgotten: --samples 4; with it the picture is right") != std::string::npos);
    CHECK(compared.out.find("  lead: ") == std::string::npos);
    REQUIRE(shell(folder, "strata render planes:count=3 --size 40x30 -q -o right.png").status == 0);
    CHECK(shell(folder, "strata compare planes:count=3 right.png").out.find("forgotten") == std::string::npos);
}
