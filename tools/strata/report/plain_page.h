// tools/strata/report/plain_page.h - builds an HTML page of text, tables and pictures in one file, for the --report
// option of commands.
//
// Rule     The page is one file of at most 8 MiB, which can be opened from disk and loads no other file. Clicking or
//          activating a table heading sorts the table; without scripts the page still shows all its contents. Contents
//          that are left out because of the limit are listed at the end.
// Tests    tests/tools/strata/report/plain_page_test.cpp, tests/browser/plain_pages.py
#pragma once
#include <CLI/CLI.hpp>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "pipeline/formats/image.h"
#include "tools/strata/table.h"

namespace strata::tools {

class PlainPage {
  public:
    PlainPage(const std::string& title, const std::string& subtitle);

    void lead(const std::string& text);  // the main result, at the top
    void heading(const std::string& text);
    void paragraph(const std::string& text);
    void items(const std::vector<std::string>& texts);  // a list with bullets
    // A list whose items are indented by two spaces a level, as a command prints them.
    void indented_items(const std::vector<std::string>& lines);
    // Pictures that stand next to each other, two in a row, and next to them, where the page is wide enough, what is
    // added between beside_pictures() and end_pictures().
    void begin_pictures() { body_ += "<div class=\"beside\">\n<div class=\"pictures\">\n"; }
    void beside_pictures() { body_ += "</div>\n<div>\n"; }
    void end_pictures() { body_ += "</div>\n</div>\n"; }
    // Pictures that stand next to each other, three in a row, until end_row().
    void begin_row() { body_ += "<div class=\"pictures three\">\n"; }
    void end_row() { body_ += "</div>\n"; }
    struct Swatch {
        std::array<std::uint8_t, 3> color;  // red, green, blue
        std::string words;
    };
    void legend(const std::vector<Swatch>& swatches);  // for the picture before it
    // A colour bar that interpolates linearly between the given colours, and numbers below it, each at its relative
    // position.
    struct Mark {
        double share;  // position on the bar, 0 to 1
        std::string words;
    };
    void scale(std::span<const std::array<std::uint8_t, 3>> colors, const std::vector<Mark>& marks);
    void table(const Table& table, const std::string& name);
    // An rgba8 picture. `text` is its alternative text for screen readers and its caption.
    void picture(const pipeline::Image& image, const std::string& text);
    // The same of a PNG file's bytes.
    void png_picture(const std::string& png, const std::string& text) { add_picture("image/png", png, text); }
    // The same at its own size on any screen width, for a picture that contains text.
    void picture_with_letters(const pipeline::Image& image, const std::string& text);

    // The whole page. Throws InputError if it exceeds the limit even without pictures.
    [[nodiscard]] std::string html() const;

  private:
    enum class Width : std::uint8_t { fits, own };
    void add_picture(const std::string& type, const std::string& bytes, const std::string& text,
                     Width width = Width::fits);

    std::string title_, subtitle_, body_;
    std::size_t left_out_ = 0;  // number of pictures left out
};

// Escapes &, <, > and " for HTML, and control characters except line ends as in `printable`.
[[nodiscard]] std::string html_text(const std::string& text);

// Adds the option --report FILE.html.
void add_report_option(CLI::App& app, std::string& path);
// Writes the page to the option's path; does nothing if that is empty.
void write_page(const std::string& path, const PlainPage& page);

}  // namespace strata::tools
