// tools/strata/explain/explain.cpp - strata explain: prints what every pass of one or more algorithms did at one pixel.
#include <memory>
#include <string>

#include "pipeline/device/check.h"
#include "scenes/files/atomic_file.h"
#include "tools/oracle/explain/history_report.h"
#include "tools/oracle/fragments/form.h"
#include "tools/oracle/judge/asked_picture.h"
#include "tools/oracle/program/drawing/surfaces.h"
#include "tools/oracle/search/edits.h"
#include "tools/strata/command.h"
#include "tools/strata/compare/compare_scene.h"
#include "tools/strata/messages.h"
#include "tools/strata/options/option.h"
#include "tools/strata/options/options.h"
#include "tools/strata/render/run.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

// Of explain --candidate: the fragments that a port composited at one pixel of its picture.
struct CandidateQuestion {
    RunOptions run{};  // of the scene; width and height are replaced by the candidate's
    std::string candidate;
    int x = 0, y = 0;
    bool json = false;
};

// Prints the fragments that the picture composited at the pixel. Returns 0 if the pixel is right, 1 if it is not.
int explain_candidate(CandidateQuestion question) {
    const oracle::Picture picture = oracle::read_picture(question.candidate);
    const oracle::TargetImage& colors = colors_of(picture);
    if (question.x >= colors.width || question.y >= colors.height)
        throw CLI::ValidationError("--pixel", "expected a pixel from 0,0 to " + std::to_string(colors.width - 1) + "," +
                                                  std::to_string(colors.height - 1) + ", found " +
                                                  std::to_string(question.x) + "," + std::to_string(question.y));
    SceneQuestion scene{.run = std::move(question.run), .algorithm = "", .json = question.json};
    const Session session = open_at_size(scene, colors, question.candidate);
    oracle::verdict::SceneFragments fragments{session.request(scene.run.render), scene.run.render.fragment_memory};
    const oracle::verdict::Formed formed = oracle::verdict::formed(fragments, colors, false);
    const oracle::verdict::Colors seen = formed.colors();
    const oracle::verdict::Verdict verdict = judge(fragments, seen);
    oracle::verdict::PixelEdits edits = edits_at(fragments, seen, verdict, question.x, question.y);
    if (!edits.is_right && edits.edits.empty()) {
        const auto value = seen.at(question.x, question.y);
        edits.surface = oracle::program::shown_surface(session.request(scene.run.render), question.x, question.y,
                                                       {value[0], value[1], value[2]});
    }
    print(question.json ? to_json(edits, verdict, session.scene.list) : to_text(edits, verdict, session.scene.list));
    return edits.is_right ? 0 : 1;
}

struct Pixel {
    int x = 0, y = 0;
};

// The options of the command line.
struct ExplainOptions {
    RunOptions run;
    std::optional<Pixel> pixel;
    std::string svg, candidate;
    bool json = false;
};

// Parses "X,Y", in pixels from 0.
std::optional<Pixel> to_pixel(std::string_view text) {
    const auto parts = split(text, ',');
    if (parts.size() != 2) return std::nullopt;
    const auto x = to_int(parts[0]), y = to_int(parts[1]);
    if (!x || !y || *x < 0 || *y < 0) return std::nullopt;
    return Pixel{*x, *y};
}

// The text or the document of all algorithms. Writes --svg.
std::string explained(ExplainOptions& options, const Pixel& pixel) {
    const Session session = open_session(options.run);
    const peeling::FrameRequest request = session.request(options.run.render);
    std::vector<oracle::SampledHistory> histories;
    for (const peeling::Algorithm* algorithm : options.run.algorithms) {
        try {
            histories.push_back(oracle::explain_samples(request, *algorithm, pixel.x, pixel.y));
        } catch (const pipeline::Refused& refused) {
            if (options.run.algorithms.size() == 1) throw;
            say_error(algorithm->name + ": " + refused.what());
        }
    }
    if (histories.empty()) throw CLI::ValidationError("--algorithm", "expected one that the profile does not refuse");
    if (!options.svg.empty()) scenes::write_file(options.svg, oracle::to_svg(oracle::of_sample(histories, 0)));
    if (options.json) return oracle::to_json(histories);
    std::string text;
    for (const oracle::SampledHistory& history : histories) text += oracle::to_text(history);
    for (const std::string& message : oracle::first_differences(histories)) text += message + '\n';
    return text;
}

int explain(ExplainOptions& options) {
    if (!options.candidate.empty()) {
        if (!options.svg.empty()) throw CLI::ValidationError("--svg has no effect with --candidate");
        const auto [x, y] = options.pixel.value_or(Pixel{});
        if (!options.pixel) throw CLI::ValidationError("--candidate needs --pixel X,Y");
        return explain_candidate({options.run, options.candidate, x, y, options.json});
    }
    complete(options.run);
    check_outputs({{"--svg", options.svg, {".svg"}}});
    const Pixel pixel = options.pixel.value_or(Pixel{});
    const int x = pixel.x, y = pixel.y;
    const peeling::RenderOptions& render = options.run.render;
    if (!options.pixel || x >= render.width || y >= render.height)
        throw CLI::ValidationError(
            "--pixel", fmt::format("expected a pixel from 0,0 to {},{}, found {}", render.width - 1, render.height - 1,
                                   options.pixel ? fmt::format("{},{}", x, y) : "none"));
    if (options.run.sampling.samples > 1 && !options.run.sample && !options.svg.empty())
        throw CLI::ValidationError("--svg shows one sample: add --sample N");
    print(explained(options, pixel));
    return 0;
}

}  // namespace

Command add_explain(CLI::App& root) {
    auto* app =
        root.add_subcommand("explain", "show what happened at one pixel: its fragments, and what each pass did");
    const auto options = std::make_shared<ExplainOptions>();
    add_picture_options(*app, options->run);
    add_memory_option(*app, options->run);
    add_option(*app, options->pixel,
               {"--pixel", "X,Y", "the pixel, from the top left", "two whole numbers from 0 such as 320,200"},
               [](std::string_view text) -> std::optional<std::optional<Pixel>> {
                   const auto pixel = to_pixel(text);
                   if (!pixel) return std::nullopt;
                   return pixel;
               });
    add_path(*app, options->svg,
             {"--svg", "FILE.svg", "the column of fragments, and which pass took which, as a drawing", "a file name"});
    add_path(*app, options->candidate,
             {"--candidate", "PICTURE",
              "a port's picture of the scene: show which layers it composited at the pixel, and by which mistake",
              "a file name"});
    app->add_flag("--json", options->json, "one JSON document instead of text: enough to do every step again");
    app->footer(
        "Examples:\n"
        "  strata explain teapot --size 64x48 --pixel 32,24\n"
        "  strata explain volume-beam:slices=4 --algorithm dual,front_to_back --size 32x32 --pixel 16,16 --json "
        "--svg column.svg\n"
        "  strata render teapot --size 64x48 -o port.png && strata explain teapot --candidate port.png --pixel 32,24\n"
        "Exit status: 0 done, 1 --candidate is wrong at the pixel, 2 bad input or usage, 3 the system failed, 130 "
        "interrupted.");
    return {app, [options] { return explain(*options); }};
}

}  // namespace strata::tools
