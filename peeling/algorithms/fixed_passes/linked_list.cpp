// peeling/algorithms/fixed_passes/linked_list.cpp - stores every visible fragment in a list of its pixel, as long as
// nodes are left, and sorts and composites the lists after the pass. Yang et al. 2010, "Real-Time Concurrent Linked
// List Construction on the GPU"; peeling/reference/algorithms.md 20.
//
// Needs      unordered access with atomics.
// Passes     1. Of equal depths the first submitted is in front. Exact unless nodes run out, which is reported.
// Invariant  a pixel's list contains its fragments in submission order. This is assumed: on a device the order depends
//            on its threads.
// If the lists of a region do not fit into the memory, they are built for one range of pixels after another, and the
// pass is counted once.
#include <algorithm>

#include "peeling/algorithms/entry.h"
#include "peeling/programs/depth_range.h"
#include "peeling/programs/fixed_passes/pixel_lists.h"
#include "peeling/programs/fragment_lists.h"
#include "peeling/programs/tie_order.h"
#include "peeling/programs/under.h"

namespace strata::peeling::listing::linked_list {

using namespace pipeline;

namespace {

struct NodeLists {
    Region& region;
    const AlgorithmOptions& options;
    ListElements elements;
    std::vector<std::uint32_t> coverage;          // of every list
    std::vector<Rgba> composited;                 // of every element whose list has fragments
    std::uint64_t last_node = ~std::uint64_t{0};  // the key of the last fragment that gets one of the frame's nodes

    [[nodiscard]] PixelRange range_from(std::uint32_t first) const {
        return next_range(coverage, region.rect().width(), first, region.frame().list_bytes / sizeof(KeyedFragment));
    }
    void fill(const PixelRange& range, Counting counting, FragmentLists& found) const {
        if (elements.are_pixels())
            list_pixels(region, range, coverage, counting, found);
        else
            list_visible(region, range, coverage, counting, found);
    }
    // The number of `count` fragments for which the pixel's own limit leaves nodes.
    [[nodiscard]] std::size_t most(std::size_t count) const {
        const auto limit = static_cast<std::size_t>(options.pixel_nodes);
        return limit == 0 ? count : std::min(count, limit);
    }
};

// The order in which fragments take the nodes of a frame: by triangle, and row by row within a triangle (assumed).
std::uint64_t node_key(const KeyedFragment& fragment, std::uint32_t pixel) {
    return std::uint64_t{fragment.primitive} << 32 | pixel;
}

// Finds the fragment that takes the last node of the frame, if --frame-nodes limits them. The region is then the whole
// frame.
void give_out_nodes(NodeLists& lists) {
    if (lists.options.frame_nodes == 0) return;
    std::vector<std::uint64_t> keys;
    FragmentLists found;
    for (std::uint32_t first = 0; first < lists.coverage.size(); first = found.pixels.last) {
        lists.fill(lists.range_from(first), Counting::silent, found);
        for (std::uint32_t pixel = first; pixel < found.pixels.last; ++pixel) {
            const auto fragments = found.of(pixel);
            for (std::size_t i = 0; i < lists.most(fragments.size()); ++i)
                keys.push_back(node_key(fragments[i], pixel));
        }
    }
    const auto nodes = static_cast<std::size_t>(lists.options.frame_nodes);
    if (keys.size() <= nodes) return;
    const auto last = keys.begin() + static_cast<std::ptrdiff_t>(nodes - 1);
    std::nth_element(keys.begin(), last, keys.end());
    lists.last_node = *last;
}

// OVER with a source that is not premultiplied, each operation rounded to binary32; alpha by algorithms.md 0.8.
void blend_over(Rgba& below, const Rgba& source) noexcept {
    const float a = source[3];
    for (Rgba::length_type c = 0; c < 3; ++c) below[c] = a * source[c] + (1.0f - a) * below[c];
    below[3] = scalar::alpha_over(1.0f - a, below[3]);
}

// Composites one list: the fragments that have nodes, sorted by depth, or the nearest of all fragments
// (Overflow::drop_far). With Overflow::blend the fragments without a node are first blended onto the background. A list
// of a pixel is composited at each sample from the nodes that have it.
void composite_list(NodeLists& lists, std::uint32_t pixel, const FragmentLists& found, PixelSet& overflow,
                    FragmentOrder& order) {
    const std::span<const KeyedFragment> fragments = found.of(pixel);
    std::size_t nodes = lists.most(fragments.size());
    while (nodes > 0 && node_key(fragments[nodes - 1], pixel) > lists.last_node) --nodes;
    const Overflow rule = lists.options.overflow;
    const bool is_full = nodes < fragments.size();
    if (is_full) overflow.add(pixel);
    const bool keeps_near = is_full && rule == Overflow::drop_far;
    sort_by(&KeyedFragment::key, keeps_near ? fragments : fragments.first(nodes), order);
    if (keeps_near) order.resize(nodes);
    lists.elements.for_each_element(pixel, 0xff, [&](std::uint32_t element) {
        Rgba color = lists.region.targets().color(lists.region.opaque_color(), element);
        const auto blend = [&](std::size_t i) {
            if ((found.samples_of(pixel, i) & lists.elements.bit_of(element)) != 0)
                blend_over(color, fragments[i].color);
        };
        if (rule == Overflow::blend)
            for (std::size_t i = nodes; i < fragments.size(); ++i) blend(i);
        for (std::size_t i = order.size(); i-- > 0;) blend(submission_index(order[i]));
        lists.composited[element] = color;
    });
    if (!lists.region.frame().trace) return;
    for (const std::uint64_t entry : order) {
        const std::size_t i = submission_index(entry);
        lists.elements.for_each_element(pixel, found.samples_of(pixel, i), [&](std::uint32_t element) {
            lists.region.trace({element, fragments[i].key, fragments[i].primitive, Side::front, true});
        });
    }
}

// The last quad, which sorts and composites the lists on a device.
void store(Region& region, const NodeLists& lists) {
    const Target result = region.make(region.frame().picture_format());
    region.set_name(result, "result");
    PassState state;
    state.color[0] = result;
    state.reads[0] = region.opaque_color();
    static_cast<void>(region.full_screen(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const bool has_list = lists.coverage[lists.elements.list_of(in.pixel[i])] > 0;
            for (std::size_t c = 0; c < 4; ++c)
                out.color[0][c][i] =
                    has_list ? lists.composited[in.pixel[i]][static_cast<int>(c)] : loads.color(0)[c][i];
        }
    }));
    region.publish(result);
}

void run(Region& region, const ListingInputs& inputs) {
    region.begin_iteration();
    const ListElements elements{region, inputs.options.list_granularity};
    NodeLists lists{region, inputs.options, elements,
                    elements.are_pixels() ? coverage_of_pixels(region) : coverage_of(region),
                    std::vector<Rgba>(region.elements())};
    give_out_nodes(lists);
    const bool is_one_range = lists.range_from(0).size() == lists.coverage.size();
    if (!is_one_range) count_list_pass(region, elements.are_pixels());
    PixelSet overflow{region};
    FragmentLists found;
    FragmentOrder order;
    for (std::uint32_t first = 0; first < lists.coverage.size(); first = found.pixels.last) {
        lists.fill(lists.range_from(first), is_one_range ? Counting::counted : Counting::silent, found);
        for (std::uint32_t pixel = first; pixel < found.pixels.last; ++pixel)
            if (lists.coverage[pixel] > 0) composite_list(lists, pixel, found, overflow, order);
    }
    overflow.report(region, Fault::buffer_overflow, "more fragments than nodes");
    store(region, lists);
}

}  // namespace

std::vector<Algorithm> entries() {
    return {Algorithm{
        .name = "linked_list",
        .listed = 200,
        .paper = "Yang et al. 2010",
        .section = "",
        .summary = "every fragment in a list of its pixel, sorted at the end; or as many as there are nodes for",
        .pass_formula = "1",
        .ties = TiePolicy::first,
        .exact = true,
        .has_lists = true,
        .shares_nodes = true,
        .compares_own_codes = true,
        .geometry_passes = one_pass,
        .run_with = run,
        .features = {unordered_access, fragment_programs}}};
}

}  // namespace strata::peeling::listing::linked_list
