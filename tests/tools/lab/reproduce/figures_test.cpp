// Tests the files of `strata reproduce` on short pages whose expected content is written by hand.
#include "tools/lab/reproduce/figures.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "scenes/files/image_io.h"
#include "tests/tools/program.h"

namespace {

using namespace strata::tools;
using nlohmann::ordered_json;
using strata::pipeline::Format;
using strata::pipeline::Image;
using strata::test::content_of;
using strata::test::Folder;

// Opaque grey pixels with these codes, in a row.
Image greys(const std::vector<std::uint32_t>& codes) {
    Image image{Format::rgba8, static_cast<int>(codes.size()), 1};
    for (std::size_t p = 0; p < codes.size(); ++p)
        for (int c = 0; c < 4; ++c) image.codes[image.index(static_cast<int>(p), 0, c)] = c == 3 ? 255 : codes[p];
    return image;
}

}  // namespace

TEST_CASE("the document of a page has its sections in order with the names of their tables and pictures") {
    const Folder folder;
    const Section first{
        "A", "text", {"numbers", {"x"}, {{"1"}}}, {{"p.png", "a caption"}}, {{"c", "x", "y", {{"peel", {{1, 2}}}}}}},
        second{"Second", "no table", {}, {}, {}};
    write_figures(folder.path().string(), {"Title", "Lead", "https://paper", {first, second}});
    CHECK(ordered_json::parse(content_of(folder / "page.json")) == ordered_json::parse(R"({
        "title": "Title", "lead": "Lead", "link": "https://paper", "sections": [
            {"title": "A", "text": "text", "table": "numbers.csv",
             "charts": [{"name": "c", "x_label": "x", "y_label": "y", "curves": [{"name": "peel", "points": [[1.0, 2.0]]}]}],
             "pictures": [{"file": "p.png", "caption": "a caption"}]},
            {"title": "Second", "text": "no table", "table": null, "charts": [], "pictures": []}]})"));
    CHECK(folder.files() == std::vector<std::string>{"numbers.csv", "page.json"});
}

TEST_CASE("a picture file has straight colours for which only those of a finished frame are divided by alpha") {
    const Folder folder;
    Image image{Format::rgba8, 1, 1};
    image.codes = {60, 30, 0, 128};
    using strata::tools::ColorForm;
    static_cast<void>(strata::tools::write_picture(folder / "", "frame.png", "", image));
    static_cast<void>(strata::tools::write_picture(folder / "", "layer.png", "", image, ColorForm::straight));
    const auto codes = [&](const char* file) {
        const Image read = strata::scenes::read_images(folder / file).front().image;
        return std::vector<std::uint32_t>(read.codes.begin(), read.codes.end());
    };
    CHECK(codes("frame.png") == std::vector<std::uint32_t>{120, 60, 0, 128});  // 60 * 255 / 128 is 119.5
    CHECK(codes("layer.png") == std::vector<std::uint32_t>{60, 30, 0, 128});
}

TEST_CASE("a table's file quotes fields with commas or quotes or line ends and no others") {
    const Folder folder;
    const Sheet sheet{"t", {"plain", "with, comma"}, {{"say \"x\"", "two\nlines"}, {"", "a;b 'c'"}}};
    write_figures(folder.path().string(), {"", "", "", {{"", "", sheet, {}, {}}}});
    CHECK(content_of(folder / "t.csv") == "plain,\"with, comma\"\n\"say \"\"x\"\"\",\"two\nlines\"\n,a;b 'c'\n");
}

TEST_CASE("pictures are compared by their largest channel difference at each pixel without alpha") {
    const Image a = greys({10, 20, 30, 40});
    Image b = a;
    const auto is = [&](double largest, double mean, std::uint64_t pixels) {
        const PictureDifference found = difference(a, b);
        return found.largest == largest && found.mean == mean && found.pixels == pixels;
    };
    CHECK(is(0, 0, 0));
    b.codes[b.index(1, 0, 0)] += 3;
    b.codes[b.index(1, 0, 2)] -= 5;
    CHECK(is(5, 1.25, 1));
    b.codes[b.index(3, 0, 1)] += 2;
    CHECK(is(5, 1.75, 2));
    const PictureDifference turned = difference(b, a);
    CHECK((turned.largest == 5 && turned.mean == 1.75 && turned.pixels == 2));
}
