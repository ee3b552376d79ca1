// A user-defined algorithm with a fragment program and state: each fragment's premultiplied colour is multiplied by a
// weight that a table gives for its depth, and added to the sum. The table is the state; several threads read it at
// once, and nothing writes to it while they run.
#include <strata/pipeline/region/region.h>
#include <strata/strata.h>

#include <algorithm>
#include <cstdio>
#include <vector>

using namespace strata::pipeline;

class DepthWeights {
  public:
    explicit DepthWeights(std::vector<float> weights) : weights_{std::move(weights)} {}

    // The fragment program: called with up to 256 fragments of different pixels.
    void operator()(const FragmentBatch& in, const Loads&, Outputs& out) const {
        for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i) {
            const float z = std::clamp(in.shader_z[i], 0.0f, 1.0f);
            const auto entry =
                std::min(static_cast<std::size_t>(z * static_cast<float>(weights_.size())), weights_.size() - 1);
            const float weight = weights_[entry] * in.color[3][i];
            for (std::size_t c = 0; c < 3; ++c) out.color[0][c][i] = in.color[c][i] * weight;
            out.color[0][3][i] = 0;
        }
    }

  private:
    std::vector<float> weights_;
};

// The passes: one pass over the geometry adds all fragments to a copy of the opaque scene.
strata::Algorithm weighted_by_depth(std::vector<float> weights) {
    return strata::own_algorithm("weighted_by_depth", [program = DepthWeights{std::move(weights)}](Region& region) {
        const Target sum = region.make_color();
        region.set_name(sum, "sum");
        region.copy(region.opaque_color(), sum);
        PassState state;
        state.color[0] = sum;
        state.blend[0] = blend_mode::sum;
        region.begin_iteration();
        static_cast<void>(region.draw(state, program));
        region.publish(sum);
    });
}

int main() try {
    const float near_and_far[] = {-1, -1, -0.9f, 3, -1, -0.9f, -1, 3, -0.9f, -1, -1, 0.9f, 3, -1, 0.9f, -1, 3, 0.9f};
    strata::Scene scene;
    scene.add({.name = "two", .positions = {near_and_far, 6}, .color = {1, 1, 1, 0.5f}});
    const strata::Rendering picture = strata::render(scene, weighted_by_depth({1.0f, 0.25f}), strata::profile("ideal"),
                                                     {.width = 8, .height = 8, .color_format = Format::rgba32f});
    const auto bytes = strata::to_memory(picture.color());
    float red = 0;
    std::copy_n(bytes.begin(), sizeof red, reinterpret_cast<std::byte*>(&red));
    std::printf("red of the first pixel: %g\n", red);  // 0.5 x 1 + 0.5 x 0.25
    return red == 0.625f ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
