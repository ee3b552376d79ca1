// tools/oracle/compare/explanations.cpp - changes the reference in every known way (flipped, moved, encoded, multiplied
// by alpha ...) and keeps what equals the candidate everywhere (explanations.h).
#include "tools/oracle/compare/explanations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "scenes/numbers/srgb_encode.h"

namespace strata::oracle {

namespace {

// The pixel of the reference that the candidate has at x, y.
using Moved = std::function<std::optional<std::size_t>(const TargetImage& reference, int x, int y)>;
// The candidate's value in channel c.
using Computed = std::function<double(const TargetImage& reference, std::size_t pixel, int c)>;

struct PictureChange {
    const char* name;
    const char* description;
    Meaning meaning = Meaning::color;
    Moved moved{};
    Computed computed{};
};

bool is_near(StoredCode candidate, double wanted) noexcept {
    const double found = value(candidate.code, candidate.word), apart = std::abs(found - wanted);
    switch (candidate.code) {
        case Code::unorm8: return apart <= 1.0 / 255;
        case Code::unorm10: return apart <= 1.0 / 1023;
        case Code::unorm16: return apart <= 1.0 / 65535;
        case Code::unorm24: return apart <= 1.0 / 16777215;
        case Code::half: return apart <= std::max(std::abs(wanted), 0x1p-14) * 0x1p-9;
        case Code::single: return apart <= std::max(std::abs(wanted), 0x1p-24) * 0x1p-18;
        case Code::integer: break;
    }
    return found == wanted;
}

// Images that are flipped, or moved by whole pixels.
std::vector<PictureChange> of_places() {
    const auto index = [](const TargetImage& t, int x, int y) -> std::optional<std::size_t> {
        if (x < 0 || y < 0 || x >= t.width || y >= t.height) return std::nullopt;
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(t.width) + static_cast<std::size_t>(x);
    };
    std::vector<PictureChange> all;
    const auto add = [&](const char* name, const char* description, auto place) {
        for (const Meaning meaning : {Meaning::color, Meaning::depth})
            all.push_back({name, description, meaning, [=](const TargetImage& t, int x, int y) {
                               const auto [from_x, from_y] = place(t, x, y);
                               return index(t, from_x, from_y);
                           }});
    };
    add("flipped_rows", "the reference upside down", [](const TargetImage& t, int x, int y) {
        return std::pair{x, t.height - 1 - y};
    });
    add("flipped_columns", "the reference as in a mirror", [](const TargetImage& t, int x, int y) {
        return std::pair{t.width - 1 - x, y};
    });
    add("turned", "the reference turned by half a circle", [](const TargetImage& t, int x, int y) {
        return std::pair{t.width - 1 - x, t.height - 1 - y};
    });
    add("moved_left", "the reference moved left by one pixel", [](const TargetImage&, int x, int y) {
        return std::pair{x + 1, y};
    });
    add("moved_right", "the reference moved right by one pixel", [](const TargetImage&, int x, int y) {
        return std::pair{x - 1, y};
    });
    add("moved_up", "the reference moved up by one pixel", [](const TargetImage&, int x, int y) {
        return std::pair{x, y + 1};
    });
    add("moved_down", "the reference moved down by one pixel", [](const TargetImage&, int x, int y) {
        return std::pair{x, y - 1};
    });
    return all;
}

// A function of colour values, of 8-bit codes from a table: powers take longer than the rest of a comparison.
class TabledFunction {
  public:
    explicit TabledFunction(float (*function)(float)) : function_{function} {
        for (std::uint32_t code = 0; code < 256; ++code) of_bytes_[code] = function(byte_value(code));
    }
    [[nodiscard]] double of(const TargetImage& t, double v) const {
        return t.code == Code::unorm8 ? of_bytes_[nearest(Code::unorm8, v)] : function_(static_cast<float>(v));
    }

  private:
    static float byte_value(std::uint32_t code) { return static_cast<float>(value(Code::unorm8, code)); }
    float (*function_)(float);
    std::array<float, 256> of_bytes_{};
};

double alpha_of(const TargetImage& t, std::size_t pixel) { return t.channels == 4 ? t.value_at(pixel, 3) : 1.0; }

// The same scene with values stored by another convention.
std::vector<PictureChange> of_values() {
    const auto color = [](auto of_channel) {
        return [=](const TargetImage& t, std::size_t pixel, int c) {
            const double v = t.value_at(pixel, c);
            return c == 3 ? v : of_channel(t, pixel, v);
        };
    };
    const TabledFunction encoded{scenes::encode_srgb}, decoded{scenes::decode_srgb};
    return {
        {"premultiplied",
         "the reference's colours times their alpha",
         Meaning::color,
         {},
         color([](const TargetImage& t, std::size_t pixel, double v) { return v * alpha_of(t, pixel); })},
        {"straight",
         "the reference's colours divided by their alpha",
         Meaning::color,
         {},
         color([](const TargetImage& t, std::size_t pixel, double v) {
             const double alpha = alpha_of(t, pixel);
             return alpha > 0 ? std::min(v / alpha, t.code == Code::single || t.code == Code::half ? v / alpha : 1.0)
                              : 0.0;
         })},
        {"encoded_again",
         "the reference's colours encoded to sRGB",
         Meaning::color,
         {},
         color([encoded](const TargetImage& t, std::size_t, double v) { return encoded.of(t, v); })},
        {"decoded",
         "the reference's colours decoded from sRGB to linear light",
         Meaning::color,
         {},
         color([decoded](const TargetImage& t, std::size_t, double v) { return decoded.of(t, v); })},
        {"red_for_blue",
         "the reference with red and blue exchanged",
         Meaning::color,
         {},
         [](const TargetImage& t, std::size_t pixel, int c) {
             return t.value_at(pixel, c < 3 && t.channels >= 3 ? 2 - c : c);
         }},
        {"alpha_lost",
         "the reference with alpha 1 everywhere",
         Meaning::color,
         {},
         [](const TargetImage& t, std::size_t pixel, int c) { return c == 3 ? 1.0 : t.value_at(pixel, c); }},
        {"alpha_inverted",
         "the reference with 1 - alpha for alpha",
         Meaning::color,
         {},
         [](const TargetImage& t, std::size_t pixel, int c) {
             return c == 3 ? 1.0 - t.value_at(pixel, c) : t.value_at(pixel, c);
         }},
        {"depth_reversed",
         "the reference with 1 - z for z",
         Meaning::depth,
         {},
         [](const TargetImage& t, std::size_t pixel, int c) { return 1.0 - t.value_at(pixel, c); }},
        {"depth_in_16_bits",
         "the reference's depth rounded to 16 bits",
         Meaning::depth,
         {},
         [](const TargetImage& t, std::size_t pixel, int c) {
             return value(Code::unorm16, nearest(Code::unorm16, t.value_at(pixel, c)));
         }},
    };
}

bool agrees(const PictureChange& mistake, const TargetPair& pair, std::size_t pixel) {
    const TargetImage& r = *pair.reference;
    std::size_t from = pixel;
    if (mistake.moved) {
        const auto width = static_cast<std::size_t>(r.width);
        const auto place = mistake.moved(r, static_cast<int>(pixel % width), static_cast<int>(pixel / width));
        if (!place) return true;  // the pixel comes from outside the image and is unknown
        from = *place;
    }
    for (int c = 0; c < pair.channels(); ++c) {
        const StoredCode found = pair.candidate->at(pixel, c);
        if (mistake.moved ? !is_equal(r.at(from, c), found) : !is_near(found, mistake.computed(r, from, c)))
            return false;
    }
    return true;
}

// A pixel that is nearly equal gives no evidence of how a value was changed, and neither does one that is NaN or
// infinite: a conversion may make anything of it.
bool shows_change(const TargetPair& pair, std::size_t pixel) {
    bool is_changed = false;
    for (int c = 0; c < pair.channels(); ++c) {
        const double given = pair.reference->value_at(pixel, c);
        if (!std::isfinite(given) || !std::isfinite(pair.candidate->value_at(pixel, c))) return false;
        is_changed = is_changed || !is_near(pair.candidate->at(pixel, c), given);
    }
    return is_changed;
}

// The pixels of a pair, apart by whether they are equal.
struct SplitPixels {
    const TargetPair* pair = nullptr;
    std::vector<std::size_t> differing{}, equal{};
};

SplitPixels split_pixels(const TargetPair& pair) {
    SplitPixels split{.pair = &pair};
    for (std::size_t pixel = 0; pixel < pair.reference->pixels(); ++pixel)
        (pair.is_equal_at(pixel) ? split.equal : split.differing).push_back(pixel);
    return split;
}

// Calls act(change, pair) where a change concerns the pair's meaning, until it returns false.
template <class Act>
bool for_each_pair(std::span<const PictureChange> changes, const std::vector<SplitPixels>& pairs, const Act& act) {
    for (const PictureChange& change : changes)
        for (const SplitPixels& split : pairs)
            if (split.pair->reference->meaning == change.meaning && !act(change, split)) return false;
    return true;
}

// The changes have one name: a movement affects colours and depths alike, and one entry sums both. Empty if it explains
// less than half of the differing pixels, or no more than it contradicts. Most mistakes are out after some of the
// differing pixels; the equal ones are looked at for the others only.
std::optional<Explanation> explanation(std::span<const PictureChange> changes, const std::vector<SplitPixels>& pairs) {
    Explanation sum{changes[0].name, changes[0].description};
    for_each_pair(changes, pairs, [&](const PictureChange&, const SplitPixels& split) {
        sum.of += split.differing.size();
        return true;
    });
    std::uint64_t missed = 0, evidence = 0;  // evidence: explained pixels whose difference is more than rounding
    const bool explains = for_each_pair(changes, pairs, [&](const PictureChange& change, const SplitPixels& split) {
        for (const std::size_t pixel : split.differing)
            if (agrees(change, *split.pair, pixel)) {
                ++sum.explained;
                evidence += change.moved || shows_change(*split.pair, pixel) ? 1 : 0;
            } else if (2 * ++missed > sum.of) {
                return false;
            }
        return true;
    });
    if (!explains || sum.explained == 0 || 2 * evidence < sum.explained) return std::nullopt;
    const bool is_kept = for_each_pair(changes, pairs, [&](const PictureChange& change, const SplitPixels& split) {
        for (const std::size_t pixel : split.equal)
            if (!agrees(change, *split.pair, pixel) && ++sum.contradicted >= sum.explained) return false;
        return true;
    });
    return is_kept ? std::optional{std::move(sum)} : std::nullopt;
}

}  // namespace

std::vector<Explanation> explanations(std::span<const TargetPair> pairs) {
    std::vector<PictureChange> mistakes = of_places();
    for (PictureChange& mistake : of_values()) mistakes.push_back(std::move(mistake));
    std::vector<SplitPixels> split;
    for (const TargetPair& pair : pairs) split.push_back(split_pixels(pair));
    std::vector<Explanation> found;
    for (std::size_t first = 0, last = 0; first < mistakes.size(); first = last) {
        while (last < mistakes.size() && std::string_view(mistakes[last].name) == mistakes[first].name) ++last;
        if (auto one = explanation(std::span{mistakes}.subspan(first, last - first), split))
            found.push_back(*std::move(one));
    }
    std::ranges::stable_sort(found, [](const Explanation& a, const Explanation& b) {
        const auto gain = [](const Explanation& e) {
            return static_cast<std::int64_t>(e.explained) - static_cast<std::int64_t>(e.contradicted);
        };
        return gain(a) > gain(b);
    });
    return found;
}

}  // namespace strata::oracle
