// tools/strata/render/stats.cpp - writes a run's outcome, counters, audit and times as a row of JSON and of the table
// (stats.h).
#include "tools/strata/render/stats.h"

#include <fmt/format.h>

#include "peeling/render.h"
#include "rasterizer/base/enum_values.h"
#include "tools/request/choices.h"
#include "tools/request/option_fields.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

using nlohmann::ordered_json;

// False if the profile refused the algorithm.
bool is_done(const RunSummary& run) { return run.result.outcome == peeling::Outcome::done; }

// These functions build the objects of a row, with the keys of scenes/reference/reports.md 1 in its order.
// Null if counters were not requested.
ordered_json to_json(const std::optional<pipeline::Counters>& counted) {
    if (!counted) return nullptr;
    const pipeline::Counters& c = *counted;
    return {{"fragments_rasterized", c.fragments_rasterized},
            {"discarded", c.discarded},
            {"alpha_killed", c.alpha_killed},
            {"stencil_killed", c.stencil_killed},
            {"depth_killed", c.depth_killed},
            {"blended", c.blended},
            {"bytes_read", c.bytes_read},
            {"bytes_written", c.bytes_written}};
}

ordered_json to_json(const pipeline::Work& work) {
    return {{"fragments", work.fragments},  {"regions", work.regions},
            {"reruns", work.reruns},        {"tile_size", work.tile_size},
            {"path", enum_name(work.path)}, {"why", work.why.empty() ? ordered_json(nullptr) : ordered_json(work.why)}};
}

ordered_json to_json(const std::vector<pipeline::Diagnostic>& diagnostics) {
    ordered_json list = ordered_json::array();
    for (const auto& d : diagnostics) {
        list.push_back({{"fault", pipeline::name(d.fault)},
                        {"pixels", d.pixels},
                        {"first", ordered_json::array({d.first_x, d.first_y})},
                        {"detail", d.detail}});
    }
    return list;
}

// The options on which bits depend and that are not their defaults, as their texts.
ordered_json options_of(const PictureRequest& request) {
    ordered_json options = ordered_json::object();
    for (const OptionField& field : option_fields())
        if (!keeps_bits(field.group) && !field.is_default(request)) options[field.key()] = field.text(request);
    return options;
}

// Null if the algorithm ran.
ordered_json refusal_of(const RunSummary& run) {
    if (is_done(run)) return nullptr;
    const auto refusal = run.result.refusal.value_or(pipeline::Refusal{});
    return {{"feature", refusal.feature}, {"extension", refusal.extension}};
}

// The line of a diagnostic below the table. Faults that are not visible in a pixel have neither a count nor a position
// (first_x is -1).
std::string describe(const std::string& algorithm, const pipeline::Diagnostic& d) {
    std::string text = fmt::format("{}: {}", algorithm, pipeline::name(d.fault));
    if (d.pixels > 0) text += fmt::format(" at {} pixels", d.pixels);
    if (d.first_x >= 0) text += fmt::format(", first at ({}, {})", d.first_x, d.first_y);
    return text + (d.detail.empty() ? "" : ": " + d.detail) + '\n';
}

// The cells of one row; "-" marks values that a refused or unaudited execution does not have.
std::vector<std::string> cells(const RunSummary& run, const RunContext& context) {
    const auto& [algorithm, result, color, depth] = run;
    if (!is_done(run)) return {algorithm->name, "refused", "-", "-", "-", "-", "-", "-", "-", "-"};
    const peeling::AuditResult& audit = result.audit;
    const auto audited = [&](const std::string& text) { return context.request.render.audit ? text : "-"; };
    return {algorithm->name, std::string(enum_name(result.outcome)), fmt::format("{}", result.frame.passes.geometry),
            audited(fmt::format("{}", audit.layers_max)),
            audited(audit.order_errors ? fmt::format("{}", *audit.order_errors) : "-"),
            audited(fmt::format("{}", audit.lost_by_ties)), audited(fmt::format("{:.3f}", audit.max_difference)),
            // The first twelve digits are enough to compare by eye; --stats has the whole digest.
            color.substr(0, 12), fmt::format("{:.3f}", result.seconds.geometry + result.seconds.passes),
            audited(fmt::format("{:.3f}", result.seconds.audit))};
}

}  // namespace

std::string path_text(const RunSummary& run) {
    const pipeline::Work& work = run.result.frame.work;
    return fmt::format("{}: {}{}", run.algorithm->name, enum_name(work.path), work.why.empty() ? "" : ": " + work.why);
}

ordered_json to_row(const RunSummary& run, const RunContext& context) {
    const auto& [algorithm, result, color, depth] = run;
    const peeling::AuditResult& audit = result.audit;
    const peeling::RenderOptions& asked = context.request.render;
    // The counts of a refused row are 0, not null, also without the audit.
    const bool counted = context.request.render.audit || !is_done(run);
    const auto audited = [&](ordered_json value) { return counted ? value : ordered_json(nullptr); };
    const bool has_order = !is_done(run) || audit.order_errors.has_value();
    ordered_json row;
    row["algorithm"] = algorithm->name;
    row["profile"] = context.profile;
    row["execution"] = name_of(executions, asked.execution);
    row["simd"] = name_of(simds, asked.simd);  // as requested, because rows do not describe the machine
    row["fragment_memory"] = asked.fragment_memory;
    row["options"] = options_of(context.request);
    row["outcome"] = enum_name(result.outcome);
    row["refusal"] = refusal_of(run);
    row["width"] = asked.width;
    row["height"] = asked.height;
    row["iterations"] = result.frame.iterations;
    row["geometry_passes"] = result.frame.passes.geometry;
    row["fullscreen_passes"] = result.frame.passes.full_screen;
    row["layers_max"] = audited(audit.layers_max);
    row["fragments_max"] = audited(audit.fragments_max);
    row["counters"] = to_json(result.frame.counters);
    row["work"] = to_json(result.frame.work);
    row["diagnostics"] = to_json(result.frame.diagnostics);
    row["digest"] = {{"color", color}, {"depth", depth}};
    row["order_errors"] = has_order ? audited(audit.order_errors.value_or(0)) : ordered_json(nullptr);
    row["lost_by_ties"] = audited(audit.lost_by_ties);
    row["hidden_by_opaque_ties"] = audited(audit.hidden_by_opaque_ties);
    row["max_difference_from_a_buffer"] = audited(audit.max_difference);
    row["max_difference_without_ties"] = audited(audit.max_difference_without_ties);
    row["seconds"] = {{"geometry", result.seconds.geometry},
                      {"passes", result.seconds.passes},
                      {"audit", counted ? ordered_json(result.seconds.audit) : ordered_json(nullptr)},
                      {"total", context.total_seconds}};
    return row;
}

std::string to_json(const std::vector<RunSummary>& runs, const RunContext& context) {
    ordered_json document = ordered_json::array();
    for (const RunSummary& run : runs) document.push_back(to_row(run, context));
    return document.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

std::string to_table(const std::vector<RunSummary>& runs, const RunContext& context) {
    Table table;
    table.columns = {{"algorithm"}, {"outcome"}};
    for (const char* title :
         {"passes", "layers", "order errors", "lost by ties", "max diff /255", "digest", "seconds", "audit s"}) {
        table.columns.push_back({title, Align::right});
    }
    std::string notes;
    for (const RunSummary& run : runs) {
        table.rows.push_back(cells(run, context));
        for (const auto& diagnostic : run.result.frame.diagnostics) notes += describe(run.algorithm->name, diagnostic);
        if (is_done(run) && context.request.render.audit && run.result.audit.max_difference > 255 &&
            std::isfinite(run.result.audit.max_difference))
            notes += fmt::format("{}: the greatest difference is {:.3f} times white: its colours exceed 1\n",
                                 run.algorithm->name, run.result.audit.max_difference / 255);
    }
    return to_text(table) + notes;
}

}  // namespace strata::tools
