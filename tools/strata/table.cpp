#include "tools/strata/table.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "scenes/files/system_error.h"
#include "scenes/printable.h"
#include "tools/strata/messages.h"

namespace strata::tools {

namespace {

// The number of characters of a UTF-8 text: bytes 10xxxxxx continue a character, every other byte starts one.
std::size_t width_of(const std::string& text) {
    const auto starts_character = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; };
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), starts_character));
}

// The text of a cell on one line, shortened to 200 characters, because one long cell would widen every row.
std::string cell_text(const std::string& text) { return scenes::shortened(scenes::printable(text), 200); }

// One row whose cells are padded to the widths of the columns.
std::string to_line(const std::vector<std::string>& cells, const std::vector<Column>& columns,
                    const std::vector<std::size_t>& widths) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::string space(widths[i] - width_of(cells[i]), ' ');
        if (i > 0) line += "  ";
        line += columns[i].align == Align::right ? space + cells[i] : cells[i] + space;
    }
    // The padding of a left-aligned last column would leave trailing spaces.
    line.erase(line.find_last_not_of(' ') + 1);
    return line + '\n';
}

}  // namespace

std::string to_text(const Table& table) {
    std::vector<std::vector<std::string>> lines{{}};
    for (const Column& column : table.columns) lines[0].push_back(cell_text(column.title));
    for (const auto& row : table.rows) {
        lines.emplace_back();
        for (const std::string& cell : row) lines.back().push_back(cell_text(cell));
    }
    std::vector<std::size_t> widths(table.columns.size());
    for (const auto& line : lines)
        for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], width_of(line[i]));
    std::string text;
    for (const auto& line : lines) text += to_line(line, table.columns, widths);
    return text;
}

std::string titled(const std::string& table) {
    const std::size_t end = std::min(table.find('\n'), table.size());
    return painted(table.substr(0, end), Paint::bold, Stream::output) + table.substr(end);
}

void print(std::string_view given) {
    const std::string text = shown_text(given, Stream::output);
    // The flush detects a full disk, because fwrite() only fills a buffer.
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    if (!written) throw SystemError("standard output", "write", std::generic_category().message(errno));
}

}  // namespace strata::tools
