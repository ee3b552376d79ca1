// tools/strata/reproduce/reproduce_page.h - what `strata reproduce` leaves in its folder: one page, its tables as CSV, its pictures.
#pragma once
#include <string>
#include <vector>

#include "peeling/render_options.h"
#include "pipeline/formats/image.h"
#include "scenes/scene.h"

namespace strata::tools {

struct Sheet {
    std::string file;  // "table1": table1.csv
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;
};

struct Picture {
    std::string file, caption;
};

struct Section {
    std::string title, text;
    Sheet sheet{};
    std::vector<Picture> pictures{};
};

struct Page {
    std::string title;
    std::vector<Section> sections{};
};

// A model beside the paper's own: what a command line or the models' folder has.
struct Model {
    std::string name;  // the file's, without folder and ending
    scenes::Scene scene;
};

struct ReproduceOptions {
    std::string paper, folder;
    std::vector<std::string> models;  // files
    int size = 256, threads = 0;      // pixels a side
};

// index.html, a CSV for each sheet; the folder exists.
void write_page(const std::string& folder, const Page& page);
// The picture of a finished frame, as `folder`/file.
[[nodiscard]] Picture write_picture(const std::string& folder, const std::string& file, const std::string& caption,
                                    const pipeline::Image& color);

// By pixel: the largest difference of r, g or b, in 1/255.
struct PictureDifference {
    double largest = 0, mean = 0;
    std::uint64_t pixels = 0;  // that differ
};
[[nodiscard]] PictureDifference difference(const pipeline::Image& a, const pipeline::Image& b);

[[nodiscard]] Page reproduce_carr(const ReproduceOptions& options, const std::vector<Model>& models);
[[nodiscard]] Page reproduce_everitt(const ReproduceOptions& options);
[[nodiscard]] Page reproduce_bavoil(const ReproduceOptions& options, const std::vector<Model>& models);

}  // namespace strata::tools
