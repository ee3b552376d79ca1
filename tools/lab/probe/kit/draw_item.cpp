// tools/lab/probe/kit/draw_item.cpp - draws a scene of the kit by the pipeline's stages with a profile's rules; a
// device without a needed format or state refuses it (draw_item.h).
#include "tools/lab/probe/kit/draw_item.h"

#include <algorithm>
#include <numeric>

#include "pipeline/device/check.h"
#include "pipeline/region/region.h"
#include "rasterizer/base/float_environment.h"
#include "rasterizer/values/depth_paths.h"

namespace strata::probe {

namespace {

using pipeline::DeviceProfile;
using rasterizer::DepthPath;

// Without a depth buffer no depth is used, and any format that the depth paths support will do.
DepthFormat format_of(const DeviceProfile& profile, const Item& item) {
    return profile.stored(item.depth.value_or(DepthFormat::d24));
}

rasterizer::RasterState raster_state(const DeviceProfile& profile, const Item& item, const Draw& draw, YDirection y) {
    rasterizer::RasterState state;
    state.viewport = {0, 0, item.width, item.height};
    state.y_direction = y;
    state.depth_near = item.depth_near;
    state.depth_far = item.depth_far;
    state.cull = rasterizer::CullFace::none;
    state.polygon_offset = draw.offset;
    state.depth_format = format_of(profile, item);
    return state;
}

pipeline::PreparedDraw prepared(const DeviceProfile& profile, const Item& item, const Draw& draw, YDirection y) {
    const rasterizer::RasterState state = raster_state(profile, item, draw, y);
    rasterizer::TriangleSoup soup;
    soup.vertices.assign(draw.corners.begin(), draw.corners.end());
    soup.indices.resize(draw.corners.size());
    std::iota(soup.indices.begin(), soup.indices.end(), 0u);
    soup.runs = {{.first_index = 0, .index_count = static_cast<std::uint32_t>(soup.indices.size())}};
    if (profile.raster.depth_path == DepthPath::perspective_rq) rasterizer::add_rq(soup, state, profile.raster);
    pipeline::PreparedDraw list;
    list.geometry = rasterizer::set_up(std::move(soup), state, profile.raster, 1);
    rasterizer::bin_triangles(list.geometry, 128);
    list.materials.emplace_back();
    return list;
}

pipeline::PassState pass_state(const Item& item, const Draw& draw) {
    pipeline::PassState pass;
    pass.depth = {.enabled = item.depth.has_value(), .func = pipeline::CompareFunc::always, .write = true};
    if (draw.blend) pass.blend[0] = {.enabled = true, .color = *draw.blend, .alpha = *draw.blend};
    if (draw.alpha_above)
        pass.alpha = {.enabled = true, .func = pipeline::CompareFunc::greater, .ref = *draw.alpha_above};
    pass.needs.shader_z = false;
    pass.needs.code = item.depth.has_value();
    pass.needs.color = true;
    return pass;
}

void check_item(const DeviceProfile& profile, const Item& item) {
    const auto require = [&](std::optional<pipeline::Refusal> verdict) {
        if (verdict) throw pipeline::Refused{profile, *std::move(verdict)};
    };
    require(pipeline::check_size(profile, item.width, item.height));
    require(pipeline::check(profile, item.color));
    if (!item.depth) return;
    require(pipeline::check(profile, *item.depth));
    require(pipeline::check(profile, profile.raster.depth_path));
    if (*item.depth == DepthFormat::d32f && profile.raster.depth_path == DepthPath::window_z)
        throw pipeline::Refused{profile, {"float depth buffers for its depth path window_z", "", ""}};
}

Answer drawn(const DeviceProfile& profile, const Item& item, YDirection y) {
    const FloatEnvironment ours;
    pipeline::PreparedDraw list;
    list.geometry.state.viewport = {0, 0, item.width, item.height};
    pipeline::Frame frame;
    frame.profile = &profile;
    frame.transparent = &list;
    frame.depth = {profile.raster.depth_path, format_of(profile, item)};
    frame.color_format = item.color;
    pipeline::RegionStatistics books;
    pipeline::Region region{frame, {frame.rect()}, books};
    const pipeline::Target color = region.make_color();
    region.clear(color, {.color = {item.clear[0], item.clear[1], item.clear[2], item.clear[3]}});
    pipeline::Target depth;
    if (item.depth) {
        depth = region.make_depth();
        region.clear(depth, {.depth = 1.0f});
    }
    for (const Draw& draw : item.draws) {
        list = prepared(profile, item, draw, y);
        pipeline::PassState pass = pass_state(item, draw);
        pass.color[0] = color;
        pass.depth_target = depth;
        static_cast<void>(
            region.draw(pass, [](const pipeline::FragmentBatch& in, const pipeline::Loads&, pipeline::Outputs& out) {
                for (std::size_t c = 0; c < 4; ++c) std::copy_n(in.color[c].begin(), in.count, out.color[0][c].begin());
            }));
    }
    Answer answer{.color = region.targets().image(color)};
    if (item.depth) answer.depth = region.targets().image(depth);
    return answer;
}

}  // namespace

Reply draw_item(const DeviceProfile& profile, const Item& item, YDirection y) {
    try {
        check_item(profile, item);
        return {.answer = drawn(profile, item, y)};
    } catch (const pipeline::Refused& refused) {
        return {.answer = std::nullopt, .refusal = refused.what()};
    }
}

}  // namespace strata::probe
