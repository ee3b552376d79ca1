// peeling/truth/truth.cpp - composites a chain's fragments tile by tile (truth.h).
#include "peeling/truth/truth.h"

#include <algorithm>
#include <optional>

#include "peeling/as_shown.h"
#include "peeling/audit/image_error.h"
#include "pipeline/formats/convert.h"
#include "pipeline/formats/packed.h"
#include "pipeline/stages/blend.h"
#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/input_error.h"
#include "rasterizer/base/parallel.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

using Color = std::array<double, 4>;

// The colour target of a chain: its format, and the conversion of stored values.
class ChainTarget {
  public:
    ChainTarget(const ChainScene& scene, const Chain& chain, Format format)
        : profile_{scene.profile}, format_{chain.store ? Format::rgba32f : format}, keeps_{chain.store} {}

    // Stored without blending and read again.
    [[nodiscard]] Color stored(const Color& color) const {
        if (keeps_) return color;
        return rounded(color);
    }
    // The value of a stored colour (image_error.h): 8-bit codes are k / 255 in binary64.
    [[nodiscard]] Color shown(const Color& color) const {
        if (keeps_ || info(format_).type != ChannelType::unorm8) return color;
        const Codes codes = codes_of(color);
        if (is_packed(format_)) return values_of(codes);
        return {codes[0][0] / 255.0, codes[1][0] / 255.0, codes[2][0] / 255.0, codes[3][0] / 255.0};
    }
    // Blends a layer stored by a peel OVER the target; alpha is not written.
    void blend_over(const Color& layer, Color& target) const {
        const Color source = rounded(layer);
        Codes codes = codes_of(target);
        rasterizer::Lanes<float> lane{};
        std::array<rasterizer::Lanes<float>, 4> values{lane, lane, lane, lane};
        for (std::size_t c = 0; c < 4; ++c) values[c][0] = static_cast<float>(source[c]);
        Blend state = blend_mode::over;
        state.write_mask = 0x7;
        blend_into(format_, state, profile_, values, codes, 1);
        target = values_of(codes);
    }

  private:
    using Codes = std::array<rasterizer::Lanes<std::uint32_t>, 4>;

    [[nodiscard]] Codes codes_of(const Color& color) const {
        Codes codes{};
        for (std::size_t c = 0; c < 4; ++c) {
            const auto value = static_cast<float>(color[c]);
            if (is_packed(format_))
                codes[c][0] = packed_code(format_, static_cast<int>(c), value, profile_.color_rounding());
            else
                pipeline::scalar::encode(info(format_).type, profile_.half_rounding, &value, codes[c].data(), 1);
        }
        return codes;
    }
    [[nodiscard]] Color values_of(const Codes& codes) const {
        Color color{};
        for (std::size_t c = 0; c < 4; ++c) {
            float value = 0;
            if (is_packed(format_))
                value = packed_value(format_, static_cast<int>(c), codes[c][0], profile_.color_rounding());
            else
                pipeline::scalar::decode(info(format_).type, codes[c].data(), &value, 1);
            color[c] = double{value};
        }
        return color;
    }
    [[nodiscard]] Color rounded(const Color& color) const { return values_of(codes_of(color)); }

    const DeviceProfile& profile_;
    Format format_;
    bool keeps_;
};

// A tile of the frame: its opaque surface, then its transparent fragments pixel by pixel.
class ChainTile {
  public:
    ChainTile(const ChainTarget& target, const Chain& chain, const Rgba& background, std::size_t pixels, double far)
        : target_{target},
          chain_{chain},
          depth_(pixels, far),
          color_(pixels, target.stored({background[0], background[1], background[2], background[3]})),
          behind_(pixels) {}

    void draw_opaque(const std::vector<ChainFragment>& fragments) {
        for (const ChainFragment& f : fragments) {
            if (!(f.depth < depth_[f.pixel])) continue;
            depth_[f.pixel] = f.depth;
            color_[f.pixel] = target_.stored(f.color);
        }
    }
    // Each pixel's fragments, nearest first, in submission order where depths are equal.
    void draw_transparent(const std::vector<ChainFragment>& fragments) {
        for (std::size_t i = 0; i < fragments.size(); ++i)
            if (fragments[i].depth < depth_[fragments[i].pixel])
                behind_[fragments[i].pixel].push_back(static_cast<std::uint32_t>(i));
        for (std::size_t pixel = 0; pixel < behind_.size(); ++pixel) {
            auto& order = behind_[pixel];
            std::stable_sort(order.begin(), order.end(),
                             [&](std::uint32_t a, std::uint32_t b) { return fragments[a].depth < fragments[b].depth; });
            composite(fragments, order, color_[pixel]);
        }
    }
    [[nodiscard]] Color color(std::size_t pixel) const { return color_[pixel]; }

  private:
    // A peel keeps one layer per depth: the first submitted.
    void composite(const std::vector<ChainFragment>& fragments, std::vector<std::uint32_t>& order, Color& color) const {
        if (!chain_.blend) {
            const auto is_tie = [&](std::uint32_t a, std::uint32_t b) {
                return fragments[a].depth == fragments[b].depth;
            };
            order.erase(std::unique(order.begin(), order.end(), is_tie), order.end());
        }
        for (std::size_t i = order.size(); i-- > 0;) {
            const Color& source = fragments[order[i]].color;
            if (!chain_.blend) {
                target_.blend_over(source, color);
                continue;
            }
            const double alpha = source[3];
            for (std::size_t c = 0; c < 3; ++c) color[c] = alpha * source[c] + (1.0 - alpha) * color[c];
        }
        if (chain_.blend && !order.empty()) color = target_.stored(color);
    }

    const ChainTarget& target_;
    const Chain& chain_;
    std::vector<double> depth_;
    std::vector<Color> color_;
    std::vector<std::vector<std::uint32_t>> behind_;
};

[[nodiscard]] bool has_opaque(const ChainScene& scene) {
    return !scene.options.alpha && std::ranges::any_of(scene.list.materials, [](const Material& m) {
        return m.alpha_mode != AlphaMode::blend;
    });
}

}  // namespace

RealImage real_image(const Image& image) {
    RealImage real{image.width, image.height, {}};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) real.rgb.push_back(channel_value(image, x, y, c));
    return real;
}

RealImage render_chain(const ChainScene& scene, const Chain& chain) {
    if (scene.list.light) throw InputError("scene", "light", "no light that casts shadows", "one");
    if (!scene.options.lights.value_or(scene.list.lights).empty())
        throw InputError("scene", "lights", "no lights", "some");
    if (scene.options.fog) throw InputError("scene", "fog", "no fog", "one");
    for (const pipeline::Instance& instance : scene.list.instances)
        if (scene.list.meshes[instance.mesh].primitive != pipeline::Primitive::triangles)
            throw InputError("scene", "primitives", "triangles alone, whose exact picture is known", "lines or points");
    // Only the NVIDIA profiles have the plane and snapping rules that a chain can evaluate.
    const rasterizer::RasterRules& rules = scene.profile.raster;
    const bool is_known = rules.plane_rule == rasterizer::PlaneRule::exact &&
                          rules.coverage == rasterizer::CoverageRule::snapped_edges &&
                          rules.clip == rasterizer::ClipVolume::guard_band;
    if (chain != exact_chain && !is_known)
        throw InputError("profile", "raster",
                         "exact planes, snapped edges and a guard band (the error chain models no others)",
                         "those of " + scene.profile.name);
    const FloatEnvironment ours;
    const SimdScope kernels{scene.options.simd};
    const ChainList transparent{scene, chain, scene.options.alpha ? Selection::all : Selection::transparent};
    std::optional<ChainList> opaque;
    if (has_opaque(scene)) opaque.emplace(scene, chain, Selection::opaque);
    const ChainTarget target{scene, chain, scene.color_format()},
        picture{scene, chain, scene.options.result_format.value_or(scene.color_format())};
    RealImage image{scene.options.width, scene.options.height, {}};
    image.rgb.resize(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    parallel_for(transparent.tile_count(), scene.options.threads, [&](std::size_t number) {
        const rasterizer::Rect rect = transparent.tile_rect(number);
        ChainTile tile{target, chain, scene.options.background, rect.area(), transparent.far()};
        std::vector<ChainFragment> fragments;
        if (opaque) opaque->fragments_of(number, fragments);
        tile.draw_opaque(fragments);
        fragments.clear();
        transparent.fragments_of(number, fragments);
        tile.draw_transparent(fragments);
        for (std::size_t pixel = 0; pixel < rect.area(); ++pixel) {
            const auto width = static_cast<std::size_t>(rect.width());
            const std::size_t x = static_cast<std::size_t>(rect.x0) + pixel % width;
            const std::size_t y = static_cast<std::size_t>(rect.y0) + pixel / width;
            const Color shown = picture.shown(picture.stored(tile.color(pixel)));
            for (std::size_t c = 0; c < 3; ++c)
                image.rgb[3 * (y * static_cast<std::size_t>(image.width) + x) + c] = shown[c];
        }
    });
    AsShown{scene.options, scene.profile}.turn_rows(image.rgb);
    return image;
}

}  // namespace strata::peeling
