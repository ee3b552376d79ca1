#include "tools/strata/report/plain_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "rasterizer/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/text_file.h"
#include "scenes/images/png_encode.h"
#include "scenes/printable.h"
#include "tools/strata/options/option.h"
#include "tools/strata/report/page_parts.h"
#include "tools/strata/report/picture_bytes.h"
#include "tools/strata/report/report_data.h"

namespace strata::tools {

namespace {

// Limit for pictures; text and tables get the rest of the 8 MiB of a page.
constexpr std::size_t most_picture_bytes = std::size_t{6} << 20;

// Escapes and shortens text: a name from a file may have a megabyte, and a table may contain it many times.
std::string element_text(const std::string& text) { return html_text(scenes::shortened(text, 2000)); }

std::string cells_of(const std::vector<std::string>& texts) {
    std::string row;
    for (const std::string& text : texts) row += "<td>" + element_text(text) + "</td>";
    return row;
}

}  // namespace

std::string html_text(const std::string& text) { return scenes::markup_text(text); }

PlainPage::PlainPage(const std::string& title, const std::string& subtitle) : title_{title}, subtitle_{subtitle} {}

void PlainPage::heading(const std::string& text) { body_ += "<h2>" + element_text(text) + "</h2>\n"; }
void PlainPage::paragraph(const std::string& text) { body_ += "<p>" + element_text(text) + "</p>\n"; }

void PlainPage::lead(const std::string& text) { body_ += "<p class=\"lead\">" + element_text(text) + "</p>\n"; }

void PlainPage::items(const std::vector<std::string>& texts) {
    if (texts.empty()) return;
    body_ += "<ul>\n";
    for (const std::string& text : texts) body_ += "<li>" + element_text(text) + "</li>\n";
    body_ += "</ul>\n";
}

void PlainPage::indented_items(const std::vector<std::string>& lines) {
    std::size_t level = 0;
    for (const std::string& line : lines) {
        const std::size_t spaces = std::min(line.find_first_not_of(' '), line.size());
        const std::size_t wanted = std::clamp<std::size_t>(spaces / 2, 1, level + 1);
        if (wanted > level) body_ += "<ul>\n";
        if (wanted <= level) body_ += "</li>\n";
        for (; level > wanted; --level) body_ += "</ul></li>\n";
        level = wanted;
        body_ += "<li>" + element_text(line.substr(spaces));
    }
    for (; level > 0; --level) body_ += "</li></ul>\n";
}

void PlainPage::legend(const std::vector<Swatch>& swatches) {
    body_ += "<div class=\"legend\">";
    for (const Swatch& swatch : swatches)
        body_ += fmt::format("<span><span class=\"swatch\" style=\"background:#{:02x}{:02x}{:02x}\"></span>{}</span>",
                             swatch.color[0], swatch.color[1], swatch.color[2], element_text(swatch.words));
    body_ += "</div>\n";
}

void PlainPage::scale(std::span<const std::array<std::uint8_t, 3>> colors, const std::vector<Mark>& marks) {
    std::string stops;
    for (const auto& [red, green, blue] : colors) stops += fmt::format(",#{:02x}{:02x}{:02x}", red, green, blue);
    body_ += fmt::format("<div class=\"scale\"><div style=\"background:linear-gradient(to right{})\"></div>", stops);
    for (const Mark& mark : marks)
        body_ += fmt::format("<span style=\"left:{0:.1f}%;transform:translateX(-{0:.1f}%)\">{1}</span>",
                             100 * mark.share, html_text(mark.words));
    body_ += "</div>\n";
}

void PlainPage::table(const Table& table, const std::string& name) {
    body_ += fmt::format(
        "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{0}\"><table class=\"sorts\">"
        "<caption>{0}</caption>\n<thead><tr>",
        element_text(name));
    for (const Column& column : table.columns) body_ += "<th scope=\"col\">" + element_text(column.title) + "</th>";
    body_ += "</tr></thead>\n<tbody>\n";
    for (const auto& row : table.rows) body_ += "<tr>" + cells_of(row) + "</tr>\n";
    body_ += "</tbody></table></div>\n";
}

void PlainPage::add_picture(const std::string& type, const std::string& bytes, const std::string& text, Width width) {
    const std::string encoded = base64(bytes);
    if (body_.size() + encoded.size() > most_picture_bytes) {
        ++left_out_;
        return;
    }
    const char* const wide = width == Width::own ? " class=\"wide\" tabindex=\"0\"" : "";
    body_ += fmt::format("<figure{}><img src=\"data:{};base64,{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n",
                         wide, type, encoded, element_text(text), element_text(text));
}

void PlainPage::picture(const pipeline::Image& image, const std::string& text) {
    add_picture("image/png", scenes::png_bytes(image), text);
}

void PlainPage::picture_with_letters(const pipeline::Image& image, const std::string& text) {
    add_picture("image/png", scenes::png_bytes(image), text, Width::own);
}

std::string PlainPage::html() const {
    std::string page = fmt::format(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, "
        "initial-scale=1\">\n<title>{0}</title>\n<style>\n{2}</style>\n"
        "</head>\n<body>\n<header><h1>{0}</h1><p>{1}</p></header>\n<main>\n{3}",
        element_text(title_), element_text(subtitle_), page_css(), body_);
    if (left_out_ > 0)
        page += fmt::format("<h2>Left out</h2>\n<p>{} pictures, so that this page has at most 8 MiB.</p>\n", left_out_);
    page += fmt::format("</main>\n<script>\n{}</script>\n</body>\n</html>\n", plain_js());
    if (page.size() > most_bytes)
        throw InputError("--report", "size", "an HTML page of at most 8 MiB", std::to_string(page.size()) + " bytes");
    return page;
}

void add_report_option(CLI::App& app, std::string& path) {
    add_path(
        app, path,
        {"--report", "FILE.html", "a page of at most 8 MiB with all of it, which needs no network", "a file name"});
}

void write_page(const std::string& path, const PlainPage& page) {
    if (!path.empty()) scenes::write_file(path, page.html());
}

}  // namespace strata::tools
