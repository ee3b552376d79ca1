// Tests the journal of a sweep on files that the test writes byte by byte. The expected shares of cells are computed by
// division.
#include <catch2/catch.hpp>
#include <fstream>

#include "rasterizer/base/input_error.h"
#include "tests/tools/program.h"
#include "tools/lab/sweep/journal.h"
#include "tools/lab/sweep/shard.h"

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
std::string message_of(Action&& action) {
    try {
        action();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("shards divide the cells of a sweep in order and their sizes differ by one at most") {
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

TEST_CASE("a shard is written I/N with I from 1 to N in whole numbers and nothing else") {
    for (int count = 1; count <= 4; ++count)
        for (int index = -1; index <= 6; ++index) {
            const auto shard = to_shard(std::to_string(index) + "/" + std::to_string(count));
            REQUIRE(shard.has_value() == (index >= 1 && index <= count));
            if (shard) CHECK((shard->index == std::size_t(index) && shard->count == std::size_t(count)));
        }
    for (const char* text : {"", "/", "1", "1/", "/2", "1/2/3", "1/0", "0/0", " 1/2", "1/2 ", "1.0/2", "a/b", "1of2"})
        CHECK_FALSE(to_shard(text).has_value());
}

TEST_CASE("the file of a single shard has the plain name and the others have the shard in their names") {
    CHECK(shard_file("out", "results", {}) == "out/results.jsonl");
    CHECK(shard_file("out", "timings", {2, 5}) == "out/timings.2of5.jsonl");
    CHECK(shard_file("", "results", {1, 12}) == "results.1of12.jsonl");
}

TEST_CASE("a journal is read line by line and a last line without its end is truncated") {
    const Folder folder;
    CHECK(read_journal(folder / "missing.jsonl").lines.empty());
    CHECK_FALSE(read_journal(folder / "missing.jsonl").torn);
    const std::string first = line_text({{"cell", 0}}), whole = first + line_text({{"cell", 1}, {"x", {2}}});
    for (std::size_t bytes = 0; bytes <= whole.size(); ++bytes) {
        const JournalContents found = read_journal(with_bytes(folder, whole.substr(0, bytes)));
        const std::size_t lines = bytes < first.size() ? 0 : bytes < whole.size() ? 1 : 2;
        INFO(bytes << " bytes");
        CHECK(found.lines.size() == lines);
        CHECK(found.changed.empty());
        CHECK(found.torn == (bytes != 0 && bytes != first.size() && bytes != whole.size()));
        CHECK(found.whole_bytes == (lines == 0 ? 0 : lines == 1 ? first.size() : whole.size()));
        if (lines == 2) CHECK(found.lines[1] == ordered_json{{"cell", 1}, {"x", {2}}});
    }
}

TEST_CASE("a line ends with the digest of its text") {
    // XXH3-128 of "line", a zero byte, and the character codes of {"cell":0 as little-endian u32.
    CHECK(line_text({{"cell", 0}}) == "{\"cell\":0,\"line_digest\":\"c79cdea5087fa8d85b7cd0c81e74f515\"}\n");
    CHECK(line_text({{"name", "b\xff"}}).starts_with("{\"name\":\"b\xef\xbf\xbd\",\"line_digest\""));
}

TEST_CASE("a line with any byte changed or removed or inserted is ignored and its neighbours are kept") {
    const Folder folder;
    const std::string before = line_text({{"cell", 0}}), line = line_text({{"cell", 1}, {"rmse", 0.25}}),
                      after = line_text({{"cell", 2}});
    std::string wrong;
    const auto try_it = [&](const std::string& changed, const std::string& what) {
        const JournalContents found = read_journal(with_bytes(folder, before + changed + after));
        if (found.changed != std::vector<std::size_t>{2} || found.numbers != std::vector<std::size_t>{1, 3})
            wrong += what + " ";
    };
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        std::string other = line;
        other[i] = static_cast<char>(other[i] ^ 1);
        if (other[i] != '\n') try_it(other, "changed " + std::to_string(i));
        try_it(line.substr(0, i) + line.substr(i + 1), "without " + std::to_string(i));
        try_it(line.substr(0, i) + "0" + line.substr(i), "more at " + std::to_string(i));
    }
    CHECK(wrong == "");
    for (const std::string& bytes : {std::string("\n"), std::string("{}\n"), std::string("{\"cell\":1}\n"),
                                     std::string(200, '\0') + "\n", std::string(300, 'x') + "\n"})
        try_it(bytes, bytes);
    CHECK(wrong == "");
}

TEST_CASE("lines are assigned to their cells and repeated ones and those with other keys are ignored") {
    const Expected expected{.cells = {1, 4, 7},
                            .described = {{{"cell", 1}, {"scene", "a"}}, {{"cell", 4}, {"scene", "b"}}, {{"cell", 7}}},
                            .keys = {"cell", "found"}};
    JournalContents found{.lines = {{{"cell", 7}, {"found", 3}},
                                    {{"cell", 1}, {"scene", "a"}, {"found", 1}},
                                    {{"cell", 4}, {"scene", "b"}},
                                    {{"cell", 1}, {"scene", "a"}, {"found", 2}}},
                          .numbers = {1, 2, 5, 6},
                          .changed = {3, 4}};
    const Lines lines = lines_of_cells("f", found, expected);
    REQUIRE(lines.size() == 3);
    CHECK(lines[0]["found"] == 1);
    CHECK(lines[1].is_null());
    CHECK(lines[2]["found"] == 3);
    CHECK(found.changed == std::vector<std::size_t>{3, 4, 5, 6});
}

TEST_CASE("a line of another plan is rejected with its number and the key that differs") {
    const Expected expected{
        .cells = {0, 1}, .described = {{{"cell", 0}, {"scene", "a"}}, {{"cell", 1}, {"scene", "b"}}}, .keys = {"cell"}};
    const auto said = [&](const ordered_json& line) {
        return message_of([&] {
            JournalContents found{.lines = {line}, .numbers = {9}};
            static_cast<void>(lines_of_cells("f", found, expected));
        });
    };
    CHECK(said({{"cell", 0}, {"scene", "a"}, {"found", 3}}) == "");
    CHECK(said({{"cell", 0}, {"scene", "z"}}) ==
          "f: line 9: scene: expected \"a\", as the plan has it (another plan needs another folder), found \"z\"");
    CHECK(said({{"cell", 1}}) ==
          "f: line 9: scene: expected \"b\", as the plan has it (another plan needs another folder), found nothing");
    CHECK(said({{"cell", 2}, {"scene", "a"}}) ==
          "f: line 9: cell: expected a cell of the plan (another plan needs another folder), found 2");
    CHECK(said({{"cell", 0.0}, {"scene", "a"}}).starts_with("f: line 9: cell: "));  // written as another JSON number
    CHECK(said({{"cell", -1}}).starts_with("f: line 9: cell: "));
    CHECK(said({{"scene", "a"}}).ends_with("found null"));
}

TEST_CASE("a journal removes a truncated line and appends whole lines that are in the file at once") {
    const Folder folder;
    const std::string first = line_text({{"cell", 0}});
    const std::string path = with_bytes(folder, first + "{\"cel");
    const JournalContents found = read_journal(path);
    {
        Journal journal(path, found.whole_bytes);
        CHECK(strata::test::content_of(path) == first);
        journal.append({{"cell", 1}, {"a", nullptr}});
        CHECK(strata::test::content_of(path) == first + line_text({{"cell", 1}, {"a", nullptr}}));
        journal.append({{"z", 1}, {"a", 2}});  // keys in the given order
    }
    CHECK(read_journal(path).lines == Lines{{{"cell", 0}}, {{"cell", 1}, {"a", nullptr}}, {{"z", 1}, {"a", 2}}});
    CHECK_FALSE(read_journal(path).torn);
    const std::string fresh = folder / "fresh.jsonl";
    { const Journal journal(fresh, 0); }
    CHECK(strata::test::content_of(fresh).empty());
    CHECK_THROWS_WITH(Journal(folder / "no/such/folder.jsonl", 0), Catch::Contains("folder.jsonl"));
}
