// Model: a machine of one pixel that does the lines of `explain` again, from their JSON alone: clears, copies, tests and blends in
// integers over 255 and in binary32, written from fragment-stages.md 5 to 9. It must arrive at the picture of the usual run.
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "peeling/render.h"
#include "scenes/camera.h"
#include "scenes/scene.h"
#include "tools/oracle/history_report.h"

using namespace strata;
using namespace strata::oracle;
using nlohmann::json;

namespace {

struct ExplainedScene {
    scenes::Scene scene;
    pipeline::View view;
    peeling::RenderOptions options;
    [[nodiscard]] RunInput input(const char* profile) const {
        return {scene.list, view, *pipeline::find_profile(profile), options};
    }
};

ExplainedScene explained_scene(const std::string& name, int columns, int rows) {
    ExplainedScene loaded{scenes::load_scene(name, {}), {}, {}};
    loaded.options.width = columns;
    loaded.options.height = rows;
    loaded.options.threads = 1;
    loaded.view = scenes::orbit_view(loaded.scene.bounds, 30, 20, static_cast<double>(columns) / rows);
    return loaded;
}

using PixelCodes = std::vector<std::uint32_t>;

bool holds(const std::string& func, std::uint32_t own, std::uint32_t stored) {
    if (func == "less") return own < stored;
    if (func == "lequal") return own <= stored;
    if (func == "equal") return own == stored;
    if (func == "notequal") return own != stored;
    if (func == "greater") return own > stored;
    if (func == "gequal") return own >= stored;
    return func == "always";
}

float float_of(const json& bits) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(std::stoul(bits.get<std::string>(), nullptr, 16)));
}

int byte_of(float v) { return !(v > 0) ? 0 : static_cast<int>(std::floor(std::min(double{v}, 1.0) * 255 + 0.5)); }

// A factor as a number of 255ths, for codes s and d of r g b a.
int factor_255(const std::string& name, int sa, int da) {
    if (name == "one") return 255;
    if (name == "src_alpha") return sa;
    if (name == "one_minus_src_alpha") return 255 - sa;
    if (name == "dst_alpha") return da;
    if (name == "one_minus_dst_alpha") return 255 - da;
    if (name != "zero") FAIL("factor " << name);
    return 0;
}

float factor_float(const std::string& name, float sa, float da) {
    if (name == "one") return 1;
    if (name == "src_alpha") return sa;
    if (name == "one_minus_src_alpha") return 1 - sa;
    if (name == "dst_alpha") return da;
    if (name == "one_minus_dst_alpha") return 1 - da;
    if (name != "zero") FAIL("factor " << name);
    return 0;
}

std::uint32_t half_of(float v) {  // finite, not negative, to the nearest, ties to even
    const int exponent = v == 0.0f ? -14 : std::max(std::ilogb(v), -14);
    const auto units = static_cast<std::uint32_t>(std::nearbyint(std::ldexp(double{v}, 10 - exponent)));
    return units + (static_cast<std::uint32_t>(exponent + 14) << 10);
}

float of_half(std::uint32_t h) {
    const int exponent = static_cast<int>(h >> 10 & 31);
    return exponent == 0 ? std::ldexp(static_cast<float>(h & 1023), -24)
                         : std::ldexp(static_cast<float>(1024 + (h & 1023)), exponent - 25);
}

// Blends one output onto the codes of its target.
void blend(const json& output, const std::string& format, PixelCodes& stored) {
    const json& state = output["blend"];
    const bool is_byte = format == "rgba8", is_half = format == "rgba16f" || format == "r16f";
    const PixelCodes before = stored;
    const auto loaded = [&](std::size_t c) { return is_half ? of_half(before[c]) : std::bit_cast<float>(before[c]); };
    for (std::size_t c = 0; c < stored.size(); ++c) {
        if ((state["write_mask"].get<unsigned>() >> c & 1u) == 0) continue;
        const float s = float_of(output["color"][c]), sa = float_of(output["color"][3]);
        if (!state["enabled"].get<bool>()) {
            stored[c] = is_byte   ? static_cast<std::uint32_t>(byte_of(s))
                        : is_half ? half_of(s)
                                  : std::bit_cast<std::uint32_t>(s);
            continue;
        }
        const json& term = state[c == 3 ? "alpha" : "color"];
        const std::string src = term["src"], dst = term["dst"];
        if (term["equation"] == "max") {
            stored[c] = is_byte ? std::max(before[c], static_cast<std::uint32_t>(byte_of(s)))
                                : std::bit_cast<std::uint32_t>(std::max(s, loaded(c)));
        } else if (is_byte) {
            const int da = static_cast<int>(before[3]);
            const int sum = byte_of(s) * factor_255(src, byte_of(sa), da) +
                            static_cast<int>(before[c]) * factor_255(dst, byte_of(sa), da);
            stored[c] = static_cast<std::uint32_t>(std::min((2 * sum + 255) / 510, 255));
        } else {
            const float da = stored.size() == 4 ? loaded(3) : 1.0f;
            const float source = s * factor_float(src, sa, da), destination = loaded(c) * factor_float(dst, sa, da);
            stored[c] = is_half ? half_of(source + destination) : std::bit_cast<std::uint32_t>(source + destination);
        }
    }
}

struct Replayed {
    PixelCodes picture;
    int lines = 0, wrong_before = 0, wrong_after = 0, wrong_fate = 0;
};

std::uint32_t changed(const std::string& op, std::uint32_t stored, std::uint32_t ref) {
    if (op == "zero") return 0;
    if (op == "replace") return ref;
    if (op == "incr") return std::min(stored + 1, 255u);
    if (op == "decr") return stored == 0 ? 0 : stored - 1;
    if (op == "invert") return ~stored & 255u;
    if (op == "incr_wrap") return (stored + 1) & 255u;
    if (op == "decr_wrap") return (stored - 1) & 255u;
    return stored;
}

// Stencil, then depth, then blending, of one sample; true if the fragment passes.
bool test_and_blend(const json& line, bool front_facing, const std::map<std::string, std::string>& formats,
                    std::map<std::string, PixelCodes>& targets) {
    const json& tests = line["tests"];
    const auto own = line["depth_code"].get<std::uint32_t>();
    const bool is_near =
        !tests.contains("depth") || holds(tests["depth"]["func"], own, targets[tests["depth"]["target"]][0]);
    if (tests.contains("stencil")) {
        const json& test = tests["stencil"];
        const json& face = test["two_sided"].get<bool>() && !front_facing ? test["back"] : test["front"];
        std::uint32_t& stored = targets[test["target"]][0];
        const auto mask = face["func_mask"].get<std::uint32_t>(), ref = face["ref"].get<std::uint32_t>(),
                   write = face["write_mask"].get<std::uint32_t>();
        const bool is_let = holds(face["func"], ref & mask, stored & mask);
        const auto next = changed(face[!is_let ? "fail" : is_near ? "pass" : "depth_fail"], stored, ref);
        stored = (stored & ~write) | (next & write);
        if (!is_let) return false;
    }
    if (!is_near) return false;
    if (tests.contains("depth") && tests["depth"]["write"].get<bool>()) targets[tests["depth"]["target"]][0] = own;
    for (const json& output : line["outputs"]) blend(output, formats.at(output["target"]), targets[output["target"]]);
    return true;
}

Replayed replay(const json& history) {
    Replayed result;
    std::map<std::string, PixelCodes> targets;
    std::map<std::string, std::string> formats;
    for (const json& line : history["lines"]) {
        ++result.lines;
        const std::string kind = line["kind"];
        if (kind == "query" || kind == "taken") continue;
        for (const json& held : line["held"]) {
            const std::string name = held["target"];
            formats[name] = held["format"];
            // The opaque scene is there before the first line; a target that nobody has cleared holds zeros.
            if (!targets.contains(name)) targets[name] = PixelCodes(held["before"].size(), 0u);
        }
        if (kind == "published") {
            result.picture = targets[line["held"][0]["target"]];
            continue;
        }
        const json& first = line["held"].empty() ? json() : line["held"][0];
        if (kind == "clear") {
            targets[first["target"]] = first["after"].get<PixelCodes>();
            continue;
        }
        if (kind == "copy") {
            const std::string from = line["from"];
            if (from.starts_with("opaque_")) targets[from] = first["after"].get<PixelCodes>();
            targets[first["target"]] = targets[from];
            continue;
        }
        for (const json& held : line["held"]) {
            const std::string name = held["target"];
            if (name.starts_with("opaque_")) targets[name] = held["before"].get<PixelCodes>();
            result.wrong_before += targets[name] != held["before"].get<PixelCodes>() ? 1 : 0;
        }
        const std::string fate = line["fate"];
        const bool is_out =
            fate == "masked" || fate == "discarded" || fate == "alpha_killed" || fate == "depth_unit_killed";
        const bool front_facing = !line.contains("fragment") ||
                                  history["fragments"][line["fragment"].get<std::size_t>()]["facing"] == "front";
        if (!is_out)
            result.wrong_fate += test_and_blend(line, front_facing, formats, targets) != (fate == "passed") ? 1 : 0;
        for (const json& held : line["held"])
            result.wrong_after += targets[held["target"]] != held["after"].get<PixelCodes>() ? 1 : 0;
    }
    return result;
}

}  // namespace

TEST_CASE("the lines of explain, done again, give the picture's bits at every pixel of three scenes", "[slow]") {
    int pixels = 0, lines = 0;
    for (const std::string scene : {"random", "teapot", "volume-beam:slices=6"})
        for (const std::string name :
             {"dual", "front_to_back", "weighted_average", "coherent_stencil", "unsorted", "dual_independent"}) {
            const ExplainedScene column = explained_scene(scene, 20, 14);
            const char* profile = name == "dual_independent" ? "geforce8_dx101" : "geforce8";
            const peeling::Algorithm& algorithm = *peeling::find_algorithm(name);
            peeling::RenderOptions counted = column.options;
            counted.counters = true;
            peeling::Renderer renderer{column.scene.list, column.view, *pipeline::find_profile(profile), counted};
            const peeling::RenderResult usual = renderer.render(algorithm);
            const auto histories = explain(column.input(profile), algorithm, {0, 0, 20, 14});
            REQUIRE(histories.size() == 20 * 14);
            int wrong = 0, unequal = 0;
            std::map<Fate, std::uint64_t> fates;
            std::string first;
            for (std::size_t p = 0; p < histories.size(); ++p) {
                const Replayed done = replay(json::parse(to_json(histories[p])));
                lines += done.lines;
                for (const Line& line : histories[p].lines) {
                    const bool is_quad = line.kind == LineKind::quad;
                    if (line.kind != LineKind::fragment && !is_quad) continue;
                    // Of quads, what a program discards is not counted.
                    if (!is_quad || line.fate != Fate::discarded) ++fates[line.fate];
                }
                ++pixels;
                unequal += done.wrong_before + done.wrong_after + done.wrong_fate;
                const bool is_right = std::equal(done.picture.begin(), done.picture.end(),
                                                 usual.frame.color.codes.begin() + static_cast<std::ptrdiff_t>(4 * p));
                if (done.picture.size() == 4 && is_right) continue;
                if (wrong++ == 0) first = std::to_string(histories[p].x) + "," + std::to_string(histories[p].y);
            }
            INFO(scene << " by " << name << ", first at " << first);
            CHECK(wrong == 0);
            CHECK(unequal == 0);
            CHECK(fates[Fate::discarded] == usual.frame.counters->discarded);
            CHECK(fates[Fate::depth_killed] == usual.frame.counters->depth_killed);
            CHECK(fates[Fate::stencil_killed] == usual.frame.counters->stencil_killed);
            CHECK(fates[Fate::alpha_killed] + fates[Fate::masked] == usual.frame.counters->alpha_killed);
        }
    CHECK(pixels == 18 * 280);
    CHECK(lines > 30 * pixels);
}

TEST_CASE("a dual peel says which pass took which fragment at which end, and merges what ties") {
    const ExplainedScene column = explained_scene("random", 20, 14);
    const auto histories = explain(column.input("geforce8"), *peeling::find_algorithm("dual"), {0, 0, 20, 14});
    int deep = 0, wrong = 0;
    for (const History& history : histories) {
        std::map<float, std::vector<int>> by_depth;
        std::uint32_t opaque_bits = 0x3f800000;  // the scene has nothing opaque
        for (std::size_t f = 0; f < history.fragments.size(); ++f)
            if (history.fragments[f].shader_z < std::bit_cast<float>(opaque_bits))
                by_depth[history.fragments[f].shader_z].push_back(static_cast<int>(f));
        std::vector<std::vector<int>> wanted;
        for (const auto& [z, fragments] : by_depth) wanted.push_back(fragments);
        wrong += composited(history) != wanted ? 1 : 0;
        if (wanted.size() < 4) continue;
        ++deep;
        // Pass 1 takes both ends, pass 2 the next two, from each side one.
        std::vector<int> iterations;
        for (const Line& line : history.lines)
            if (line.kind == LineKind::taken) iterations.push_back(line.side == pipeline::Side::back ? -1 : 1);
        wrong += std::vector<int>(iterations.begin(), iterations.begin() + 4) != std::vector<int>{1, -1, 1, -1} ? 1 : 0;
    }
    CHECK(deep > 10);
    CHECK(wrong == 0);
}

TEST_CASE(
    "a fragment's depth by every path is what a frame with that path stores there, and its triangle holds the pixel") {
    const ExplainedScene column = explained_scene("planes:gap=4", 20, 14);
    RunInput input = column.input("geforce3");
    input.options.depth = pipeline::DepthFormat::d24;
    const peeling::Algorithm& algorithm = *peeling::find_algorithm("depth_units");
    const auto histories = explain(input, algorithm, {3, 2, 17, 12});
    int compared = 0, wrong = 0, apart = 0, shares = 0;
    for (std::size_t path = 0; path < 7; ++path) {
        peeling::RenderOptions options = input.options;
        options.depth_path = static_cast<rasterizer::DepthPath>(path);
        peeling::Renderer renderer{input.list, input.view, input.profile, options};
        const peeling::RenderResult trial = renderer.render(algorithm);
        if (trial.outcome == peeling::Outcome::refused) continue;
        const auto fragments = renderer.fragments(algorithm);
        for (const auto& fragment : fragments.all) {
            const int x = static_cast<int>(fragment.pixel % 20), y = static_cast<int>(fragment.pixel / 20);
            if (x < 3 || x >= 17 || y < 2 || y >= 12) continue;
            for (const FragmentFact& fact : histories[static_cast<std::size_t>((y - 2) * 14 + x - 3)].fragments)
                if (fact.primitive == fragment.primitive) {
                    ++compared;
                    wrong += fact.path_codes[path] != fragment.code ? 1 : 0;
                }
        }
    }
    for (const History& history : histories)
        for (const FragmentFact& fact : history.fragments) {
            double sum = 0;
            bool is_inside = true;
            for (const double share : fact.barycentric) {
                sum += share;
                is_inside &= share >= 0 && share <= 1;
            }
            shares += is_inside && std::abs(sum - 1) < 1e-12 ? 0 : 1;
            apart += fact.path_codes[0] != fact.path_codes[5] ? 1 : 0;
        }
    CHECK(compared > 500);
    CHECK(wrong == 0);
    CHECK(shares == 0);
    CHECK(apart > 0);  // the hazard of close planes: the chip's interpolator and the exact plane store other codes
}

TEST_CASE(
    "of a peel that compares another depth than it stores, both are shown, and which fragments lie behind themselves") {
    const ExplainedScene column = explained_scene("planes:gap=4", 20, 14);
    RunInput input = column.input("geforce3");
    input.options.depth = pipeline::DepthFormat::d24;
    const auto histories = explain(input, *peeling::find_algorithm("shadow_map"), {8, 6, 12, 9});
    int compared = 0, wrong = 0, apart = 0;
    for (const History& history : histories)
        for (const Line& line : history.lines) {
            if (line.kind != LineKind::fragment || !line.reference_code) continue;
            const FragmentFact& fact = history.fragments[static_cast<std::size_t>(line.fragment)];
            ++compared;
            // shadow_map stores the device's window_z and compares perspective_rq.
            wrong += fact.path_codes[0] != line.depth_code || fact.path_codes[1] != *line.reference_code ? 1 : 0;
            apart += line.depth_code != *line.reference_code ? 1 : 0;
        }
    CHECK(compared > 20);
    CHECK(wrong == 0);
    CHECK(apart > 0);
}

// Model: the nearest code of the opaque fragments that are not cut, one by one in the order of their list, with LESS.
TEST_CASE("opaque and masked fragments have a history, which leaves the depth and colour that the first pass finds") {
    ExplainedScene room = explained_scene("showroom", 64, 64);
    REQUIRE(room.scene.own_view);
    room.view = *room.scene.own_view;
    auto& instances = room.scene.list.instances;
    const auto once = instances;  // and once more at the same depths, which LESS hides
    instances.insert(instances.end(), once.begin(), once.end());
    const RunInput input = room.input("geforce8");
    int told = 0, cut = 0, wrong = 0, behind = 0;
    for (const History& history : explain(input, *peeling::find_algorithm("front_to_back"), {0, 0, 64, 64})) {
        std::optional<std::uint32_t> depth;
        bool is_over = false;  // no opaque line after those of the passes
        for (const Line& line : history.lines) {
            wrong += line.kind == LineKind::opaque && is_over ? 1 : 0;
            is_over |= line.kind != LineKind::opaque;
            if (line.kind != LineKind::opaque) continue;
            ++told;
            wrong += line.pass == -1 ? 0 : 1;
            const FragmentFact& fact = history.opaque.at(static_cast<std::size_t>(line.fragment));
            if (fact.is_masked) {
                ++cut;
                wrong += line.fate == Fate::masked ? 0 : 1;
                continue;
            }
            const bool is_nearer = !depth || line.depth_code < *depth;
            wrong += line.fate == (is_nearer ? Fate::passed : Fate::depth_killed) ? 0 : 1;
            behind += is_nearer ? 0 : 1;
            if (is_nearer) depth = line.depth_code;
        }
    }
    CHECK(wrong == 0);
    CHECK(told > 500);
    CHECK(cut > 10);
    CHECK(behind > 0);
    const auto histories = explain(input, *peeling::find_algorithm("front_to_back"), {0, 0, 64, 64});
    const auto with_surface = std::ranges::find_if(histories, [](const History& h) { return !h.opaque.empty(); });
    REQUIRE(with_surface != histories.end());
    const std::string text = to_text(*with_surface);
    CHECK(text.find(" opaque or masked\n") != std::string::npos);
    CHECK(text.find("  opaque.0 ") != std::string::npos);
    CHECK(text.find("  before: fragment opaque.0 ") != std::string::npos);
}

TEST_CASE("where algorithms part ways is told in a sentence, and drawn") {
    const ExplainedScene column = explained_scene("random", 20, 14);
    const rasterizer::Rect centre{10, 7, 11, 8};
    std::vector<History> histories;
    for (const char* name : {"front_to_back", "dual", "weighted_average"})
        histories.push_back(explain(column.input("geforce8"), *peeling::find_algorithm(name), centre).at(0));
    const auto sentences = partings(histories);
    REQUIRE(sentences.size() == 2);
    CHECK(sentences[0].starts_with("dual composites the same "));
    CHECK(sentences[1].starts_with("weighted_average parts from front_to_back at layer 0: no further layer against #"));
    const std::string svg = to_svg(histories);
    CHECK(svg.starts_with("<svg "));
    CHECK(svg.find(">dual</text>") != std::string::npos);
    CHECK(svg.find("near") != std::string::npos);
    const std::string text = to_text(histories[1]);
    CHECK(text.find("window_z none") != std::string::npos);
    CHECK(text.find("takes #") != std::string::npos);
    CHECK_THROWS(explain(column.input("geforce8"), *peeling::find_algorithm("dual"), {20, 0, 21, 1}));
}
