// Tests the HTML pages of reports. The expected text of short pages is written by hand, the picture in a page is read
// back with another PNG reader.
#include "tools/strata/report/plain_page.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "rasterizer/base/input_error.h"
#include "scenes/files/image_io.h"
#include "scenes/images/png_encode.h"
#include "tests/tools/program.h"
#include "tools/strata/report/picture_bytes.h"

using namespace strata::test;
using namespace strata::tools;

namespace {

std::size_t times_in(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

strata::pipeline::Image checkered(int width, int height) {
    strata::pipeline::Image image{strata::pipeline::Format::rgba8, width, height};
    std::uint32_t state = 1;
    for (std::uint32_t& code : image.codes) code = (state = state * 1664525u + 1013904223u) >> 24;
    for (std::size_t i = 3; i < image.codes.size(); i += 4) image.codes[i] = 255;
    return image;
}

// True if the page refers to no other file or address.
bool stands_alone(const std::string& page) {
    return page.find("src=\"http") == std::string::npos && times_in(page, "href=\"") == times_in(page, "href=\"#") &&
           page.find("<link") == std::string::npos && page.size() <= (std::size_t{8} << 20);
}

}  // namespace

TEST_CASE("a page has its parts in order and every character of a text is escaped") {
    PlainPage page{"Title <1>", "a & b"};
    page.heading("First");
    page.paragraph("x < y & \"z\"\x1b");
    page.table({{{"n"}, {"m"}}, {{"1", "</td>"}}}, "numbers");
    page.lead("found & said");
    page.items({"one <li>", "two"});
    page.items({});
    const std::string html = page.html();
    for (const std::string part :
         {"<title>Title &lt;1&gt;</title>", "<p>a &amp; b</p>", "<h2>First</h2>",
          "<p>x &lt; y &amp; &quot;z&quot;\\x1b</p>", "<caption>numbers</caption>", "<td>1</td><td>&lt;/td&gt;</td>",
          "<p class=\"lead\">found &amp; said</p>", "<ul>\n<li>one &lt;li&gt;</li>\n<li>two</li>\n</ul>"})
        CHECK(times_in(html, part) == 1);
    CHECK(html.find("First") < html.find("<caption>"));
    CHECK(stands_alone(html));
}

TEST_CASE("a legend of a page has a swatch per colour with its label") {
    PlainPage page{"t", "s"};
    page.legend({{{255, 0, 10}, "lost & <found>"}, {{0, 1, 2}, "other"}});
    const std::string html = page.html();
    CHECK(times_in(html, "style=\"background:#ff000a\"></span>lost &amp; &lt;found&gt;</span>") == 1);
    CHECK(times_in(html, "style=\"background:#000102\"></span>other</span>") == 1);
}

TEST_CASE("a scale of a page has its colours in a row and each number at its proportional position") {
    PlainPage page{"t", "s"};
    const std::array<std::array<std::uint8_t, 3>, 2> colors{{{255, 0, 10}, {0, 1, 2}}};
    page.scale(colors, {{0, "1 <code>"}, {0.25, "4"}, {1, "255"}});
    const std::string html = page.html();
    CHECK(times_in(html, "linear-gradient(to right,#ff000a,#000102)") == 1);
    CHECK(times_in(html, "left:0.0%;transform:translateX(-0.0%)\">1 &lt;code&gt;</span>") == 1);
    CHECK(times_in(html, "left:25.0%;transform:translateX(-25.0%)\">4</span>") == 1);
    CHECK(times_in(html, "left:100.0%;transform:translateX(-100.0%)\">255</span>") == 1);
}

TEST_CASE("a picture of a page is a PNG that another reader reads") {
    const Folder folder;
    const auto image = checkered(7, 5);
    std::ofstream(folder / "a.png", std::ios::binary) << strata::scenes::png_bytes(image);
    CHECK(strata::scenes::read_images(folder / "a.png").at(0).image.codes == image.codes);
    CHECK(base64("") == "");
    CHECK(base64("f") == "Zg==");
    CHECK(base64("fo") == "Zm8=");
    CHECK(base64("foobar") == "Zm9vYmFy");  // RFC 4648, 10
}

TEST_CASE("pictures that would make a page larger than 8 MiB are omitted and their number is given") {
    PlainPage page{"t", "s"};
    for (int i = 0; i < 5; ++i) page.picture(checkered(800, 600), "noise");
    const std::string html = page.html();
    CHECK(times_in(html, "<img") == 3);
    CHECK(html.find("2 pictures, so that this page has at most 8 MiB") != std::string::npos);
    CHECK(stands_alone(html));
    for (int i = 0; i < 5000; ++i) page.paragraph(std::string(1999, 'x'));
    CHECK_THROWS_AS(page.html(), strata::InputError);
}

TEST_CASE("every command with --report writes one page that refers to no other file") {
    const Folder folder;
    REQUIRE(shell(folder, "strata render planes:count=2 --size 16x12 -q --algorithm dual,unsorted -o t.png").status ==
            0);
    const std::vector<std::string> lines{
        "strata render planes:count=2 --size 16x12 --algorithm dual,unsorted --report p.html",
        "strata passes planes:count=2 --size 16x12 --algorithm front_to_back -o passes --report p.html",
        "strata compare t.dual.png t.unsorted.png --report p.html",
        "strata diagnose planes:count=2 t.dual.png --report p.html"};
    for (const std::string& line : lines) {
        const CommandResult ended = shell(folder, line + " && ls p.html");
        INFO(line << "\n" << ended.out << ended.err);
        CHECK(ended.status <= 1);
        const std::string page = content_of(folder / "p.html");
        CHECK(page.starts_with("<!doctype html>"));
        CHECK(page.ends_with("</html>\n"));
        CHECK(stands_alone(page));
        // The result is the first sentence, numbers are in tables, and no picture's text is a file name.
        const std::size_t message = page.find("<p class=\"lead\">");
        if (line.find("render") == std::string::npos) {
            CHECK(message != std::string::npos);
            CHECK(message < page.find("<table"));
            CHECK(message < page.find("<img"));
            CHECK(page.find("<pre") == std::string::npos);
        }
        for (std::size_t at = page.find("<figcaption>"); at != std::string::npos;
             at = page.find("<figcaption>", at + 1)) {
            const std::string caption = page.substr(at + 12, page.find("</figcaption>", at) - at - 12);
            CHECK(caption.find(' ') != std::string::npos);
        }
        std::filesystem::remove(folder / "p.html");
    }
    CHECK(run_strata(folder, {"compare", "t.dual.png", "t.dual.png", "--report", "p.txt"}).err ==
          "strata: --report: expected a file that ends in .html, found 'p.txt'\n");
}
