// pipeline/geforce3/combiner.h - GeForce3's register combiners: up to eight general stages and a final one, on 9-bit
// signed values.
//
// Rule     A value is an integer in units of 1/255, -255 to 255. A general stage computes A B, C D (products or dot
//          products) and A B + C D or a choice between the two, then bias (- 128), scale, clamp to [-255, 255];
//          separately for colours and for alpha. The final stage gives A B + (1 - A) C + D as colours and G as alpha,
//          clamped to [0, 255].
// Source   NV_register_combiners; pipeline/reference/combiners.md 1 to 3; chip-fragment.md 9 (bias, scales, inverts,
//          MUX and sums as measured). Sums of products are exact and rounded once, to nearest: an odd divisor has no
//          ties. That rounding is an assumption wherever two factors are fractions.
// Numbers  |A B + C D| <= 2 * 255^2, three times that for dot products: far below 2^31.
// Tests    tests/pipeline/geforce3/combiner_test.cpp
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "pipeline/stages/target.h"

namespace strata::pipeline {

// The registers that an input can name. The first twelve have their own value; the final stage computes the next two.
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
    // The fog's colour; as alpha, which only the final stage reads, the fragment's fog factor.
    fog,
    // Only for inputs A to D of the final stage.
    spare0_plus_secondary_color,
    e_times_f,
    // As an output: the result is discarded.
    discard
};
inline constexpr std::size_t combiner_registers = 12;  // number of registers that have a value

// The mapping of an input value e (combiners.md 2.1); results are in -255..255 again.
enum class CombinerMapping : std::uint8_t {
    // max(0, e)
    unsigned_identity,
    // 1 - clamp(e, 0, 1)
    unsigned_invert,
    // expand_normal: 2 max(0, e) - 1, which maps codes 0..255 to -1..1. expand_negate: its negative.
    expand_normal,
    expand_negate,
    // max(0, e) - 128/255, and its negative.
    half_bias_normal,
    half_bias_negate,
    // e and -e.
    signed_identity,
    signed_negate
};

// The part of a register that an input uses: `own` is r g b in a colour portion, alpha in an alpha portion.
enum class CombinerComponent : std::uint8_t { own, alpha, blue };

struct CombinerInput {
    CombinerRegister source = CombinerRegister::zero;
    CombinerMapping mapping = CombinerMapping::unsigned_identity;
    CombinerComponent component = CombinerComponent::own;
    friend bool operator==(const CombinerInput&, const CombinerInput&) = default;
};

// Component by component, or one dot product of r g b for all three components; alpha has no dot product.
enum class CombinerProduct : std::uint8_t { component_wise, dot };
// The third result of a portion: the sum of both products, or one of them, selected by spare0's alpha before the stage.
enum class CombinerSum : std::uint8_t {
    add,
    // C D if alpha of spare0 is at least 128/255, else A B.
    mux,
    // C D if bit 0 of that alpha is set, else A B: a mode of NV2A that OpenGL does not have.
    mux_low_bit
};
// The factor after the bias; by_half rounds a half up (combiners.md 2.2).
enum class CombinerScale : std::uint8_t { by_one, by_two, by_four, by_half };
enum class CombinerBias : std::uint8_t { none, by_negative_half };

// The rgb or the alpha part of a stage: A B, C D and their sum or choice, each written to a register or discarded. All
// three have the same bias and scale.
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
    // Per stage, as in NV_register_combiners2.
    std::array<Rgba, 2> constant{};
    friend bool operator==(const CombinerStage&, const CombinerStage&) = default;
};

// rgb = A B + (1 - A) C + D, alpha = G; A to D may use the product E F (combiners.md 3).
struct FinalCombiner {
    CombinerInput a{}, b{}, c{}, d{}, e{}, f{}, g{};  // unsigned mappings only
    bool clamps_color_sum = false;
    // If set, the operand of the colour sum is 1 - x; flags of NV2A that OpenGL does not have.
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

// The initial registers of the combiners: colours in [0,1], rounded to 8 bits when loaded.
struct CombinerSources {
    const ColorLanes* primary = nullptr;
    const ColorLanes* secondary = nullptr;                 // null: 0
    std::array<const ColorLanes*, 4> texture{};            // null: 0
    Rgba fog{};                                            // its alpha is not used
    const rasterizer::Lanes<float>* fog_factor = nullptr;  // null: colour and alpha of fog are 0
};

struct CombinerOperand;

// Runs one combiner state over batches. It stores registers for a batch, so each thread needs its own unit.
class CombinerUnit {
  public:
    // Throws std::logic_error for state that no device could run: too many stages, an input that does not exist.
    explicit CombinerUnit(const Combiners& state);
    // Writes r g b a in [0,1], each k / 255, to lanes [0, count) of `out`.
    void run(const CombinerSources& sources, ColorLanes& out, int count);

  private:
    using Values = rasterizer::Lanes<std::int32_t>;
    using Register = std::array<Values, 4>;

    [[nodiscard]] Register& at(CombinerRegister r) noexcept { return registers_[static_cast<std::size_t>(r)]; }
    [[nodiscard]] const Register& value_of(CombinerRegister r) const noexcept;
    [[nodiscard]] CombinerOperand operand(const CombinerInput& input, bool is_alpha) const noexcept;
    void load(CombinerRegister r, const ColorLanes* color, std::size_t count);
    void load_fog(const CombinerSources& sources, std::size_t count);
    void set_constants(const std::array<Rgba, 2>& constant, std::size_t count);
    void run_stage(const CombinerStage& stage, std::size_t count);
    void run_portion(const CombinerPortion& portion, bool is_alpha, std::size_t count);
    void commit(const CombinerPortion& portion, bool is_alpha, std::size_t count);
    void finish(ColorLanes& out, std::size_t count);

    Combiners state_;
    std::array<Register, combiner_registers> registers_{};
    // A B, C D and the sum of a stage. They are stored here because both portions read the registers from before the
    // stage.
    std::array<Register, 3> result_{};
    // spare0_plus_secondary_color and e_times_f.
    Register sum_{}, product_{};
};

}  // namespace strata::pipeline
