#include "tools/lab/reproduce/reproduce_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/files/atomic_file.h"
#include "scenes/files/image_io.h"
#include "scenes/printable.h"
#include "tools/strata/report/page_parts.h"

namespace strata::tools {

namespace {

// Quoted if the text contains a comma, a quotation mark or a line end; a quotation mark inside is doubled.
std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted{'"'};
    for (const char c : text) {
        if (c == '"') quoted += c;
        quoted += c;
    }
    quoted += '"';
    return quoted;
}

// A header line and one line per row.
std::string csv(const Sheet& sheet) {
    std::string text;
    const auto add = [&](const std::vector<std::string>& cells) {
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (i > 0) text += ',';
            text += csv_cell(cells[i]);
        }
        text += '\n';
    };
    add(sheet.columns);
    for (const auto& row : sheet.rows) add(row);
    return text;
}

// The table and a link to its CSV.
std::string html(const Sheet& sheet) {
    std::string text = fmt::format(
        "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{}\"><table class=\"sorts\">\n<thead><tr>",
        sheet.file);
    for (const auto& column : sheet.columns)
        text += fmt::format("<th scope=\"col\">{}</th>", scenes::markup_text(column));
    text += "</tr></thead>\n<tbody>\n";
    for (const auto& row : sheet.rows) {
        text += "<tr>";
        for (const auto& cell : row) text += fmt::format("<td>{}</td>", scenes::markup_text(cell));
        text += "</tr>\n";
    }
    return text + fmt::format("</tbody></table></div>\n<p><a href=\"{0}.csv\">{0}.csv</a></p>\n", sheet.file);
}

// The page needs no files except its images, and has the report's style. {0} is the title, {2} the paper's address, {3}
// a sentence.
constexpr auto head = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1"><title>{0}</title><style>
{1}</style></head><body>
<header><h1>{0}</h1><p><a href="{2}">the paper</a></p></header>
<main>
<p class="lead">{3}</p>
)";

}  // namespace

void write_page(const std::string& folder, const Page& page) {
    std::string text =
        fmt::format(head, scenes::markup_text(page.title), page_css(), page.link, scenes::markup_text(page.lead));
    for (const Section& section : page.sections) {
        text += fmt::format("<h2>{}</h2>\n<p>{}</p>\n", scenes::markup_text(section.title),
                            scenes::markup_text(section.text));
        // A section without rows has no table and no CSV.
        if (!section.sheet.rows.empty()) {
            text += html(section.sheet);
            scenes::write_file(folder + '/' + section.sheet.file + ".csv", csv(section.sheet));
        }
        for (const Picture& picture : section.pictures)
            text += fmt::format("<figure><img src=\"{0}\" alt=\"{1}\"><figcaption>{1}</figcaption></figure>\n",
                                picture.file, scenes::markup_text(picture.caption));
    }
    scenes::write_file(folder + "/index.html",
                       text + "</main>\n<script>\n" + std::string(plain_js()) + "</script>\n</body></html>\n");
}

Picture write_picture(const std::string& folder, const std::string& file, const std::string& caption,
                      const pipeline::Image& color, ColorForm form) {
    scenes::write_image(folder + '/' + file, {.color = color, .premultiplied = form == ColorForm::premultiplied});
    return {file, caption};
}

PictureDifference difference(const pipeline::Image& a, const pipeline::Image& b) {
    // Both images converted to 8 bits for viewing, whatever their format.
    const auto bytes = [](const pipeline::Image& image) {
        return scenes::as_straight_rgba8({.color = image, .premultiplied = true});
    };
    const pipeline::Image x = bytes(a), y = bytes(b);
    PictureDifference found;
    const std::size_t pixels = x.codes.size() / 4;
    for (std::size_t p = 0; p < pixels; ++p) {
        double largest = 0;
        // Alpha is not compared: a finished image's is 1.
        for (std::size_t c = 4 * p; c < 4 * p + 3; ++c)
            largest = std::max(largest, std::fabs(double(x.codes[c]) - double(y.codes[c])));
        found.largest = std::max(found.largest, largest);
        found.mean += largest / static_cast<double>(pixels);
        found.pixels += largest > 0 ? 1 : 0;
    }
    return found;
}

}  // namespace strata::tools
