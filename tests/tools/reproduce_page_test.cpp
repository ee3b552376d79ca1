// Tests the pages and charts of `strata reproduce` on short pages whose expected text is written by hand. The expected
// points of charts are computed from logarithms.
#include "tools/lab/reproduce/reproduce_page.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <regex>

#include "scenes/files/image_io.h"
#include "tests/tools/program.h"
#include "tools/lab/reproduce/reproduce_chart.h"

namespace {

using namespace strata::tools;
using strata::pipeline::Format;
using strata::pipeline::Image;
using strata::test::content_of;
using strata::test::Folder;

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

std::string page_with(const Folder& folder, const Page& page) {
    write_page(folder.path().string(), page);
    return content_of(folder / "index.html");
}

std::string chart_with(const Folder& folder, const Chart& chart) {
    static_cast<void>(write_chart(folder.path().string(), "c.svg", "", chart));
    return content_of(folder / "c.svg");
}

// Opaque grey pixels with these codes, in a row.
Image greys(const std::vector<std::uint32_t>& codes) {
    Image image{Format::rgba8, static_cast<int>(codes.size()), 1};
    for (std::size_t p = 0; p < codes.size(); ++p)
        for (int c = 0; c < 4; ++c) image.codes[image.index(static_cast<int>(p), 0, c)] = c == 3 ? 255 : codes[p];
    return image;
}

// The corners of the curves, in order.
std::vector<std::pair<double, double>> points_of(const std::string& svg) {
    std::vector<std::pair<double, double>> points;
    const std::regex path{"<path d=\"([^\"]*)\" fill=\"none\""}, point{"[ML]([0-9.]+) ([0-9.]+)"};
    for (std::sregex_iterator at{svg.begin(), svg.end(), path}, end; at != end; ++at) {
        const std::string corners = (*at)[1];
        for (std::sregex_iterator p{corners.begin(), corners.end(), point}; p != end; ++p)
            points.emplace_back(std::stod((*p)[1]), std::stod((*p)[2]));
    }
    return points;
}

}  // namespace

TEST_CASE("a page has its sections in order with their tables and pictures and every character of a text is escaped") {
    const Folder folder;
    const Section first{
        "A < B & C", "text", {"numbers", {"x", "y > 0"}, {{"1", "a<b"}, {"2", "&"}}}, {{"p.png", "caption & more"}}},
        second{"Second", "no table", {}, {}};
    const std::string page = page_with(folder, {"Title <1>", "Shows <all>", "https://paper", {first, second}});
    CHECK(page.starts_with("<!doctype html>"));
    CHECK(page.ends_with("</body></html>\n"));
    CHECK(page.find("<p><a href=\"https://paper\">the paper</a></p>") != std::string::npos);
    CHECK(page.find("<p class=\"lead\">Shows &lt;all&gt;</p>") < page.find("<h2>A"));
    CHECK(page.find("<title>Title &lt;1") != std::string::npos);
    CHECK(page.find("<h1>Title &lt;1") != std::string::npos);
    CHECK(page.find("<h2>A &lt; B &amp; C</h2>\n<p>text</p>") != std::string::npos);
    CHECK(page.find("<tr><td>1</td><td>a&lt;b</td></tr>\n<tr><td>2</td><td>&amp;</td></tr>\n</tbody></table>") !=
          std::string::npos);
    CHECK(page.find("<a href=\"numbers.csv\">numbers.csv</a>") != std::string::npos);
    CHECK(page.find("<img src=\"p.png\" alt=\"caption &amp; more\"><figcaption>caption &amp; more</figcaption>") !=
          std::string::npos);
    CHECK(count_of(page, "<table class=\"sorts\">") == 1);
    CHECK(page.find("<h2>A") < page.find("<h2>Second"));
    CHECK(folder.files() == std::vector<std::string>{"index.html", "numbers.csv"});
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
    static_cast<void>(page_with(folder, {"", "", "", {{"", "", sheet, {}}}}));
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

TEST_CASE("an axis of a chart runs from the power below its least value to the one above its greatest") {
    const Folder folder;
    const auto at_ends = [&](double x0, double x1, double y0, double y1) {
        return points_of(chart_with(folder, {"", "", {{"c", {{x0, y0}, {x1, y1}}}}}));
    };
    using Points = std::vector<std::pair<double, double>>;
    CHECK(at_ends(2, 8, 1, 100) == Points{{60, 230}, {300, 20}});
    // One more power, because the axis must have a length.
    CHECK(at_ends(4, 4, 10, 10) == Points{{60, 230}, {60, 230}});
    const Points inner = at_ends(3, 6, 20, 500);  // 2 to 8, 10 to 1000
    CHECK(inner[0].first == Approx(60 + 240 * std::log2(3 / 2.0) / 2).margin(0.051));
    CHECK(inner[1].first == Approx(60 + 240 * std::log2(6 / 2.0) / 2).margin(0.051));
    CHECK(inner[0].second == Approx(230 - 210 * std::log10(20 / 10.0) / 2).margin(0.051));
    CHECK(inner[1].second == Approx(230 - 210 * std::log10(500 / 10.0) / 2).margin(0.051));
    CHECK(at_ends(1, 2, 0.001, 0.01) == Points{{60, 230}, {300, 20}});
}

TEST_CASE("every power on an axis has its line and its label in digits up to 9999 and as a power of ten beyond") {
    const Folder folder;
    const std::string svg = chart_with(folder, {"slices", "ms", {{"c", {{1, 0.001}, {16, 1e5}}}}});
    for (const char* number : {"1", "2", "4", "8", "16", "0.01", "0.1", "10", "100", "1000"}) {
        INFO(number);  // 1 is on both axes
        CHECK(count_of(svg, std::string(">") + number + "</text>") == (number == std::string("1") ? 2u : 1u));
    }
    for (const char* exponent : {"-3", "4", "5"})
        CHECK(count_of(svg, std::string("10<tspan dy=\"-5\" font-size=\"9\">") + exponent + "</tspan>") == 1);
    CHECK(count_of(svg, "stroke=\"#ddd\"") == 5 + 9);
    CHECK(count_of(svg, ">slices</text>") == 1);
    CHECK(count_of(svg, ">ms</text>") == 1);
}

TEST_CASE("each curve of a chart has its colour and its row in the legend and a path through its points in order") {
    const Folder folder;
    Chart chart{"x", "y", {}};
    for (int i = 0; i < 7; ++i) chart.curves.push_back({"curve " + std::to_string(i), {{1, 1.0 + i}, {2, 10}}});
    const std::string svg = chart_with(folder, chart);
    const char* const colors[] = {"#000000", "#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00"};
    for (std::size_t i = 0; i < 6; ++i)
        CHECK(count_of(svg, std::string("stroke=\"") + colors[i] + "\"") ==
              (i == 0 ? 4u : 2u));  // the colours repeat from the seventh curve
    for (int i = 0; i < 7; ++i) {
        const std::string row = std::to_string(34 + 18 * i) + ".0";
        CHECK(count_of(svg, "<text x=\"328.0\" y=\"" + row + "\" text-anchor=\"start\">curve " + std::to_string(i)) ==
              1);
    }
    CHECK(points_of(svg).size() == 14);
}
