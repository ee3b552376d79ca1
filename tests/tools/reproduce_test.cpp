// Tests `strata reproduce`: its pages link to files that exist, the tables have the numbers of passes and the
// differences that the papers' algorithms must give, and chart points are placed on logarithmic axes.
#include <catch2/catch.hpp>
#include <regex>

#include "tests/tools/program.h"
#include "tools/lab/reproduce/reproduce_chart.h"

using namespace strata::test;

namespace {

// The local files that the page links to; https:// links are skipped.
std::vector<std::string> local_links(const std::string& page) {
    const std::regex link{"(?:src|href)=\"([^\"]+)\""};
    std::vector<std::string> files;
    for (std::sregex_iterator at{page.begin(), page.end(), link}, end; at != end; ++at)
        if (!(*at)[1].str().starts_with("https://")) files.push_back((*at)[1]);
    return files;
}

std::string reproduce_page(const Folder& folder, const std::string& paper) {
    const CommandResult result = run_strata(folder, {"reproduce", paper, "-o", "page", "--size", "48"});
    CHECK(result.status == 0);
    CHECK(result.out == "page/index.html\n");
    return content_of(folder / "page/index.html");
}

}  // namespace

TEST_CASE(
    "a reproduced paper's page shows only existing files and the last composite of Figure 5 is the complete one") {
    const Folder folder;
    const auto files = local_links(reproduce_page(folder, "everitt2001"));
    CHECK(files.size() >= 8);
    for (const std::string& file : files) CHECK(std::filesystem::file_size(folder / ("page/" + file)) > 0);
    const auto rows = lines_of(content_of(folder / "page/figure5.csv"));
    CHECK_THAT(rows.at(1), Catch::StartsWith("1,") && !Catch::EndsWith(",0"));  // one layer is not the complete picture
    CHECK_THAT(rows.back(), Catch::EndsWith(",0,0.000,0,0"));
}

TEST_CASE("front_to_back takes N + 1 passes and dual takes floor((N + 1) / 2) + 1 for the teapot's N layers") {
    const Folder folder;
    for (const std::string& file : local_links(reproduce_page(folder, "bavoil2008")))
        CHECK(std::filesystem::file_size(folder / ("page/" + file)) > 0);
    int layers = 0, front_to_back = 0, dual = 0;
    const std::string row = lines_of(content_of(folder / "page/passes.csv")).at(1);
    REQUIRE(std::sscanf(row.c_str(), "teapot,%d,%d,%*f,%d,", &layers, &front_to_back, &dual) == 3);
    CHECK(layers > 1);
    CHECK(front_to_back == layers + 1);
    CHECK(dual == (layers + 1) / 2 + 1);  // an odd layer in the middle takes a pass (errata.md E11)
    // Figure 4: the averages differ from dual peeling.
    for (const std::string& line : lines_of(content_of(folder / "page/figure4_teapot.csv")))
        if (line.find(",weighted_") != std::string::npos) CHECK_THAT(line, !Catch::EndsWith(",0,0.000"));
}

// The x axis maps 16 to 256 (powers of 2) to pixels 60 to 300, the y axis 1 to 1000 (powers of 10) to pixels 230 to 20.
TEST_CASE("a chart's points are placed on logarithmic axes") {
    const Folder folder;
    const auto picture = strata::tools::write_chart(folder.path().string(), "chart.svg", "counts",
                                                    {"slices", "passes", {{"peel", {{16, 1}, {64, 10}, {256, 1000}}}}});
    CHECK(picture.file == "chart.svg");
    const std::string svg = content_of(folder / "chart.svg");
    CHECK(svg.find("M60.0 230.0L180.0 160.0L300.0 20.0") != std::string::npos);
    CHECK(svg.find(">peel</text>") != std::string::npos);
}
