// Tests the adviser against the emulated machine: values that it calls safe must peel without error, and the nearest
// values outside must not.
#include "peeling/invariance.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "peeling/registry.h"

using namespace strata::peeling;
using namespace strata::pipeline;
using strata::rasterizer::DepthPath;

namespace {

// `count` parallel planes, `gap` apart, each divided into squares, in perspective.
struct Stack {
    int count = 4;
    float gap = 0.25f;
};

DrawList list_of(const Stack& stack) {
    DrawList list;
    list.materials = {{.name = "glass",
                       .front = {1, 0.5f, 0.25f, 0.5f},
                       .back = {1, 0.5f, 0.25f, 0.5f},
                       .alpha_mode = AlphaMode::blend,
                       .double_sided = true,
                       .unlit = true}};
    Mesh mesh;
    for (int i = 0; i < stack.count; ++i) {
        const int cells = 3 + i;
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (int k = 0; k < (cells + 1) * (cells + 1); ++k) {
            const float x = -1.0f + 2.0f * float(k % (cells + 1)) / float(cells),
                        y = -1.0f + 2.0f * float(k / (cells + 1)) / float(cells);
            mesh.positions.push_back({x, y, -2.5f + 0.4f * x + 0.3f * y - stack.gap * float(i)});
        }
        const auto row = static_cast<std::uint32_t>(cells + 1);
        for (std::uint32_t k = 0; k < row * (row - 1); ++k)
            if (k % row + 1 < row) {
                const std::uint32_t a = first + k, c = a + row;
                mesh.indices.insert(mesh.indices.end(), {a, a + 1, c + 1, a, c + 1, c});
            }
    }
    list.meshes = {mesh};
    list.instances = {{.mesh = 0, .material = 0}};
    return list;
}

View perspective() {  // near 0.1, far 10
    View view;
    const double near = 0.1, far = 10;
    view.projection = {
        2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -(far + near) / (far - near), -1, 0, 0, -2 * far * near / (far - near), 0};
    return view;
}

struct Case {
    std::string profile, algorithm;
    DepthPath write, compare;
    DepthFormat format;
};

InvarianceCase experiment(const Case& c) {
    InvarianceCase e;
    e.render.width = e.render.height = 24;
    e.render.threads = 1;
    e.render.depth = c.format;
    e.write = c.write;
    e.compare = c.compare;
    e.algorithm = find_algorithm(c.algorithm);
    return e;
}

Measurement run(const Case& c, const Stack& stack, const InvarianceCase& e) {
    const Measurement m = measure(list_of(stack), perspective(), *find_profile(c.profile), e);
    INFO((m.refusal ? m.refusal->message(*find_profile(c.profile)) : std::string()));
    REQUIRE_FALSE(m.refusal);
    return m;
}

bool is_right(const Measurement& m) { return m.errors.total() == 0 && m.ended; }

// Whether the peel with this remedy is correct exactly where the adviser says so.
struct Verdicts {
    int tried = 0, wrong = 0;
    void add(bool safe, bool right) {
        ++tried;
        wrong += safe == right ? 0 : 1;
    }
};

template <class T>
std::vector<T> ends(std::optional<T> lowest, std::optional<T> highest, T (*before)(T), T (*after)(T)) {
    std::vector<T> values;
    if (lowest) values.insert(values.end(), {before(*lowest), *lowest});
    if (highest) values.insert(values.end(), {*highest, after(*highest)});
    return values;
}

const Case with_ulps{"ideal", "front_to_back", DepthPath::float32, DepthPath::perspective_rq, DepthFormat::d24};

}  // namespace

TEST_CASE("the machine peels without error at both ends of the adviser's epsilons and not with the next values outside",
          "[slow]") {
    Verdicts verdicts;
    int empty = 0;
    for (const float gap : {0.5f, 0x1p-12f, 0x1p-21f})
        for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f}) {
            Case c = with_ulps;
            c.format = format;
            InvarianceCase e = experiment(c);
            const SafeRange range = *run(c, {4, gap}, e).advice.epsilon_ulps;
            empty += range.is_empty() ? 1 : 0;
            for (const std::int64_t n : ends<std::int64_t>(
                     range.lowest, range.highest, [](std::int64_t v) { return v - 1; },
                     [](std::int64_t v) { return v + 1; })) {
                if (n < 0 || n > 1 << 24) continue;
                e.render.compare_epsilon = {0, static_cast<int>(n)};
                verdicts.add(range.contains(n), is_right(run(c, {4, gap}, e)));
            }
        }
    CHECK(empty > 0);
    CHECK(empty < 9);
    CHECK(verdicts.tried > 12);
    CHECK(verdicts.wrong == 0);
}

TEST_CASE("the same is true of absolute epsilons to the last bit of a double", "[slow]") {
    Verdicts verdicts;
    for (const float gap : {0.5f, 0x1p-12f})
        for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f}) {
            Case c = with_ulps;
            c.format = format;
            InvarianceCase e = experiment(c);
            const SafeAbsolute range = *run(c, {4, gap}, e).advice.epsilon;
            for (const double epsilon : ends<double>(
                     range.lowest, range.highest, [](double v) { return std::nextafter(v, -1.0); },
                     [](double v) { return std::nextafter(v, 2.0); })) {
                if (epsilon < 0 || epsilon > 1) continue;
                e.render.compare_epsilon = {epsilon, 0};
                verdicts.add(range.contains(epsilon), is_right(run(c, {4, gap}, e)));
            }
        }
    CHECK(verdicts.tried > 12);
    CHECK(verdicts.wrong == 0);
}

TEST_CASE("geforce3 peels without error at both ends of the adviser's biases and not with the next values outside") {
    const Case c{"geforce3", "depth_units", DepthPath::window_z, DepthPath::perspective_rq, DepthFormat::d24};
    Verdicts verdicts;
    for (const float gap : {0.5f, 0x1p-14f}) {
        InvarianceCase e = experiment(c);
        const SafeRange range = *run(c, {4, gap}, e).advice.bias;
        for (const std::int64_t n : ends<std::int64_t>(
                 range.lowest, range.highest, [](std::int64_t v) { return v - 1; },
                 [](std::int64_t v) { return v + 1; })) {
            e.render.raster.polygon_offset = {true, 0, static_cast<float>(n)};
            verdicts.add(range.contains(n), is_right(run(c, {4, gap}, e)));
        }
    }
    CHECK(verdicts.tried == 8);
    CHECK(verdicts.wrong == 0);
}

TEST_CASE("passes that see one depth find every layer once in N + 1 passes") {
    Case c = with_ulps;
    c.compare = c.write;
    const Measurement m = run(c, {5, 0.25f}, experiment(c));
    CHECK(m.paths.fragments > 0);
    CHECK(m.paths.differing == 0);
    CHECK(is_right(m));
    CHECK(m.passes == m.errors.layers_max + 1);
    CHECK(m.image.max_difference < 0.01);
}

TEST_CASE("a compared depth that is not rounded like the stored one never ends") {
    Case c = with_ulps;
    InvarianceCase e = experiment(c);
    e.render.quantize_reference = false;
    const Measurement m = run(c, {6, 0.25f}, e);
    CHECK_FALSE(m.ended);
    CHECK(m.errors.total() > 0);
    CHECK_FALSE(m.advice.epsilon_ulps);
}

TEST_CASE("dual peeling loses the layers that its epsilon merges") {
    const Case c{"ideal", "dual", DepthPath::float32, DepthPath::float32, DepthFormat::d32f};
    InvarianceCase e = experiment(c);
    CHECK(is_right(run(c, {4, 0x1p-12f}, e)));
    e.render.compare_epsilon = {0.5, 0};
    CHECK(run(c, {4, 0x1p-12f}, e).errors.lost > 0);
}

TEST_CASE("what a profile cannot do is a rejection and not an error") {
    const Case c{"geforce3", "front_to_back", DepthPath::window_z, DepthPath::perspective_rq, DepthFormat::d24};
    CHECK(measure(list_of({}), perspective(), *find_profile(c.profile), experiment(c)).refusal);
}
