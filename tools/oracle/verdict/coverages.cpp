#include "tools/oracle/verdict/coverages.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <span>

#include "pipeline/device/profile.h"
#include "pipeline/vertices/prepare.h"

namespace strata::oracle::verdict {

PixelList OtherList::at(int x, int y) const noexcept {
    return {.x = x,
            .y = y,
            .visible = visible,
            .hidden = hidden,
            .behind = behind,
            .behind_spread = behind_spread,
            .opaque = opaque,
            .has_opaque = has_opaque};
}

namespace {

constexpr std::size_t tie_drawings = 4;
constexpr double moved_by = 1.0 / 16;  // pixels
constexpr std::size_t most_others = 48;

OtherList copy_of(const PixelList& list) {
    return {.visible = {list.visible.begin(), list.visible.end()},
            .hidden = {list.hidden.begin(), list.hidden.end()},
            .behind = list.behind,
            .behind_spread = list.behind_spread,
            .opaque = list.opaque,
            .has_opaque = list.has_opaque};
}

bool is_blank(const PixelList& list) noexcept { return list.visible.empty() && list.hidden.empty(); }

// True if the same triangles cover the pixel, visible and hidden, with nearly the same opaque surface.
bool is_covered_alike(const OtherList& a, const OtherList& b) {
    const auto same = [](const std::vector<Fragment>& x, const std::vector<Fragment>& y) {
        return std::ranges::equal(x, y, {}, &Fragment::primitive, &Fragment::primitive);
    };
    return same(a.visible, b.visible) && same(a.hidden, b.hidden) && a.has_opaque == b.has_opaque &&
           (a.behind == b.behind || !a.has_opaque ||
            std::fabs(a.behind[0] - b.behind[0]) + std::fabs(a.behind[1] - b.behind[1]) +
                    std::fabs(a.behind[2] - b.behind[2]) <
                0.02f);
}

// Moves the scene to the right and up by the given number of pixels.
pipeline::VertexAlteration moved(double right, double up, int width, int height) {
    const auto x = static_cast<float>(2 * right / width), y = static_cast<float>(2 * up / height);
    return {.vertices =
                [x, y](rasterizer::TriangleSoup& soup) {
                    for (rasterizer::ClipVertex& v : soup.vertices) {
                        v.x += x * v.w;
                        v.y += y * v.w;
                    }
                },
            .corners = {}};
}

// Fragments of one instance with one facing, which move together.
using Cluster = std::pair<std::uint32_t, bool>;
Cluster cluster_of(const Fragment& f) { return {f.instance, f.is_front_facing}; }

// The fragments of a list, visible and hidden, grouped by cluster.
std::map<Cluster, std::vector<Fragment>> clusters_of(const OtherList& list) {
    std::map<Cluster, std::vector<Fragment>> clusters;
    for (const auto* part : {&list.visible, &list.hidden})
        for (const Fragment& f : *part) clusters[cluster_of(f)].push_back(f);
    return clusters;
}

float most_apart(const Rgba& a, const Rgba& b) noexcept {
    float most = 0;
    for (std::size_t c = 0; c < 4; ++c) most = std::max(most, std::fabs(a[c] - b[c]));
    return most;
}

using Drawings = std::span<const OtherList* const>;

// The fragment of the same triangle in another rendering; null if the triangle does not cover the pixel there.
const Fragment* same_triangle(const Fragment& f, const OtherList& drawing) {
    for (const auto* part : {&drawing.visible, &drawing.hidden})
        for (const Fragment& other : *part)
            if (other.primitive == f.primitive) return &other;
    return nullptr;
}

// The fragment of the same cluster that is nearest in depth: the continuation of the surface.
const Fragment* same_surface(const Fragment& f, const OtherList& drawing) {
    const Fragment* nearest = nullptr;
    for (const auto* part : {&drawing.visible, &drawing.hidden})
        for (const Fragment& other : *part)
            if (cluster_of(other) == cluster_of(f) &&
                (nearest == nullptr ||
                 std::fabs(other.shader_z - f.shader_z) < std::fabs(nearest->shader_z - f.shader_z)))
                nearest = &other;
    return nearest;
}

// The corresponding fragment in another rendering: of the same triangle, or else of the same surface.
const Fragment* like(const Fragment& f, const OtherList& drawing) {
    const Fragment* const same = same_triangle(f, drawing);
    return same != nullptr ? same : same_surface(f, drawing);
}

void find_spread(Fragment& f, Drawings moved) {
    for (const OtherList* drawing : moved)
        if (const Fragment* const other = like(f, *drawing))
            f.spread = std::max(f.spread, most_apart(f.color, other->color));
}

// Sets the spreads of the given rendering to the largest colour changes in the moved ones.
void find_spreads(OtherList& given, Drawings moved) {
    for (auto* part : {&given.visible, &given.hidden})
        for (Fragment& f : *part) find_spread(f, moved);
    for (const OtherList* drawing : moved)
        if (given.has_opaque && drawing->has_opaque)
            given.behind_spread = std::max(given.behind_spread, most_apart(given.behind, drawing->behind));
}

std::int64_t codes_behind(std::uint32_t a, std::uint32_t b) noexcept { return std::int64_t{b} - std::int64_t{a}; }

// True if two different depths may change their order: in some moved rendering their distance changes by at least as
// much as it is.
class Meetings {
  public:
    explicit Meetings(Drawings moved) : moved_{moved} {}
    [[nodiscard]] bool may_meet(const Fragment& a, const Fragment& b) const {
        return may_meet(codes_behind(a.code, b.code), [&](const OtherList& drawing) -> std::optional<std::int64_t> {
            const Fragment *const x = same_triangle(a, drawing), *const y = same_triangle(b, drawing);
            if (x == nullptr || y == nullptr) return std::nullopt;
            return codes_behind(x->code, y->code);
        });
    }
    [[nodiscard]] bool may_meet(const Fragment& a, std::uint32_t opaque) const {
        return may_meet(codes_behind(a.code, opaque), [&](const OtherList& drawing) -> std::optional<std::int64_t> {
            const Fragment* const x = same_triangle(a, drawing);
            if (x == nullptr || !drawing.has_opaque) return std::nullopt;
            return codes_behind(x->code, drawing.opaque);
        });
    }

  private:
    template <class Between>
    [[nodiscard]] bool may_meet(std::int64_t given, Between between) const {
        constexpr std::int64_t rounded = 2;  // codes
        return given != 0 && std::ranges::any_of(moved_, [&](const OtherList* drawing) {
                   const auto other = between(*drawing);
                   return other && std::abs(given) <= std::abs(*other - given) + rounded;
               });
    }
    Drawings moved_;
};

// Adds copies of the list in which neighbours with such depths are exchanged: each pair alone, then all pairs starting
// at an even index, and all starting at an odd one.
void add_exchanged(const OtherList& given, const Meetings& meetings, std::vector<OtherList>& others) {
    const std::size_t n = given.visible.size();
    const auto exchanged = [&](std::size_t first, std::size_t last, std::size_t step) {
        OtherList made = given;
        bool is_changed = false;
        for (std::size_t i = first; i + 1 < std::min(n, last); i += step) {
            Fragment &a = made.visible[i], &b = made.visible[i + 1];
            if (!meetings.may_meet(a, b)) continue;
            std::swap(a.code, b.code);
            std::swap(a.shader_z, b.shader_z);
            std::swap(a, b);
            is_changed = true;
        }
        if (is_changed && others.size() < most_others) others.push_back(std::move(made));
    };
    for (std::size_t i = 0; i + 1 < n; ++i) exchanged(i, i + 2, 1);
    if (n > 3)
        for (const std::size_t first : {std::size_t{0}, std::size_t{1}}) exchanged(first, n, 2);
}

// Adds copies with the farthest visible fragment hidden, or the nearest hidden one visible, if its depth may change its
// order with the opaque surface.
void add_at_opaque(const OtherList& given, const Meetings& meetings, std::vector<OtherList>& others) {
    if (!given.has_opaque) return;
    if (!given.visible.empty() && meetings.may_meet(given.visible.back(), given.opaque)) {
        others.push_back(given);
        others.back().hidden.insert(others.back().hidden.begin(), given.visible.back());
        others.back().visible.pop_back();
    }
    if (!given.hidden.empty() && meetings.may_meet(given.hidden.front(), given.opaque)) {
        others.push_back(given);
        others.back().visible.push_back(given.hidden.front());
        others.back().hidden.erase(others.back().hidden.begin());
    }
}

bool has_same_triangles(const std::vector<Fragment>& a, const std::vector<Fragment>& b) {
    return std::ranges::equal(a, b, {}, &Fragment::primitive, &Fragment::primitive);
}

// Combines the renderings of one pixel, the given one first, into its possible lists.
class EdgeMaker {
  public:
    explicit EdgeMaker(std::vector<const OtherList*> drawings) : drawings_{std::move(drawings)} {}

    [[nodiscard]] EdgePixel make() {
        EdgePixel edge;
        if (std::ranges::any_of(drawings_, [&](const OtherList* d) { return !is_covered_alike(*d, given()); })) {
            find_surfaces();
            find_clusters();
            std::vector<Fragment> chosen;
            combine(0, chosen, edge.others);
            make_ties(edge);
        }
        const Meetings meetings{Drawings{drawings_}.subspan(tie_drawings)};
        add_exchanged(given(), meetings, edge.others);
        add_at_opaque(given(), meetings, edge.others);
        return edge;
    }

  private:
    [[nodiscard]] const OtherList& given() const { return *drawings_[0]; }

    // The fragment of the given rendering, if it has one; else the moved one, with a slack for the change by the
    // movement.
    [[nodiscard]] Fragment told(const Fragment& f) const {
        if (const Fragment* const own = same_triangle(f, given())) return *own;
        Fragment moved = f;
        moved.slack = 1.0f / 255;
        for (const OtherList* drawing : drawings_)
            if (const Fragment* const other = like(f, *drawing))
                moved.slack = std::max(moved.slack, most_apart(f.color, other->color));
        return moved;
    }

    void find_surfaces() {
        for (const OtherList* drawing : drawings_) {
            const bool is_there = std::ranges::any_of(surfaces_, [&](const OtherList* s) {
                return s->has_opaque == drawing->has_opaque && s->behind == drawing->behind;
            });
            if (!is_there && surfaces_.size() < 3) surfaces_.push_back(drawing);
        }
    }

    void find_clusters() {
        std::map<Cluster, std::vector<std::vector<Fragment>>> found;
        for (const OtherList* drawing : drawings_)
            for (auto& [cluster, fragments] : clusters_of(*drawing)) found[cluster];
        for (const OtherList* drawing : drawings_) {
            auto clusters = clusters_of(*drawing);
            for (auto& [cluster, sets] : found) {
                std::vector<Fragment> own = std::move(clusters[cluster]);
                std::ranges::sort(own, {}, &Fragment::primitive);
                if (std::ranges::none_of(sets, [&](const auto& set) { return has_same_triangles(set, own); }))
                    sets.push_back(std::move(own));
            }
        }
        for (auto& [cluster, sets] : found) sets_.push_back(std::move(sets));
    }

    void combine(std::size_t cluster, std::vector<Fragment>& chosen, std::vector<OtherList>& others) const {
        if (others.size() >= most_others) return;
        if (cluster == sets_.size()) {
            for (const OtherList* surface : surfaces_) {
                OtherList made = list_of(chosen, *surface);
                if (!is_covered_alike(made, given()) || made.behind != given().behind)
                    others.push_back(std::move(made));
            }
            return;
        }
        for (const std::vector<Fragment>& set : sets_[cluster]) {
            chosen.insert(chosen.end(), set.begin(), set.end());
            combine(cluster + 1, chosen, others);
            chosen.resize(chosen.size() - set.size());
        }
    }

    [[nodiscard]] OtherList list_of(const std::vector<Fragment>& fragments, const OtherList& surface) const {
        OtherList list{.behind = surface.behind,
                       .behind_spread = given().behind_spread,
                       .opaque = surface.opaque,
                       .has_opaque = surface.has_opaque};
        for (const Fragment& f : fragments) {
            const Fragment own = told(f);
            (own.code < list.opaque ? list.visible : list.hidden).push_back(own);
        }
        for (auto* part : {&list.visible, &list.hidden})
            std::ranges::sort(*part, {}, [](const Fragment& f) { return std::pair{f.code, f.primitive}; });
        return list;
    }

    // Sets the list of all triangles that some tie rule draws at the pixel centre, and the list of those that every tie
    // rule draws.
    void make_ties(EdgePixel& edge) const {
        std::map<std::uint32_t, std::size_t> times;
        std::vector<Fragment> twice, never;
        for (std::size_t d = 0; d < tie_drawings; ++d)
            for (const auto* part : {&drawings_[d]->visible, &drawings_[d]->hidden})
                for (const Fragment& f : *part)
                    if (++times[f.primitive] == 1) twice.push_back(f);
        for (const Fragment& f : twice)
            if (times[f.primitive] == tie_drawings) never.push_back(f);
        edge.has_centre_on_edge = never.size() != twice.size();
        edge.twice = list_of(twice, given());
        edge.never = list_of(never, given());
        // The centre is exactly on the edge, so colours have no error.
        for (OtherList* list : {&edge.twice, &edge.never})
            for (auto* part : {&list->visible, &list->hidden})
                for (Fragment& f : *part) f.slack = 0;
    }

    std::vector<const OtherList*> drawings_;
    std::vector<const OtherList*> surfaces_{};
    std::vector<std::vector<std::vector<Fragment>>> sets_{};  // per cluster
};

}  // namespace

namespace {

// The renderings of some rows: by every tie rule, then moved.
class EightDrawings {
  public:
    EightDrawings(const RunInput& input, const SceneFragments& given, const Rows& rows) : given_{given} {
        constexpr std::uint64_t bytes = std::uint64_t{1} << 30;
        using rasterizer::TieRule;
        for (const TieRule rule :
             {TieRule::top_left, TieRule::top_right, TieRule::bottom_left, TieRule::bottom_right}) {
            if (rule == input.profile.raster.tie_rule) continue;
            pipeline::DeviceProfile& profile = profiles_.emplace_back(input.profile);
            profile.raster.tie_rule = rule;
            others_.emplace_back(RunInput{input.list, input.view, profile, input.options}, bytes, rows);
        }
        for (const double right : {moved_by, -moved_by})
            for (const double up : {moved_by, -moved_by}) {
                peeling::RenderOptions options = input.options;
                options.vertex_alteration =
                    &changes_.emplace_back(moved(right, up, input.options.width, input.options.height));
                others_.emplace_back(RunInput{input.list, input.view, input.profile, options}, bytes, rows);
            }
    }

    // The lists of a pixel, the given rendering's first. They are valid until the next call.
    [[nodiscard]] std::span<OtherList> at(int x, int memory_row) {
        lists_.clear();
        lists_.push_back(copy_of(given_.list_at(x, memory_row)));
        for (const SceneFragments& other : others_) lists_.push_back(copy_of(other.list_at(x, memory_row)));
        return lists_;
    }

    // True if no rendering has a fragment there, and all have the same surface behind it.
    [[nodiscard]] bool is_plain(int x, int memory_row) const {
        const PixelList given = given_.list_at(x, memory_row);
        return is_blank(given) && std::ranges::all_of(others_, [&](const SceneFragments& other) {
                   const PixelList list = other.list_at(x, memory_row);
                   return is_blank(list) && list.has_opaque == given.has_opaque && list.opaque == given.opaque &&
                          list.behind == given.behind;
               });
    }

  private:
    const SceneFragments& given_;
    // The renderings refer to these.
    std::deque<pipeline::DeviceProfile> profiles_{};
    std::deque<pipeline::VertexAlteration> changes_{};
    std::deque<SceneFragments> others_{};
    std::vector<OtherList> lists_{};
};

// Bands of rows whose eight renderings take about as much memory as a quarter of the picture's bound.
std::vector<Rows> bands_of(const SceneFragments& scene) {
    constexpr std::uint64_t drawings = 8, least = std::uint64_t{24} << 20, bytes_a_pixel = 24, of_pixel = 28;
    constexpr int step = 64;  // rows of a tile
    const auto width = static_cast<std::uint64_t>(scene.width());
    const std::uint64_t most = std::max(least, bytes_a_pixel * width * static_cast<std::uint64_t>(scene.height()));
    const std::vector<std::uint64_t> bytes = scene.bytes_of_rows();
    std::vector<Rows> bands{{0, 0}};
    std::uint64_t sum = 0;
    for (int y = 0; y < scene.height(); y += step) {
        const int end = std::min(y + step, scene.height());
        std::uint64_t more = 0;
        for (int row = y; row < end; ++row)
            more += drawings * (bytes[static_cast<std::size_t>(row)] + of_pixel * width);
        if (sum + more > most && bands.back().end > bands.back().first) {
            bands.push_back({y, y});
            sum = 0;
        }
        sum += more;
        bands.back().end = end;
    }
    return bands;
}

}  // namespace

Coverages::Coverages(const RunInput& input, const SceneFragments& given, const TakeSpreads& take)
    : width_{given.width()} {
    number_.assign(static_cast<std::size_t>(given.width()) * static_cast<std::size_t>(given.height()), 0);
    for (const Rows& rows : bands_of(given)) {
        EightDrawings drawings{input, given, rows};
        for (int row = rows.first; row < rows.end; ++row)
            for (int x = 0; x < given.width(); ++x) {
                if (drawings.is_plain(x, row)) continue;
                add(given.list_at(x, row), row, drawings.at(x, row), take);
            }
    }
}

void Coverages::add(const PixelList& pixel, int memory_row, std::span<OtherList> lists, const TakeSpreads& take) {
    std::vector<const OtherList*> of_pixel;
    for (const OtherList& list : lists) of_pixel.push_back(&list);
    find_spreads(lists[0], Drawings{of_pixel}.subspan(tie_drawings));
    std::vector<float> spreads;
    for (const auto* part : {&lists[0].visible, &lists[0].hidden})
        for (const Fragment& f : *part) spreads.push_back(f.spread);
    if (!spreads.empty()) take(pixel.x, memory_row, spreads);
    const std::size_t at = index(pixel.x, pixel.y);
    if (lists[0].behind_spread > 0) {
        behind_spreads_.resize(number_.size());
        behind_spreads_[at] = lists[0].behind_spread;
    }
    EdgePixel edge = EdgeMaker{std::move(of_pixel)}.make();
    if (edge.others.empty() && !edge.has_centre_on_edge) return;
    pixels_.push_back(std::move(edge));
    number_[at] = static_cast<std::uint32_t>(pixels_.size());
}

const EdgePixel* Coverages::at(int x, int y) const noexcept {
    const std::uint32_t number =
        number_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
    return number == 0 ? nullptr : &pixels_[number - 1];
}

}  // namespace strata::oracle::verdict
