// tools/oracle/program/properties.cpp - the table of properties (properties.h).
#include "tools/oracle/program/properties.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace strata::oracle::program {

namespace {

using Kind = FragmentProperty::Kind;
constexpr double none = std::numeric_limits<double>::infinity();

const ListFragment& at(const ListPixel& p, std::size_t k) { return p.fragments[k]; }
double rank(const ListPixel&, std::size_t k) { return static_cast<double>(k); }
double layers(const ListPixel& p, std::size_t) { return static_cast<double>(p.fragments.size()); }
template <int n>
double rank_modulo(const ListPixel&, std::size_t k) {
    return static_cast<double>(k % n);
}
template <int n>
double x_modulo(const ListPixel& p, std::size_t) {
    return p.x % n;
}
template <int n>
double y_modulo(const ListPixel& p, std::size_t) {
    return p.y % n;
}
template <int n>
double triangle_modulo(const ListPixel& p, std::size_t k) {
    return at(p, k).primitive % n;
}
double gap_before(const ListPixel& p, std::size_t k) { return k == 0 ? none : at(p, k).depth - at(p, k - 1).depth; }
double gap_behind(const ListPixel& p, std::size_t k) {
    return k + 1 == p.fragments.size() ? none : gap_before(p, k + 1);
}
double luminance(const ListPixel& p, std::size_t k) {
    const Color& c = at(p, k).color;
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}
template <int n>
double channel(const ListPixel& p, std::size_t k) {
    return at(p, k).color[n];
}
double largest_channel(const ListPixel& p, std::size_t k) { return *std::ranges::max_element(at(p, k).color); }
template <int n>
double is_mostly(const ListPixel& p, std::size_t k) {
    const Color& c = at(p, k).color;
    return c[n] > c[(n + 1) % 3] && c[n] > c[(n + 2) % 3];
}
double through_before(const ListPixel& p, std::size_t k) {
    double through = 1;
    for (std::size_t i = 0; i < k; ++i) through *= 1 - at(p, i).alpha;
    return through;
}
double alpha_before(const ListPixel& p, std::size_t k) {
    double sum = 0;
    for (std::size_t i = 0; i < k; ++i) sum += at(p, i).alpha;
    return sum;
}
// The largest number of bits in which the depth equals that of the fragment before it, up to 24.
double equal_bits(const ListPixel& p, std::size_t k) {
    if (k == 0) return -1;
    double a = at(p, k).depth, b = at(p, k - 1).depth;
    int bits = 0;
    for (; bits < 24; ++bits) {
        a *= 2;
        b *= 2;
        if (static_cast<std::int64_t>(a) != static_cast<std::int64_t>(b)) break;
    }
    return bits;
}

const FragmentProperty table[] = {
    {.name = "rank from the front", .kind = Kind::integer, .price = 3, .of = rank},
    {.name = "rank from the back",
     .kind = Kind::integer,
     .price = 3,
     .of = [](const ListPixel& p, std::size_t k) { return static_cast<double>(p.fragments.size() - 1 - k); }},
    {.name = "twice the rank from the middle layer",
     .kind = Kind::integer,
     .price = 4,
     .of = [](const ListPixel& p, std::size_t k) { return 2 * rank(p, k) - (layers(p, k) - 1); }},
    {.name = "twice the distance in ranks from the middle",
     .kind = Kind::integer,
     .price = 5,
     .of = [](const ListPixel& p, std::size_t k) { return std::fabs(2 * rank(p, k) - (layers(p, k) - 1)); }},
    {.name = "odd ranks from the front", .no = "even ranks from the front", .kind = Kind::flag, .of = rank_modulo<2>},
    {.name = "rank modulo 3", .kind = Kind::integer, .of = rank_modulo<3>},
    {.name = "rank modulo 4", .kind = Kind::integer, .of = rank_modulo<4>},
    {.name = "rank modulo 5", .kind = Kind::integer, .of = rank_modulo<5>},
    {.name = "rank in drawing order",
     .kind = Kind::integer,
     .price = 4,
     .of = [](const ListPixel& p, std::size_t k) { return static_cast<double>(at(p, k).submission); }},
    {.name = "rank in drawing order from the last one",
     .kind = Kind::integer,
     .price = 4,
     .of = [](const ListPixel& p, std::size_t k) { return layers(p, k) - 1 - at(p, k).submission; }},
    {.name = "distance in depth behind the one before", .of = gap_before},
    {.name = "distance in depth to the next one behind", .of = gap_behind},
    {.name = "depth codes before the opaque surface",
     .of =
         [](const ListPixel& p, std::size_t k) {
             return p.has_opaque ? static_cast<double>(p.opaque_code) - static_cast<double>(at(p, k).code) : none;
         }},
    {.name = "number of bits of depth shared with the one before", .kind = Kind::integer, .price = 6, .of = equal_bits},
    {.name = "ones at the depth of the one before",
     .no = "ones not at the depth of the one before",
     .kind = Kind::flag,
     .price = 3,
     .of = [](const ListPixel& p, std::size_t k) { return k > 0 && at(p, k).code == at(p, k - 1).code ? 1.0 : 0.0; }},
    {.name = "depth", .price = 3, .of = [](const ListPixel& p, std::size_t k) { return at(p, k).depth; }},
    {.name = "alpha", .price = 3, .of = [](const ListPixel& p, std::size_t k) { return at(p, k).alpha; }},
    {.name = "luminance", .of = luminance},
    {.name = "red", .of = channel<0>},
    {.name = "green", .of = channel<1>},
    {.name = "blue", .of = channel<2>},
    {.name = "largest channel", .of = largest_channel},
    {.name = "mostly red ones", .no = "ones that are not mostly red", .kind = Kind::flag, .of = is_mostly<0>},
    {.name = "mostly green ones", .no = "ones that are not mostly green", .kind = Kind::flag, .of = is_mostly<1>},
    {.name = "mostly blue ones", .no = "ones that are not mostly blue", .kind = Kind::flag, .of = is_mostly<2>},
    {.name = "front faces",
     .no = "back faces",
     .kind = Kind::flag,
     .price = 2,
     .of = [](const ListPixel& p, std::size_t k) { return at(p, k).is_front_facing ? 1.0 : 0.0; }},
    {.name = "instance",
     .kind = Kind::integer,
     .of = [](const ListPixel& p, std::size_t k) { return static_cast<double>(at(p, k).instance); }},
    {.name = "material",
     .kind = Kind::integer,
     .price = 4,
     .of = [](const ListPixel& p, std::size_t k) { return static_cast<double>(at(p, k).material); }},
    {.name = "triangles of odd number",
     .no = "triangles of even number",
     .kind = Kind::flag,
     .price = 5,
     .of = triangle_modulo<2>},
    {.name = "triangle number modulo 3", .kind = Kind::integer, .price = 6, .of = triangle_modulo<3>},
    {.name = "triangle number",
     .kind = Kind::integer,
     .price = 6,
     .of = [](const ListPixel& p, std::size_t k) { return static_cast<double>(at(p, k).primitive); }},
    {.name = "ones drawn after the one before them",
     .no = "ones drawn earlier than the one before them",
     .kind = Kind::flag,
     .price = 6,
     .of = [](const ListPixel& p,
              std::size_t k) { return k > 0 && at(p, k).submission > at(p, k - 1).submission ? 1. : 0.; }},
    {.name = "transmittance before", .price = 6, .of = through_before, .is_rounded = true},
    {.name = "transmittance behind",
     .price = 6,
     .of = [](const ListPixel& p, std::size_t k) { return through_before(p, k + 1); },
     .is_rounded = true},
    {.name = "sum of alphas before", .price = 6, .of = alpha_before, .is_rounded = true},
    {.name = "node number in all lists",
     .kind = Kind::integer,
     .price = 6,
     .of = [](const ListPixel& p, std::size_t k) { return static_cast<double>(p.first + at(p, k).submission); }},
    {.name = "number of layers", .kind = Kind::integer, .is_of_pixel = true, .price = 3, .of = layers},
    {.name = "odd numbers of layers",
     .no = "even numbers of layers",
     .kind = Kind::flag,
     .is_of_pixel = true,
     .price = 4,
     .of = [](const ListPixel& p, std::size_t) { return static_cast<double>(p.fragments.size() % 2); }},
    {.name = "total transmittance",
     .is_of_pixel = true,
     .of = [](const ListPixel& p, std::size_t) { return through_before(p, p.fragments.size()); },
     .is_rounded = true},
    {.name = "an opaque surface behind",
     .no = "no opaque surface behind",
     .kind = Kind::flag,
     .is_of_pixel = true,
     .price = 4,
     .of = [](const ListPixel& p, std::size_t) { return p.has_opaque ? 1.0 : 0.0; }},
    {.name = "x",
     .kind = Kind::integer,
     .is_of_pixel = true,
     .of = [](const ListPixel& p, std::size_t) { return double(p.x); }},
    {.name = "y",
     .kind = Kind::integer,
     .is_of_pixel = true,
     .of = [](const ListPixel& p, std::size_t) { return double(p.y); }},
    {.name = "odd columns",
     .no = "even columns",
     .kind = Kind::flag,
     .is_of_pixel = true,
     .price = 4,
     .of = x_modulo<2>},
    {.name = "odd rows", .no = "even rows", .kind = Kind::flag, .is_of_pixel = true, .price = 4, .of = y_modulo<2>},
    {.name = "odd pixels of a checkerboard",
     .no = "even pixels of a checkerboard",
     .kind = Kind::flag,
     .is_of_pixel = true,
     .of = [](const ListPixel& p, std::size_t) { return double((p.x + p.y) % 2); }},
    {.name = "x modulo 8", .kind = Kind::integer, .is_of_pixel = true, .price = 6, .of = x_modulo<8>},
    {.name = "y modulo 8", .kind = Kind::integer, .is_of_pixel = true, .price = 6, .of = y_modulo<8>},
    {.name = "x modulo 16", .kind = Kind::integer, .is_of_pixel = true, .price = 7, .of = x_modulo<16>},
    {.name = "y modulo 16", .kind = Kind::integer, .is_of_pixel = true, .price = 7, .of = y_modulo<16>},
};

}  // namespace

std::span<const FragmentProperty> properties() { return table; }

}  // namespace strata::oracle::program
