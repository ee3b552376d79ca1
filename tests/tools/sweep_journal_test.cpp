// Model: files written here byte by byte, and shares of cells by division.
#include <catch2/catch.hpp>
#include <fstream>

#include "rasterizer/base/input_error.h"
#include "tests/tools/program.h"
#include "tools/strata/sweep/journal.h"
#include "tools/strata/sweep/shard.h"

namespace {

using namespace strata::tools;
using nlohmann::ordered_json;
using strata::test::Folder;

std::string with_bytes(const Folder& folder, const std::string& bytes) {
    const std::string path = folder / "results.jsonl";
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

template <class Action>
std::string sentence_of(Action&& action) {
    try {
        action();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("shards share the cells of a sweep: each cell is one shard's, in order, and shares differ by one at most") {
    std::string wrong;
    for (std::size_t all = 0; all <= 12; ++all)
        for (std::size_t count = 1; count <= 14; ++count) {
            std::vector<int> owners(all, 0);
            std::size_t fewest = all, most = 0;
            for (std::size_t index = 1; index <= count; ++index) {
                const auto cells = Shard{index, count}.cells(all);
                for (const std::size_t cell : cells)
                    if (cell < all && cell % count == index - 1) ++owners[cell];
                fewest = std::min(fewest, cells.size());
                most = std::max(most, cells.size());
                if (!std::is_sorted(cells.begin(), cells.end())) wrong += "order ";
            }
            if (owners != std::vector<int>(all, 1) || most > fewest + 1)
                wrong += std::to_string(all) + " in " + std::to_string(count) + " ";
        }
    CHECK(wrong == "");
}

TEST_CASE("a shard is written I/N with I from 1 to N, both whole numbers and nothing else") {
    for (int count = 1; count <= 4; ++count)
        for (int index = -1; index <= 6; ++index) {
            const auto shard = to_shard(std::to_string(index) + "/" + std::to_string(count));
            REQUIRE(shard.has_value() == (index >= 1 && index <= count));
            if (shard) CHECK((shard->index == std::size_t(index) && shard->count == std::size_t(count)));
        }
    for (const char* text : {"", "/", "1", "1/", "/2", "1/2/3", "1/0", "0/0", " 1/2", "1/2 ", "1.0/2", "a/b", "1of2"})
        CHECK_FALSE(to_shard(text).has_value());
}

TEST_CASE("the file of the only shard has the plain name, the others tell which they are") {
    CHECK(shard_file("out", "results", {}) == "out/results.jsonl");
    CHECK(shard_file("out", "timings", {2, 5}) == "out/timings.2of5.jsonl");
    CHECK(shard_file("", "results", {1, 12}) == "results.1of12.jsonl");
}

TEST_CASE("a journal is read line by line, and a last line without its end is torn") {
    const Folder folder;
    CHECK(read_journal(folder / "missing.jsonl").lines.empty());
    CHECK_FALSE(read_journal(folder / "missing.jsonl").torn);
    const std::string whole = "{\"cell\":0}\n{\"cell\":1,\"x\":[2]}\n";
    for (std::size_t bytes = 0; bytes <= whole.size(); ++bytes) {
        const Found found = read_journal(with_bytes(folder, whole.substr(0, bytes)));
        const std::size_t lines = bytes < 11 ? 0 : bytes < whole.size() ? 1 : 2;
        INFO(bytes << " bytes");
        CHECK(found.lines.size() == lines);
        CHECK(found.torn == (bytes != 0 && bytes != 11 && bytes != whole.size()));
        CHECK(found.whole_bytes == (lines == 0 ? 0 : lines == 1 ? 11 : whole.size()));
        if (lines == 2) CHECK(found.lines[1] == ordered_json{{"cell", 1}, {"x", {2}}});
    }
}

TEST_CASE("a whole line that is no object is refused with its number and its beginning") {
    const Folder folder;
    const std::pair<std::string, std::string> faults[] = {
        {"\n", "line 1: expected one JSON object, found ''"},
        {"{}\n7\n", "line 2: expected one JSON object, found '7'"},
        {"{}\n{}\n[1]\n", "line 3: expected one JSON object, found '[1]'"},
        {"{\"cell\":\n", "line 1: expected one JSON object, found '{\"cell\":'"},
        {std::string(100, 'x') + "\n", "line 1: expected one JSON object, found '" + std::string(40, 'x') + "'"}};
    for (const auto& [bytes, sentence] : faults) {
        const std::string path = with_bytes(folder, bytes);
        CHECK(sentence_of([&] { static_cast<void>(read_journal(path)); }) == path + ": " + sentence);
    }
    CHECK(read_journal(with_bytes(folder, "{}\n7")).torn);  // not whole: it counts for nothing
}

TEST_CASE("lines are those of a plan if they begin with their cells' descriptions, and there are no more of them") {
    const Lines expected{{{"cell", 0}, {"scene", "a"}}, {{"cell", 1}, {"scene", "b"}}};
    const auto said = [&](const Lines& lines) { return sentence_of([&] { check_journal("f", lines, expected); }); };
    CHECK(said({}) == "");
    CHECK(said({{{"cell", 0}, {"scene", "a"}, {"found", 3}}}) == "");
    CHECK(said({expected[0], expected[1]}) == "");
    CHECK(said({{{"cell", 0}, {"scene", "z"}}}) ==
          "f: line 1: scene: expected \"a\", as the plan has it (another plan needs another folder), found \"z\"");
    CHECK(said({expected[0], {{"cell", 1}}}) ==
          "f: line 2: scene: expected \"b\", as the plan has it (another plan needs another folder), found nothing");
    CHECK(said({expected[0], expected[1], expected[0]}) ==
          "f: line 3: expected no further line: the plan has no such cell, found one (another plan needs another "
          "folder)");
    CHECK(said({{{"cell", 0.0}, {"scene", "a"}}}).starts_with("f: line 1: cell: expected 0, "));  // its text is another
}

TEST_CASE("a journal cuts off what was torn, appends whole lines, and each is on disk at once") {
    const Folder folder;
    const std::string path = with_bytes(folder, "{\"cell\":0}\n{\"cel");
    const Found found = read_journal(path);
    {
        Journal journal(path, found.whole_bytes);
        CHECK(strata::test::content_of(path) == "{\"cell\":0}\n");
        journal.append({{"cell", 1}, {"a", nullptr}});
        CHECK(strata::test::content_of(path) == "{\"cell\":0}\n{\"cell\":1,\"a\":null}\n");
        journal.append({{"z", 1}, {"a", 2}});  // keys as they come
    }
    CHECK(strata::test::content_of(path) == "{\"cell\":0}\n{\"cell\":1,\"a\":null}\n{\"z\":1,\"a\":2}\n");
    CHECK_FALSE(read_journal(path).torn);
    const std::string fresh = folder / "fresh.jsonl";
    { Journal journal(fresh, 0); }
    CHECK(strata::test::content_of(fresh).empty());
    CHECK_THROWS_WITH(Journal(folder / "no/such/folder.jsonl", 0), Catch::Contains("folder.jsonl"));
}
