// Tests that the lines of `explain` are complete: a model of one pixel repeats them from their JSON alone. It clears,
// copies, tests and blends in integers over 255 and in binary32, written from pipeline/reference/fragment-stages.md 5
// to 9, and must produce the picture of the ordinary run.
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "peeling/render.h"
#include "tests/tools/oracle/explain/explained_scene.h"
#include "tools/oracle/explain/history_report.h"

using namespace strata;
using namespace strata::oracle;
using namespace strata::testing;
using nlohmann::json;

namespace {

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

// A blend factor in units of 1/255; sa and da are the codes of the alphas.
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

std::uint32_t half_of(float v) {  // v is finite and not negative; rounded to nearest, ties to even
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
            // The opaque scene is drawn before the first line; a target that was never cleared contains zeros.
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

TEST_CASE("the lines of explain reproduce the bits of the picture at every pixel of three scenes", "[slow]") {
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
                    // For quads, fragments that the shader discards are not counted.
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
