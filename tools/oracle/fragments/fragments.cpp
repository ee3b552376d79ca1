// tools/oracle/fragments/fragments.cpp - draws the scene tile by tile, keeps every visible fragment in depth order,
// and answers for one pixel at a time (fragments.h).
#include "tools/oracle/fragments/fragments.h"

#include <algorithm>
#include <bit>
#include <mutex>
#include <numeric>
#include <utility>

#include "peeling/as_shown.h"
#include "peeling/render.h"
#include "pipeline/region/region.h"
#include "rasterizer/base/parallel.h"
#include "tools/oracle/fragments/coverages.h"

namespace strata::oracle::verdict {

namespace {

using pipeline::FragmentBatch;
using pipeline::Loads;
using pipeline::Outputs;
using pipeline::Region;

struct Captured {
    std::uint32_t pixel = 0;  // index in the region
    Fragment fragment{};
};

constexpr int tile_side = 64;  // pixels

constexpr rasterizer::FragmentNeeds all_values{
    .shader_z = true, .code = true, .exact_code = false, .color = true, .texcoord = false, .facing = true};

// The region's fragments in submission order, after the alpha test of MASK and before all other tests.
std::vector<Captured> capture(Region& region, std::span<const std::uint32_t> instance_of,
                              const std::vector<pipeline::Instance>& instances) {
    std::vector<Captured> all;
    pipeline::PassState state;
    state.needs = all_values;
    static_cast<void>(region.draw(state, [&](const FragmentBatch& in, const Loads&, Outputs& out) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) {
            if (out.alive[i] == 0) continue;
            const std::uint32_t primitive = in.primitive[i];
            all.push_back({in.pixel[i],
                           {.color = {in.color[0][i], in.color[1][i], in.color[2][i], in.color[3][i]},
                            .code = in.code[i],
                            .shader_z = in.shader_z[i],
                            .primitive = primitive,
                            .instance = instance_of[primitive],
                            .material = instances[instance_of[primitive]].material,
                            .is_front_facing = in.front_facing[i] != 0}});
        }
    }));
    return all;
}

// Sorts the fragments into the lists of their pixels: visible ones first, each part by code.
TileLists sorted_into_lists(const Region& region, const std::vector<Captured>& captured) {
    const rasterizer::Rect rect = region.rect(), frame = region.frame().rect();
    TileLists tile{.rect = {rect.x0 - frame.x0, rect.y0 - frame.y0, rect.x1 - frame.x0, rect.y1 - frame.y0}};
    const std::size_t pixels = tile.rect.area();
    const std::uint32_t* const opaque = region.storage(region.opaque_depth()).depth(0);
    tile.opaque.assign(opaque, opaque + pixels);
    tile.start.assign(pixels + 1, 0);
    tile.hidden.assign(pixels, 0);
    const auto is_visible = [&](const Captured& c) { return c.fragment.code < opaque[c.pixel]; };
    for (const Captured& c : captured) {
        ++tile.start[c.pixel + 1];
        tile.hidden[c.pixel] += is_visible(c) ? 1 : 0;
    }
    std::partial_sum(tile.start.begin(), tile.start.end(), tile.start.begin());
    for (std::size_t p = 0; p < pixels; ++p) tile.hidden[p] += tile.start[p];
    std::vector<std::uint32_t> visible(tile.start.begin(), tile.start.end() - 1), hidden = tile.hidden;
    tile.fragments.resize(captured.size());
    for (const Captured& c : captured)
        tile.fragments[is_visible(c) ? visible[c.pixel]++ : hidden[c.pixel]++] = c.fragment;
    const auto sort = [&](std::uint32_t first, std::uint32_t last) {
        const auto at = [&](std::uint32_t i) { return tile.fragments.begin() + static_cast<std::ptrdiff_t>(i); };
        std::stable_sort(at(first), at(last), [](const Fragment& a, const Fragment& b) { return a.code < b.code; });
    };
    for (std::size_t p = 0; p < pixels; ++p) {
        sort(tile.start[p], tile.hidden[p]);
        sort(tile.hidden[p], tile.start[p + 1]);
    }
    return tile;
}

// The instance of every triangle, in submission order.
std::vector<std::uint32_t> instances_of(const peeling::FrameRequest& input) {
    std::vector<std::uint32_t> instances;
    const pipeline::DrawList& list = input.list;
    for (std::uint32_t i = 0; i < list.instances.size(); ++i) {
        const pipeline::Instance& instance = list.instances[i];
        const bool is_drawn = input.options.alpha.has_value() ||
                              list.materials[instance.material].alpha_mode == pipeline::AlphaMode::blend;
        if (is_drawn) instances.insert(instances.end(), list.meshes[instance.mesh].indices.size() / 3, i);
    }
    return instances;
}

// The pixels of a frame that are in none of the tiles, as rectangles.
std::vector<rasterizer::Rect> rest_of_frame(int width, int height, std::span<const rasterizer::Rect> tiles) {
    std::vector<bool> is_held(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const auto at = [&](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    };
    for (const rasterizer::Rect& tile : tiles)
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x) is_held[at(x, y)] = true;
    std::vector<rasterizer::Rect> rest;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if (is_held[at(x, y)]) continue;
            const int begin = x;
            while (x < width && !is_held[at(x, y)]) ++x;
            const auto above = std::ranges::find_if(
                rest, [&](const rasterizer::Rect& r) { return r.y1 == y && r.x0 == begin && r.x1 == x; });
            if (above != rest.end())
                ++above->y1;
            else
                rest.push_back({begin, y, x, y + 1});
        }
    return rest;
}

}  // namespace

SceneFragments::SceneFragments(const peeling::FrameRequest& input, std::uint64_t bytes, const Rows& rows)
    : input_{input},
      rows_{rows},
      setting_{setting_of(input.list, input.view, input.options.background)},
      instance_of_{instances_of(input)} {
    find_nearness(input.list, input.view, instance_of_, setting_);
    far_code_ = rasterizer::max_code(input.profile.depth_buffer(input.options.depth));
    std::mutex mutex;
    std::vector<rasterizer::Rect> rects;
    keep_behind(draw([&](TileLists&& tile) {
        const std::scoped_lock lock{mutex};
        rects.push_back(tile.rect);
        count_ += tile.fragments.size();
        for (std::size_t p = 0; p + 1 < tile.start.size(); ++p) {
            most_visible_ = std::max<std::size_t>(most_visible_, tile.hidden[p] - tile.start[p]);
            count_at_far_plane_ += tile.opaque[p] == far_code_ && tile.hidden[p] < tile.start[p + 1] ? 1 : 0;
        }
        keeps_ = keeps_ && count_ * sizeof(Fragment) <= bytes;
        if (keeps_)
            kept_.push_back(std::move(tile));
        else
            kept_.clear();
    }));
    // Threads finish tiles in any order.
    std::ranges::sort(kept_, {}, [](const TileLists& t) { return std::pair{t.rect.y0, t.rect.x0}; });
    index_tiles();
    if (rows_.end >= height()) blank_ = rest_of_frame(width(), height(), rects);
}

void SceneFragments::keep_behind(const pipeline::Image& drawn) {
    const peeling::AsShown shown{input_.options, input_.profile};
    const rasterizer::Rect held =
        shown.rect({0, std::max(rows_.first, 0), drawn.width, std::min(rows_.end, drawn.height)});
    first_behind_ = held.y0;
    const auto color = [&](int x, int y) {
        Rgba value{};
        for (int c = 0; c < 4; ++c) value[c] = std::bit_cast<float>(drawn.codes[drawn.index(x, y, c)]);
        return value;
    };
    const std::uint32_t* const first = &drawn.codes[drawn.index(0, held.y0)];
    const auto words = static_cast<std::size_t>(drawn.index(0, held.y1 - 1) - drawn.index(0, held.y0)) +
                       static_cast<std::size_t>(drawn.width) * 4;
    const bool is_one = std::equal(first, first + words - 4, first + 4);
    if (is_one) behind_ = {color(0, held.y0)};
    if (is_one) return;
    behind_.reserve(words / 4);
    for (int y = held.y0; y < held.y1; ++y)
        for (int x = 0; x < drawn.width; ++x) behind_.push_back(color(x, y));
}

Rgba SceneFragments::behind_at(int x, int y) const noexcept {
    if (behind_.size() == 1) return behind_[0];
    return behind_[static_cast<std::size_t>(y - first_behind_) * static_cast<std::size_t>(width()) +
                   static_cast<std::size_t>(x)];
}

// Renders the scene and passes each tile to `take`. Blank tiles are not processed one by one: the renderer runs only
// the first of them, and it must not be recorded twice.
pipeline::Image SceneFragments::draw(const std::function<void(TileLists&&)>& take) const {
    pipeline::DeviceProfile profile = input_.profile;
    profile.has_float_targets = true;  // the opaque colours are rendered unrounded
    peeling::RenderOptions options = input_.options;
    options.color_format = pipeline::Format::rgba32f;
    options.result_format = options.back_format = std::nullopt;
    options.audit = options.keep_layers = options.nearest_depth = false;
    options.execution = pipeline::Execution::replay;
    options.max_passes = 0;
    options.termination = {};
    options.tile_size = tile_side;
    options.sampling = {};
    peeling::Algorithm fragments;
    fragments.name = "fragments";
    fragments.body = [&](Region& region) {
        const rasterizer::Rect rect = region.rect(), frame = region.frame().rect();
        if (rect.y0 - frame.y0 < rows_.end && rect.y1 - frame.y0 > rows_.first)
            take(sorted_into_lists(region, capture(region, instance_of_, input_.list.instances)));
        region.publish(region.opaque_color());
    };
    peeling::Renderer renderer{input_.on(profile, options)};
    peeling::RenderResult result = renderer.render(fragments);
    if (result.refusal) throw pipeline::Refused{profile, *std::move(result.refusal)};
    return std::move(result.frame.color);
}

void SceneFragments::for_each_tile(const std::function<void(const TileLists&)>& visit) const {
    if (keeps_)
        parallel_for(kept_.size(), input_.options.threads, [&](std::size_t i) { visit(kept_[i]); });
    else
        static_cast<void>(draw([&](TileLists&& tile) { visit(tile); }));
    for (const rasterizer::Rect& rect : blank_) {
        TileLists tile{.rect = rect};
        tile.start.assign(rect.area() + 1, 0);
        tile.hidden.assign(rect.area(), 0);
        tile.opaque.assign(rect.area(), far_code_);
        visit(tile);
    }
}

void SceneFragments::index_tiles() {
    if (!keeps_) return;
    const auto squares = [](int length) { return static_cast<std::size_t>((length + tile_side - 1) / tile_side); };
    columns_ = squares(width());
    tile_of_.assign(columns_ * squares(height()), 0);
    for (std::size_t t = 0; t < kept_.size(); ++t) {
        const rasterizer::Rect& r = kept_[t].rect;  // one square, or the whole frame
        for (std::size_t y = squares(r.y0); y < squares(r.y1); ++y)
            for (std::size_t x = squares(r.x0); x < squares(r.x1); ++x)
                tile_of_[y * columns_ + x] = static_cast<std::uint32_t>(t + 1);
    }
}

const TileLists* SceneFragments::tile_at(int x, int memory_row) const noexcept {
    const std::uint32_t number =
        tile_of_[static_cast<std::size_t>(memory_row / tile_side) * columns_ + static_cast<std::size_t>(x / tile_side)];
    return number == 0 ? nullptr : &kept_[number - 1];
}

namespace {

std::size_t index_in(const TileLists& tile, int x, int memory_row) noexcept {
    return static_cast<std::size_t>(memory_row - tile.rect.y0) * static_cast<std::size_t>(tile.rect.width()) +
           static_cast<std::size_t>(x - tile.rect.x0);
}

}  // namespace

std::span<const Fragment> SceneFragments::visible_at(int x, int y) const noexcept {
    if (!keeps_ || x < 0 || y < 0 || x >= width() || y >= height()) return {};
    const int row = peeling::AsShown{input_.options, input_.profile}.row(y);
    const TileLists* const tile = tile_at(x, row);
    if (tile == nullptr) return {};
    const std::size_t pixel = index_in(*tile, x, row);
    return std::span{tile->fragments}.subspan(tile->start[pixel], tile->hidden[pixel] - tile->start[pixel]);
}

PixelList SceneFragments::list_at(int x, int memory_row) const noexcept {
    if (const TileLists* const tile = tile_at(x, memory_row)) return at(*tile, index_in(*tile, x, memory_row));
    const int y = peeling::AsShown{input_.options, input_.profile}.row(memory_row);
    return {.x = x, .y = y, .behind = behind_at(x, y), .opaque = far_code_, .scene = this};
}

std::vector<std::uint64_t> SceneFragments::bytes_of_rows() const {
    std::vector<std::uint64_t> bytes(static_cast<std::size_t>(height()));
    for (const TileLists& tile : kept_) {
        const std::uint64_t of_row = (tile.fragments.size() * sizeof(Fragment) + tile.rect.area() * 12) /
                                     static_cast<std::uint64_t>(tile.rect.height());
        for (int y = tile.rect.y0; y < tile.rect.y1; ++y) bytes[static_cast<std::size_t>(y)] += of_row;
    }
    return bytes;
}

void SceneFragments::find_coverages() {
    constexpr std::uint64_t most_fragments = std::uint64_t{1} << 21;
    if (coverages_ != nullptr || !keeps_ || count_ > most_fragments) return;
    const auto set_spread = [&](int x, int memory_row, std::span<const float> spreads) {
        const std::uint32_t number = tile_of_[static_cast<std::size_t>(memory_row / tile_side) * columns_ +
                                              static_cast<std::size_t>(x / tile_side)];
        TileLists& tile = kept_[number - 1];
        const std::size_t first = tile.start[index_in(tile, x, memory_row)];
        for (std::size_t i = 0; i < spreads.size(); ++i) tile.fragments[first + i].spread = spreads[i];
    };
    coverages_ = std::make_shared<const Coverages>(input_, *this, set_spread);
}

PixelList SceneFragments::at(const TileLists& tile, std::size_t pixel) const noexcept {
    const auto width = static_cast<std::size_t>(tile.rect.width());
    const peeling::AsShown shown{input_.options, input_.profile};  // tiles count rows in memory order
    PixelList list{.x = tile.rect.x0 + static_cast<int>(pixel % width),
                   .y = shown.row(tile.rect.y0 + static_cast<int>(pixel / width))};
    const std::uint32_t first = tile.start[pixel], end = tile.start[pixel + 1];
    const bool shows_all = shows_at_far_plane_ && tile.opaque[pixel] == far_code_;
    const std::uint32_t hidden = shows_all ? end : tile.hidden[pixel];
    list.visible = {tile.fragments.data() + first, hidden - first};
    list.hidden = {tile.fragments.data() + hidden, end - hidden};
    list.opaque = tile.opaque[pixel];
    list.has_opaque = list.opaque != far_code_;
    list.scene = keeps_ ? this : nullptr;
    list.behind = behind_at(list.x, list.y);
    if (coverages_ != nullptr) {
        list.edge = coverages_->at(list.x, list.y);
        list.behind_spread = coverages_->behind_spread(list.x, list.y);
        list.has_spreads = true;
    }
    return list;
}

}  // namespace strata::oracle::verdict
