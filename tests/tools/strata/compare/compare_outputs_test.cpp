// Tests the files of `strata compare SCENE PICTURE`: JUnit, heat maps and pictures next to each other, for verdicts
// with one sample and several, and for inputs that cannot be compared.
#include <catch2/catch.hpp>
#include <fstream>

#include "scenes/files/image_io.h"
#include "tests/tools/program.h"

namespace {

using namespace strata::test;

void draw_planes(const Folder& folder, const std::string& options) {
    REQUIRE(shell(folder, "strata render planes:count=3 --size 24x16 --no-audit -q " + options).status == 0);
}

std::array<int, 2> size_of_picture(const std::string& file) {
    const auto image = strata::scenes::read_images(file).at(0).image;
    return {image.width, image.height};
}

std::string counts_in(const std::string& xml) {
    const std::size_t begin = xml.find("tests="), end = xml.find(" skipped", begin);
    return xml.substr(begin, end - begin);
}

}  // namespace

TEST_CASE("a verdict writes a test case and a heat map and the pictures with one sample and several") {
    for (const std::string samples : {"1", "4"}) {
        const Folder folder;
        draw_planes(folder, "--samples " + samples + " --algorithm front_to_back -o right.png");
        draw_planes(folder, "--samples " + samples + " --algorithm weighted_sum -o wrong.png");
        for (const bool is_right : {true, false}) {
            const CommandResult ended = run_strata(
                folder, {"compare", "planes:count=3", is_right ? "right.png" : "wrong.png", "--samples", samples,
                         "--junit", "r.xml", "--heat", "heat.png", "--side", "side.png", "--report", "r.html"});
            INFO(samples << " samples: " << ended.out << ended.err);
            CHECK(ended.status == (is_right ? 0 : 1));
            const std::string xml = content_of(folder / "r.xml");
            CHECK(counts_in(xml) == (is_right ? "tests=\"1\" failures=\"0\"" : "tests=\"1\" failures=\"1\""));
            CHECK(xml.find("<testcase classname=\"strata.compare\" name=\"verdict\"") != std::string::npos);
            const std::string first_line = lines_of(ended.out).at(0);
            CHECK((xml.find("<failure message=\"" + first_line) != std::string::npos) == !is_right);
            CHECK(size_of_picture(folder / "heat.png")[1] > 16);      // with a legend
            CHECK(size_of_picture(folder / "side.png")[0] > 4 * 24);  // four pictures and lines between them
            CHECK(size_of_picture(folder / "side.png")[1] == 16);
            const std::string page = content_of(folder / "r.html");
            std::size_t figures = 0;
            for (std::size_t at = 0; (at = page.find("<figure>", at)) != std::string::npos; ++at) ++figures;
            CHECK(figures == 4);
        }
    }
}

TEST_CASE("the option --exact holds a resolved picture of several samples to every bit") {
    const Folder folder;
    draw_planes(folder, "--samples 4 --algorithm front_to_back -o four.png");
    draw_planes(folder, "--algorithm front_to_back -o one.png");
    const auto compared = [&](const char* picture) {
        return run_strata(folder, {"compare", "planes:count=3", picture, "--samples", "4", "--algorithm",
                                   "front_to_back", "--exact", "--junit", "r.xml"});
    };
    CHECK(compared("four.png").out == "equal\n");
    CHECK(compared("one.png").status == 1);
    CHECK(content_of(folder / "r.xml").find("<failure message=") != std::string::npos);
}

TEST_CASE("an input that cannot be compared is a failed test case and pictures of two sizes are both shown") {
    const Folder folder;
    draw_planes(folder, "-o a.png");
    REQUIRE(
        shell(folder, "strata render planes:count=3 --size 24x17 --no-audit -q -o b.png && echo x > c.png").status ==
        0);
    for (const auto& [reference, candidate] :
         {std::pair{"a.png", "b.png"}, {"a.png", "c.png"}, {"planes:count=3", "c.png"}, {"a.png", "none.png"}}) {
        const CommandResult ended =
            run_strata(folder, {"compare", reference, candidate, "--junit", "r.xml", "--side", "side.png"});
        INFO(reference << " and " << candidate << ": " << ended.err);
        CHECK(ended.status == 2);
        const std::string xml = content_of(folder / "r.xml");
        CHECK(counts_in(xml) == "tests=\"1\" failures=\"1\"");
        CHECK(xml.find(std::string{"<failure message=\""} + candidate + ": ") != std::string::npos);
        CHECK(std::filesystem::exists(folder / "side.png") == (candidate == std::string{"b.png"}));
        std::filesystem::remove(folder / "side.png");
        std::filesystem::remove(folder / "r.xml");
    }
}

TEST_CASE("a picture of another size than --size is rejected with both sizes") {
    const Folder folder;
    draw_planes(folder, "-o a.png");
    const std::string said = "strata: a.png: size: expected 640x480, the value of --size, found 24x16\n";
    for (const char* command : {"compare", "diagnose"}) {
        CHECK(run_strata(folder, {command, "planes:count=3", "a.png", "--size", "640x480"}).err == said);
        CHECK(run_strata(folder, {command, "planes:count=3", "a.png", "--size", "24x16"}).status == 0);
        const std::string help = run_strata(folder, {command, "--help"}).out;
        CHECK(help.find("default: the picture's") != std::string::npos);
    }
    CHECK(
        run_strata(folder, {"explain", "planes:count=3", "--candidate", "a.png", "--pixel", "1,1", "--size", "640x480"})
            .err == said);
}

TEST_CASE("over a reversed range LESS is refused with the option that draws the same picture") {
    const Folder folder;
    draw_planes(folder, "-o a.png");
    const CommandResult range =
        run_strata(folder, {"render", "planes:count=3", "--size", "24x16", "--depth-range", "1,0"});
    CHECK(range.status == 2);
    CHECK(range.err.find("or --depth-order greater beside this one") != std::string::npos);
    const std::string reversed = " --size 24x16 --depth-range 1,0 --depth-order greater";
    CHECK(shell(folder, "strata render planes:count=3 -o b.png" + reversed).status == 0);
    CHECK(shell(folder, "strata compare a.png b.png").status == 0);
    CHECK(shell(folder, "strata compare planes:count=3 a.png" + reversed).status == 0);
    CHECK(shell(folder, "strata render planes:count=3 --size 24x16 --depth-order greater").status == 0);
}

TEST_CASE("a NaN is called so and not a number of codes") {
    const Folder folder;
    const auto write = [&](const std::string& name, const std::string& bytes) {
        std::ofstream{folder / name, std::ios::binary} << bytes;
    };
    const std::string one{"\0\0\x80\x3f", 4}, half{"\0\0\0\x3f", 4}, nan{"\0\0\xc0\x7f", 4};
    write("a.raw", one + one + one + half);
    write("b.raw", one + nan + half + half);
    const CommandResult ended = run_strata(folder, {"compare", "a.raw", "b.raw", "--layout", "2x2:r32f"});
    INFO(ended.out << ended.err);
    CHECK(ended.status == 1);
    CHECK(ended.out.find(" NaN at 0 pixels of the reference and 1 of the candidate, first at 1,0\n") !=
          std::string::npos);
    for (const char* never : {"4294967295", "at most 0 codes"}) CHECK(ended.out.find(never) == std::string::npos);
}

TEST_CASE("reduce asks for a pack where it is given a model and compare takes a scene from standard input") {
    const Folder folder;
    CHECK(run_strata(folder, {"reduce", "mine.glb", "x {pack} {picture}", "-o", "y"}).err ==
          "strata: PACK: expected a pack's folder, which `strata golden mine.glb -o PACK` writes, found 'mine.glb'\n");
    std::ofstream{folder / "a.gltf"} << R"({"asset": {"version": "2.0"}, "scenes": [{}], "scene": 0})";
    REQUIRE(shell(folder, "strata render a.gltf --size 8x8 --no-audit -q -o a.png").status == 0);
    CHECK(shell(folder, "strata compare - a.png < a.gltf").status == 0);
}
