// A rubber band: lines that XOR inverts on a dithered picture, and that the same draw removes again. Logical operations
// and dithering are parts of a pass's blend state.
#include <strata/pipeline/region/region.h>
#include <strata/strata.h>

#include <cstdio>
#include <vector>

using namespace strata::pipeline;

// The passes: the quad (primitives 0 and 1) dithered, then the lines inverted `draws` times.
strata::Algorithm rubber_band(int draws) {
    return strata::own_algorithm("rubber_band", [draws](Region& region) {
        const auto own_color = [](const FragmentBatch& in, const Loads&, Outputs& out) { out.color[0] = in.color; };
        const Target picture = region.make_color();
        region.copy(region.opaque_color(), picture);
        region.begin_iteration();
        const PrimitiveRange quad[] = {{0, 2}}, band[] = {{2, 6}};
        PassState state;
        state.color[0] = picture;
        state.primitives = quad;
        state.blend[0].dither = true;
        static_cast<void>(region.draw(state, own_color));
        state.primitives = band;
        state.blend[0].dither = false;
        state.blend[0].logic_op = LogicOp::xor_both;
        for (int i = 0; i < draws; ++i) static_cast<void>(region.draw(state, own_color));
        region.publish(picture);
    });
}

int main() try {
    const float corners[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    const float colors[] = {0.25f, 0.25f, 0.25f, 1, 0.3f, 0.25f, 0.25f, 1, 0.3f, 0.3f, 0.25f, 1, 0.25f, 0.3f, 0.25f, 1};
    const float box[] = {-0.61f, -0.53f, 0, 0.62f, -0.53f, 0, 0.62f, 0.71f, 0, -0.61f, 0.71f, 0};
    const std::uint32_t two[] = {0, 1, 2, 0, 2, 3}, sides[] = {0, 1, 1, 2, 2, 3, 3, 0};
    strata::Scene scene;
    scene.add({.name = "quad", .positions = {corners, 4}, .colors = {colors, 4}, .indices = two});
    scene.add({.name = "band", .positions = {box, 4}, .indices = sides, .primitive = Primitive::lines});
    std::vector<Image> pictures;
    for (const int draws : {0, 1, 2})
        pictures.push_back(
            strata::render(scene, rubber_band(draws), strata::profile("geforce8"), {.width = 64, .height = 48})
                .color());
    const auto changed = [&](const Image& image) {
        int pixels = 0;
        for (std::size_t i = 0; i < image.codes.size(); i += 4)
            pixels += image.codes[i] != pictures[0].codes[i] ? 1 : 0;
        return pixels;
    };
    const int once = changed(pictures[1]), twice = changed(pictures[2]);
    std::printf("pixels that differ after one draw: %d, after two: %d\n", once, twice);
    return once > 100 && twice == 0 ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
