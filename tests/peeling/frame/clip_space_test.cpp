// Tests triangles given in clip space against triangles that matrices transform there. The products are rounded like
// those of the vertex stage; identity matrices change nothing.
#include <catch2/catch.hpp>

#include "peeling/registry.h"
#include "pipeline/vertices/matrix.h"
#include "pipeline/vertices/vertex_transform.h"
#include "tests/peeling/rendering.h"
#include "tests/support/random_triangles.h"

using namespace strata::testing;
using namespace strata::pipeline;

TEST_CASE("triangles that are given in clip space are drawn like those that matrices transform there") {
    TriangleScene scene = random_triangles(31, 40);
    for (Material& material : scene.list.materials) material.unlit = true;
    DrawList clip = scene.list;
    const Matrix whole = product(scene.view.projection, scene.view.view);
    const VertexTransform transform{VertexPath::separate, whole, scene.view.projection, scene.view.view};
    int far = 0;
    for (Mesh& mesh : clip.meshes)
        for (Vec3& p : mesh.positions) {
            const auto at = transform(p);
            p = {at[0], at[1], at[2]};
            mesh.w.push_back(at[3]);
            far += at[3] != 1 ? 1 : 0;
        }
    CHECK(far > 100);
    for (const char* profile : {"geforce8", "ideal", "llvmpipe", "softpipe"})
        for (const char* algorithm : {"front_to_back", "dual", "weighted_average"}) {
            strata::peeling::RenderOptions options;
            options.width = 40;
            options.height = 28;
            const auto expected = render(scene.list, scene.view, {profile, algorithm}, options);
            const auto found = render(clip, {}, {profile, algorithm}, options);
            INFO(algorithm << " on " << profile);
            REQUIRE(found.outcome == expected.outcome);
            CHECK(found.frame.color == expected.frame.color);
            CHECK(found.frame.depth == expected.frame.depth);
        }
}
