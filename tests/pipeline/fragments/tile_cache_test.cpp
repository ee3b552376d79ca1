// Tests blends in the tile cache of softpipe, which keeps binary32 values. The model processes one fragment at a time,
// without batches, lists or planes.
#include "pipeline/fragments/tile_cache.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <optional>

#include "pipeline/region/region.h"
#include "tests/pipeline/region/both_ways.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::rasterizer::Rect;

// The cache as its specification describes it: 50 slots, each with the position of a tile. Pixels of cached tiles hold
// a float.
struct FragmentModel {
    int width, height;
    ChannelType type;
    std::vector<std::uint32_t> codes =
        std::vector<std::uint32_t>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    std::map<int, std::pair<int, int>> place{};  // tile column and row in each occupied slot
    std::map<int, float> held{};                 // value by pixel index
    int thrown_out = 0;

    [[nodiscard]] float value(std::uint32_t code) const {
        if (type == ChannelType::half) return half_to_float(static_cast<std::uint16_t>(code));
        return static_cast<float>(code) * (1.0f / 255.0f);
    }
    [[nodiscard]] std::uint32_t code(float v) const {
        if (type == ChannelType::half) return to_half(v, HalfRounding::toward_zero);
        // In these tests no product is half way between codes, so adding 1/2 and truncating gives the nearest code.
        return static_cast<std::uint32_t>(v * 255.0f + 0.5f);
    }
    void write_back(int column, int row) {
        for (auto it = held.begin(); it != held.end();) {
            const int x = it->first % width, y = it->first / width;
            if (x / 64 != column || y / 64 != row) {
                ++it;
                continue;
            }
            codes[static_cast<std::size_t>(it->first)] = code(it->second);
            it = held.erase(it);
        }
    }
    void fetch(int pixel) {
        const int column = pixel % width / 64, row = pixel / width / 64, at = (column + 5 * row) % 50;
        const auto found = place.find(at);
        if (found != place.end() && found->second != std::pair{column, row}) {
            write_back(found->second.first, found->second.second);
            ++thrown_out;
        }
        place[at] = {column, row};
    }
    void add(int pixel, float source) {
        fetch(pixel);
        const auto found = held.find(pixel);
        const float before = found != held.end() ? found->second : value(codes[static_cast<std::size_t>(pixel)]);
        const bool clamps = type == ChannelType::unorm8;
        const float sum = before + (clamps ? std::clamp(source, 0.0f, 1.0f) : source);
        held[pixel] = clamps ? std::clamp(sum, 0.0f, 1.0f) : sum;
    }
    void close() {
        for (const auto& [pixel, v] : held) codes[static_cast<std::size_t>(pixel)] = code(v);
        held.clear();
        place.clear();
    }
};

struct CachedFrame {
    int width, height;
    bool shares;
};

}  // namespace

TEST_CASE("sums in cached tiles are those of a model of one fragment at a time for any sequence of evictions") {
    Random random{301};
    const DeviceProfile& device = *find_profile("softpipe");
    for (const CachedFrame& size : {CachedFrame{320, 200, false}, {400, 130, true}, {70, 705, true}})
        for (const Format format : {Format::rgba8, Format::rgba16f, Format::r16f}) {
            const Rect frame{0, 0, size.width, size.height};
            TargetStorage target{format, 1, frame.area()};
            FragmentModel model{size.width, size.height, info(format).type};
            TileCache cache{frame, frame};
            // Few pixels, so that they recur; their neighbours are in tiles of slot 5 and others.
            std::vector<int> pixels;
            for (int i = 0; i < 12; ++i) pixels.push_back(random_int(random, 0, size.width * size.height - 1));
            if (size.width > 324) pixels.insert(pixels.end(), {321, 322, 65 * size.width + 3, 66 * size.width + 4});
            if (size.height > 642) pixels.insert(pixels.end(), {5, 6, 641 * size.width + 3, 642 * size.width + 4});
            int wrong = 0;
            for (int pass = 0; pass < 3; ++pass) {
                cache.hold(0, device, blend_mode::sum, {format, frame.area(), {target.texels(0)}});
                for (int trial = 0; trial < 200; ++trial) {
                    FragmentBatch batch;
                    ColorLanes color{};
                    Lanes<std::uint32_t> alive{}, fetched{};
                    std::vector<int> order = pixels;
                    for (int k = static_cast<int>(order.size()) - 1; k > 0; --k)
                        std::swap(order[static_cast<std::size_t>(k)],
                                  order[static_cast<std::size_t>(random_int(random, 0, k))]);
                    batch.count = random_int(random, 1, static_cast<int>(order.size()));
                    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
                        batch.pixel[i] = static_cast<std::uint32_t>(order[i]);
                        const float source = static_cast<float>(random_int(random, 1, 40)) /
                                             (format == Format::rgba8 ? 40000.0f : 300.0f);
                        for (auto& channel : color) channel[i] = source;
                        fetched[i] = random_int(random, 0, 5) > 0 ? ~0u : 0;
                        alive[i] = random_int(random, 0, 2) > 0 ? fetched[i] : 0;
                        if (alive[i] != 0)
                            model.add(order[i], source);
                        else if (fetched[i] != 0)
                            model.fetch(order[i]);
                    }
                    cache.blend(0, {batch, color, alive, fetched, 0});
                }
                cache.close();
                model.close();
                for (const int pixel : pixels)
                    for (int c = 0; c < info(format).channels; ++c)
                        wrong += target.code(static_cast<std::size_t>(pixel), c, 0) ==
                                         model.codes[static_cast<std::size_t>(pixel)]
                                     ? 0
                                     : 1;
            }
            INFO(size.width << " x " << size.height << ", format " << static_cast<int>(format));
            CHECK(wrong == 0);
            CHECK((model.thrown_out > 100) == size.shares);
        }
}

TEST_CASE("only blends that round are cached") {
    CHECK(TileCache::knows(blend_mode::sum, Format::rgba8));
    CHECK(TileCache::knows(blend_mode::over, Format::rgba16f));
    CHECK(TileCache::knows(blend_mode::under, Format::r16f));
    CHECK_FALSE(TileCache::knows(blend_mode::sum, Format::rgba32f));
    CHECK_FALSE(TileCache::knows(blend_mode::max, Format::rgba8));
    CHECK_FALSE(TileCache::knows(blend_mode::replace, Format::rgba8));
    CHECK_FALSE(TileCache::knows(blend_mode::sum, Format::r5g6b5));
}

namespace {

// Ten fragments of red `value` on each of the listed pixels, each nearer than the one before.
FragmentScene ten_on_each(int width, int height, float value, const std::vector<int>& pixels) {
    FragmentScene scene{width, height};
    for (const int pixel : pixels)
        for (int i = 0; i < 10; ++i)
            scene.pixels[static_cast<std::size_t>(pixel)].fragments.push_back(
                {0.9f - 0.05f * static_cast<float>(i), {value, value, value, value}});
    return scene;
}

// Sums into rgba8 and half floats, in two passes; the second starts from the codes that the first stored.
void add_twice(Region& region) {
    PassState state;
    state.color = {region.make(Format::rgba8), region.make(Format::rgba16f)};
    state.blend = {blend_mode::sum, blend_mode::sum};
    for (const Target t : {state.color[0], state.color[1]}) region.clear(t, {.color = {0, 0, 0, 0}});
    for (int pass = 0; pass < 2; ++pass)
        static_cast<void>(region.draw(state, [](const FragmentBatch& in, const Loads&, Outputs& out) {
            out.color[0] = in.color;
            out.color[1] = in.color;
        }));
    region.publish(state.color[0]);
}

}  // namespace

TEST_CASE(
    "a cached pass rounds once at its end and other devices after each blend and the next pass starts from codes") {
    const FragmentScene scene = ten_on_each(8, 4, 0.34f / 255.0f, {5});
    const auto red_on = [&](const char* profile) {
        TestFrame test{scene, profile};
        RegionStatistics statistics;
        Region region{test.frame, {test.frame.rect()}, statistics};
        add_twice(region);
        return region.storage({region.targets().count() - 2}).code(5, 0, 0);
    };
    CHECK(red_on("geforce8") == 0);
    CHECK(red_on("llvmpipe") == 0);
    CHECK(red_on("softpipe") == 6);  // 3.4 becomes 3, and 3 + 3.4 becomes 6
}

TEST_CASE("rendering by tiles gives the frame's result even if a cached tile is evicted by a tile of another region") {
    // Pixels of the tiles (5, 0) and (0, 1), which share a slot, and of one that shares none.
    const int width = 512;
    const std::vector<int> pixels{321, 330, 70, 65 * width + 3, 66 * width + 9};
    for (const char* profile : {"softpipe", "geforce8"}) {
        const FragmentScene scene = ten_on_each(width, 128, 0.34f / 255.0f, pixels);
        TestFrame test{scene, profile, 16};
        const auto literal = run_one_way(test.frame, add_twice, Execution::literal, {});
        const auto tiled = run_one_way(test.frame, add_twice, Execution::replay, {});
        CHECK(literal.codes == tiled.codes);
        CHECK(literal.refusal.empty());
    }
}

TEST_CASE("a fragment that its program discards fetches its tile unless the pass has a test") {
    constexpr int width = 512;
    const FragmentScene scene =
        ten_on_each(width, 128, 0.34f / 255.0f, {321, 65 * width + 3});  // tiles (5, 0) and (0, 1)
    for (const bool has_test : {false, true}) {
        TestFrame test{scene, "softpipe"};
        RegionStatistics statistics;
        Region region{test.frame, {test.frame.rect()}, statistics};
        PassState state;
        state.color[0] = region.make(Format::rgba8);
        state.blend[0] = blend_mode::sum;
        state.depth_target = region.make_depth();
        state.depth = {.enabled = has_test, .func = CompareFunc::always, .write = false};
        static_cast<void>(region.draw(state, [](const FragmentBatch& in, const Loads&, Outputs& out) {
            out.color[0] = in.color;
            for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i)
                if (in.pixel[i] >= 64 * width) out.alive[i] = 0;
        }));
        CHECK(region.storage(state.color[0]).code(321, 0, 0) == (has_test ? 3 : 0));
    }
}
