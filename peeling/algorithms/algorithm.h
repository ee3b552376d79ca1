// peeling/algorithms/algorithm.h - an algorithm as a value: its paper, its needs, its tie policy and its pass formula.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "peeling/programs/tie_policy.h"
#include "pipeline/device/check.h"
#include "pipeline/frame/run_settings.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {
class Region;
}

namespace strata::peeling {

// In which order, and in which parts, an algorithm wants its triangles.
enum class ListOrder : std::uint8_t {
    given,          // as --sort says
    back_to_front,  // sorted by centroid, far first
    sets,           // two parts: the ordered set, front to back as it comes, then the rest as --sort says
    objects,        // a part for each instance; --sort sorts within them
};

struct Algorithm {
    std::string name;
    int listed = 0;            // where lists show it: ten times its section of algorithms.md, or between two
    std::string paper;         // author and year
    std::string section;       // where in it
    std::string summary;       // one sentence
    std::string pass_formula;  // geometry passes for N layers, under --termination exact
    TiePolicy ties = TiePolicy::none;
    pipeline::DepthKey key = pipeline::DepthKey::stored_code;
    bool exact = false;  // order_errors must be 0
    bool makes_layers = false;
    bool takes_both_ends = false;       // its layers come from the near end and from the far one
    bool premultiplied_layers = false;  // their colours are times alpha
    ListOrder order = ListOrder::given;
    bool kills_alpha_zero = false;    // an alpha test keeps fragments that store alpha 0 from being layers
    bool is_oracle = false;           // not a device's algorithm: never refused
    bool whole_frame = false;         // its queries nest: runs literally, whatever --execution says
    bool runs_loops = false;          // one loop after another: in tiles wherever its queries are its own
    bool compares_own_codes = false;  // by the code that it stores, alone: refused where options choose another depth
    bool has_published_form = false;  // its listing has errata: --formulation published runs it as printed
    int (*geometry_passes)(int layers) = nullptr;  // the formula; null where the layers do not decide
    void (*run)(pipeline::Region&) = nullptr;
    // In place of `run`: an algorithm that carries values of its own. Regions run on several threads at once, and some
    // of them twice.
    std::function<void(pipeline::Region&)> body{};
    bool (*resolve_loop)(pipeline::Region&) = nullptr;  // its whole loop from the record, or false; null if it has none
    std::vector<pipeline::Feature> features{};          // what a profile must have
    int render_targets = 1;
    int samples = 1;
    std::optional<rasterizer::DepthPath> stores{};    // the depth path that it writes, whatever the options say
    std::optional<rasterizer::DepthPath> compares{};  // the one that it compares, unless the options say otherwise

    // Whether a tile's fragments are recorded for it: of an algorithm that draws them once that would be work for
    // nothing.
    [[nodiscard]] bool draws_again() const {
        const bool draws_once = geometry_passes != nullptr && geometry_passes(9) == 1;
        const bool is_known = run != nullptr || geometry_passes != nullptr;  // unlike a body of a user's own
        return is_known && !is_oracle && !whole_frame && !draws_once;
    }
    // What is recorded: colours, and the depths that it has its key from.
    [[nodiscard]] rasterizer::FragmentNeeds recorded() const noexcept {
        const bool is_code = key == pipeline::DepthKey::stored_code;
        return {.shader_z = !is_code, .code = is_code, .color = true};
    }
};

}  // namespace strata::peeling
