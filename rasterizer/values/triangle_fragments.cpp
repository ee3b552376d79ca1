// rasterizer/values/triangle_fragments.cpp - the weights of fragments, also of triangles with wide edges.
#include "rasterizer/values/triangle_fragments.h"

#include "rasterizer/values/lane_kernels.h"

namespace strata::rasterizer {

void fill_weights(const LaneKernels& kernels, const TriangleFragments& f) noexcept {
    const PixelWeights& w = f.triangle.weights;
    double* const b1 = &f.weights.b1[f.first];
    double* const b2 = &f.weights.b2[f.first];
    if (w.kind != PixelWeights::Kind::snapped_wide) return kernels.weights(w, f.x(), f.y(), f.count(), b1, b2);
    const TriangleEdges edges = f.triangle.edges();
    const TriangleLanes lanes = f.lanes(edges);
    for (int i = 0; i < lanes.count; ++i) {
        const EdgeValues e = lanes.edge_values(i);
        b1[i] = static_cast<double>(e[1]) * w.r;
        b2[i] = static_cast<double>(e[2]) * w.r;
    }
}

}  // namespace strata::rasterizer
