// tools/lab/hard_cases/moves/hard_stability.h - measures how much a renderer's result changes if the input moves so
// little that the exact answer hardly changes. Rule     The case is drawn once unmoved and once for each move
// (hard_moves.h): eight seeds for each size, and each
//          coordinate alone if the case has at most eight triangles. Changes are counted (hard_result.h) for the
//          renderer and for the exact answer; their ratio is the amplification. A pixel is counted
//            within the move    if the exact answer there is open to the move itself;
//            within the device  if it is open when corners are also off by one step of the device's grid, and depths by
//                               two codes of the buffer and 2^-22 for the arithmetic of its vertices;
//            beyond             otherwise: nothing may change there, and the result must be the exact answer.
//          Then the triangles are permuted: of pixels that composite no two fragments of one depth none may change. The
//          verdict is the first that holds:
//            unstable  something changes or is wrong beyond, or a permutation changes such a pixel, and nothing
//            explains it
//            breaks    the same, but a diagnostic reports misplaced fragments, or the device computes planes in steps
//            degrades  something changes within the device; or the algorithm has no order, but its sums round by it
//            stable    changes occur only within the move
// Tests    tests/tools/lab/hard_cases/hard_stability_test.cpp
#pragma once
#include <array>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scenes/procedural/hard_cases/hard_case.h"
#include "tools/lab/hard_cases/moves/hard_moves.h"
#include "tools/lab/hard_cases/moves/hard_result.h"

namespace strata::tools {

class ExactCase;  // hard_exact.h

// Renders a scene and returns its visible result.
using RenderFunction = std::function<RenderedPixels(const scenes::Scene& scene, const pipeline::View& view)>;

// Properties of the renderer.
struct RendererProperties {
    double grid = 0;   // a step of the position grid, in pixels
    double depth = 0;  // a code of the depth buffer, in the depth range 0 to 1
    bool is_ordered = true;
    bool is_excused = false;  // a diagnostic of the case, or the device's arithmetic, explains errors beyond
};

enum class StabilityVerdict : std::uint8_t { refused, stable, degrades, breaks, unstable };
[[nodiscard]] std::string_view name_of(StabilityVerdict verdict) noexcept;

enum class PixelClass : std::uint8_t { within_move, within_device, beyond };
inline constexpr std::size_t pixel_classes = 3;

// The results of all moves of one size.
struct SizeRow {
    std::uint64_t moves = 0;
    Changes exact;
    std::array<Changes, pixel_classes> ours;  // indexed by PixelClass
    std::uint64_t wrong_beyond = 0;           // pixels, over all moves, that differ from the exact answer
    [[nodiscard]] Changes all() const;
};

struct StabilityRow {
    std::array<SizeRow, move_sizes.size()> by_size;
    std::uint64_t permuted = 0, permuted_ties = 0;  // pixels that change, without and with two fragments of one depth
    bool reports_misplaced = false;
    StabilityVerdict verdict = StabilityVerdict::stable;
    std::vector<std::string> reasons;
};

// A case with all its moves and their exact answers, which are the same for every device.
class MovedCase {
  public:
    explicit MovedCase(const scenes::HardCase& hard);
    ~MovedCase();
    [[nodiscard]] StabilityRow stability(const RendererProperties& renderer, const RenderFunction& render) const;
    [[nodiscard]] const scenes::HardCase& hard() const noexcept { return *hard_; }
    [[nodiscard]] const scenes::Scene& scene() const noexcept { return scene_; }

  private:
    struct Draw {
        Move move;
        ResultPixels exact;
    };
    [[nodiscard]] std::vector<PixelClass> classes(const RendererProperties& renderer, MoveSize size) const;
    void permute(const RendererProperties& renderer, const RenderFunction& render, const ResultPixels& before,
                 StabilityRow& row) const;

    const scenes::HardCase* hard_;
    scenes::Scene scene_;
    std::unique_ptr<const ExactCase> exact_;
    ResultPixels visible_pixels_;
    std::vector<Draw> draws_;
};

[[nodiscard]] nlohmann::ordered_json to_json(const StabilityRow& row);

}  // namespace strata::tools
