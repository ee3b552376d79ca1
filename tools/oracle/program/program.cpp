// tools/oracle/program/program.cpp - runs a program on the fragments of a pixel (program.h).
#include "tools/oracle/program/program.h"

#include <algorithm>
#include <cmath>

namespace strata::oracle::program {

namespace {

double color_of(const PortLayer& layer, std::size_t c, const PortRounding& r) {
    if (r.layers == PortFormat::exact) return layer.color[c] * layer.alpha;
    if (r.premultiplies) return stored(r.layers, layer.color[c] * layer.alpha, r.truncates);
    return stored(r.layers, layer.color[c]) * stored(r.layers, layer.alpha);
}

double cover_of(const PortLayer& layer, const PortRounding& r) { return stored(r.layers, layer.cover); }

// A layer over `below`.
void blend_over(const PortLayer& layer, Color& below, const PortRounding& r) {
    const double rest = 1 - cover_of(layer, r);
    for (std::size_t c = 0; c < 3; ++c) {
        const double own = color_of(layer, c, r), other = below[c] * rest;
        below[c] = r.splits ? r.kept(r.kept(own) + r.kept(other)) : r.kept(own + other);
    }
}

// A layer under what is accumulated with this transmittance.
void blend_under(const PortLayer& layer, Color& sum, double& through, const PortRounding& r) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] = r.kept(sum[c] + through * color_of(layer, c, r));
    if (r.form == BlendForm::under_alpha)
        through = 1 - r.weighed((1 - through) + through * cover_of(layer, r));
    else
        through = r.weighed(through * (1 - cover_of(layer, r)));
}

Color kept(const Color& color, const PortRounding& r) { return {r.kept(color[0]), r.kept(color[1]), r.kept(color[2])}; }

}  // namespace

Color blended(std::span<const PortLayer> layers, const Color& behind, const PortRounding& r) {
    if (r.form == BlendForm::once) {
        Color color = behind;
        for (std::size_t i = layers.size(); i-- > 0;)
            for (std::size_t c = 0; c < 3; ++c)
                color[c] = layers[i].color[c] * layers[i].alpha + color[c] * (1 - layers[i].cover);
        return color;
    }
    std::size_t near = layers.size();
    if (r.form == BlendForm::over) near = 0;
    if (r.form == BlendForm::both_ends) near = (layers.size() + 1) / 2;
    Color below = kept(behind, r), sum{};
    for (std::size_t i = layers.size(); i-- > near;) blend_over(layers[i], below, r);
    if (near == 0) return below;
    double through = 1;
    for (std::size_t i = 0; i < near; ++i) blend_under(layers[i], sum, through, r);
    for (std::size_t c = 0; c < 3; ++c) sum[c] = r.kept(sum[c] + through * below[c]);
    return sum;
}

void EditedPixel::edit(std::span<const Applied> edits, const ListPixel& pixel) {
    edits_ = edits;
    layers_.clear();
    for (std::uint32_t k = 0; k < pixel.fragments.size(); ++k) {
        const ListFragment& f = pixel.fragments[k];
        layers_.push_back({.color = f.color, .alpha = f.alpha, .cover = f.alpha, .depth = f.depth, .fragment = k});
    }
    behind_ = pixel.behind;
    fold_ = nullptr;
    for (const Applied& edit : edits) {
        const bool is_here = edit.mask.size() > 0 && edit.mask[0] != 0;
        switch (edit.entry->step) {
            case PortStep::list: edit.entry->edit(layers_, {pixel, edit.mask}, edit.parameters); break;
            case PortStep::background:
                if (is_here && !pixel.has_opaque) behind_ = edit.entry->recolor(behind_, edit.parameters);
                break;
            case PortStep::fold:
                if (is_here) fold_ = &edit;
                break;
            case PortStep::finish: break;
        }
    }
}

Color EditedPixel::color(const PortRounding& rounding) const {
    Color color = fold_ != nullptr ? fold_->entry->fold(layers_, behind_, rounding, fold_->parameters)
                                   : blended(layers_, behind_, rounding);
    for (const Applied& edit : edits_)
        if (edit.entry->step == PortStep::finish && edit.mask[0] != 0)
            color = edit.entry->recolor(color, edit.parameters);
    for (double& c : color) c = stored(rounding.result, c, rounding.truncates);
    return color;
}

Color run(std::span<const Applied> edits, const ListPixel& pixel, const PortRounding& rounding) {
    thread_local EditedPixel made;
    made.edit(edits, pixel);
    return made.color(rounding);
}

void select(const Edit& edit, const ListPixel& pixel, std::vector<char>& mask) {
    mask.assign(edit.entry->step == PortStep::list ? pixel.fragments.size() : 1, 1);
    for (std::size_t k = 0; k < mask.size(); ++k)
        for (const Condition& condition : edit.conditions)
            if (mask[k] != 0 && !condition.holds(pixel, k)) mask[k] = 0;
}

const EditedPixel& edited(const Program& program, const ListPixel& pixel) {
    thread_local EditedPixel made;
    thread_local std::vector<std::vector<char>> masks;
    thread_local std::vector<Applied> applied;
    applied.clear();
    if (masks.size() < program.edits.size()) masks.resize(program.edits.size());
    for (std::size_t i = 0; i < program.edits.size(); ++i) {
        const Edit& edit = program.edits[i];
        select(edit, pixel, masks[i]);
        applied.push_back({edit.entry, edit.parameters, masks[i]});
    }
    made.edit(applied, pixel);
    return made;
}

Color value(const Program& program, const ListPixel& pixel, const PortRounding& rounding) {
    return edited(program, pixel).color(rounding);
}

bool changes(const Program& program, const ListPixel& pixel) {
    std::vector<char> mask;
    return std::ranges::any_of(program.edits, [&](const Edit& edit) {
        select(edit, pixel, mask);
        return std::ranges::find(mask, 1) != mask.end();
    });
}

bool is_round(double parameter) noexcept { return std::fabs(parameter * 100 - std::nearbyint(parameter * 100)) < 1e-7; }

namespace {

// A number of few digits is cheap: that one fits is no accident.
double price_of(double parameter) {
    const auto is_whole = [&](double scale) {
        return std::fabs(parameter * scale - std::nearbyint(parameter * scale)) < 1e-9 * scale;
    };
    return is_whole(8) || is_whole(10) ? 4 : is_whole(16) || is_round(parameter) ? 8 : 14;
}

}  // namespace

double price(const Edit& edit) {
    double bits = edit.entry->price;
    for (const double parameter : edit.parameters) bits += price_of(parameter);
    for (const Condition& c : edit.conditions) bits += c.property->price;
    return bits;
}

double price(const Program& program) {
    double bits = program.drawing_price;
    for (const Edit& edit : program.edits) bits += price(edit);
    return bits;
}

}  // namespace strata::oracle::program
