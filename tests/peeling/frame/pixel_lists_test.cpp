// Tests lists of pixels against plain lists of nodes with masks, made from every sample's own fragments and composited
// in binary64. peeling/reference/algorithms.md 21.4.
#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "peeling/audit/region_trace.h"
#include "peeling/render.h"
#include "tests/peeling/rendering.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata::testing;
using strata::peeling::AlgorithmOptions;
using strata::peeling::find_algorithm;
using strata::peeling::FrameFragments;
using strata::peeling::ListGranularity;
using strata::peeling::Outcome;
using strata::peeling::Overflow;
using strata::peeling::Renderer;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::peeling::Tail;
using strata::pipeline::Fault;
using strata::pipeline::find_profile;
using strata::pipeline::Image;
using strata::rasterizer::Interpolation;

using Color = std::array<double, 3>;

struct Node {
    std::uint32_t key = 0;
    unsigned mask = 0;
    Color color{};
    double alpha = 0;
};
using Nodes = std::vector<Node>;  // of a pixel, in submission order

// What a model composites: nodes from near to far over a colour, and that colour.
using Model = Color (*)(const Nodes&, const AlgorithmOptions&, unsigned bit, Color behind);

RenderOptions options_of(int samples, Interpolation interpolation) {
    RenderOptions options;
    options.width = 41, options.height = 33;
    options.threads = 1;
    options.color_format = strata::pipeline::Format::rgba32f;
    options.sampling.samples = samples;
    options.raster.interpolation = interpolation;
    options.algorithm.list_granularity = ListGranularity::pixel;
    options.keep_samples = true;
    return options;
}

// The fragments of every sample, joined by triangle.
std::vector<Nodes> nodes_of(const TriangleScene& scene, const RenderOptions& options) {
    Renderer renderer{scene.list, scene.view, *find_profile("ideal"), options};
    const FrameFragments found = renderer.fragments(*find_algorithm("front_to_back"));
    const auto pixels = static_cast<std::size_t>(options.width * options.height);
    std::map<std::pair<std::uint32_t, std::uint32_t>, Node> joined;
    for (const auto& f : found.all) {
        if (f.code >= found.opaque[f.sample * pixels + f.pixel]) continue;
        Node& node = joined[{f.pixel, f.primitive}];
        node.key = std::bit_cast<std::uint32_t>(std::clamp(f.shader_z, 0.0f, 1.0f));
        node.mask |= 1u << f.sample;
        node.color = {f.color[0], f.color[1], f.color[2]};
        node.alpha = f.color[3];
    }
    std::vector<Nodes> nodes(pixels);
    for (const auto& [at, node] : joined) nodes[at.first].push_back(node);
    return nodes;
}

Color over(const Node& node, const Color& below) {
    Color color;
    for (std::size_t c = 0; c < 3; ++c) color[c] = node.alpha * node.color[c] + (1 - node.alpha) * below[c];
    return color;
}

Color composited(const Nodes& near_to_far, unsigned bit, Color behind) {
    for (std::size_t i = near_to_far.size(); i-- > 0;)
        if ((near_to_far[i].mask & bit) != 0) behind = over(near_to_far[i], behind);
    return behind;
}

Color linked_list(const Nodes& nodes, const AlgorithmOptions& options, unsigned bit, Color behind) {
    const std::size_t most = options.pixel_nodes == 0 ? nodes.size() : static_cast<std::size_t>(options.pixel_nodes);
    Nodes kept = nodes;
    if (options.overflow != Overflow::drop_far && kept.size() > most) {
        for (std::size_t i = most; options.overflow == Overflow::blend && i < nodes.size(); ++i)
            if ((nodes[i].mask & bit) != 0) behind = over(nodes[i], behind);
        kept.resize(most);
    }
    std::ranges::stable_sort(kept, {}, &Node::key);
    if (kept.size() > most) kept.resize(most);
    return composited(kept, bit, behind);
}

// The k least keys; of a shared entry the last node stays.
Color atomic_loop(const Nodes& nodes, const AlgorithmOptions& options, unsigned bit, Color behind) {
    std::vector<std::uint32_t> keys;
    for (const Node& node : nodes) keys.push_back(node.key);
    std::ranges::sort(keys);
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    keys.resize(std::min(keys.size(), static_cast<std::size_t>(options.nodes)));
    Nodes entries(keys.size());
    for (const Node& node : nodes) {
        const auto at = std::ranges::find(keys, node.key);
        if (at != keys.end())
            entries[static_cast<std::size_t>(at - keys.begin())] = node;
        else if ((node.mask & bit) != 0)
            behind = over(node, behind);
    }
    return composited(entries, bit, behind);
}

// The k nearest; the mean of the others with their mean alpha, as weighted_average has it.
Color hybrid_transparency(const Nodes& nodes, const AlgorithmOptions& options, unsigned bit, Color behind) {
    Nodes sorted = nodes;
    std::ranges::stable_sort(sorted, {}, &Node::key);
    const std::size_t core = std::min(sorted.size(), static_cast<std::size_t>(options.nodes));
    Color sum{};
    double alphas = 0, count = 0;
    for (std::size_t i = core; i < sorted.size(); ++i) {
        if ((sorted[i].mask & bit) == 0) continue;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += sorted[i].alpha * sorted[i].color[c];
        alphas += sorted[i].alpha;
        ++count;
    }
    if (alphas > 0) {
        const double through = std::pow(1 - alphas / count, count);
        for (std::size_t c = 0; c < 3; ++c) behind[c] = sum[c] / alphas * (1 - through) + through * behind[c];
    }
    sorted.resize(core);
    return composited(sorted, bit, behind);
}

// Four entries; a fifth pushes the nearest out, which is composited under what was pushed out before.
Color k_buffer(const Nodes& nodes, const AlgorithmOptions& /*options*/, unsigned bit, Color behind) {
    Nodes order, entries;
    for (const Node& node : nodes) {
        entries.insert(std::ranges::upper_bound(entries, node.key, {}, &Node::key), node);
        if (entries.size() <= 4) continue;
        order.push_back(entries.front());
        entries.erase(entries.begin());
    }
    order.insert(order.end(), entries.begin(), entries.end());
    return composited(order, bit, behind);
}

// A layer of several nodes is shown at every sample that one of them has.
Color multi_layer(const Nodes& nodes, const AlgorithmOptions& options, unsigned bit, Color behind) {
    struct Layer {
        std::uint32_t key;
        unsigned mask;
        Nodes near_to_far;
    };
    std::vector<Layer> layers;
    for (const Node& node : nodes) {
        layers.insert(std::ranges::lower_bound(layers, node.key, {}, &Layer::key), {node.key, node.mask, {node}});
        if (layers.size() <= static_cast<std::size_t>(options.nodes)) continue;
        const Layer last = layers.back();
        layers.pop_back();
        layers.back().mask |= last.mask;
        layers.back().near_to_far.insert(layers.back().near_to_far.end(), last.near_to_far.begin(),
                                         last.near_to_far.end());
    }
    for (std::size_t i = layers.size(); i-- > 0;) {
        for (Node& node : layers[i].near_to_far) node.mask = layers[i].mask;
        behind = composited(layers[i].near_to_far, bit, behind);
    }
    return behind;
}

Color color_at(const Image& image, std::size_t pixel) {
    Color color;
    for (std::size_t c = 0; c < 3; ++c) color[c] = std::bit_cast<float>(image.codes[4 * pixel + c]);
    return color;
}

// Samples of which a channel is off by more than the model's tolerance. A half has 11 bits, in tails that are sums.
std::uint64_t unlike(const RenderResult& drawn, const RenderResult& opaque, const std::vector<Nodes>& nodes,
                     Model model, const RenderOptions& options, double tolerance) {
    std::uint64_t wrong = 0;
    for (std::size_t s = 0; s < drawn.frame.samples.size(); ++s)
        for (std::size_t p = 0; p < nodes.size(); ++p) {
            const Color expected = model(nodes[p], options.algorithm, 1u << s, color_at(opaque.frame.samples[s], p));
            const Color found = color_at(drawn.frame.samples[s], p);
            bool is_alike = true;
            for (std::size_t c = 0; c < 3; ++c)
                is_alike &= std::fabs(expected[c] - found[c]) <= tolerance * std::max(1.0, std::fabs(expected[c]));
            wrong += is_alike ? 0 : 1;
        }
    return wrong;
}

RenderResult drawn_by(const TriangleScene& scene, const std::string& algorithm, const RenderOptions& options) {
    return render(scene.list, scene.view, {"ideal", algorithm}, options);
}

struct Choice {
    std::string algorithm;
    Model model;
    AlgorithmOptions options{};
};

std::vector<Choice> choices() {
    std::vector<Choice> all{{"linked_list", linked_list}, {"k_buffer", k_buffer}};
    for (const Overflow rule : {Overflow::drop_new, Overflow::drop_far, Overflow::blend})
        all.push_back({"linked_list", linked_list, {.pixel_nodes = 4, .overflow = rule}});
    for (const int nodes : {1, 4}) all.push_back({"multi_layer", multi_layer, {.nodes = nodes}});
    for (const int nodes : {1, 4, 8}) {
        all.push_back({"atomic_loop", atomic_loop, {.nodes = nodes, .tail = Tail::blend}});
        all.push_back({"hybrid_transparency", hybrid_transparency, {.nodes = nodes, .tail = Tail::average}});
    }
    for (Choice& choice : all) choice.options.list_granularity = ListGranularity::pixel;
    return all;
}

}  // namespace

TEST_CASE("a list of a pixel has nodes with masks that are composited at the samples they have in every execution") {
    const TriangleScene scene = random_triangles(5601, 50);
    TriangleScene solid = scene;
    solid.list.instances.erase(solid.list.instances.begin(), solid.list.instances.begin() + 2);
    for (const int samples : {2, 4, 8})
        for (const Interpolation interpolation : {Interpolation::centre, Interpolation::centroid}) {
            RenderOptions options = options_of(samples, interpolation);
            const std::vector<Nodes> nodes = nodes_of(scene, options);
            const RenderResult opaque = drawn_by(solid, "linked_list", options);
            std::uint64_t partial = 0;
            for (const Nodes& of_pixel : nodes)
                for (const Node& node : of_pixel) partial += node.mask != (1u << samples) - 1 ? 1 : 0;
            CHECK(partial > 500);
            for (const Choice& choice : choices()) {
                INFO(samples << " samples, " << choice.algorithm << ", " << choice.options.nodes << " nodes, "
                             << choice.options.pixel_nodes << " nodes a pixel");
                options.algorithm = choice.options;
                const RenderResult drawn = drawn_by(scene, choice.algorithm, options);
                REQUIRE(drawn.outcome == Outcome::done);
                CHECK(unlike(drawn, opaque, nodes, choice.model, options, 1e-4) == 0);
                CHECK_FALSE(drawn.audit.order_errors);
                RenderOptions other = options;
                other.execution = strata::pipeline::Execution::literal;
                other.fragment_memory = 4096;
                other.audit = false;
                CHECK(drawn_by(scene, choice.algorithm, other).frame.samples == drawn.frame.samples);
            }
        }
}

TEST_CASE("the trace of lists of pixels has every node at each sample of its mask") {
    const TriangleScene scene = random_triangles(5603, 30);
    const RenderOptions options = options_of(4, Interpolation::centre);
    const std::vector<Nodes> nodes = nodes_of(scene, options);
    const auto pixels = static_cast<std::uint32_t>(options.width * options.height);
    for (const char* algorithm : {"linked_list", "k_buffer"}) {
        RenderOptions whole = options;
        whole.execution = strata::pipeline::Execution::literal;
        Renderer renderer{scene.list, scene.view, *find_profile("ideal"), whole};
        std::vector<strata::peeling::RegionTrace> traces;
        REQUIRE(renderer.render_traced(*find_algorithm(algorithm), traces).outcome == Outcome::done);
        std::vector<std::vector<std::uint32_t>> found(4 * nodes.size()), expected(4 * nodes.size());
        for (const auto& trace : traces)
            for (const auto& entry : trace.entries) found[entry.pixel].push_back(entry.key);
        for (std::size_t e = 0; e < expected.size(); ++e) {
            for (const Node& node : nodes[e % pixels])
                if ((node.mask >> e / pixels & 1u) != 0) expected[e].push_back(node.key);
            std::ranges::sort(expected[e]);
            std::ranges::sort(found[e]);
        }
        INFO(algorithm);
        CHECK(found == expected);
    }
}

TEST_CASE("along edges inside a surface lists of pixels overflow where lists of samples do not") {
    // A pane of 8 x 8 cells of two triangles, in four layers.
    TriangleScene scene = random_triangles(1, 0);
    scene.list.instances.clear();
    strata::pipeline::Mesh mesh;
    for (int layer = 0; layer < 4; ++layer)
        for (int cell = 0; cell < 64; ++cell) {
            const float z = 2.0f + static_cast<float>(layer);
            const auto corner = [&](int x, int y) {
                mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
                mesh.positions.push_back({(static_cast<float>(cell % 8 + x) / 8.0f - 0.47f) * z,
                                          (static_cast<float>(cell / 8 + y) / 8.0f - 0.48f) * z, -z});
                mesh.colors.push_back({0.5f, 0.25f, 1.0f, 0.5f});
            };
            for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}) corner(x, y);
        }
    scene.list.meshes.push_back(mesh);
    scene.list.instances.push_back({.mesh = static_cast<std::uint32_t>(scene.list.meshes.size() - 1), .material = 0});
    std::array<std::uint64_t, 3> overflowing{};
    for (std::size_t i = 0; i < 3; ++i) {
        RenderOptions options = options_of(1 << (i == 0 ? 0 : i + 1), Interpolation::centre);
        options.algorithm.pixel_nodes = 4;
        overflowing[i] = diagnosed(drawn_by(scene, "linked_list", options), Fault::buffer_overflow);
        options.algorithm.list_granularity = ListGranularity::sample;
        options.raster.interpolation = Interpolation::sample;
        CHECK(diagnosed(drawn_by(scene, "linked_list", options), Fault::buffer_overflow) == 0);
    }
    CHECK(overflowing[0] == 0);
    CHECK(overflowing[1] > 200);
    CHECK(overflowing[2] >= overflowing[1]);
}

TEST_CASE("a list of a pixel is refused where its nodes would not have one colour or one mask") {
    const TriangleScene scene = random_triangles(5602, 4);
    const auto refusal = [&](const RenderOptions& options, const std::string& algorithm = "linked_list") {
        const RenderResult result = drawn_by(scene, algorithm, options);
        return result.refusal ? result.refusal->feature : "";
    };
    RenderOptions options = options_of(4, Interpolation::sample);
    CHECK(refusal(options).starts_with("lists of pixels with per-sample shading"));
    CHECK(refusal(options, "adaptive").empty());
    options.raster.interpolation = Interpolation::centre;
    CHECK(refusal(options).empty());
    CHECK(refusal(options, "adaptive").starts_with("per-pixel shading"));
    options.raster.sample_coverage.mask = 5;
    CHECK(refusal(options).starts_with("lists of pixels with samples that are dropped"));
    options.raster.sample_coverage = {};
    options.algorithm.nodes = 5;
    CHECK(refusal(options, "multi_layer").starts_with("targets for more than 4 layers"));
    options.algorithm.list_granularity = ListGranularity::sample;
    CHECK(refusal(options).starts_with("per-pixel shading"));
}
