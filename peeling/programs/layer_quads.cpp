#include "peeling/programs/layer_quads.h"

#include "peeling/programs/programs.h"

namespace strata::peeling {

using namespace pipeline;

// OVER, far to near (algorithms.md 2). A pixel without such a layer holds alpha 0, which leaves it alone, and the
// opaque depth, by which the trace knows it.
void composite_quads(Region& region, const SavedLayers& layers, Target result) {
    for (std::size_t layer = layers.color.size(); layer-- > 0;) {
        region.count_with(static_cast<int>(layer) + 1);
        PassState state;
        state.color[0] = result;
        state.blend[0] = blend_mode::over;
        state.blend[0].write_mask = 0x7;  // the final alpha stays 1
        state.reads = {layers.color[layer], layers.depth[layer], region.opaque_depth()};
        static_cast<void>(region.full_screen(state, [](const FragmentBatch& in, const Loads& own, Outputs& out) {
            out.color[0] = own.color(0);
            out.traced = true;
            for (std::size_t i = 0; i < lanes(in); ++i) {
                out.side[i] = own.depth(1)[i] != own.depth(2)[i] ? Side::back : Side::none;
                out.key[i] = own.depth(1)[i];
            }
        }));
    }
}

}  // namespace strata::peeling
