// tools/lab/reproduce/figures.h - the output of `strata reproduce`: the content of a page as page.json, its tables as
// CSV, its images. tools/lab/reproduce/page.py makes the page and its charts.
//
// Tests    tests/tools/lab/reproduce/figures_test.cpp, tests/tools/lab/reproduce/page_test.py
#pragma once
#include <string>
#include <vector>

#include "peeling/render_options.h"
#include "pipeline/formats/image.h"
#include "scenes/scene.h"
#include "tools/strata/papers.h"

namespace strata::tools {

// A table of a page. Every row has as many cells as there are columns.
struct Sheet {
    // The CSV's name without its ending: "table1" becomes table1.csv in the page's folder.
    std::string file;
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;
};

// A file in the page's folder, and its caption.
struct FigureFile {
    std::string file, caption;
};

// Both axes are logarithmic: x and y are above 0.
struct CurvePoint {
    double x, y;
};
struct Curve {
    std::string name;
    std::vector<CurvePoint> points{};
};
struct Chart {
    std::string name;  // of its file, without ending
    std::string x_label, y_label;
    std::vector<Curve> curves{};
};

// A heading, a paragraph, a table (none without rows), charts and images.
struct Section {
    std::string title, text;
    Sheet sheet{};
    std::vector<FigureFile> pictures{};
    std::vector<Chart> charts{};
};

// The sentence on every page.
inline constexpr const char* page_note =
    "The paper's figures and tables by its algorithms on the devices that it was written for, next to the paper's own "
    "numbers where it has any, and why "
    "ours differ where they do.";

// The page of one paper: its sections from top to bottom.
struct Page {
    std::string title;
    std::string lead;       // the content of the page
    std::string_view link;  // a link to the paper
    std::vector<Section> sections{};
};

// A model given on the command line.
struct Model {
    // The file's name without folder and ending; Table 1 of Carr et al. looks its rows up by it.
    std::string name;
    scenes::Scene scene;
};

// The command line: `paper` is one of the names in reproduce.cpp, `folder` receives the page.
struct ReproduceOptions {
    std::string paper, folder;
    std::vector<std::string> models;  // files
    // Pixels per side of the images, 1 to 4096; maximum number of threads, 0: all.
    int size = 256, threads = 0;
};

// Writes page.json and a CSV per sheet; the folder must exist.
void write_figures(const std::string& folder, const Page& page);
// Whether an image's colours are premultiplied: a finished frame's are, a layer's as stated by its algorithm.
enum class ColorForm : std::uint8_t { premultiplied, straight };
// Writes an image to `folder`/file with 8-bit colours that are not premultiplied.
[[nodiscard]] FigureFile write_picture(const std::string& folder, const std::string& file, const std::string& caption,
                                       const pipeline::Image& color, ColorForm form = ColorForm::premultiplied);

// The difference of two images of one size. A pixel's difference is the largest of its r, g and b, in 1/255.
struct PictureDifference {
    double largest = 0, mean = 0;
    // The number of pixels that differ.
    std::uint64_t pixels = 0;
};
[[nodiscard]] PictureDifference difference(const pipeline::Image& a, const pipeline::Image& b);

// The three pages. Each renders its scenes and writes its images into the folder, which must exist.
[[nodiscard]] Page reproduce_carr(const ReproduceOptions& options, const std::vector<Model>& models);
[[nodiscard]] Page reproduce_everitt(const ReproduceOptions& options);
[[nodiscard]] Page reproduce_bavoil(const ReproduceOptions& options, const std::vector<Model>& models);

}  // namespace strata::tools
