// tools/strata/render/render.cpp - strata render: renders the picture of one or more algorithms.
#include "peeling/render.h"

#include <memory>

#include "scenes/files/image_io.h"
#include "tools/oracle/emulations/catalogue.h"
#include "tools/oracle/emulations/mistake_renderer.h"
#include "tools/strata/command.h"
#include "tools/strata/messages.h"
#include "tools/strata/options/option.h"
#include "tools/strata/recorded_command.h"
#include "tools/strata/render/map.h"
#include "tools/strata/render/run.h"
#include "tools/strata/report/plain_page.h"
#include "tools/strata/report/report_page.h"

namespace strata::tools {

namespace {

struct RenderCommand {
    RunOptions run;
    std::vector<const oracle::Mistake*> mistakes;
    std::optional<Map> map;
    std::string report;  // path of the --report page; empty: none
};

// A map is written instead of the picture, and its recorded command renders the map again.
void write_map(const RunOptions& options, Map map, const CompletedRun& finished) {
    const MapPicture picture = map_of(map, options, finished);
    scenes::Attributes attributes = attributes_of("render", options, finished);
    attributes["command"] += " --map " + name_of(map_names(), map);
    scenes::write_image(path_for(options.output, options, finished.algorithm),
                        {.color = picture.image, .attributes = attributes}, scenes::ImageFile::png);
    say_note(legend_of(map, picture));
}

// Without -o no picture is written: the statistics are the result.
void write_picture(const RunOptions& options, const CompletedRun& finished) {
    if (options.output.empty()) return;
    scenes::write_image(path_for(options.output, options, finished.algorithm),
                        {.color = finished.result.frame.color,
                         .depth = finished.result.frame.depth,
                         .premultiplied = true,  // either form is right, because a finished frame's alpha is 1
                         .space = options.scene_options.color_space,
                         .attributes = attributes_of("render", options, finished)},
                        kind_of(options, scenes::ImageFile::png));
}

// Parses names separated by commas, as `strata diagnose --list` shows them.
std::vector<const oracle::Mistake*> to_mistakes(const std::string& text) {
    std::vector<const oracle::Mistake*> chosen;
    std::vector<std::string> names;
    for (const oracle::Mistake& mistake : oracle::catalogue()) names.emplace_back(mistake.name);
    for (const std::string& name : split(text, ',')) {
        const oracle::Mistake* const mistake = oracle::find_mistake(name);
        if (mistake == nullptr)
            throw CLI::ValidationError(
                "--mistake",
                "expected names of mistakes (strata diagnose --list shows them), found " + found_but_near(name, names));
        chosen.push_back(mistake);
    }
    return chosen;
}

// Renders the picture of a simulated renderer with mistakes. It prints no statistics, because they would be wrong, too.
int render_mistaken(RunOptions& options, const std::vector<const oracle::Mistake*>& mistakes) {
    complete(options);
    if (options.algorithms.size() != 1) throw CLI::ValidationError("--mistake takes one algorithm");
    if (options.output.empty()) throw CLI::ValidationError("--mistake needs -o FILE");
    const Session session = open_session(options);
    const oracle::MistakeRenderer mistake_renderer{session.request(options.render), *options.algorithms[0]};
    const auto picture = mistake_renderer.with(mistakes);
    if (!picture)
        throw CLI::ValidationError("--mistake",
                                   "expected a mistake that can occur with this scene, algorithm and profile, found '" +
                                       std::string(mistakes.front()->name) + "'");
    std::string names;
    for (const oracle::Mistake* mistake : mistakes) names += (names.empty() ? "" : ",") + std::string(mistake->name);
    if (picture->targets[0].codes == mistake_renderer.right().targets[0].codes)
        say_warning(
            "--mistake " + names +
            " changes no pixel of this picture; strata diagnose --list --suite lists scenes that show mistakes");
    scenes::write_image(options.output, {.color = oracle::color_image(*picture),
                                         .premultiplied = true,
                                         .space = options.scene_options.color_space,
                                         .attributes = {{"mistake", names}}});
    return 0;
}

// Statistics, maps and reports describe the algorithm, not a renderer with mistakes.
void check_effects(const RenderCommand& command) {
    const RunOptions& options = command.run;
    if (!command.mistakes.empty())
        for (const auto& [name, is_given] :
             {std::pair{"--stats", !options.stats.empty()}, std::pair{"--map", command.map.has_value()},
              std::pair{"--report", !command.report.empty()}})
            if (is_given) throw CLI::ValidationError(std::string(name) + " has no effect with --mistake");
    if (options.render.counters && options.stats.empty())
        throw CLI::ValidationError("--counters has no effect without --stats");
}

int render(RenderCommand& command) {
    RunOptions& options = command.run;
    const std::vector<std::string> pictures{".exr", ".png"}, map_endings{".png"};
    check_outputs({{"-o", options.output, command.map ? map_endings : pictures, StandardOutput::possibly},
                   {"--report", command.report, {".html"}}});
    check_effects(command);
    if (command.map && options.output.empty()) throw CLI::ValidationError("--map needs -o FILE.png");
    if (!command.mistakes.empty()) return render_mistaken(options, command.mistakes);
    const int status = run_algorithms(options, [&](const CompletedRun& finished) {
        command.map ? write_map(options, *command.map, finished) : write_picture(options, finished);
    });
    if (status == 0 && !command.report.empty()) write_report(options, command.report);
    return status;
}

}  // namespace

Command add_render(CLI::App& root) {
    auto* app = root.add_subcommand(
        "render", "render a scene by one or more algorithms and compare each with the exact A-buffer");
    const auto options = std::make_shared<RenderCommand>();
    add_picture_options(*app, options->run);
    add_from_option(*app, options->run.files_in);
    add_execution_options(*app, options->run);
    add_output_options(*app, options->run,
                       "the picture, .exr or .png; with several algorithms out.NAME.png; - is standard output");
    add_format_option(*app, options->run, "what -o - writes (default png)");
    app->add_option_function<std::string>(
           "--mistake", [options = options.get()](const std::string& text) { options->mistakes = to_mistakes(text); },
           "render with these mistakes, to try strata diagnose (strata diagnose --list shows them)")
        ->type_name("NAME[,NAME...]");
    add_choice(*app, options->map, "--map", map_names(),
               "write a map as the .png of -o: fragments a pixel, fragments at another one's depth, or the difference "
               "from the exact A-buffer");
    add_report_option(*app, options->report);
    app->footer(
        footer("  strata render teapot --size 400x300 -o teapot.png\n"
               "  strata render volume-beam:slices=16 --algorithm all --profile ideal --size 200x150\n"
               "  strata render teapot --algorithm dual,weighted_average --size 200x150 --stats - -o teapot.exr\n"));
    return {app, [options] { return render(*options); }};
}

}  // namespace strata::tools
