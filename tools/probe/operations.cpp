#include "tools/probe/operations.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "scenes/packs/pack_files.h"

namespace strata::probe {

namespace {

using nlohmann::ordered_json;

constexpr std::array<std::string_view, 4> state_names{"inferred", "open", "broken", "undrawn"};
constexpr std::array<std::string_view, 3> result_names{"words", "words", "srgb8"};

std::string corners_text(const std::vector<std::array<float, 4>>& corners) {
    std::string text;
    for (const auto& corner : corners)
        for (const float f : corner) text += fmt::format("{:08x}", std::bit_cast<std::uint32_t>(f));
    return text;
}

ordered_json image_json(const SourceImage& image) {
    std::string texels;
    for (const std::uint32_t word : image.texels) texels += fmt::format("{:08x}", word);
    return {{"format", image.format}, {"linear", image.linear}, {"compare", image.compare}, {"texels", texels}};
}

ordered_json operation_json(const Operation& o) {
    std::string inputs;
    for (const Texel& texel : o.inputs)
        for (const std::uint32_t word : texel) inputs += fmt::format("{:08x}", word);
    ordered_json programs = ordered_json::array();
    for (const ShaderPair& p : o.programs) programs.push_back({{"vertex", p.vertex}, {"fragment", p.fragment}});
    return {{"name", o.name},
            {"question", o.question},
            {"size", {o.width, o.height()}},
            {"target", result_names[static_cast<std::size_t>(o.result)]},
            {"stencil", o.stencil},
            {"image", o.image ? image_json(*o.image) : ordered_json(nullptr)},
            {"programs", programs},
            {"corners", corners_text(o.corners)},
            {"inputs", inputs}};
}

bool is_nan(std::uint32_t bits) { return (bits & 0x7fffffffu) > 0x7f800000u; }

// Maps binary32 to integers in numerical order; the two zeros are neighbours.
std::int64_t rank(std::uint32_t bits) {
    const auto magnitude = static_cast<std::int64_t>(bits & 0x7fffffffu);
    return (bits >> 31) != 0 ? -1 - magnitude : magnitude;
}

std::uint64_t distance(const Operation& o, std::uint32_t a, std::uint32_t b) {
    const bool floats = o.result == ResultKind::floats;
    if (a == b || (floats && is_nan(a) && is_nan(b))) return 0;
    const std::int64_t difference = floats ? rank(a) - rank(b) : static_cast<std::int64_t>(a) - std::int64_t{b};
    return static_cast<std::uint64_t>(difference < 0 ? -difference : difference);
}

HypothesisCount count_of(const Operation& o, const Hypothesis& hypothesis, const std::vector<Texel>& found) {
    HypothesisCount count{.name = hypothesis.name};
    for (std::size_t i = 0; i < o.inputs.size(); ++i) {
        const Texel expected = hypothesis.answer(o.inputs[i]);
        for (std::size_t k = 0; k < static_cast<std::size_t>(o.words); ++k) {
            const std::uint64_t apart = distance(o, expected[k], found[i][k]);
            count.furthest = std::max(count.furthest, apart);
            if (apart == 0)
                ++count.agree;
            else if (!count.first)
                count.first = CounterExample{i, k, o.inputs[i], expected[k], found[i][k]};
        }
    }
    return count;
}

}  // namespace

std::string_view name(OperationState state) noexcept { return state_names[static_cast<std::size_t>(state)]; }

const std::vector<Operation>& operations() {
    static const std::vector<Operation> list = [] {
        std::vector<Operation> all;
        add_arithmetic(all);
        add_conversions(all);
        add_packing(all);
        add_textures(all);
        add_tests(all);
        add_discards(all);
        return all;
    }();
    return list;
}

ordered_json operations_json() {
    ordered_json json = ordered_json::array();
    for (const Operation& o : operations()) json.push_back(operation_json(o));
    return json;
}

std::string operations_digest() {
    static const std::string digest = scenes::digest_of_bytes(operations_json().dump());
    return digest;
}

std::vector<Texel> answer(const Operation& operation, const Hypothesis& hypothesis) {
    std::vector<Texel> texels;
    for (const Texel& given : operation.inputs) texels.push_back(hypothesis.answer(given));
    return texels;
}

OperationReplies answer_operations() {
    OperationReplies replies;
    for (const Operation& o : operations()) replies[o.name].texels = answer(o, o.hypotheses.front());
    return replies;
}

OperationFinding judge(const Operation& operation, const OperationReply& reply) {
    OperationFinding finding{.name = operation.name, .reason = reply.refusal};
    if (!reply.texels) return finding;
    finding.places = operation.inputs.size() * static_cast<std::size_t>(operation.words);
    for (const Hypothesis& h : operation.hypotheses) finding.counts.push_back(count_of(operation, h, *reply.texels));
    std::ranges::stable_sort(finding.counts, std::ranges::greater{}, &HypothesisCount::agree);
    const auto whole = std::ranges::count(finding.counts, finding.places, &HypothesisCount::agree);
    finding.state = whole == 0 ? OperationState::broken : whole == 1 ? OperationState::inferred : OperationState::open;
    return finding;
}

std::vector<OperationFinding> judge(const OperationReplies& replies) {
    std::vector<OperationFinding> findings;
    if (replies.empty()) return findings;
    for (const Operation& o : operations()) {
        const auto reply = replies.find(o.name);
        findings.push_back(judge(o, reply == replies.end() ? OperationReply{} : reply->second));
    }
    return findings;
}

std::vector<ShaderPair> one_pass(const std::string& body, const std::string& declared, bool float_result) {
    return {{"layout(location = 0) in highp vec4 clip;\nvoid main() { gl_Position = clip; }",
             fmt::format("uniform highp usampler2D inputs;\nlayout(location = 0) out highp {} result;\n{}\n"
                         "#define F uintBitsToFloat\n#define U floatBitsToUint\n"
                         "void main() {{ highp uvec4 given = texelFetch(inputs, ivec2(gl_FragCoord.xy), 0); {} }}",
                         float_result ? "vec4" : "uvec4", declared, body)}};
}

std::vector<std::array<float, 4>> whole_picture() { return {{-1, -1, 0, 1}, {3, -1, 0, 1}, {-1, 3, 0, 1}}; }

}  // namespace strata::probe
