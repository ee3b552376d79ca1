#include "tools/lab/cost/cost_card.h"

#include <algorithm>
#include <array>

namespace strata::tools {

namespace {

// A row of the paper's table, for front views.
struct PrintedRate {
    const char *scene, *algorithm;
    double frames_a_second;
};
constexpr std::array printed{
    PrintedRate{"dragon", "coherent_stencil", 51}, PrintedRate{"dragon", "coherent_blend", 53},
    PrintedRate{"dragon", "layer_peel", 35},       PrintedRate{"sponza", "coherent_stencil", 56},
    PrintedRate{"sponza", "coherent_blend", 50},   PrintedRate{"sponza", "layer_peel", 35}};

}  // namespace

const Card& card_of(bool has_fragment_programs) {
    static const Card geforce3{"GeForce3", 50e6, 800e6, 7.36e9};
    static const Card geforce8{"GeForce 8800 GTX", 10800e6, 13.8e9, 86.4e9};
    return has_fragment_programs ? geforce8 : geforce3;
}

double modelled_seconds(const Card& card, const CardWork& work) {
    return std::max({static_cast<double>(work.vertices) / card.vertices_a_second,
                     static_cast<double>(work.fragments) / card.fragments_a_second,
                     static_cast<double>(work.bytes) / card.bytes_a_second});
}

std::optional<double> printed_seconds(const std::string& scene, const std::string& algorithm) {
    for (const PrintedRate& rate : printed)
        if (scene.starts_with(rate.scene) && algorithm == rate.algorithm) return 1 / rate.frames_a_second;
    return std::nullopt;
}

}  // namespace strata::tools
