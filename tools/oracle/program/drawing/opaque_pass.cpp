// tools/oracle/program/drawing/opaque_pass.cpp - the table of what becomes of opaque surfaces, and its search
// (opaque_pass.h).
#include "tools/oracle/program/drawing/opaque_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/oracle/program/fit/fitting.h"
#include "tools/oracle/program/fit/score.h"
#include "tools/oracle/program/fit/search.h"

namespace strata::oracle::program {

namespace {

// A key of the fragment that stays: the largest.
struct OpaqueKeep {
    std::string_view words{};
    double price = 0;
    double (*key)(const ListFragment& f) = nullptr;
};
double nearness(const ListFragment& f) { return -static_cast<double>(f.code); }
const OpaqueKeep keeps[] = {
    {"", 0, nearness},
    {"the farthest opaque surface stays", 3, [](const ListFragment& f) { return static_cast<double>(f.code); }},
    {"opaque surfaces are not tested: the last drawn stays", 3,
     [](const ListFragment& f) { return static_cast<double>(f.submission); }},
    {"of opaque surfaces the first drawn stays", 3,
     [](const ListFragment& f) { return -static_cast<double>(f.submission); }},
};

// What layers are tested against.
enum class LayerTest : std::uint8_t { kept, right, none, kept_at_most };
struct LayerTestEntry {
    LayerTest test{};
    std::string_view words{};
    double price = 0;
};
constexpr LayerTestEntry layer_tests[] = {
    {LayerTest::kept, "", 0},
    {LayerTest::right, "layers are tested against the right depth", 4},
    {LayerTest::none, "layers are not tested against opaque surfaces", 3},
    {LayerTest::kept_at_most, "layers at the depth of an opaque surface are shown", 3},
};

// Opaque surfaces behind layers that write depth.
enum class Hiding : std::uint8_t { none, drawn_before, all };
struct HidingEntry {
    Hiding hiding{};
    std::string_view words{};
    double price = 0;
};
constexpr HidingEntry hidings[] = {
    {Hiding::none, "", 0},
    {Hiding::drawn_before, "opaque surfaces behind layers that are drawn before them are lost: layers write depth", 4},
    {Hiding::all, "opaque surfaces behind layers are lost: layers are drawn first and write depth", 4},
};

struct OpaquePass {
    const OpaqueKeep* keep = &keeps[0];
    const LayerTestEntry* test = &layer_tests[0];
    const HidingEntry* hiding = &hidings[0];
    int bits = 0;  // of all depths; 0: as given
    std::vector<Condition> lost{};

    [[nodiscard]] double price() const {
        double sum = keep->price + test->price + hiding->price + (bits > 0 ? 4 : 0) + (lost.empty() ? 0 : 2);
        for (const Condition& c : lost) sum += c.property->price;
        return sum;
    }
    [[nodiscard]] std::string words() const {
        std::string all;
        const auto add = [&](std::string_view more) {
            if (!more.empty()) all += (all.empty() ? "" : "; ") + std::string{more};
        };
        if (bits > 0) add(fmt::format("depths have {} bits", bits));
        add(keep->words);
        add(hiding->words);
        if (!lost.empty()) add(fmt::format("opaque fragments {} are left out", joined_words(lost)));
        add(test->words);
        return all;
    }
};

std::uint32_t coarse(const ListFragment& f, int bits) {
    return bits == 0 ? f.code : static_cast<std::uint32_t>(std::nearbyint(f.depth * (std::exp2(bits) - 1)));
}

// What a pixel shows then.
struct OpaqueOutcome {
    const ListFragment* kept = nullptr;
    const ListFragment* right = nullptr;
};

bool is_hidden_by_layer(const OpaquePass& pass, const ListFragment& f, const std::vector<ListFragment>& layers) {
    if (pass.hiding->hiding == Hiding::none) return false;
    return std::ranges::any_of(layers, [&](const ListFragment& layer) {
        return layer.code < f.code && (pass.hiding->hiding == Hiding::all || layer.submission < f.submission);
    });
}

OpaqueOutcome outcome(const OpaquePass& pass, const ListPixel& pixel, const std::vector<ListFragment>& layers) {
    OpaqueOutcome found;
    if (!pixel.fragments.empty()) found.right = &pixel.fragments[0];
    double best = 0;
    const bool is_coarse = pass.bits > 0 && pass.keep == &keeps[0];
    for (std::size_t k = 0; k < pixel.fragments.size(); ++k) {
        const ListFragment& f = pixel.fragments[k];
        if (!pass.lost.empty() && std::ranges::all_of(pass.lost, [&](const Condition& c) { return c.holds(pixel, k); }))
            continue;
        if (is_hidden_by_layer(pass, f, layers)) continue;
        const double key = is_coarse ? -static_cast<double>(coarse(f, pass.bits)) : pass.keep->key(f);
        // Of equal ones the first drawn stays.
        if (found.kept == nullptr || key > best || (key == best && f.submission < found.kept->submission)) {
            found.kept = &f;
            best = key;
        }
    }
    return found;
}

void add_layers(const OpaquePass& pass, const OpaqueOutcome& found, const std::vector<ListFragment>& layers,
                std::vector<ListFragment>& to) {
    const ListFragment* const before = pass.test->test == LayerTest::right  ? found.right
                                       : pass.test->test == LayerTest::none ? nullptr
                                                                            : found.kept;
    const auto first = static_cast<std::ptrdiff_t>(to.size());
    for (const ListFragment& f : layers) {
        const std::uint32_t code = coarse(f, pass.bits);
        if (before != nullptr) {
            const std::uint32_t limit = coarse(*before, pass.bits);
            if (pass.test->test == LayerTest::kept_at_most ? code > limit : code >= limit) continue;
        }
        to.push_back(f);
        to.back().code = code;
    }
    if (pass.bits > 0)
        std::ranges::stable_sort(to.begin() + first, to.end(), {}, [](const ListFragment& f) {
            return std::pair{f.code, f.submission};
        });
}

Lists lists_by(const OpaquePass& pass, const SceneSurfaces& surfaces, std::size_t step) {
    Lists made;
    made.width = surfaces.opaque.width;
    made.height = surfaces.opaque.height;
    made.format = surfaces.opaque.format;
    for (std::size_t i = 0; i < surfaces.opaque.pixels.size(); i += step) {
        const ListPixel& pixel = surfaces.opaque.pixels[i];
        const OpaqueOutcome found = outcome(pass, pixel, surfaces.layers[i]);
        made.pixels.push_back({.x = pixel.x,
                               .y = pixel.y,
                               .first = made.fragments.size(),
                               .behind = found.kept != nullptr ? found.kept->color : surfaces.background,
                               .has_opaque = found.kept != nullptr,
                               .opaque_code = found.kept != nullptr ? found.kept->code : 0,
                               .seen = pixel.seen});
        add_layers(pass, found, surfaces.layers[i], made.fragments);
    }
    complete(made);
    return made;
}

class OpaqueSearch {
  public:
    explicit OpaqueSearch(const SceneSurfaces& surfaces) : surfaces_{surfaces} {}

    std::vector<OtherLists> best() {
        for (const OpaqueKeep& keep : keeps)
            for (const LayerTestEntry& test : layer_tests)
                if (keep.price > 0 || test.price > 0) add({.keep = &keep, .test = &test});
        for (const HidingEntry& hiding : hidings)
            if (hiding.price > 0) add({.hiding = &hiding});
        for (const int bits : {8, 10, 12, 15, 16, 20}) {
            add({.bits = bits});
            add({.test = &layer_tests[3], .bits = bits});
        }
        for (const Condition& condition : conditions()) add({.lost = {condition}});
        std::ranges::stable_sort(tried_, {}, &Tried::cost);
        for (std::size_t i = 0; i < std::min<std::size_t>(tried_.size(), 3); ++i) place_threshold(tried_[i]);
        std::vector<OtherLists> all;
        constexpr std::size_t most = 6;
        for (const Tried& tried : tried_) {
            if (all.size() == most) break;
            // Of thresholds of one property the best is told.
            const auto is_like = [&](const Tried& before) { return differs_in_number(before.pass, tried.pass); };
            if (std::any_of(std::as_const(tried_).data(), &tried, is_like)) continue;
            all.push_back({tried.pass.words(), tried.pass.price(), lists_by(tried.pass, surfaces_, 1)});
        }
        return all;
    }

  private:
    struct Tried {
        OpaquePass pass{};
        double cost = 0;
    };

    [[nodiscard]] static bool differs_in_number(const OpaquePass& a, const OpaquePass& b) {
        return !a.lost.empty() && !b.lost.empty() && a.lost[0].property == b.lost[0].property &&
               a.lost[0].is == b.lost[0].is && a.lost[0].is != Condition::Is::equal;
    }

    // Some thousand pixels at even distances.
    [[nodiscard]] std::size_t step() const { return surfaces_.opaque.pixels.size() / 4096 | 1; }

    void add(const OpaquePass& pass) { tried_.push_back({pass, cost_of(pass)}); }

    [[nodiscard]] double cost_of(const OpaquePass& pass) const {
        const Lists lists = lists_by(pass, surfaces_, step());
        double cost = pass.price();
        for (const ListPixel& pixel : lists.pixels) cost += bits_of(residual_of({}, pixel, {}, lists.unit()).off);
        return cost;
    }

    [[nodiscard]] std::vector<double> values_of(const FragmentProperty& property) const {
        std::vector<double> values;
        for (std::size_t i = 0; i < surfaces_.opaque.pixels.size(); i += step()) {
            const ListPixel& pixel = surfaces_.opaque.pixels[i];
            for (std::size_t k = 0; k < pixel.fragments.size(); ++k) values.push_back(property.of(pixel, k));
        }
        return values;
    }

    // Moves the threshold of a condition over the values of the sample while that lowers the cost.
    void place_threshold(Tried& tried) const {
        if (tried.pass.lost.empty() || tried.pass.lost[0].is == Condition::Is::equal) return;
        const FragmentProperty& property = *tried.pass.lost[0].property;
        std::vector<double> values = values_of(property);
        std::ranges::sort(values);
        values.erase(std::unique(values.begin(), values.end()), values.end());
        const auto count = static_cast<std::ptrdiff_t>(values.size());
        std::ptrdiff_t at = std::ranges::lower_bound(values, tried.pass.lost[0].threshold) - values.begin();
        for (std::ptrdiff_t by = std::max<std::ptrdiff_t>(count / 24, 1); by > 0; by /= 2)
            for (const std::ptrdiff_t next : {at - by, at + by, at - by / 2, at + by / 2}) {
                if (next < 1 || next >= count) continue;
                OpaquePass pass = tried.pass;
                const double low = values[static_cast<std::size_t>(next - 1)];
                pass.lost[0].threshold = shortest_between(low, values[static_cast<std::size_t>(next)]);
                const double cost = cost_of(pass);
                if (!(cost < tried.cost)) continue;
                tried = {std::move(pass), cost};
                at = next;
            }
    }

    // On properties of an opaque fragment.
    [[nodiscard]] std::vector<Condition> conditions() const {
        std::vector<Condition> all;
        for (const FragmentProperty& property : properties()) {
            if (property.is_of_pixel || property.price > 5) continue;
            const std::vector<Condition> some = conditions_of(property, values_of(property));
            all.insert(all.end(), some.begin(), some.end());
        }
        return all;
    }

    const SceneSurfaces& surfaces_;
    std::vector<Tried> tried_{};
};

}  // namespace

std::vector<OtherLists> other_opaque_passes(const SceneSurfaces& surfaces) {
    if (!surfaces.has_opaque()) return {};
    return OpaqueSearch{surfaces}.best();
}

}  // namespace strata::oracle::program
