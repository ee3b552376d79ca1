// tools/lab/reproduce/reproduce_page.h - what `strata reproduce` leaves in its folder: one page, its tables as
// CSV, its pictures.
#pragma once
#include <string>
#include <vector>

#include "peeling/render_options.h"
#include "pipeline/formats/image.h"
#include "scenes/scene.h"
#include "tools/strata/papers.h"

namespace strata::tools {

// A table of a page. Every row has a cell for every column.
struct Sheet {
    // The CSV's name without its ending: "table1" becomes table1.csv in the page's folder.
    std::string file;
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;
};

// A file in the page's folder, and the words under it.
struct Picture {
    std::string file, caption;
};

// A heading, a paragraph, a table (without rows: none) and pictures.
struct Section {
    std::string title, text;
    Sheet sheet{};
    std::vector<Picture> pictures{};
};

// The sentence of every page.
inline constexpr const char* page_sentence =
    "The paper's figures and tables by its algorithms on the devices that it was written for, next to the paper's own "
    "numbers where it has any, and why "
    "ours differ where they do.";

// The page of one paper: its sections from top to bottom.
struct Page {
    std::string title;
    std::string sentence;   // what the page shows
    std::string_view link;  // where the paper is to be had
    std::vector<Section> sections{};
};

// A model that the command line gave, beside the paper's own.
struct Model {
    // The file's name without folder and ending; Table 1 of Carr et al. looks its rows up by it.
    std::string name;
    scenes::Scene scene;
};

// The command line: `paper` is one of the names in reproduce.cpp, `folder` takes the page.
struct ReproduceOptions {
    std::string paper, folder;
    std::vector<std::string> models;  // files
    // Pixels a side of the pictures, 1 to 4096; threads at most, 0 being all.
    int size = 256, threads = 0;
};

// index.html, a CSV for each sheet; the folder exists.
void write_page(const std::string& folder, const Page& page);
// Whether a picture's colours are times their alpha: a finished frame's are, a layer's as its algorithm says.
enum class ColorForm : std::uint8_t { premultiplied, straight };
// A picture as `folder`/file, whose 8-bit colours are straight.
[[nodiscard]] Picture write_picture(const std::string& folder, const std::string& file, const std::string& caption,
                                    const pipeline::Image& color, ColorForm form = ColorForm::premultiplied);

// How far two pictures of one size are apart. A pixel's difference is the largest of its r, g and
// b, in 1/255.
struct PictureDifference {
    double largest = 0, mean = 0;
    // The number of pixels that differ.
    std::uint64_t pixels = 0;
};
[[nodiscard]] PictureDifference difference(const pipeline::Image& a, const pipeline::Image& b);

// The three pages. Each renders its scenes and writes its pictures into the folder, which exists.
[[nodiscard]] Page reproduce_carr(const ReproduceOptions& options, const std::vector<Model>& models);
[[nodiscard]] Page reproduce_everitt(const ReproduceOptions& options);
[[nodiscard]] Page reproduce_bavoil(const ReproduceOptions& options, const std::vector<Model>& models);

}  // namespace strata::tools
