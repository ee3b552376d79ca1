// tools/oracle/suite/mistake_plot.cpp - a bar chart of the number of mistakes that each scene of the suite reveals.
#include <fmt/format.h>

#include <algorithm>

#include "tools/oracle/emulations/catalogue.h"
#include "tools/oracle/suite/mistake_table.h"

namespace strata::oracle {

namespace {

constexpr int row_px = 20, names_px = 270, unit_px = 5, top_px = 64, margin_px = 16;

// The segments of a bar from left to right. Those where another mistake is reported are red; there should be none.
struct Piece {
    const char* words;
    const char* color;
    std::vector<TableAnswer> cells;
};
const std::vector<Piece>& pieces() {
    static const std::vector<Piece> all{
        {"named first", "#1b7837", {TableAnswer::named}},
        {"the same picture as one that is named", "#a6dba0", {TableAnswer::alike}},
        {"another mistake is named", "#c51b1b", {TableAnswer::wrong, TableAnswer::accused}},
        {"does not show", "#d9d9d9", {TableAnswer::hidden}},
        {"cannot be made", "#f5f5f5", {TableAnswer::impossible}}};
    return all;
}

std::string words_at(int x, int y, const std::string& text, const char* anchor = "start") {
    return fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, text);
}

std::string box(int x, int y, int width, const char* color) {
    return fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", x, y, width, row_px - 6,
                       color);
}

int number_in(const TableColumn& column, const Piece& piece) {
    return static_cast<int>(std::ranges::count_if(
        column.cells, [&](TableAnswer cell) { return std::ranges::find(piece.cells, cell) != piece.cells.end(); }));
}

// Two rows, because the text is wider than the drawing.
std::string legend() {
    std::string text;
    int x = margin_px, y = margin_px;
    for (const Piece& piece : pieces()) {
        text += box(x, y - 10, 14, piece.color) + words_at(x + 20, y + 1, piece.words);
        x += piece.cells.front() == TableAnswer::alike ? 290 : 210;
        if (piece.cells.front() == TableAnswer::wrong) x = margin_px, y += row_px + 2;
    }
    return text;
}

}  // namespace

std::string to_svg(const std::vector<TableColumn>& columns) {
    const int width = names_px + unit_px * static_cast<int>(catalogue().size()) + 3 * margin_px,
              height = top_px + row_px * static_cast<int>(columns.size()) + margin_px;
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" font-family=\"sans-serif\" "
        "font-size=\"12\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
        width, height);
    svg += legend();
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const int y = top_px + row_px * static_cast<int>(c);
        svg += words_at(names_px - 8, y + 11, fmt::format("{} {}", c + 1, columns[c].scene->name), "end");
        int x = names_px;
        for (const Piece& piece : pieces()) {
            const int length = unit_px * number_in(columns[c], piece);
            if (length > 0) svg += box(x, y, length, piece.color);
            x += length;
        }
        svg += fmt::format("<text x=\"{}\" y=\"{}\" fill=\"white\">{}</text>\n", names_px + 4, y + 11,
                           number_in(columns[c], pieces().front()));
    }
    return svg + "</svg>\n";
}

}  // namespace strata::oracle
