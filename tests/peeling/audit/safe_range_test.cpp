// Tests the safe ranges of epsilon and bias against a peel after Everitt 2001, fragment by fragment: each pass finds
// the nearest fragment behind the depth that was peeled last.
#include "peeling/audit/safe_range.h"

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "tests/support/random_numbers.h"

using namespace strata::peeling;
using strata::testing::Random;
using strata::testing::random_int;

namespace {

enum class Moved { compare, stored };

struct Errors {
    int duplicated = 0, lost = 0, hidden = 0;  // hidden: fragments behind the opaque surface that were composited
    [[nodiscard]] bool none() const { return duplicated == 0 && lost == 0 && hidden == 0; }
};

// Peels one pixel in `passes` passes. n is added to the compared depth, or to the stored depth (which is then clamped
// to 0 and `far`).
Errors peel(const std::vector<PathPair>& pixel, std::int64_t opaque, std::int64_t n, Moved moved) {
    std::set<std::int64_t> layers;
    for (const PathPair& f : pixel)
        if (f.stored < opaque) layers.insert(f.stored);
    std::map<std::int64_t, int> times;
    std::optional<std::int64_t> peeled;
    for (std::size_t pass = 0; pass < 2 * layers.size() + 2; ++pass) {
        const PathPair* nearest = nullptr;
        const auto depth = [&](const PathPair& f) {
            return moved == Moved::stored ? std::max<std::int64_t>(0, f.stored + n) : std::int64_t{f.stored};
        };
        for (const PathPair& f : pixel) {
            const std::int64_t limit = moved == Moved::compare ? n : 0;
            if (peeled && !(std::int64_t{f.reference} > *peeled + limit)) continue;
            if (depth(f) < opaque && (nearest == nullptr || depth(f) < depth(*nearest))) nearest = &f;
        }
        if (nearest == nullptr) break;
        peeled = depth(*nearest);
        ++times[nearest->stored];
    }
    Errors errors;
    for (const auto& [stored, count] : times)
        if (stored >= opaque) errors.hidden += count;
    for (const std::int64_t layer : layers) {
        if (times[layer] > 1) ++errors.duplicated;
        if (times[layer] == 0) ++errors.lost;
    }
    return errors;
}

struct Field {
    std::vector<PathPair> pairs;
    std::vector<std::uint32_t> opaque;
};

// Few codes, so that ties, neighbours and exclusions all occur; the depths differ by up to `noise`.
Field random_field(Random& random, int codes, int noise) {
    Field field;
    const int pixels = random_int(random, 1, 3);
    for (int p = 0; p < pixels; ++p) {
        field.opaque.push_back(static_cast<std::uint32_t>(random_int(random, codes / 2, codes)));
        const int fragments = random_int(random, 0, 5);
        for (int i = 0; i < fragments; ++i) {
            const int stored = random_int(random, 0, codes - 1);
            const int reference = std::max(1, stored + random_int(random, -noise, noise));
            field.pairs.push_back({static_cast<std::uint32_t>(p), static_cast<std::uint32_t>(i),
                                   static_cast<std::uint32_t>(stored), static_cast<std::uint32_t>(reference)});
        }
    }
    return field;
}

Errors peel(const Field& field, std::int64_t n, Moved moved) {
    Errors all;
    for (std::uint32_t p = 0; p < field.opaque.size(); ++p) {
        std::vector<PathPair> pixel;
        for (const PathPair& pair : field.pairs)
            if (pair.pixel == p) pixel.push_back(pair);
        const Errors errors = peel(pixel, field.opaque[p], n, moved);
        all.duplicated += errors.duplicated;
        all.lost += errors.lost;
        all.hidden += errors.hidden;
    }
    return all;
}

// Number of 4,000 random fields with an n for which "safe" and "no error" are not the same.
int wrong_fields(Moved moved, int codes, int noise) {
    Random random{1};
    int wrong = 0;
    for (int i = 0; i < 4000; ++i) {
        const Field field = random_field(random, codes, noise);
        const SafeRange range =
            moved == Moved::stored ? safe_bias(field.pairs, field.opaque) : safe_epsilon(field.pairs, field.opaque);
        bool agrees = true;
        for (int n = -codes - noise - 2; n <= codes + noise + 2; ++n)
            agrees = agrees && range.contains(n) == peel(field, n, moved).none();
        wrong += agrees ? 0 : 1;
    }
    return wrong;
}

}  // namespace

TEST_CASE("an epsilon peels without duplicate and loss exactly if the adviser calls it safe", "[slow]") {
    CHECK(wrong_fields(Moved::compare, 12, 2) == 0);
    CHECK(wrong_fields(Moved::compare, 200, 9) == 0);
}

TEST_CASE("a bias of the stored depth peels without duplicate and loss exactly if the adviser calls it safe",
          "[slow]") {
    CHECK(wrong_fields(Moved::stored, 12, 2) == 0);
    CHECK(wrong_fields(Moved::stored, 200, 9) == 0);
}

TEST_CASE("where no epsilon is safe the named fragments by themselves exclude each other") {
    Random random{2};
    int empty = 0, wrong = 0;
    for (int i = 0; i < 2000; ++i) {
        const Field field = random_field(random, 40, 6);
        const SafeRange range = safe_epsilon(field.pairs, field.opaque);
        if (!range.is_empty()) continue;
        ++empty;
        std::vector<PathPair> named{range.repeated, range.front, range.behind};
        named[0].pixel = 0;
        named[1].pixel = named[2].pixel = 1;  // even if they are in one pixel
        const std::vector<std::uint32_t> opaque(2, 40u);
        if (!safe_epsilon(named, opaque).is_empty()) ++wrong;
    }
    CHECK(empty > 100);
    CHECK(wrong == 0);
}

// D24 codes 20 and 30 with compared codes 22 and 31: the first fragment is hidden behind itself from 2 codes on, the
// second is lost at 11.
TEST_CASE("an absolute epsilon is safe between the same two numbers for any number of pixels") {
    const std::vector<PathPair> pixel{{0, 0, 20, 22}, {0, 1, 30, 31}};
    std::vector<PathPair> four;
    for (std::uint32_t p = 0; p < 4; ++p)
        for (PathPair pair : pixel) {
            pair.pixel = p;
            four.push_back(pair);
        }
    const auto format = strata::pipeline::DepthFormat::d24;
    const SafeAbsolute alone = safe_absolute(pixel, std::vector<std::uint32_t>(1, 1000u), format);
    CHECK(safe_absolute(four, std::vector<std::uint32_t>(4, 1000u), format) == alone);
    constexpr double code = 1.0 / 16777215.0;
    REQUIRE(alone.lowest);
    REQUIRE(alone.highest);
    CHECK(*alone.lowest == Approx(2 * code));
    CHECK(*alone.highest == Approx(11 * code));
    CHECK(*alone.highest < 11 * code * (1 + 1e-9));
}

TEST_CASE("without fragments every epsilon is safe and with one layer every one from its difference on") {
    const std::vector<std::uint32_t> opaque{100};
    CHECK(safe_epsilon({}, opaque) == SafeRange{});
    const std::vector<PathPair> one{{0, 0, 10, 13}};
    CHECK(safe_epsilon(one, opaque).lowest == 3);
    CHECK_FALSE(safe_epsilon(one, opaque).highest);
    CHECK(safe_bias(one, opaque).highest == 89);
    CHECK(safe_bias(one, opaque).behind_opaque);
}
