// Tests `strata reproduce`: its page has its pictures and tables, the tables have the numbers that the papers'
// algorithms must give, and the points of charts are at the positions of their logarithms.
#include <catch2/catch.hpp>
#include <regex>

#include "tests/tools/program.h"
#include "tools/lab/reproduce/reproduce_chart.h"

using namespace strata::test;

namespace {

// The files that the page links to.
std::vector<std::string> linked(const std::string& page) {
    const std::regex link{"(?:src|href)=\"([^\"]+)\""};
    std::vector<std::string> files;
    for (std::sregex_iterator at{page.begin(), page.end(), link}, end; at != end; ++at)
        if (!(*at)[1].str().starts_with("https://")) files.push_back((*at)[1]);
    return files;
}

std::string reproduced(const Folder& folder, const std::string& paper) {
    const CommandResult ended = run_strata(folder, {"reproduce", paper, "-o", "page", "--size", "48"});
    CHECK(ended.status == 0);
    CHECK(ended.out == "page/index.html\n");
    return content_of(folder / "page/index.html");
}

}  // namespace

TEST_CASE(
    "a reproduced paper's page shows only existing files and the last composite of Figure 5 is the complete one") {
    const Folder folder;
    const auto files = linked(reproduced(folder, "everitt2001"));
    CHECK(files.size() >= 8);
    for (const std::string& file : files) CHECK(std::filesystem::file_size(folder / ("page/" + file)) > 0);
    const auto rows = lines_of(content_of(folder / "page/figure5.csv"));
    CHECK_THAT(rows.at(1), Catch::StartsWith("1,") && !Catch::EndsWith(",0"));  // one layer is not the complete picture
    CHECK_THAT(rows.back(), Catch::EndsWith(",0,0.000,0,0"));
}

TEST_CASE("dual peels in the number of passes on the reproduced page and its figure is the exact picture") {
    const Folder folder;
    for (const std::string& file : linked(reproduced(folder, "bavoil2008")))
        CHECK(std::filesystem::file_size(folder / ("page/" + file)) > 0);
    for (const std::string& row : lines_of(content_of(folder / "page/figure4_teapot.csv")))
        if (row.find(",dual,") != std::string::npos) CHECK_THAT(row, Catch::EndsWith(",0,0.000"));
}

// 60 to 300 pixels are 16 to 256 in powers of two, 230 to 20 are 1 to 1000 in powers of ten.
TEST_CASE("the points of a chart are at the positions of their logarithms") {
    const Folder folder;
    const auto picture = strata::tools::write_chart(folder.path().string(), "chart.svg", "counts",
                                                    {"slices", "passes", {{"peel", {{16, 1}, {64, 10}, {256, 1000}}}}});
    CHECK(picture.file == "chart.svg");
    const std::string svg = content_of(folder / "chart.svg");
    CHECK(svg.find("M60.0 230.0L180.0 160.0L300.0 20.0") != std::string::npos);
    CHECK(svg.find(">peel</text>") != std::string::npos);
}
