// tools/oracle/explain/history_text.cpp - a history as text: one line per fragment and per step.
#include <fmt/format.h>

#include <bit>

#include "rasterizer/base/enum_values.h"
#include "tools/oracle/explain/history_report.h"

namespace strata::oracle {

namespace {

std::string hex(const std::vector<std::uint32_t>& codes) {
    std::string text;
    for (const std::uint32_t code : codes) text += fmt::format("{}{:x}", text.empty() ? "" : " ", code);
    return text;
}

std::string_view noun_of(rasterizer::Primitive kind) {
    switch (kind) {
        case rasterizer::Primitive::triangles: break;
        case rasterizer::Primitive::lines:
        case rasterizer::Primitive::line_strips: return "line";
        case rasterizer::Primitive::points: return "point";
        case rasterizer::Primitive::polygon_lines: return "side";
        case rasterizer::Primitive::polygon_points: return "corner";
    }
    return "triangle";
}

// The depth of a reversed frame is a key, which is no number.
std::string of_fragment(const FragmentFact& f, std::string_view mark, std::size_t number, bool is_reversed) {
    std::string text =
        fmt::format("  {}{} {} {} {}, submitted as {}, {}-facing{}\n", mark, number,
                    f.mesh.empty() ? "mesh unknown" : f.mesh, noun_of(f.kind), f.triangle, f.primitive,
                    f.front_facing ? "front" : "back", f.is_masked ? ", cut by its material's alpha" : "");
    text += "     ";
    if (f.kind == rasterizer::Primitive::triangles)
        text += fmt::format("barycentric {:.6f} {:.6f} {:.6f}; ", f.barycentric[0], f.barycentric[1], f.barycentric[2]);
    text += fmt::format("colour {:.6f} {:.6f} {:.6f} {:.6f}; ", f.color[0], f.color[1], f.color[2], f.color[3]);
    const auto bits = std::bit_cast<std::uint32_t>(f.shader_z);
    text += is_reversed ? fmt::format("z key {:08x}\n     depth", bits)
                        : fmt::format("z {:.9g} ({:08x})\n     depth", f.shader_z, bits);
    for (std::size_t path = 0; path < depth_path_names.size(); ++path)
        text += fmt::format(" {} {}", depth_path_names[path],
                            f.path_codes[path] ? fmt::format("{:08x}", *f.path_codes[path]) : "none");
    return text + '\n';
}

std::string of_held(const std::vector<TargetValues>& held) {
    std::string text;
    for (const TargetValues& h : held) {
        text += fmt::format("; {} {}", h.target, hex(h.before));
        if (!h.after.empty()) text += h.after == h.before ? " stays" : " becomes " + hex(h.after);
    }
    return text;
}

std::string numbers(const std::vector<int>& fragments) {
    std::string text;
    for (const int f : fragments) text += fmt::format("{}#{}", text.empty() ? "" : " and ", f);
    return text.empty() ? "nothing" : text;
}

std::string of_line(const Line& line) {
    switch (line.kind) {
        case LineKind::clear: return fmt::format("clear {} to {}", line.held[0].target, hex(line.held[0].after));
        case LineKind::copy:
            return fmt::format("copy {} to {}: {}", line.from, line.held[0].target, hex(line.held[0].after));
        case LineKind::query:
            return fmt::format("occlusion query: {} samples passed in the frame; {}", line.count,
                               line.goes_on ? "another pass follows" : "the peel ends");
        case LineKind::taken:
            return fmt::format("takes {} at the {} end{}", numbers(line.fragments),
                               line.side == pipeline::Side::back ? "far" : "near",
                               line.fragments.size() > 1 ? ", merged" : "");
        case LineKind::published: return fmt::format("the picture has {}", hex(line.held[0].before));
        case LineKind::opaque:
        case LineKind::fragment:
        case LineKind::quad: break;
    }
    std::string text = line.kind == LineKind::quad     ? "quad "
                       : line.kind == LineKind::opaque ? fmt::format("fragment opaque.{} ", line.fragment)
                                                       : fmt::format("fragment #{} ", line.fragment);
    text += name(line.fate);
    if (line.fate == Fate::depth_killed) text += fmt::format(" ({:x} against {})", line.depth_code, line.depth_target);
    if (line.reference_code)
        text += fmt::format("; stores {:08x}, compares {:08x}", line.depth_code, *line.reference_code);
    for (const TargetValues& read : line.reads) text += fmt::format("; reads {} {}", read.target, hex(read.before));
    return text + of_held(line.held);
}

}  // namespace

std::string to_text(const History& history) {
    std::string text =
        fmt::format("pixel {},{} by {} on {}: {} fragments in submission order{}\n", history.x, history.y,
                    history.algorithm, history.profile, history.fragments.size(),
                    history.opaque.empty() ? "" : fmt::format(", {} opaque or masked", history.opaque.size()));
    if (history.fragments.empty() && history.opaque.empty())
        text += fmt::format("  no fragment covers this pixel: it shows what was there before{}\n",
                            history.lines.empty() ? "" : ", " + hex(history.lines.back().held.at(0).before));
    if (history.is_reversed) text += "  depth is reversed: depths are shown as keys, of which the less is nearer\n";
    for (std::size_t f = 0; f < history.opaque.size(); ++f)
        text += of_fragment(history.opaque[f], "opaque.", f, history.is_reversed);
    for (std::size_t f = 0; f < history.fragments.size(); ++f)
        text += of_fragment(history.fragments[f], "#", f, history.is_reversed);
    for (const Line& line : history.lines)
        text += line.kind == LineKind::opaque ? fmt::format("  before: {}\n", of_line(line))
                                              : fmt::format("  pass {}: {}\n", line.pass, of_line(line));
    return text;
}

std::vector<std::string> first_differences(std::span<const History> histories) {
    std::vector<std::string> descriptions;
    const auto picture = [](const History& history) {
        return history.lines.empty() ? std::vector<std::uint32_t>{} : history.lines.back().held.at(0).before;
    };
    for (const History& other : histories.subspan(histories.empty() ? 0 : 1)) {
        const History& first = histories[0];
        const auto mine = composited(first), theirs = composited(other);
        std::size_t same = 0;
        while (same < mine.size() && same < theirs.size() && mine[same] == theirs[same]) ++same;
        const auto at = [&](const std::vector<std::vector<int>>& layers) {
            return same < layers.size() ? numbers(layers[same]) : "no further layer";
        };
        std::string text =
            same == mine.size() && same == theirs.size()
                ? fmt::format("{} composites the same {} layers as {}", other.algorithm, same, first.algorithm)
                : fmt::format("{} parts from {} at layer {}: {} against {}", other.algorithm, first.algorithm, same,
                              at(theirs), at(mine));
        text += picture(first) == picture(other)
                    ? "; the picture has the same bits"
                    : fmt::format("; the picture has {} against {}", hex(picture(other)), hex(picture(first)));
        descriptions.push_back(std::move(text));
    }
    return descriptions;
}

std::string to_text(const SampledHistory& history) {
    if (history.samples.size() == 1) return to_text(history.samples[0]);
    std::string text;
    for (std::size_t s = 0; s < history.samples.size(); ++s)
        text +=
            fmt::format("sample {} at {},{} sixteenths of the pixel: ", s, history.points[s].x, history.points[s].y) +
            to_text(history.samples[s]);
    const peeling::Multisampling& sampling = history.sampling;
    if (sampling.loads_others())
        text += fmt::format("programs load the sample: {} in geometry passes, {} in full-screen passes\n",
                            enum_name(sampling.loads), enum_name(sampling.composites));
    return text + fmt::format("the picture has {}: the {} resolve of {} samples\n", hex(history.resolved),
                              enum_name(sampling.resolve), history.samples.size());
}

std::vector<std::string> first_differences(std::span<const SampledHistory> histories) {
    std::vector<std::string> descriptions;
    const std::size_t samples = histories.empty() ? 0 : histories[0].samples.size();
    for (std::size_t s = 0; s < samples; ++s)
        for (const std::string& difference : first_differences(of_sample(histories, s)))
            descriptions.push_back(samples == 1 ? difference : fmt::format("sample {}: {}", s, difference));
    return descriptions;
}

}  // namespace strata::oracle
