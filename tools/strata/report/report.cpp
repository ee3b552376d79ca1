// tools/strata/report/report.cpp - strata report: one page that shows a scene by every algorithm, pixel by pixel.
#include <filesystem>
#include <memory>

#include "rasterizer/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "tools/strata/command.h"
#include "tools/strata/options/option.h"
#include "tools/strata/report/report_page.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

constexpr int usual_width = 256, usual_height = 192;

int report(RunOptions& options, bool has_size) {
    if (!has_size) options.render.width = usual_width, options.render.height = usual_height;
    complete(options);
    if (options.output.empty()) throw CLI::ValidationError("-o", "expected a folder for report.html, found none");
    const Session session = open_session(options);
    const ReportData data = report_data(options, session);
    for (const auto& entry : data.document["algorithms"])
        if (!data.has_run)
            std::fprintf(stderr, "strata: %s: %s\n", entry["name"].get_ref<const std::string&>().c_str(),
                         entry["refusal"].get_ref<const std::string&>().c_str());
    if (!data.has_run) return 2;
    const std::string page = report_page(data);
    if (page.size() > most_bytes)
        throw InputError("report", "size", "a page of at most 8 MiB; a smaller --size or fewer algorithms have one",
                         std::to_string(page.size()) + " bytes");
    std::filesystem::create_directories(options.output);
    const std::string path = (std::filesystem::path(options.output) / "report.html").string();
    scenes::write_file(path, page);
    print(path + ": " + std::to_string((page.size() + 1023) / 1024) + " KiB, opens in any browser, needs no network\n");
    for (const auto& sentence : data.document["left_out"]) print("left out: " + sentence.get<std::string>() + "\n");
    return 0;
}

}  // namespace

Command add_report(CLI::App& root) {
    auto* app = root.add_subcommand("report", "write one page that shows a scene by every algorithm, pixel by pixel");
    const auto options = std::make_shared<RunOptions>();
    options->default_algorithm = "all";
    add_picture_options(*app, *options);
    add_resource_options(*app, *options);
    add_path(*app, options->output, {"-o", "FOLDER", "gets report.html: one file of at most 8 MiB", "a folder's name"});
    app->get_option("--size")->description("pixels (default 256x192)");
    app->footer(
        footer("  strata report teapot --size 64x48 -o report\n"
               "  strata report volume-beam:slices=4 --algorithm dual,weighted_average --size 64x48 -o beam\n"));
    return {app, [app, options] { return report(*options, app->count("--size") > 0); }};
}

}  // namespace strata::tools
