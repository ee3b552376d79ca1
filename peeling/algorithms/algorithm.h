// peeling/algorithms/algorithm.h - the description of an algorithm: its paper, requirements, tie policy and pass
// formula.
#pragma once
#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "peeling/programs/algorithm_options.h"
#include "peeling/programs/tie_policy.h"
#include "pipeline/device/check.h"
#include "pipeline/frame/run_settings.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {
class Region;
}

namespace strata::peeling {

// The order, and the parts, in which an algorithm's triangles are submitted.
enum class ListOrder : std::uint8_t {
    given,          // the order of --sort
    back_to_front,  // sorted by centroid, far first
    sets,           // two parts: the ordered set, front to back as listed, then the rest in the order of --sort
    objects,        // one part per instance; --sort sorts within a part
};

struct Algorithm {
    std::string name;
    int listed = 0;            // sorts lists of algorithms: ten times the section in algorithms.md, plus 1, 2 ... for
                               // further names of a section
    std::string paper;         // author and year
    std::string section;       // section of the paper
    std::string summary;       // one sentence
    std::string pass_formula;  // geometry passes for N layers, under --termination exact
    TiePolicy ties = TiePolicy::none;
    pipeline::DepthKey key = pipeline::DepthKey::stored_code;
    bool exact = false;  // order_errors is always 0 where no limit of passes or nodes ends it
    bool makes_layers = false;
    bool takes_both_ends = false;       // a pass takes one layer from the near end and one from the far end
    bool premultiplied_layers = false;  // layer colours are premultiplied by alpha
    ListOrder order = ListOrder::given;
    bool kills_alpha_zero = false;  // an alpha test discards fragments that store alpha 0, so they are no layers
    bool is_oracle = false;         // not an algorithm of a device: no profile rejects it
    bool whole_frame = false;       // its queries are nested: the frame runs literally, whatever --execution says
    bool has_lists = false;         // its lists of fragments may be a pixel's, with coverage masks: --list-granularity
    bool shares_nodes = false;      // tiles share the frame's limit of nodes: runs literally if there is a limit
    bool runs_loops = false;  // its loops follow one another: runs in tiles only if each query depends on its tile
                              // alone
    bool compares_own_codes = false;  // compares only its stored code: rejected where options choose another depth
    bool traces_own_targets = false;  // its trace has the depths in its own sample's targets, not those of the sample
                                      // that it loads: losses cannot be counted where it loads another
    bool shows_depth_paths = false;   // the measurement of flicker draws it by every depth path
    bool blends_in_picture = false;   // blends every layer straight into the picture: no colour that it stores needs an
                                      // alpha
    bool has_published_form = false;  // the listing has errata: --formulation published runs it as printed
    int (*geometry_passes)(int layers) = nullptr;  // the formula; null if layers do not determine it
    void (*run)(pipeline::Region&) = nullptr;
    void (*run_with)(pipeline::Region&, const ListingInputs&) = nullptr;  // used instead of `run` by an algorithm that
                                                                          // reads options
    // Used instead of `run` by an algorithm that carries state of its own. Regions run on several threads at once, and
    // some regions run twice.
    std::function<void(pipeline::Region&)> body{};
    bool (*resolve_loop)(pipeline::Region&) = nullptr;  // computes the whole loop from the record, or returns false;
                                                        // may be null
    std::vector<pipeline::Feature> features{};          // features that the profile must have
    int render_targets = 1;
    int samples = 1;
    std::optional<rasterizer::DepthPath> stores{};    // the depth path that it writes; empty: by the options
    std::optional<rasterizer::DepthPath> compares{};  // the compared path, unless the options choose one

    // True if a tile's fragments are worth recording: an algorithm that draws them once would not read them again.
    [[nodiscard]] bool draws_again() const {
        const bool draws_once = geometry_passes != nullptr && geometry_passes(9) == 1;
        const bool is_known =
            run != nullptr || run_with != nullptr || geometry_passes != nullptr;  // false for a user's body
        return is_known && !is_oracle && !whole_frame && !draws_once;
    }
    // The recorded values: the colour, and the depth from which the key is made.
    [[nodiscard]] rasterizer::FragmentNeeds recorded() const noexcept {
        const bool is_code = key == pipeline::DepthKey::stored_code;
        return {.shader_z = !is_code, .code = is_code, .color = true};
    }
};

[[nodiscard]] inline bool needs(const Algorithm& algorithm, pipeline::Feature feature) noexcept {
    return std::find(algorithm.features.begin(), algorithm.features.end(), feature) != algorithm.features.end();
}

}  // namespace strata::peeling
