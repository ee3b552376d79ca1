// Tests `strata reproduce`: its documents name files that exist, the tables have the numbers of passes and the
// differences that the papers' algorithms must give.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

using namespace strata::test;

namespace {

// The tables and pictures that the document names.
std::vector<std::string> files_of(const Folder& folder, const std::string& paper) {
    const CommandResult result = run_strata(folder, {"reproduce", paper, "-o", "page", "--size", "48"});
    CHECK(result.status == 0);
    CHECK(result.out == "page/page.json; page: tools/lab/reproduce/page.py page\n");
    std::vector<std::string> files;
    const auto page = nlohmann::ordered_json::parse(content_of(folder / "page/page.json"));
    for (const auto& section : page.at("sections")) {
        if (!section.at("table").is_null()) files.push_back(section.at("table"));
        for (const auto& picture : section.at("pictures")) files.push_back(picture.at("file"));
    }
    return files;
}

}  // namespace

TEST_CASE(
    "a reproduced paper's document names only existing files and the last composite of Figure 5 is the complete one") {
    const Folder folder;
    const auto files = files_of(folder, "everitt2001");
    CHECK(files.size() >= 8);
    for (const std::string& file : files) CHECK(std::filesystem::file_size(folder / ("page/" + file)) > 0);
    const auto rows = lines_of(content_of(folder / "page/figure5.csv"));
    CHECK_THAT(rows.at(1), Catch::StartsWith("1,") && !Catch::EndsWith(",0"));  // one layer is not the complete picture
    CHECK_THAT(rows.back(), Catch::EndsWith(",0,0.000,0,0"));
}

TEST_CASE("front_to_back takes N + 1 passes and dual takes floor((N + 1) / 2) + 1 for the teapot's N layers") {
    const Folder folder;
    for (const std::string& file : files_of(folder, "bavoil2008"))
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
