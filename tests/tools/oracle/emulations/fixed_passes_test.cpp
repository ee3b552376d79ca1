// Tests the diagnosis of mistakes in the algorithms with a fixed number of passes: each mistake is named from its
// picture in a scene of the suite, and no other is. Some pictures are compared with a model of the mistake.
#include <catch2/catch.hpp>

#include "tests/tools/oracle/diagnosis/scenes_of_test.h"
#include "tools/oracle/suite/mistake_table.h"

using namespace strata;
using namespace strata::oracle;
using strata::test::SceneFixture;

namespace {

struct NamedIn {
    const char* scene;
    std::vector<const char*> mistakes;
};
const NamedIn mistakes_by_scene[] = {
    {"random.weighted_blended",
     {"weight_grows_with_depth", "weight_without_alpha", "revealage_cleared_to_0", "revealage_added", "sums_in_bytes",
      "background_added_whole", "sums_not_premultiplied", "revealage_replaced", "alphas_not_weighted",
      "revealage_weighted"}},
    {"random.moments",
     {"alpha_not_corrected", "moments_without_bias", "moments_of_window_depth", "absorbance_by_log2",
      "absorbance_all_its_own", "absorbance_none_its_own", "moments_of_two_ranges"}},
    {"random.stochastic",
     {"sums_in_bytes", "background_added_whole", "alpha_not_corrected", "one_mask_for_all", "mask_by_alpha_alone"}},
    {"random.bucket_peel", {"buckets_of_whole_range", "bounds_cleared_to_0", "far_ends_lost"}},
    {"random.linked_list",
     {"list_cut_at_4", "list_cut_at_8", "list_of_8_nearest", "list_loses_every_second", "list_of_8_last",
      "list_skips_equal_depths"}},
    {"random.atomic_loop", {"one_node_too_few", "tail_lost", "core_again_in_tail", "tail_blended_twice"}},
    {"random.hybrid_transparency", {"one_node_too_few", "tail_lost", "tail_not_averaged", "core_again_in_tail"}},
    {"random.multi_layer", {"one_node_too_few", "overflow_not_merged"}},
    {"showroom.front_to_back", {"front_multiplied_again"}},
    {"showroom.dual", {"front_multiplied_again"}}};

}  // namespace

TEST_CASE("mistakes of weights and moments and lists and tails and samples and buckets are named and no other is") {
    for (const NamedIn& named : mistakes_by_scene) {
        const SceneFixture bench{named.scene};
        const MistakeImages mistake_images{bench.mistake_renderer};
        INFO(named.scene);
        CHECK(mistake_images.diagnose(bench.mistake_renderer.right()).conclusion == Conclusion::right);
        for (const char* mistake : named.mistakes) {
            INFO(mistake);
            const Diagnosis found = mistake_images.diagnose(bench.with(mistake));
            REQUIRE(found.conclusion == Conclusion::one_mistake);
            CHECK(found.findings.front().mistakes.front()->name == mistake);
            CHECK(found.findings.front().agreeing == found.pixels);
        }
    }
}
