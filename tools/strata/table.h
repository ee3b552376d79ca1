// tools/strata/table.h - formats tables as text, and prints all results to standard output.
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

// Every row has one cell per column.
struct Table {
    std::vector<Column> columns;
    std::vector<std::vector<std::string>> rows;  // one cell per column
};

// Two spaces between columns, no trailing spaces; every character counts as one column wide (UTF-8). Cells are
// shortened to 200 characters, and control characters are escaped.
[[nodiscard]] std::string to_text(const Table& table);

// The text of a table, with a bold first line if standard output shows colours.
[[nodiscard]] std::string titled(const std::string& table);

// Writes `text`, escaped as by shown_text (messages.h), to standard output and flushes it. Throws SystemError if that
// fails (for example because the disk is full).
void print(std::string_view text);

}  // namespace strata::tools
