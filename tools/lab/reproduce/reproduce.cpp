// tools/lab/reproduce/reproduce.cpp - strata reproduce: compares a paper's figures and tables with measured results.
#include <filesystem>
#include <memory>

#include "rasterizer/base/input_error.h"
#include "tools/lab/commands.h"
#include "tools/lab/reproduce/figures.h"
#include "tools/request/names.h"
#include "tools/strata/options/option.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

// The papers that have a page, in the order of error messages.
const std::vector<std::string> papers{"carr2008", "everitt2001", "bavoil2008"};

// Reads every model before anything is drawn, so that a wrong file ends the command at once. Throws InputError.
std::vector<Model> load_models(const ReproduceOptions& options) {
    std::vector<Model> models;
    for (const std::string& path : options.models)
        models.push_back({std::filesystem::path(path).stem().string(), scenes::load_scene(path, {})});
    return models;
}

// Everitt's figures only show the teapot: no models are loaded for them.
Page page_of(const ReproduceOptions& options) {
    if (options.paper == "everitt2001") return reproduce_everitt(options);
    const std::vector<Model> models = load_models(options);
    return options.paper == "carr2008" ? reproduce_carr(options, models) : reproduce_bavoil(options, models);
}

// The exit status is 0, or the command throws.
int reproduce(const ReproduceOptions& options) {
    if (std::find(papers.begin(), papers.end(), options.paper) == papers.end())
        throw CLI::ValidationError("PAPER",
                                   "expected " + one_of(papers) + ", found " + found_but_near(options.paper, papers));
    // Whether the folder could be created is checked afterwards, because it may already exist.
    std::error_code failed;
    std::filesystem::create_directories(options.folder, failed);
    if (!std::filesystem::is_directory(options.folder))
        throw CLI::ValidationError("-o",
                                   "expected a folder that exists or can be made, found '" + options.folder + "'");
    write_figures(options.folder, page_of(options));
    print(options.folder + "/page.json; page: tools/lab/reproduce/page.py " + options.folder + '\n');
    return 0;
}

}  // namespace

Command add_reproduce(CLI::App& root) {
    auto* app = add_lab_command(root, "reproduce");
    const auto options = std::make_shared<ReproduceOptions>();
    app->add_option("PAPER", options->paper, "carr2008, everitt2001 or bavoil2008")->required()->type_name("");
    app->add_option("MODEL", options->models,
                    "glTF files to run with the built-in scenes (dragon.glb, sponza.glb, a car ...)")
        ->type_name("");
    add_path(*app, options->folder,
             {"-o,--output", "DIR", "folder for page.json, tables as CSV and pictures", "a folder"})
        ->required();
    add_option(*app, options->size,
               {"--size", "N", "pixels a side of the pictures (default 256)", "a whole number from 1 to 4096"},
               [](std::string_view text) {
                   const auto size = to_positive(text);
                   return size && *size <= 4096 ? size : std::nullopt;
               });
    app->footer(footer(
        "  strata reproduce everitt2001 -o everitt --size 128\n  strata reproduce bavoil2008 -o bavoil --size 128\n"));
    return {app, [options] { return reproduce(*options); }};
}

}  // namespace strata::tools
