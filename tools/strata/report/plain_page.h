// tools/strata/report/plain_page.h - a page of text, tables and pictures in one file, in the report's style: what
// --report of a command writes.
//
// Rule     One file of at most 8 MiB that opens from a disk and loads nothing. Headings of tables sort them, by mouse
//          and by keyboard; the page says all that it has to say without its script. What is left out to stay within 8
//          MiB stands at the end.
// Tests    tests/tools/plain_page_test.cpp, tests/browser/plain_pages.py
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

    void sentence(const std::string& text);  // what was found: the first thing that is read
    void heading(const std::string& text);
    void paragraph(const std::string& text);
    void items(const std::vector<std::string>& texts);  // a list
    struct Swatch {
        std::array<std::uint8_t, 3> color;  // red, green, blue
        std::string words;
    };
    void legend(const std::vector<Swatch>& swatches);  // of the picture before it
    // A bar of colours that lead from one to the next in even steps, and numbers below it, each at its share of the
    // way.
    struct Mark {
        double share;  // 0 to 1
        std::string words;
    };
    void scale(std::span<const std::array<std::uint8_t, 3>> colors, const std::vector<Mark>& marks);
    void table(const Table& table, const std::string& name);
    // rgba8. `text` is said to those who do not see it, and stands below it.
    void picture(const pipeline::Image& image, const std::string& text);
    // The same in its own size, however narrow the screen: for a picture with letters in it.
    void picture_with_letters(const pipeline::Image& image, const std::string& text);
    // A file's own bytes: .png or .svg.
    void picture_file(const std::string& path, const std::string& text);

    // The whole page. InputError if even without pictures it is too large.
    [[nodiscard]] std::string html() const;

  private:
    enum class Width : std::uint8_t { fits, own };
    void add_picture(const std::string& type, const std::string& bytes, const std::string& text,
                     Width width = Width::fits);

    std::string title_, subtitle_, body_;
    std::size_t left_out_ = 0;  // pictures
};

// &, <, > and " as HTML has them; control characters as `printable` has them, but for line ends.
[[nodiscard]] std::string html_text(const std::string& text);

// --report FILE.html.
void add_report_option(CLI::App& app, std::string& path);
// For its value, which is empty for none.
void write_page(const std::string& path, const PlainPage& page);

}  // namespace strata::tools
