#include "tools/lab/reproduce/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "scenes/files/atomic_file.h"
#include "scenes/files/image_io.h"
#include "tools/lab/sweep/csv.h"

namespace strata::tools {

using nlohmann::ordered_json;

namespace {

// A header line and one line per row.
std::string csv(const Sheet& sheet) {
    std::string text;
    const auto add = [&](const std::vector<std::string>& cells) {
        std::vector<std::string> fields;
        for (const std::string& cell : cells) fields.push_back(csv_field(cell));
        text += fmt::format("{}\n", fmt::join(fields, ","));
    };
    add(sheet.columns);
    for (const auto& row : sheet.rows) add(row);
    return text;
}

ordered_json to_json(const Chart& chart) {
    ordered_json curves = ordered_json::array();
    for (const Curve& curve : chart.curves) {
        ordered_json points = ordered_json::array();
        for (const CurvePoint& p : curve.points) points.push_back({p.x, p.y});
        curves.push_back({{"name", curve.name}, {"points", points}});
    }
    return {{"name", chart.name}, {"x_label", chart.x_label}, {"y_label", chart.y_label}, {"curves", curves}};
}

ordered_json to_json(const Section& section) {
    ordered_json pictures = ordered_json::array(), charts = ordered_json::array();
    for (const FigureFile& picture : section.pictures)
        pictures.push_back({{"file", picture.file}, {"caption", picture.caption}});
    for (const Chart& chart : section.charts) charts.push_back(to_json(chart));
    const bool has_table = !section.sheet.rows.empty();
    return {{"title", section.title},
            {"text", section.text},
            {"table", has_table ? ordered_json(section.sheet.file + ".csv") : ordered_json(nullptr)},
            {"charts", charts},
            {"pictures", pictures}};
}

}  // namespace

void write_figures(const std::string& folder, const Page& page) {
    ordered_json sections = ordered_json::array();
    for (const Section& section : page.sections) {
        sections.push_back(to_json(section));
        if (!section.sheet.rows.empty())
            scenes::write_file(folder + '/' + section.sheet.file + ".csv", csv(section.sheet));
    }
    const ordered_json document{
        {"title", page.title}, {"lead", page.lead}, {"link", page.link}, {"sections", sections}};
    scenes::write_file(folder + "/page.json",
                       document.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n');
}

FigureFile write_picture(const std::string& folder, const std::string& file, const std::string& caption,
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
