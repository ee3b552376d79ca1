// tests/golden/golden.h - digests of scenes as reviewable lines: scene profile algorithm colour depth outcome.
// Model: none; a golden pins bits that the other groups prove. It fails when a bit depends on a setting that no bit may
// depend on.
#pragma once
#include <string>

#include "peeling/render.h"
#include "rasterizer/base/simd.h"

namespace strata::golden {

// What must not change a bit. Given as words: threads=N tile=N execution=literal|replay memory=BYTES effects=needed|all
// simd=scalar|avx2|avx512 check=FILE. An instruction set that this processor lacks is replaced by the best it has.
struct Settings {
    int threads = 1;
    int tile_size = 32;
    pipeline::Execution execution = pipeline::Execution::replay;
    int fragment_memory = 0;  // bytes
    pipeline::Effects effects = pipeline::Effects::needed;
    Simd simd = Simd::best;
    std::string check;  // the file to compare with; empty: print
};

// Throws std::invalid_argument for a word that is none of these.
[[nodiscard]] Settings parse(int count, char** words);

struct GoldenScene {
    std::string name;
    pipeline::DrawList list{};
    pipeline::View view{};
    int width = 64, height = 64;
    std::optional<float> alpha{};
};

// One line for every built-in profile and algorithm.
[[nodiscard]] std::string lines(const GoldenScene& scene, const Settings& settings);

// Prints `text`, or compares it with the file and shows the first lines that differ. Exit status: 0, or 1 for
// differences.
[[nodiscard]] int finish(const std::string& text, const Settings& settings);

}  // namespace strata::golden
