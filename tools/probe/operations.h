// tools/probe/operations.h - measures what shaders, textures and fixed-function tests compute: one operation per
// picture, with exact bits in and out.
//
// Rule     A fragment reads four words of its texel of the inputs and writes four; `words` of them are compared. A
//          hypothesis predicts the result for those inputs; the prediction must be equal, except that all NaNs are
//          equal if results are floats. The first hypothesis of an operation is the answer of a profile's device.
// Tests    tests/tools/probe/operations_test.cpp
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace strata::probe {

using Texel = std::array<std::uint32_t, 4>;

struct Hypothesis {
    std::string name{};
    std::function<Texel(const Texel&)> answer{};
};

// The texture that the fragment's `image` reads: one row of texels, one word each (r32f and d32f: bits of the float;
// rgba8 and srgb8: red in the low byte; d16 and d24: the code).
struct SourceImage {
    std::string format{};
    std::vector<std::uint32_t> texels{};
    bool linear = false;   // false: nearest
    bool compare = false;  // comparison with LEQUAL
};

struct ShaderPair {
    std::string vertex{}, fragment{};
};

enum class ResultKind : std::uint8_t { floats, words, srgb8 };

struct Operation {
    std::string name{};
    std::string question{};  // description for users
    int width = 64;          // of the inputs and of the picture
    std::vector<Texel> inputs{};
    int words = 1;
    ResultKind result = ResultKind::floats;
    std::optional<SourceImage> image{};
    // x y z w per corner.
    std::vector<std::array<float, 4>> corners{};
    // GLSL without version and precision. If there are two, the first draws only depths (D32F, ALWAYS), the second
    // tests with EQUAL.
    std::vector<ShaderPair> programs{};
    // Column x is stencil test number x of the first row's inputs; row b is bit b of the resulting stencil.
    bool stencil = false;
    std::vector<Hypothesis> hypotheses{};

    [[nodiscard]] int height() const noexcept { return static_cast<int>(inputs.size()) / width; }
};

// All operations. Names are unique.
[[nodiscard]] const std::vector<Operation>& operations();
// The list in the form that clients read.
[[nodiscard]] nlohmann::ordered_json operations_json();
[[nodiscard]] std::string operations_digest();

// A device's results in the order of the inputs, or the reason why there are none.
struct OperationReply {
    std::optional<std::vector<Texel>> texels{};
    std::string refusal{};
};
using OperationReplies = std::map<std::string, OperationReply>;

// The answer of one hypothesis; and the first hypotheses' answers to all operations.
[[nodiscard]] std::vector<Texel> answer(const Operation& operation, const Hypothesis& hypothesis);
[[nodiscard]] OperationReplies answer_operations();

// The first result that differs from a hypothesis.
struct CounterExample {
    std::size_t texel = 0, word = 0;
    Texel inputs{};
    std::uint32_t expected = 0, found = 0;
};

struct HypothesisCount {
    std::string name{};
    std::uint64_t agree = 0;  // k
    // The largest distance from the results: in codes, or in representable numbers.
    std::uint64_t furthest = 0;
    std::optional<CounterExample> first{};
};

// inferred: one hypothesis has all n. open: several have all n. broken: none has. undrawn: no results.
enum class OperationState : std::uint8_t { inferred, open, broken, undrawn };
[[nodiscard]] std::string_view name(OperationState state) noexcept;

struct OperationFinding {
    std::string name{}, reason{};
    OperationState state = OperationState::undrawn;
    std::uint64_t places = 0;               // n
    std::vector<HypothesisCount> counts{};  // best first
};

[[nodiscard]] OperationFinding judge(const Operation& operation, const OperationReply& reply);
// For every operation; empty if the pack was written before operations existed.
[[nodiscard]] std::vector<OperationFinding> judge(const OperationReplies& replies);

// Parts of the list (operations_*.cpp).
void add_arithmetic(std::vector<Operation>& list);
void add_conversions(std::vector<Operation>& list);
void add_textures(std::vector<Operation>& list);
void add_packing(std::vector<Operation>& list);
void add_srgb(std::vector<Operation>& list);
void add_tests(std::vector<Operation>& list);
void add_discards(std::vector<Operation>& list);

// `body` reads `given` and sets `result`; `declared` is placed before main.
[[nodiscard]] std::vector<ShaderPair> one_pass(const std::string& body, const std::string& declared = "",
                                               bool float_result = false);
// One triangle that covers the whole picture.
[[nodiscard]] std::vector<std::array<float, 4>> whole_picture();

}  // namespace strata::probe
