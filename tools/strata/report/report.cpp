// tools/strata/report/report.cpp - strata report: writes one HTML page that shows a scene rendered by every algorithm,
// pixel by pixel.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "rasterizer/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/unfinished_files.h"
#include "tools/strata/command.h"
#include "tools/strata/messages.h"
#include "tools/strata/options/option.h"
#include "tools/strata/render/memory.h"
#include "tools/strata/report/report_page.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

constexpr int usual_width = 256, usual_height = 192, most_side = 256;

struct ReportOptions {
    RunOptions run;
    std::optional<rasterizer::Rect> region;
};

// The requested region, which must be inside the frame; by default the whole frame.
rasterizer::Rect region_of(const ReportOptions& options) {
    const int width = options.run.render.width, height = options.run.render.height;
    const rasterizer::Rect region = options.region.value_or(rasterizer::Rect{0, 0, width, height});
    if (region.x1 > width || region.y1 > height)
        throw CLI::ValidationError("--region",
                                   fmt::format("expected pixels within the frame of {}x{}, found columns {} to {} and "
                                               "rows {} to {}",
                                               width, height, region.x0, region.x1 - 1, region.y0, region.y1 - 1));
    return region;
}

std::string checked_page(const ReportData& data) {
    std::string page = report_page(data);
    if (page.size() > most_bytes)
        throw InputError("report", "size",
                         "a page of at most 8 MiB (a smaller --size or --region or fewer algorithms make it smaller)",
                         std::to_string(page.size()) + " bytes");
    return page;
}

// The path of the page: -o names FILE.html, or a folder in which report.html is written.
std::filesystem::path page_of(const std::string& output) {
    return output.ends_with(".html") ? std::filesystem::path(output) : std::filesystem::path(output) / "report.html";
}

int report(ReportOptions& command, bool has_size) {
    RunOptions& options = command.run;
    if (!has_size && !command.region) options.render.width = usual_width, options.render.height = usual_height;
    complete(options);
    options.render.counters = true;  // the page's table shows them
    if (options.output.empty()) throw CLI::ValidationError("-o is missing: the page, FILE.html, or a folder for it");
    const rasterizer::Rect region = region_of(command);
    const std::filesystem::path path = page_of(options.output);
    scenes::set_interrupt_message("not written: " + path.string());
    const Session session = open_session(options);
    for (const peeling::Algorithm* algorithm : options.algorithms)
        if (!command.region) check_memory(options, session, *algorithm);
    const ReportData data = report_data(options, session, region);
    for (const auto& entry : data.document["algorithms"])
        if (!data.has_run) say_error(entry["name"].get<std::string>() + ": " + entry["refusal"].get<std::string>());
    if (!data.has_run) return 2;
    const std::string page = checked_page(data);
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
    scenes::write_file(path.string(), page);
    scenes::set_interrupt_message("");
    if (is_quiet()) return 0;
    print(path.string() + ": " + std::to_string((page.size() + 1023) / 1024) +
          " KiB, opens in any browser, needs no network\n");
    for (const auto& message : data.document["left_out"]) print("left out: " + message.get<std::string>() + "\n");
    return 0;
}

}  // namespace

void write_report(RunOptions& options, const std::string& path) {
    const int width = std::min(options.render.width, most_side), height = std::min(options.render.height, most_side);
    const int x = (options.render.width - width) / 2, y = (options.render.height - height) / 2;
    scenes::set_interrupt_message("not written: " + path);
    options.render.counters = true;
    const Session session = open_session(options);
    scenes::write_file(path, checked_page(report_data(options, session, {x, y, x + width, y + height})));
    scenes::set_interrupt_message("");
}

Command add_report(CLI::App& root) {
    auto* app = root.add_subcommand("report", "write one page that shows a scene by every algorithm, pixel by pixel");
    const auto options = std::make_shared<ReportOptions>();
    options->run.default_algorithm = "all";
    add_picture_options(*app, options->run);
    add_memory_option(*app, options->run);
    add_options(*app, options->run, OptionGroup::resources);
    add_option(*app, options->region,
               {"--region", "X,Y,W,H", "show these pixels of the frame of --size alone (default: all)",
                "four whole numbers such as 400,300,200,150: left, top, width and height"},
               to_region);
    add_path(*app, options->run.output,
             {"-o,--output", "FILE.html|FOLDER", "the page, of at most 8 MiB; a folder gets report.html", "a name"});
    app->get_option("--size")->description("pixels (default 256x192; with --region 1024x1024)");
    app->footer(
        footer("  strata report teapot --size 64x48 -o report\n"
               "  strata report teapot --size 640x480 --region 240,180,160,120 --algorithm dual,unsorted -o part.html\n"
               "  strata report volume-beam:slices=4 --algorithm dual,weighted_average --size 64x48 -o beam\n"));
    return {app, [app, options] { return report(*options, app->count("--size") > 0); }};
}

}  // namespace strata::tools
