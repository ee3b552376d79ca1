// tools/strata/table.h - text in columns, and the one way to standard output.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace strata::tools {

enum class Align : std::uint8_t { left, right };

struct Column {
    std::string title;
    Align align = Align::left;
};

// Every row has a cell for every column.
struct Table {
    std::vector<Column> columns;
    std::vector<std::vector<std::string>> rows;  // one cell a column
};

// Two spaces between columns, no space at a line's end; a character counts as one place wide (UTF-8). Of a cell above
// 200 characters the begin is shown, and no control character of any.
[[nodiscard]] std::string to_text(const Table& table);

// The text of a table, with its first line bold where standard output shows colours.
[[nodiscard]] std::string titled(const std::string& table);

// Writes all of `text`, as shown_text has it (messages.h), to standard output and flushes it. Throws SystemError where
// that fails (a full disk).
void print(std::string_view text);

}  // namespace strata::tools
