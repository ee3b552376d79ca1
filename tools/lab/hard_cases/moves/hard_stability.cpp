// tools/lab/hard_cases/moves/hard_stability.cpp - decides whether an algorithm is stable under moves: counts changed
// layers and order within the move, within the device's steps, and beyond (hard_stability.h).
#include "tools/lab/hard_cases/moves/hard_stability.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/lab/hard_cases/hard_exact.h"

namespace strata::tools {

using nlohmann::ordered_json;

namespace {

constexpr std::uint64_t seeds = 8;
constexpr std::size_t few_triangles = 8;

std::vector<Move> moves_of(const scenes::Scene& scene) {
    std::size_t triangles = 0;
    for (const pipeline::Mesh& mesh : scene.list.meshes) triangles += mesh.indices.size() / 3;
    std::vector<Move> moves;
    for (const MoveSize size : move_sizes) {
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) moves.push_back({size, seed});
        if (triangles > few_triangles) continue;
        for (std::size_t i = 0; i < coordinate_count(scene); ++i) moves.push_back({size, 0, i});
    }
    return moves;
}

bool has_equal_depths(const ResultPixel& pixel) {
    std::vector<double> depths;
    for (const ResultFragment& f : pixel.fragments) depths.push_back(f.depth);
    std::sort(depths.begin(), depths.end());
    return std::adjacent_find(depths.begin(), depths.end()) != depths.end();
}

std::size_t index_of(PixelClass which) { return static_cast<std::size_t>(which); }

void judge(StabilityRow& row, const RendererProperties& renderer) {
    const auto say = [&](StabilityVerdict verdict, std::string reason) {
        row.verdict = std::max(row.verdict, verdict);
        row.reasons.push_back(std::move(reason));
    };
    const auto worst =
        renderer.is_excused || row.reports_misplaced ? StabilityVerdict::breaks : StabilityVerdict::unstable;
    for (std::size_t i = 0; i < move_sizes.size(); ++i) {
        const SizeRow& size = row.by_size[i];
        const Changes& beyond = size.ours[index_of(PixelClass::beyond)];
        const Changes& device = size.ours[index_of(PixelClass::within_device)];
        const std::string_view name = name_of(move_sizes[i]);
        if (beyond.is_any())
            say(worst, fmt::format("{}: {} fragments gained, {} lost and {} pairs reordered beyond what the move and "
                                   "the device explain",
                                   name, beyond.gained, beyond.lost, beyond.reordered));
        if (size.wrong_beyond > 0)
            say(worst, fmt::format("{}: {} pixels show another order than the exact one, beyond what the device "
                                   "explains",
                                   name, size.wrong_beyond));
        if (device.is_any())
            say(StabilityVerdict::degrades,
                fmt::format("{}: {} fragments gained, {} lost and {} pairs reordered within a step of the device", name,
                            device.gained, device.lost, device.reordered));
    }
    if (row.permuted > 0)
        say(renderer.is_ordered ? worst : StabilityVerdict::degrades,
            fmt::format("another order of triangles changes {} pixels without equal depths", row.permuted));
}

}  // namespace

std::string_view name_of(StabilityVerdict verdict) noexcept {
    switch (verdict) {
        case StabilityVerdict::refused: return "refused";
        case StabilityVerdict::stable: return "stable";
        case StabilityVerdict::degrades: return "degrades gracefully";
        case StabilityVerdict::breaks: return "breaks as the hardware did";
        case StabilityVerdict::unstable: break;
    }
    return "unstable";
}

Changes SizeRow::all() const {
    Changes sum;
    for (const Changes& one : ours) sum += one;
    return sum;
}

MovedCase::MovedCase(const scenes::HardCase& hard)
    : hard_{&hard},
      scene_{make_hard_case({}, hard)},
      exact_{std::make_unique<const ExactCase>(hard, scene_, *scene_.own_view)},
      visible_pixels_{exact_->visible_pixels()} {
    for (const Move& move : moves_of(scene_))
        draws_.push_back({move, ExactCase{hard, moved(scene_, move), *scene_.own_view}.visible_pixels()});
}

MovedCase::~MovedCase() = default;

std::vector<PixelClass> MovedCase::classes(const RendererProperties& renderer, MoveSize size) const {
    const Slack move{.relative = share_of(size)};
    const Slack device{.relative = share_of(size), .pixels = renderer.grid, .depth = 2 * renderer.depth + 0x1p-22};
    const std::vector<bool> in_move = exact_->open_pixels(move), in_device = exact_->open_pixels(device);
    std::vector<PixelClass> classes;
    for (std::size_t p = 0; p < in_move.size(); ++p)
        classes.push_back(in_move[p]     ? PixelClass::within_move
                          : in_device[p] ? PixelClass::within_device
                                         : PixelClass::beyond);
    return classes;
}

void MovedCase::permute(const RendererProperties& renderer, const RenderFunction& render, const ResultPixels& before,
                        StabilityRow& row) const {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const ResultPixels after = render(permuted(scene_, seed).scene, *scene_.own_view).pixels;
        for (std::size_t p = 0; p < before.size(); ++p)
            if (before[p].color != after[p].color)
                ++(renderer.is_ordered && has_equal_depths(before[p]) ? row.permuted_ties : row.permuted);
    }
}

StabilityRow MovedCase::stability(const RendererProperties& renderer, const RenderFunction& render) const {
    StabilityRow row;
    const RenderedPixels before = render(scene_, *scene_.own_view);
    if (!before.refusal.empty()) return row.verdict = StabilityVerdict::refused, row;
    row.reports_misplaced = before.reports_misplaced;
    const FragmentOrderMatch what =
        renderer.is_ordered ? FragmentOrderMatch::in_order : FragmentOrderMatch::in_any_order;
    const std::array classes_of{classes(renderer, MoveSize::unit), classes(renderer, MoveSize::relative)};
    for (const Draw& draw : draws_) {
        SizeRow& size = row.by_size[static_cast<std::size_t>(draw.move.size)];
        const auto& pixels = classes_of[static_cast<std::size_t>(draw.move.size)];
        const RenderedPixels after = render(moved(scene_, draw.move), *scene_.own_view);
        row.reports_misplaced = row.reports_misplaced || after.reports_misplaced;
        ++size.moves;
        for (std::size_t p = 0; p < pixels.size(); ++p) {
            size.exact += changes(visible_pixels_[p], draw.exact[p]);
            size.ours[index_of(pixels[p])] += changes(before.pixels[p], after.pixels[p]);
            if (pixels[p] == PixelClass::beyond && !matches(after.pixels[p], draw.exact[p], what)) ++size.wrong_beyond;
        }
    }
    permute(renderer, render, before.pixels, row);
    judge(row, renderer);
    return row;
}

namespace {

ordered_json changes_json(const Changes& c) {
    return {{"gained", c.gained}, {"lost", c.lost}, {"reordered", c.reordered}, {"color", c.color}, {"depth", c.depth}};
}

// Null if the exact answer does not change.
ordered_json ratio(double ours, double exact) { return exact > 0 ? ordered_json(ours / exact) : ordered_json(nullptr); }

ordered_json amplification(const Changes& ours, const Changes& exact) {
    const auto count = [](std::uint64_t n) { return static_cast<double>(n); };
    return {{"gained", ratio(count(ours.gained), count(exact.gained))},
            {"lost", ratio(count(ours.lost), count(exact.lost))},
            {"reordered", ratio(count(ours.reordered), count(exact.reordered))},
            {"color", ratio(ours.color, exact.color)},
            {"depth", ratio(ours.depth, exact.depth)}};
}

}  // namespace

ordered_json to_json(const StabilityRow& row) {
    ordered_json json{{"verdict", name_of(row.verdict)}, {"reasons", row.reasons}};
    for (std::size_t i = 0; i < move_sizes.size(); ++i) {
        const SizeRow& size = row.by_size[i];
        json[std::string{name_of(move_sizes[i])}] = {
            {"moves", size.moves},
            {"exact", changes_json(size.exact)},
            {"ours", changes_json(size.all())},
            {"amplification", amplification(size.all(), size.exact)},
            {"within_move", changes_json(size.ours[index_of(PixelClass::within_move)])},
            {"within_device", changes_json(size.ours[index_of(PixelClass::within_device)])},
            {"beyond", changes_json(size.ours[index_of(PixelClass::beyond)])},
            {"wrong_beyond", size.wrong_beyond}};
    }
    json["permuted"] = row.permuted;
    json["permuted_ties"] = row.permuted_ties;
    return json;
}

}  // namespace strata::tools
