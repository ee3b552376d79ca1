// tools/lab/hard_cases/hard_stability.h - what a machine's picture makes of a movement that the exact answer hardly
// notices.
//
// Rule     The case is drawn once as it is and once for each move (hard_moves.h): eight seeds for each size, and each
//          coordinate alone where the case has at most eight triangles. What changes is counted (hard_seen.h), for the
//          machine and for the exact answer; their ratio is the amplification. A pixel is counted
//            within the move    if the exact answer there is open to the move itself;
//            within the device  if it is open once corners are also one step of the device's grid off, and depths two
//                               codes of the buffer and 2^-22 for the arithmetic of its vertices;
//            beyond             elsewhere: nothing may change there, and what is shown must be the exact answer.
//          Then the triangles are permuted: of pixels that composite no two fragments of one depth none may change.
//          The verdict, the first that holds:
//            unstable something changes or is wrong beyond, or a permutation moves what it must not, and nothing says
//            so breaks the same, but a diagnostic names misplaced fragments, or the device steps its planes degrades
//            something changes within the device; or the algorithm has no order, but rounds sums by it stable nothing
//            changes but within the move
// Tests    tests/tools/hard_cases/hard_stability_test.cpp
#pragma once
#include <array>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scenes/procedural/hard_cases/hard_case.h"
#include "tools/lab/hard_cases/hard_moves.h"
#include "tools/lab/hard_cases/hard_seen.h"

namespace strata::tools {

class ExactCase;  // hard_exact.h

// A renderer that draws a scene and says what is seen.
using Look = std::function<Looked(const scenes::Scene& scene, const pipeline::View& view)>;

// What is known of who looks.
struct Looker {
    double grid = 0;   // a step of the grid of positions, in pixels
    double depth = 0;  // a code of the depth buffer, of the depth range 0 to 1
    bool is_ordered = true;
    bool is_excused = false;  // a diagnostic of the case, or the device's arithmetic, explains faults beyond
};

enum class StabilityVerdict : std::uint8_t { refused, stable, degrades, breaks, unstable };
[[nodiscard]] std::string_view name_of(StabilityVerdict verdict) noexcept;

enum class PixelClass : std::uint8_t { within_move, within_device, beyond };
inline constexpr std::size_t pixel_classes = 3;

// Of all moves of one size.
struct SizeRow {
    std::uint64_t moves = 0;
    Changes exact;
    std::array<Changes, pixel_classes> ours;  // by PixelClass
    std::uint64_t wrong_beyond = 0;           // pixels of any move that do not show the exact answer
    [[nodiscard]] Changes all() const;
};

struct StabilityRow {
    std::array<SizeRow, move_sizes.size()> by_size;
    std::uint64_t permuted = 0, permuted_ties = 0;  // pixels that change without and with two fragments of one depth
    bool names_misplaced = false;
    StabilityVerdict verdict = StabilityVerdict::stable;
    std::vector<std::string> reasons;
};

// A case with all its moves and the exact answer to each: the same for every machine.
class MovedCase {
  public:
    explicit MovedCase(const scenes::HardCase& hard);
    ~MovedCase();
    [[nodiscard]] StabilityRow stability(const Looker& looker, const Look& look) const;
    [[nodiscard]] const scenes::HardCase& hard() const noexcept { return *hard_; }
    [[nodiscard]] const scenes::Scene& scene() const noexcept { return scene_; }

  private:
    struct Draw {
        Move move;
        Seen exact;
    };
    [[nodiscard]] std::vector<PixelClass> classes(const Looker& looker, MoveSize size) const;
    void permute(const Looker& looker, const Look& look, const Seen& before, StabilityRow& row) const;

    const scenes::HardCase* hard_;
    scenes::Scene scene_;
    std::unique_ptr<const ExactCase> exact_;
    Seen seen_;
    std::vector<Draw> draws_;
};

[[nodiscard]] nlohmann::ordered_json to_json(const StabilityRow& row);

}  // namespace strata::tools
