// tools/oracle/program/program.h - a port as a small program: fragments -> layers -> fold -> finish -> pixel.
//
// Rule     The right program has no edits: layers are the fragments near to far, blended over what is behind them. An
//          edit is an entry of a table (steps/) with a parameter, applied to the fragments or pixels that meet all its
//          conditions. Edits of lists come first, in their order; then the background's, one fold, and what is done to
//          the finished colour.
// Tests    tests/tools/oracle/program/parts_test.cpp, found_test.cpp: pictures composited by plain code of the tests
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/oracle/program/lists.h"
#include "tools/oracle/program/properties.h"
#include "tools/oracle/program/rounding.h"

namespace strata::oracle::program {

// Adds `alpha` times the colour, and lets 1 - `cover` of what is behind through: right layers have one value for both.
struct PortLayer {
    Color color{};
    double alpha = 0, cover = 0;
    double depth = 0;
    std::uint32_t fragment = 0;  // of its pixel
};
using PortLayers = std::vector<PortLayer>;

// The fragments of a pixel that an edit changes.
struct SelectedFragments {
    const ListPixel& pixel;
    std::span<const char> mask{};
    [[nodiscard]] bool has(const PortLayer& layer) const { return mask[layer.fragment] != 0; }
    [[nodiscard]] const ListFragment& of(const PortLayer& layer) const { return pixel.fragments[layer.fragment]; }
};

using Parameters = std::span<const double>;

enum class PortStep : std::uint8_t { list, background, fold, finish };

// A way in which a step is done. Of the functions there is the one of its step.
struct StepEntry {
    PortStep step = PortStep::list;
    std::string_view words;                // what happens to the fragments or colours; {} is the parameter
    double price = 4;                      // bits
    std::span<const double> parameters{};  // candidates of the parameter; empty: none
    // Of entries with several fitted parameters: where they begin, for depths in this range.
    std::vector<double> (*start)(double nearest, double farthest) = nullptr;
    // A fit of several parameters that explains narrowly is told if these look like a cause; null: only if all are
    // round.
    bool (*is_plausible)(Parameters parameters) = nullptr;
    bool is_continuous = false;  // the parameter is fitted
    bool is_threshold = false;   // the parameter is compared with a transmittance, which a port rounds
    bool is_order = false;       // acts on the selected fragments together
    void (*edit)(PortLayers& layers, const SelectedFragments& selection, Parameters parameters) = nullptr;
    Color (*recolor)(const Color& color, Parameters parameters) = nullptr;
    Color (*fold)(std::span<const PortLayer> layers, const Color& behind, const PortRounding& rounding,
                  Parameters p) = nullptr;
};

struct Edit {
    const StepEntry* entry = nullptr;
    std::vector<double> parameters{};
    std::vector<Condition> conditions{};
    friend bool operator==(const Edit&, const Edit&) = default;
};

struct Program {
    std::vector<Edit> edits{};
    std::string drawing{};     // in words, how the lists that it runs on are drawn; empty: rightly
    double drawing_price = 0;  // of these words
    friend bool operator==(const Program&, const Program&) = default;
};

// An edit with the fragments that it changes; of edits of other steps `mask` has one element.
struct Applied {
    const StepEntry* entry = nullptr;
    Parameters parameters{};
    std::span<const char> mask{};
};

// A pixel whose list is edited: ports of all roundings have that in common. It refers to the edits.
class EditedPixel {
  public:
    void edit(std::span<const Applied> edits, const ListPixel& pixel);
    // Without a rounding it is exact.
    [[nodiscard]] Color color(const PortRounding& rounding) const;

  private:
    std::span<const Applied> edits_{};
    PortLayers layers_{};
    Color behind_{};
    const Applied* fold_ = nullptr;
};

// The pixel's colour.
[[nodiscard]] Color run(std::span<const Applied> edits, const ListPixel& pixel, const PortRounding& rounding);
[[nodiscard]] Color value(const Program& program, const ListPixel& pixel, const PortRounding& rounding);
// The pixel after the program's edits; until the next call of the thread.
[[nodiscard]] const EditedPixel& edited(const Program& program, const ListPixel& pixel);

// True for the fragments, or the pixel, that an edit changes.
void select(const Edit& edit, const ListPixel& pixel, std::vector<char>& mask);
[[nodiscard]] bool changes(const Program& program, const ListPixel& pixel);

// The right fold, with the form of the rounding.
[[nodiscard]] Color blended(std::span<const PortLayer> layers, const Color& behind, const PortRounding& rounding);

// A parameter of at most two digits after the point.
[[nodiscard]] bool is_round(double parameter) noexcept;
[[nodiscard]] double price(const Edit& edit);
[[nodiscard]] double price(const Program& program);

}  // namespace strata::oracle::program
