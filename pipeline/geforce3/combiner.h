// pipeline/geforce3/combiner.h - GeForce3's register combiners: up to eight general stages and a final one, on 9-bit
// signed values.
//
// Rule     A value is an integer in units of 1/255, -255 to 255. A general stage computes A B, C D (products or dot
//          products) and A B + C D or a choice between the two, then bias (- 128), scale, clamp to [-255, 255]; of the
//          colours and of alpha apart. The final stage gives A B + (1 - A) C + D of colours and G as alpha, clamped to
//          [0, 255].
// Source   NV_register_combiners; combiners.md 1 to 3; chip-fragment.md 9 (bias, scales, inverts, MUX and sums as
//          measured). Sums of products are exact and rounded once, to nearest: no tie exists for an odd divisor. That
//          rounding is our assumption wherever two factors are fractions [A].
// Numbers  |A B + C D| <= 2 * 255^2, three times that for dot products: far below 2^31.
// Tests    tests/pipeline/geforce3/combiner_test.cpp
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "pipeline/stages/target.h"

namespace strata::pipeline {

// Registers that an input can name. The first eleven hold a value of their own; the next two are made by the final
// stage.
enum class CombinerRegister : std::uint8_t {
    zero,
    constant_color0,
    constant_color1,
    primary_color,
    secondary_color,
    texture0,
    texture1,
    texture2,
    texture3,
    spare0,
    spare1,
    // Of the final stage, for its inputs A to D alone.
    spare0_plus_secondary_color,
    e_times_f,
    // As an output: the result is discarded.
    discard
};
inline constexpr std::size_t combiner_registers = 11;  // those that hold a value

// How an input reads a value e (combiners.md 2.1); results lie in -255..255 again.
enum class CombinerMapping : std::uint8_t {
    // max(0, e)
    unsigned_identity,
    // 1 - clamp(e, 0, 1)
    unsigned_invert,
    // 2 max(0, e) - 1: codes 0..255 are stretched to -1..1; the next is its negative.
    expand_normal,
    expand_negate,
    // max(0, e) - 128/255, and its negative.
    half_bias_normal,
    half_bias_negate,
    // e and -e.
    signed_identity,
    signed_negate
};

// Which part of a register an input takes: `own` is r g b in a colour portion, alpha in an alpha portion.
enum class CombinerComponent : std::uint8_t { own, alpha, blue };

struct CombinerInput {
    CombinerRegister source = CombinerRegister::zero;
    CombinerMapping mapping = CombinerMapping::unsigned_identity;
    CombinerComponent component = CombinerComponent::own;
    friend bool operator==(const CombinerInput&, const CombinerInput&) = default;
};

// Component by component, or one dot product of r g b that all three components get; alpha has none.
enum class CombinerProduct : std::uint8_t { component_wise, dot };
// The third result of a portion: the sum of both products, or one of them, chosen by spare0's alpha before the stage.
enum class CombinerSum : std::uint8_t {
    add,
    // C D where alpha of spare0 is at least 128/255, else A B.
    mux,
    // C D where bit 0 of that alpha is set: the chip's other mode, not OpenGL's.
    mux_low_bit
};
// The factor behind the bias; by_half rounds a half up (combiners.md 2.2).
enum class CombinerScale : std::uint8_t { by_one, by_two, by_four, by_half };
enum class CombinerBias : std::uint8_t { none, by_negative_half };

// The rgb or the alpha part of a stage: A B, C D and a sum or choice of them, each to a register or discarded. All
// three take the same bias and scale.
struct CombinerPortion {
    CombinerInput a{}, b{}, c{}, d{};
    CombinerRegister ab = CombinerRegister::discard, cd = CombinerRegister::discard, sum = CombinerRegister::discard;
    CombinerProduct ab_product = CombinerProduct::component_wise, cd_product = CombinerProduct::component_wise;
    CombinerSum sum_rule = CombinerSum::add;
    CombinerScale scale = CombinerScale::by_one;
    CombinerBias bias = CombinerBias::none;
    friend bool operator==(const CombinerPortion&, const CombinerPortion&) = default;
};

struct CombinerStage {
    CombinerPortion rgb{}, alpha{};
    // Per stage, as NV_register_combiners2 has them.
    std::array<Rgba, 2> constant{};
    friend bool operator==(const CombinerStage&, const CombinerStage&) = default;
};

// rgb = A B + (1 - A) C + D, alpha = G; E F is a product that A to D may name (combiners.md 3).
struct FinalCombiner {
    CombinerInput a{}, b{}, c{}, d{}, e{}, f{}, g{};  // unsigned mappings only
    bool clamps_color_sum = false;
    // Each operand of the colour sum may be taken as 1 - x before it is added; flags of the chip, not of OpenGL.
    bool inverts_spare0 = false, inverts_secondary_color = false;
    std::array<Rgba, 2> constant{};
    friend bool operator==(const FinalCombiner&, const FinalCombiner&) = default;
};

inline constexpr std::size_t max_combiner_stages = 8;
struct Combiners {
    std::vector<CombinerStage> stages;  // at most max_combiner_stages
    FinalCombiner final_stage;
    friend bool operator==(const Combiners&, const Combiners&) = default;
};

// The registers that the combiners start with: colours in [0,1], rounded to 8 bits on the way in.
struct CombinerSources {
    const ColorLanes* primary = nullptr;
    const ColorLanes* secondary = nullptr;       // null: 0
    std::array<const ColorLanes*, 4> texture{};  // null: 0
};

struct CombinerOperand;

// Runs one state over batches. Its registers are as wide as a batch, so a unit serves one thread.
class CombinerUnit {
  public:
    // Throws std::logic_error for what no machine could run: too many stages, an input that is not there.
    explicit CombinerUnit(const Combiners& state);
    // r g b a in [0,1], each k / 255.
    // Writes lanes [0, count) of `out`.
    void run(const CombinerSources& sources, ColorLanes& out, int count);

  private:
    using Values = rasterizer::Lanes<std::int32_t>;
    using Register = std::array<Values, 4>;

    [[nodiscard]] Register& at(CombinerRegister r) noexcept { return registers_[static_cast<std::size_t>(r)]; }
    [[nodiscard]] const Register& value_of(CombinerRegister r) const noexcept;
    [[nodiscard]] CombinerOperand operand(const CombinerInput& input, bool is_alpha) const noexcept;
    void load(CombinerRegister r, const ColorLanes* color, std::size_t count);
    void set_constants(const std::array<Rgba, 2>& constant, std::size_t count);
    void run_stage(const CombinerStage& stage, std::size_t count);
    void run_portion(const CombinerPortion& portion, bool is_alpha, std::size_t count);
    void commit(const CombinerPortion& portion, bool is_alpha, std::size_t count);
    void finish(ColorLanes& out, std::size_t count);

    Combiners state_;
    std::array<Register, combiner_registers> registers_{};
    // A B, C D and the sum of a stage. They wait here, because both portions read what stood before the stage.
    std::array<Register, 3> result_{};
    // spare0_plus_secondary_color and e_times_f.
    Register sum_{}, product_{};
};

}  // namespace strata::pipeline
