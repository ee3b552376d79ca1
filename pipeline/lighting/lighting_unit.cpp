// pipeline/lighting/lighting_unit.cpp - the lighting unit's sums (lighting_unit.h).
#include "pipeline/lighting/lighting_unit.h"

#include <algorithm>

#include "pipeline/formats/unorm8.h"
#include "pipeline/lighting/float22.h"
#include "rasterizer/base/nv20_arithmetic.h"

namespace strata::pipeline {
namespace {

namespace f22 = float22;
namespace wide = rasterizer::nv20;

[[nodiscard]] Three rounded(const Three& v) noexcept {
    return {f22::rounded(v[0]), f22::rounded(v[1]), f22::rounded(v[2])};
}

// Dot products and lengths of the 32-bit unit.
[[nodiscard]] float wide_dot(const Three& a, const Three& b) noexcept {
    return wide::sum<3>({wide::multiply(a[0], b[0]), wide::multiply(a[1], b[1]), wide::multiply(a[2], b[2])});
}
struct Offset {
    Three unit{};             // 32 bits
    float squared, distance;  // 22 bits
};
[[nodiscard]] Offset offset_of(const Three& v) noexcept {
    const float squared = wide_dot(v, v), inverse = f22::wide_rsq(squared);
    return {{wide::multiply(v[0], inverse), wide::multiply(v[1], inverse), wide::multiply(v[2], inverse)},
            f22::rounded(squared),
            f22::rounded(wide::multiply(squared, inverse))};
}
[[nodiscard]] Three difference(const Three& a, const Three& b) noexcept {
    Three d{};
    for (std::size_t i = 0; i < 3; ++i) d[i] = wide::sum<2>({a[i], -b[i]});
    return d;
}

// What a light gives a vertex, before its colours.
struct Given {
    Three direction{};  // toward the light
    float attenuation = 1.0f;
    bool is_out_of_range = false;
};

[[nodiscard]] float spot_factor(const LightRegisters& light, const Three& direction) noexcept {
    const auto& [x, y, z, w] = light.spot_direction;
    const float along = wide::sum<4>(
        {wide::multiply(direction[0], x), wide::multiply(direction[1], y), wide::multiply(direction[2], z), w});
    const float c = std::min(std::max(f22::rounded(along), 0.0f), 1.0f);
    const Three f = rounded(light.spot_falloff);
    const float under = f22::sadd(f22::mul(c, f[1]), f[2]);
    return std::min(1.0f, f22::mul(f22::sadd(c, f[0]), f22::rcp(under)));
}

[[nodiscard]] Given given_by(const LightRegisters& light, const Three& position) noexcept {
    if (light.kind == LightKind::infinite) return {rounded(light.direction)};
    const Offset to = offset_of(difference(light.position, position));
    Given given{rounded(to.unit)};
    given.attenuation = f22::rcp(f22::dot({1.0f, to.distance, to.squared}, rounded(light.attenuation)));
    given.is_out_of_range = to.distance > light.range;
    if (light.kind == LightKind::spot) given.attenuation = f22::mul(given.attenuation, spot_factor(light, to.unit));
    return given;
}

// Products enter these sums whole, and the sums keep 2 bits below for infinite lights and 1 else (fog-and-lighting.md
// 5.3).
[[nodiscard]] float specular_quotient(float above, float below, float attenuation) noexcept {
    return above < 0.0f ? 0.0f : f22::mul(f22::mul(above, attenuation), f22::rcp(below));
}
[[nodiscard]] float infinite_specular(const std::array<float, 6>& p, float s) noexcept {
    return specular_quotient(f22::cut_sum<2>({double{s}, double{p[0]}}, 2),
                             f22::cut_sum<2>({double{s} * double{p[1]}, double{p[2]}}, 2), 1.0f);
}
[[nodiscard]] float local_specular(const std::array<float, 6>& p, const Three& normal, const Three& half,
                                   float attenuation) noexcept {
    const double length = double{f22::dot(half, half)};
    const float s = std::max(f22::dot(normal, half), 0.0f), square = f22::mul(s, s);
    return specular_quotient(f22::cut_sum<2>({double{square}, length * double{p[3]}}, 1),
                             f22::cut_sum<2>({double{square} * double{p[4]}, length * double{p[5]}}, 1), attenuation);
}

// The unit's state for one vertex.
class Unit {
  public:
    Unit(const LightingRegisters& registers, const UnlitVertex& vertex) noexcept
        : r_{registers}, v_{vertex}, normal_{rounded(vertex.normal)} {
        for (std::size_t i = 0; i < 6; ++i) params_[i] = f22::rounded(r_.specular_params[i]);
        const Three scene = rounded(r_.scene_ambient), emission = rounded(r_.material_emission);
        const bool both = is_of_vertex(r_.emission) && is_of_vertex(r_.ambient);
        primary_ = both ? color_of(r_.emission) : scene;
        if (is_of_vertex(r_.emission) || is_of_vertex(r_.ambient))
            add(primary_, 1.0f, emission, is_of_vertex(r_.ambient) ? r_.ambient : r_.emission);
    }

    void add_light(const LightRegisters& light) noexcept {
        const Given given = given_by(light, v_.position);
        if (given.is_out_of_range) return;
        add(primary_, given.attenuation, rounded(light.ambient), r_.ambient);
        const float cosine = f22::dot(normal_, given.direction);
        if (cosine < 0.0f) return;
        add(primary_, f22::mul(given.attenuation, cosine), rounded(light.diffuse), r_.diffuse);
        add(r_.separates_specular && r_.has_specular ? secondary_ : primary_, specular(light, given),
            rounded(light.specular), r_.specular);
    }

    [[nodiscard]] const Three& primary() const noexcept { return primary_; }
    [[nodiscard]] const Three& secondary() const noexcept { return secondary_; }

  private:
    [[nodiscard]] static bool is_of_vertex(MaterialSource s) noexcept { return s != MaterialSource::constant; }
    [[nodiscard]] Three color_of(MaterialSource s) const noexcept {
        const auto& c = s == MaterialSource::vertex_diffuse ? v_.diffuse : v_.specular;
        return rounded({c[0], c[1], c[2]});
    }
    void add(Three& sum, float factor, const Three& color, MaterialSource source) const noexcept {
        const Three own = is_of_vertex(source) ? color_of(source) : Three{};
        for (std::size_t c = 0; c < 3; ++c) {
            float term = f22::mul(factor, color[c]);
            if (is_of_vertex(source)) term = f22::mul(term, own[c]);
            sum[c] = f22::add(sum[c], term);
        }
    }
    [[nodiscard]] float specular(const LightRegisters& light, const Given& given) const noexcept {
        if (light.kind == LightKind::infinite && !r_.has_local_eye)
            return infinite_specular(params_, f22::dot(normal_, rounded(light.half_vector)));
        const Three to_eye = rounded(r_.has_local_eye ? offset_of(difference({}, v_.position)).unit : r_.eye_direction);
        Three half = given.direction;
        for (std::size_t i = 0; i < 3; ++i) half[i] = f22::add(to_eye[i], half[i]);
        return local_specular(params_, normal_, half, given.attenuation);
    }

    const LightingRegisters& r_;
    const UnlitVertex& v_;
    Three normal_;
    std::array<float, 6> params_{};
    Three primary_{}, secondary_{};
};

// A vertex' own colour is cut to 14 bits first (attributes.md 2.2); a lit one has no more.
[[nodiscard]] float byte_value(float v) noexcept { return unorm8_value(f22::to_byte(f22::cut(double{v}))); }

}  // namespace

Three unit_of_lighting(const Three& v) noexcept { return rounded(offset_of(v).unit); }

LitColors light_vertex(const LightingRegisters& registers, const UnlitVertex& vertex) noexcept {
    LitColors lit;
    Three primary{vertex.diffuse[0], vertex.diffuse[1], vertex.diffuse[2]},
        secondary{vertex.specular[0], vertex.specular[1], vertex.specular[2]};
    float alpha = vertex.diffuse[3];
    if (registers.is_enabled) {
        Unit unit{registers, vertex};
        for (const LightRegisters& light : registers.light)
            if (light.kind != LightKind::off) unit.add_light(light);
        primary = unit.primary();
        if (registers.separates_specular) secondary = unit.secondary();
        switch (registers.diffuse) {
            case MaterialSource::constant: alpha = f22::rounded(registers.material_alpha); break;
            case MaterialSource::vertex_diffuse: break;
            case MaterialSource::vertex_specular: alpha = vertex.specular[3]; break;
        }
    }
    for (std::size_t c = 0; c < 3; ++c) {
        lit.primary[c] = byte_value(primary[c]);
        lit.secondary[c] = registers.has_specular ? byte_value(secondary[c]) : 0.0f;
    }
    lit.primary[3] = byte_value(alpha);
    lit.secondary[3] = registers.has_specular && registers.has_specular_alpha ? byte_value(vertex.specular[3]) : 1.0f;
    return lit;
}

}  // namespace strata::pipeline
