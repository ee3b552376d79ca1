// tools/oracle/explain/history_json.cpp - a history as JSON, with all data needed to repeat every line.
#include <fmt/format.h>

#include <bit>
#include <nlohmann/json.hpp>

#include "rasterizer/base/enum_values.h"
#include "tools/oracle/explain/history_report.h"

namespace strata::oracle {

namespace {

using nlohmann::ordered_json;

std::string bits(float value) { return fmt::format("{:08x}", std::bit_cast<std::uint32_t>(value)); }

ordered_json bits(const std::array<float, 4>& color) {
    return {bits(color[0]), bits(color[1]), bits(color[2]), bits(color[3])};
}

ordered_json json_of_held(const TargetValues& h) {
    ordered_json document{{"target", h.target}, {"format", pipeline::info(h.format).name}, {"before", h.before}};
    if (!h.after.empty()) document["after"] = h.after;
    return document;
}

ordered_json all_held(const std::vector<TargetValues>& list) {
    ordered_json array = ordered_json::array();
    for (const TargetValues& h : list) array.push_back(json_of_held(h));
    return array;
}

ordered_json json_of_term(const pipeline::BlendTerm& t) {
    return {{"equation", enum_name(t.equation)}, {"src", enum_name(t.src)}, {"dst", enum_name(t.dst)}};
}

ordered_json json_of_blend(const pipeline::Blend& b) {
    ordered_json json{{"enabled", b.blends()}};
    if (b.blends()) json.update({{"color", json_of_term(b.color)}, {"alpha", json_of_term(b.alpha)}});
    json["write_mask"] = b.write_mask;
    if (b.logic_op) json["logic_op"] = enum_name(*b.logic_op);
    if (b.dither) json["dither"] = true;
    return json;
}

ordered_json json_of_face(const pipeline::StencilFace& f) {
    return {{"func", enum_name(f.func)}, {"ref", f.ref},
            {"func_mask", f.func_mask},  {"write_mask", f.write_mask},
            {"fail", enum_name(f.fail)}, {"depth_fail", enum_name(f.depth_fail)},
            {"pass", enum_name(f.pass)}};
}

// The tests of the pass.
ordered_json json_of_tests(const Line& line) {
    ordered_json document = ordered_json::object();
    const pipeline::PassState& state = line.state;
    if (state.alpha.enabled)
        document["alpha"] = {{"func", enum_name(state.alpha.func)}, {"ref", bits(state.alpha.ref)}};
    if (state.depth.enabled)
        document["depth"] = {
            {"target", line.depth_target}, {"func", enum_name(state.depth.func)}, {"write", state.depth.write}};
    if (state.stencil.enabled)
        document["stencil"] = {{"target", line.stencil_target},
                               {"two_sided", state.stencil.two_sided},
                               {"front", json_of_face(state.stencil.front)},
                               {"back", json_of_face(state.stencil.back)}};
    return document;
}

void add_shaded(const Line& line, ordered_json& document) {
    if (line.kind != LineKind::quad) document["fragment"] = line.fragment;
    document["fate"] = name(line.fate);
    document["depth_code"] = line.depth_code;
    document["reference_code"] = line.reference_code ? ordered_json(*line.reference_code) : ordered_json();
    document["sample_mask"] = line.state.sample_mask;
    document["tests"] = json_of_tests(line);
    document["reads"] = all_held(line.reads);
    document["outputs"] = ordered_json::array();
    for (const ProgramOutput& output : line.outputs)
        document["outputs"].push_back(
            {{"target", output.target}, {"color", bits(output.color)}, {"blend", json_of_blend(output.blend)}});
}

ordered_json json_of_line(const Line& line) {
    ordered_json document{{"kind", name(line.kind)}, {"pass", line.pass}, {"iteration", line.iteration}};
    switch (line.kind) {
        case LineKind::copy: document["from"] = line.from; break;
        case LineKind::opaque:
        case LineKind::fragment:
        case LineKind::quad: add_shaded(line, document); break;
        case LineKind::query:
            document["count"] = line.count;
            document["goes_on"] = line.goes_on;
            return document;
        case LineKind::taken:
            document["end"] = line.side == pipeline::Side::back ? "far" : "near";
            document["fragments"] = line.fragments;
            return document;
        case LineKind::clear:
        case LineKind::published: break;
    }
    document["held"] = all_held(line.held);
    return document;
}

ordered_json json_of_fragment(const FragmentFact& f) {
    ordered_json document{{"primitive", f.primitive},
                          {"mesh", f.triangle < 0 ? ordered_json() : ordered_json(f.mesh)},
                          {"triangle", f.triangle < 0 ? ordered_json() : ordered_json(f.triangle)},
                          {"barycentric", f.barycentric},
                          {"color", bits(f.color)},
                          {"z", bits(f.shader_z)},
                          {"code", f.code},
                          {"facing", f.front_facing ? "front" : "back"},
                          {"masked", f.is_masked}};
    for (std::size_t path = 0; path < depth_path_names.size(); ++path)
        document["depth"][std::string(depth_path_names[path])] =
            f.path_codes[path] ? ordered_json(fmt::format("{:08x}", *f.path_codes[path])) : ordered_json();
    return document;
}

ordered_json of_history(const History& history) {
    ordered_json document{
        {"pixel", {history.x, history.y}}, {"algorithm", history.algorithm}, {"profile", history.profile}};
    if (history.sample) document["sample"] = *history.sample;
    document["depth_format"] = pipeline::info(pipeline::target_format(history.depth_format)).name;
    document["reversed_depth"] = history.is_reversed;
    for (const char* const list : {"fragments", "opaque", "lines"}) document[list] = ordered_json::array();
    document["composited"] = composited(history);
    for (const FragmentFact& fragment : history.fragments) document["fragments"].push_back(json_of_fragment(fragment));
    for (const FragmentFact& fragment : history.opaque) document["opaque"].push_back(json_of_fragment(fragment));
    for (const Line& line : history.lines) document["lines"].push_back(json_of_line(line));
    return document;
}

ordered_json of_pixel(const SampledHistory& history) {
    ordered_json document{{"algorithm", history.samples.at(0).algorithm},
                          {"resolve", enum_name(history.sampling.resolve)},
                          {"loads", enum_name(history.sampling.loads)},
                          {"composites", enum_name(history.sampling.composites)},
                          {"samples", ordered_json::array()},
                          {"format", pipeline::info(history.format).name},
                          {"picture", history.resolved}};
    for (const rasterizer::SamplePoint& point : history.points)
        document["samples"].push_back({{"x", point.x}, {"y", point.y}});
    return document;
}

std::string as_text(const ordered_json& document) {
    return document.dump(2, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace

std::string to_json(const History& history) { return of_history(history).dump(); }

std::string to_json(std::span<const History> histories) {
    ordered_json document{{"histories", ordered_json::array()}, {"first_differences", first_differences(histories)}};
    for (const History& history : histories) document["histories"].push_back(of_history(history));
    return as_text(document);
}

std::string to_json(std::span<const SampledHistory> histories) {
    if (!histories.empty() && histories[0].samples.size() == 1) return to_json(of_sample(histories, 0));
    ordered_json document{{"histories", ordered_json::array()},
                          {"pixels", ordered_json::array()},
                          {"first_differences", first_differences(histories)}};
    for (const SampledHistory& history : histories) {
        document["pixels"].push_back(of_pixel(history));
        for (const History& sample : history.samples) document["histories"].push_back(of_history(sample));
    }
    return as_text(document);
}

}  // namespace strata::oracle
