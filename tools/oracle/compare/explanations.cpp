// tools/oracle/compare/explanations.cpp - changes the reference in every known way (flipped, moved, encoded, multiplied
// by alpha ...) and keeps what equals the candidate everywhere (explanations.h).
#include "tools/oracle/compare/explanations.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
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

double alpha_of(const TargetImage& t, std::size_t pixel) { return t.channels == 4 ? t.value_at(pixel, 3) : 1.0; }

// The same scene with values stored by another convention.
std::vector<PictureChange> of_values() {
    const auto color = [](auto of_channel) {
        return [=](const TargetImage& t, std::size_t pixel, int c) {
            const double v = t.value_at(pixel, c);
            return c == 3 ? v : of_channel(t, pixel, v);
        };
    };
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
         color([](const TargetImage&, std::size_t, double v) { return scenes::encode_srgb(static_cast<float>(v)); })},
        {"decoded",
         "the reference's colours decoded from sRGB to linear light",
         Meaning::color,
         {},
         color([](const TargetImage&, std::size_t, double v) { return scenes::decode_srgb(static_cast<float>(v)); })},
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

// `evidence`: explained pixels whose difference is more than rounding.
void count(const PictureChange& mistake, const TargetPair& pair, Explanation& sum, std::uint64_t& evidence) {
    for (std::size_t pixel = 0; pixel < pair.reference->pixels(); ++pixel) {
        const bool agreed = agrees(mistake, pair, pixel), equal = pair.is_equal_at(pixel);
        sum.of += equal ? 0 : 1;
        sum.explained += !equal && agreed ? 1 : 0;
        evidence += !equal && agreed && (mistake.moved || shows_change(pair, pixel)) ? 1 : 0;
        sum.contradicted += equal && !agreed ? 1 : 0;
    }
}

}  // namespace

std::vector<Explanation> explanations(std::span<const TargetPair> pairs) {
    std::vector<PictureChange> mistakes = of_places();
    for (PictureChange& mistake : of_values()) mistakes.push_back(std::move(mistake));
    std::vector<Explanation> found;
    std::map<std::string, std::uint64_t> evidence;
    for (const PictureChange& mistake : mistakes) {
        // A movement affects colours and depths alike: one entry sums both.
        if (found.empty() || found.back().mistake != mistake.name) found.push_back({mistake.name, mistake.description});
        for (const TargetPair& pair : pairs)
            if (pair.reference->meaning == mistake.meaning) count(mistake, pair, found.back(), evidence[mistake.name]);
    }
    std::erase_if(found, [&](const Explanation& e) {
        return 2 * evidence[e.mistake] < e.explained || e.explained == 0 || 2 * e.explained < e.of ||
               e.explained <= e.contradicted;
    });
    std::ranges::stable_sort(found, [](const Explanation& a, const Explanation& b) {
        const auto gain = [](const Explanation& e) {
            return static_cast<std::int64_t>(e.explained) - static_cast<std::int64_t>(e.contradicted);
        };
        return gain(a) > gain(b);
    });
    return found;
}

}  // namespace strata::oracle
