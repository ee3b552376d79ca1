// Tests line stipple against OpenGL's text: the fragments of the unstippled lines, counted in integers along each line
// and on through strips.
#include "rasterizer/coverage/line_stipple.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "rasterizer/base/input_error.h"
#include "tests/rasterizer/lines.h"

namespace {

using namespace strata::rasterizer;

const RasterRules stippled_rules{.lines = LineRule::diamond_exit};

TriangleSoup soup_of(const std::vector<ClipVertex>& ends, Primitive primitive) {
    TriangleSoup soup;
    soup.vertices.assign(ends.begin(), ends.end());
    const auto count = static_cast<std::uint32_t>(ends.size());
    const bool is_strip = primitive == Primitive::line_strips;
    for (std::uint32_t i = 0; i + 1 < count; i += is_strip ? 1 : 2)
        soup.indices.insert(soup.indices.end(), {i, i, i + 1});
    soup.runs = {{.index_count = static_cast<std::uint32_t>(soup.indices.size()), .primitive = primitive}};
    return soup;
}

// The pixels of every line, by its number in the list.
using LinePixels = std::map<std::uint32_t, PixelSet>;
LinePixels pixels_by_line(const TriangleSoup& soup, const RasterState& state) {
    LinePixels pixels;
    for (const Fragment& f : draw(set_up(soup, state, stippled_rules, 1), {}, coverage_only).fragments)
        pixels[soup.order.empty() ? f.primitive : soup.order[f.primitive]].insert({f.x, f.y});
    return pixels;
}

// Fragments from `a` on: a line along x has one in each column.
std::vector<std::pair<int, int>> in_order(const PixelSet& pixels, const ClipVertex& a, const ClipVertex& b) {
    std::vector<std::pair<int, int>> all{pixels.begin(), pixels.end()};
    const bool is_x = std::abs(b.x - a.x) >= std::abs(b.y - a.y);
    const bool is_backwards = is_x ? b.x < a.x : b.y < a.y;
    std::ranges::sort(all, [&](const auto& p, const auto& q) {
        const int first = is_x ? p.first : p.second, second = is_x ? q.first : q.second;
        return is_backwards ? first > second : first < second;
    });
    return all;
}

// Bit floor(s / factor) mod 16 of the pattern, s counting on where `continues`.
LinePixels kept_by_text(const TriangleSoup& soup, LinePixels whole, const LineStipple& stipple, bool continues) {
    LinePixels kept;
    int s = 0;
    for (std::uint32_t line = 0; line < soup.indices.size() / 3; ++line) {
        if (!continues) s = 0;
        const ClipVertex& a = soup.vertices[soup.indices[3 * line]];
        const ClipVertex& b = soup.vertices[soup.indices[3 * line + 2]];
        for (const auto& pixel : in_order(whole[line], a, b)) {
            if ((stipple.pattern >> (s / stipple.factor % 16) & 1) != 0) kept[line].insert(pixel);
            ++s;
        }
    }
    return kept;
}

std::vector<ClipVertex> random_ends(Random& random, int count) {
    std::vector<ClipVertex> ends;
    for (int i = 0; i < count; ++i) {
        const RandomLine line = random_line(random, 8, 6);
        ends.push_back(vertex_at(line.a, 8));
    }
    return ends;
}

}  // namespace

TEST_CASE("a stipple keeps the fragments whose bit is set and counts on in strips alone") {
    Random random{1};
    int wrong = 0;
    for (int i = 0; i < 200; ++i) {
        const bool is_strip = i % 2 == 0;
        TriangleSoup soup = soup_of(random_ends(random, 12), is_strip ? Primitive::line_strips : Primitive::lines);
        RasterState state = line_state();
        const LinePixels whole = pixels_by_line(soup, state);
        state.line_stipple = {random_int(random, 1, 9), static_cast<std::uint16_t>(random())};
        const LinePixels expected = kept_by_text(soup, whole, *state.line_stipple, is_strip);
        wrong += pixels_by_line(soup, state) != expected ? 1 : 0;
        // The order of drawing does not change a line's numbers.
        for (std::uint32_t k = static_cast<std::uint32_t>(soup.indices.size() / 3); k-- > 0;) soup.order.push_back(k);
        wrong += pixels_by_line(soup, state) != expected ? 1 : 0;
    }
    CHECK(wrong == 0);
}

TEST_CASE("a stipple of a wide line keeps whole columns") {
    RasterState state = line_state();
    state.line_width_px = 3;
    state.line_stipple = {2, 0b1001};
    const TriangleSoup soup =
        soup_of({{.x = 4.25f, .y = 10, .z = 0.5f}, {.x = 44.25f, .y = 13, .z = 0.5f}}, Primitive::lines);
    std::map<int, int> columns;
    const PixelSet pixels = pixels_by_line(soup, state)[0];
    for (const auto& [x, y] : pixels) ++columns[x];
    // Fragments 0 and 1, 6 and 7, and those 32 later; the first column is 4.
    CHECK(columns == std::map<int, int>{{4, 3}, {5, 3}, {10, 3}, {11, 3}, {36, 3}, {37, 3}, {42, 3}, {43, 3}});
}

TEST_CASE("a stipple counts from the edge of the viewport on and is refused where no rule counts") {
    RasterState state = line_state();
    state.line_stipple = {1, 0x0001};
    const TriangleSoup soup =
        soup_of({{.x = -9.75f, .y = 10, .z = 0.5f}, {.x = 20.25f, .y = 10, .z = 0.5f}}, Primitive::lines);
    CHECK(pixels_by_line(soup, state)[0] == PixelSet{{0, 10}, {16, 10}});
    const auto refusal = [&](Primitive primitive, const RasterState& s, const RasterRules& rules) -> std::string {
        try {
            static_cast<void>(set_up(soup_of({{}, {.x = 1}}, primitive), s, rules, 1));
        } catch (const strata::InputError& e) {
            return e.what();
        }
        return {};
    };
    const std::string none = ": expected no line_stipple, because the rules have none for these lines, found lines";
    CHECK(refusal(Primitive::lines, state, chip_lines) == "triangle soup: runs[0].primitive" + none);
    CHECK(refusal(Primitive::polygon_lines, state, stippled_rules) == "triangle soup: runs[0].primitive" + none);
    CHECK(refusal(Primitive::lines, state, stippled_rules).empty());
    state.line_stipple->factor = 257;
    CHECK(refusal(Primitive::lines, state, stippled_rules) ==
          "raster state: line_stipple.factor: expected 1 to 256, found 257");
}
