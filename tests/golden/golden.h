// tests/golden/golden.h - digests of scenes as reviewable lines: scene profile algorithm colour depth outcome. A golden
// digest pins bits that other tests prove. It also fails if a bit depends on a setting that it must not depend on.
#pragma once
#include <string>

#include "peeling/render.h"
#include "rasterizer/base/simd.h"

namespace strata::golden {

// Settings that must not change a bit, given as arguments: threads=N tile=N execution=literal|replay memory=BYTES
// effects=needed|all simd=scalar|avx2|avx512 check=FILE. An instruction set that this processor lacks is replaced
// by the best available one.
struct Settings {
    int threads = 1;
    int tile_size = 32;
    pipeline::Execution execution = pipeline::Execution::replay;
    int fragment_memory = 0;  // bytes
    pipeline::Effects effects = pipeline::Effects::needed;
    Simd simd = Simd::best;
    std::string check;  // the file to compare with; empty: print
};

// Throws std::invalid_argument for an unknown argument.
[[nodiscard]] Settings parse(int count, char** words);

struct GoldenScene {
    std::string name;
    pipeline::DrawList list{};
    pipeline::View view{};
    int width = 64, height = 64;
    std::optional<float> alpha{};
};

// One line per built-in profile and algorithm.
[[nodiscard]] std::string lines(const GoldenScene& scene, const Settings& settings);

// Prints `text`, or compares it with the file and shows the first lines that differ. Exit status: 0, or 1 for
// differences.
[[nodiscard]] int finish(const std::string& text, const Settings& settings);

}  // namespace strata::golden
