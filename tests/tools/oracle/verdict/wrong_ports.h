// tests/tools/oracle/verdict/wrong_ports.h - pictures of ports that composite wrong fragments: the lists of
// Renderer::fragments are changed by a function of the test, and blended step by step by port_model.h.
#pragma once
#include <functional>

#include "tests/tools/oracle/verdict/opened_scene.h"
#include "tests/tools/oracle/verdict/port_model.h"

namespace strata::test {

// The fragments of a pixel, near to far, equal depths in submission order.
struct PortList {
    std::vector<pipeline::CapturedFragment> visible{}, hidden{};
    Rgba background{};  // colour of the opaque surface, or the clear colour
    bool has_opaque = false;
};
using ChangeList = std::function<void(PortList&)>;

// 8-bit accumulators with rounding to nearest and this order of blending.
inline oracle::verdict::Hypothesis port_of_codes(oracle::verdict::Order order) {
    using namespace oracle::verdict;
    const End end{Storage::unorm8, SourceRounding::stored, Rounding::nearest};
    return {.order = order,
            .front = end,
            .back = end,
            .result = {Storage::unorm8, SourceRounding::unrounded, Rounding::nearest}};
}

// The picture of a port that applies a change to every list. `seed` decides where the hypothesis leaves a choice.
inline oracle::TargetImage picture_of_port(const OpenedScene& opened, const oracle::verdict::Hypothesis& hypothesis,
                                           const ChangeList& change, std::uint64_t seed = 1) {
    peeling::RenderOptions options = opened.options;
    options.audit = false;
    peeling::Renderer renderer{opened.scene.list, opened.view, opened.profile, options};
    const peeling::FrameFragments all = renderer.fragments(*peeling::find_algorithm("front_to_back"));
    // The opaque scene is rendered as a frame whose transparent layers are all discarded: one pass of an empty peel.
    pipeline::DrawList opaque = opened.scene.list;
    std::erase_if(opaque.instances, [&](const pipeline::Instance& i) {
        return opaque.materials[i.material].alpha_mode == pipeline::AlphaMode::blend;
    });
    options.color_format = pipeline::Format::rgba32f;
    const pipeline::Image behind = peeling::Renderer{opaque, opened.view, opened.profile, options}
                                       .render(*peeling::find_algorithm("unsorted"))
                                       .frame.color;
    const auto pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
    std::vector<PortList> lists(pixels);
    for (std::size_t p = 0; p < pixels; ++p) {
        for (std::size_t c = 0; c < 4; ++c)
            lists[p].background[static_cast<int>(c)] = std::bit_cast<float>(behind.codes[4 * p + c]);
        lists[p].has_opaque = std::bit_cast<float>(all.opaque[p]) < 1.0f;
    }
    for (const pipeline::CapturedFragment& f : all.all)
        (f.code < all.opaque[f.pixel] ? lists[f.pixel].visible : lists[f.pixel].hidden).push_back(f);
    PortModel port{hypothesis, seed};
    oracle::TargetImage picture{
        .name = "color", .code = oracle::Code::unorm8, .width = options.width, .height = options.height, .channels = 4};
    for (PortList& list : lists) {
        std::ranges::stable_sort(list.visible, {}, &pipeline::CapturedFragment::code);
        std::ranges::stable_sort(list.hidden, {}, &pipeline::CapturedFragment::code);
        if (change) change(list);
        oracle::verdict::Stack stack{.background = list.background};
        for (const pipeline::CapturedFragment& f : list.visible) stack.layers.push_back({.color = f.color});
        // A peel from both ends divides the depths into halves, not the layers.
        std::size_t depths = 0;
        std::vector<std::size_t> depth_of;
        for (std::size_t i = 0; i < list.visible.size(); ++i) {
            depths += i == 0 || list.visible[i].code != list.visible[i - 1].code ? 1 : 0;
            depth_of.push_back(depths);
        }
        stack.near = static_cast<std::size_t>(
            std::ranges::count_if(depth_of, [&](std::size_t d) { return d <= (depths + 1) / 2; }));
        stack.near_without_middle =
            static_cast<std::size_t>(std::ranges::count_if(depth_of, [&](std::size_t d) { return d <= depths / 2; }));
        for (const double v : port.composite(stack))
            picture.codes.push_back(static_cast<std::uint32_t>(std::lround(v * 255)));
    }
    return picture;
}

}  // namespace strata::test
