// tools/lab/probe/infer.cpp - strata infer: infers the profile of a device from its answers to the probe kit.
#include "tools/lab/probe/search/infer.h"

#include <fmt/format.h>

#include <memory>

#include "rasterizer/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/profile_json.h"
#include "tools/lab/commands.h"
#include "tools/lab/probe/items.h"
#include "tools/strata/messages.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

using nlohmann::ordered_json;
using probe::FieldFinding;
using probe::FieldState;
using probe::Inference;

// The command line.
struct InferOptions {
    std::string pack, output;
    std::optional<probe::YDirection> orientation{};  // if absent: up, or down if the pack only has that
    bool json = false;
};

std::string runners_up(const FieldFinding& finding) {
    std::string text;
    for (std::size_t i = 0; i < finding.runners_up.size() && i < 2; ++i)
        text +=
            fmt::format("{}{} {}", text.empty() ? "" : ", ", finding.runners_up[i].value, finding.runners_up[i].agree);
    return text;
}

std::string evidence(const FieldFinding& finding) {
    if (finding.places == 0) return finding.reason;
    const bool says_why = finding.state == FieldState::broken && !finding.reason.empty();
    return fmt::format("{} of {}{}{}", finding.agree, finding.places, says_why ? "; " : "",
                       says_why ? finding.reason : "");
}

std::size_t count(const Inference& result, FieldState state) {
    return static_cast<std::size_t>(std::ranges::count(result.fields, state, &FieldFinding::state));
}

std::string place_text(const probe::Contradiction& c) {
    return fmt::format("{} of {} at {},{}", c.target, c.item, c.x, c.y);
}

// The differences that the profile leaves, scene by scene, and the fields whose evidence they invalidate.
std::string left_over(const Inference& result) {
    std::string text;
    for (const FieldFinding& f : result.fields)
        if (f.broken)
            text += fmt::format("evidence of {} is broken in {} of {} places, first the {}\n", f.key,
                                f.places - f.agree, f.places, place_text(*f.broken));
    for (const probe::Unexplained& u : result.unexplained) {
        text += fmt::format("not explained: {} of {} pixels of {}, first the {}", u.tally.all - u.tally.equal,
                            u.tally.all, u.item, place_text(u.first));
        text += u.nearest.empty() ? "; no change of one field explains more\n"
                                  : fmt::format("; {} would leave {}\n", u.nearest, u.left);
    }
    for (const auto& [item, reason] : result.missing) text += fmt::format("not drawn: {}: {}\n", item, reason);
    return text;
}

std::string to_text(const Inference& result) {
    Table table{{{"field"}, {"value"}, {"state"}, {"evidence"}, {"runners-up"}}, {}};
    for (const FieldFinding& f : result.fields)
        if (f.state != FieldState::stated)
            table.rows.push_back({f.key, f.value, std::string{probe::name(f.state)}, evidence(f), runners_up(f)});
    return tools::to_text(table) +
           fmt::format("{} fields inferred, {} broken, {} open; {} of {} pixels agree\n",
                       count(result, FieldState::inferred), count(result, FieldState::broken),
                       count(result, FieldState::open), result.tally.equal, result.tally.all) +
           left_over(result);
}

ordered_json place_json(const probe::Contradiction& c) {
    return {{"scene", c.item}, {"target", c.target}, {"pixel", {c.x, c.y}}};
}

ordered_json field_json(const FieldFinding& f) {
    ordered_json json{{"field", f.key},       {"value", f.value},   {"state", probe::name(f.state)},
                      {"agree", f.agree},     {"places", f.places}, {"runners_up", ordered_json::array()},
                      {"broken_at", nullptr}, {"reason", f.reason}};
    for (const probe::ValueCount& v : f.runners_up)
        json["runners_up"].push_back({{"value", v.value}, {"agree", v.agree}});
    if (f.broken) json["broken_at"] = place_json(*f.broken);
    return json;
}

ordered_json to_json(const Inference& result) {
    ordered_json json{{"orientation", probe::name(result.orientation)},
                      {"pixels", result.tally.all},
                      {"agree", result.tally.equal},
                      {"fields", ordered_json::array()},
                      {"unexplained", ordered_json::array()},
                      {"not_drawn", ordered_json::array()}};
    for (const FieldFinding& f : result.fields) json["fields"].push_back(field_json(f));
    for (const probe::Unexplained& u : result.unexplained)
        json["unexplained"].push_back({{"scene", u.item},
                                       {"pixels", u.tally.all},
                                       {"differ", u.tally.all - u.tally.equal},
                                       {"first", place_json(u.first)},
                                       {"nearest", u.nearest},
                                       {"left", u.left}});
    for (const auto& [item, reason] : result.missing)
        json["not_drawn"].push_back({{"scene", item}, {"reason", reason}});
    json["profile"] = ordered_json::parse(scenes::to_json(result.profile));
    return json;
}

int run(const InferOptions& options) {
    const std::vector<probe::Item>& items = probe::kit();
    const probe::ProbePack pack = probe::read_pack(options.pack, items);
    using enum probe::YDirection;
    const probe::YDirection y = options.orientation.value_or(pack.answers.contains(up) ? up : down);
    if (!pack.answers.contains(y))
        throw InputError(options.pack, "probe/" + std::string{probe::name(y)},
                         options.orientation ? "answers of that orientation (--y names another)" : "answers", "none");
    const Inference result = probe::infer(pack, items, y);
    std::vector<std::string> open;
    for (const FieldFinding& f : result.fields)
        if (f.state == FieldState::open) open.push_back(f.key);
    if (!options.output.empty()) scenes::write_file(options.output, scenes::to_json(result.profile, open));
    const std::string told = options.json ? to_json(result).dump(1) + "\n" : to_text(result);
    scenes::is_standard_output(options.output) ? say_note(told) : print(told);
    return 0;
}

}  // namespace

Command add_infer(CLI::App& root) {
    auto* app = add_lab_command(root, "infer");
    const auto options = std::make_shared<InferOptions>();
    add_path(*app, options->pack, {"PACK", "", "answers: a folder or a tar archive of it", "a folder or an archive"})
        ->required();
    add_path(*app, options->output,
             {"-o,--output", "FILE.json", "the profile, as --profile takes it; - is standard output", "a file's name"});
    add_orientation(*app, options->orientation,
                    "the answers that count, and the origin of the profile (default up; down if there are no others)");
    app->add_flag("--json", options->json, "print one JSON object instead of the table");
    app->footer(
        footer("  strata probe --profile softpipe -o softpipe && strata infer softpipe -o profile.json\n"
               "  strata probe --profile geforce8 -o answers && strata infer answers --y down --json > found.json\n"));
    return {app, [options] { return run(*options); }};
}

}  // namespace strata::tools
