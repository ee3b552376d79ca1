#include "tools/oracle/fragments/edge_lists.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "tools/oracle/fragments/near_depths.h"

namespace strata::oracle::verdict {

namespace {

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

bool has_same_triangles(const std::vector<Fragment>& a, const std::vector<Fragment>& b) {
    return std::ranges::equal(a, b, {}, &Fragment::primitive, &Fragment::primitive);
}

// Combines the renderings of one pixel, the given one first, into its possible lists.
class EdgeMaker {
  public:
    explicit EdgeMaker(Drawings drawings) : drawings_{drawings} {}

    [[nodiscard]] EdgePixel make() {
        EdgePixel edge;
        add_close_depths(given(), edge.others);
        if (std::ranges::any_of(drawings_, [&](const OtherList* d) { return !is_covered_alike(*d, given()); })) {
            find_surfaces();
            find_clusters();
            std::vector<Fragment> chosen;
            combine(0, chosen, edge.others);
            make_ties(edge);
        }
        for (OtherList& other : edge.others)
            if (!other.has_close_depths) other.directions = directions_of(other);
        add_near_depths(given(), drawings_.subspan(tie_drawings), edge.others);
        return edge;
    }

  private:
    [[nodiscard]] const OtherList& given() const { return *drawings_[0]; }

    // The moved renderings with this coverage, one bit each.
    [[nodiscard]] std::uint8_t directions_of(const OtherList& other) const {
        unsigned bits = 0;
        for (std::size_t d = tie_drawings; d < drawings_.size(); ++d)
            if (is_covered_alike(other, *drawings_[d])) bits |= 1u << (d - tie_drawings);
        return static_cast<std::uint8_t>(bits);
    }

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

    Drawings drawings_;
    std::vector<const OtherList*> surfaces_{};
    std::vector<std::vector<std::vector<Fragment>>> sets_{};  // per cluster
};

}  // namespace

const Fragment* same_triangle(const Fragment& f, const OtherList& drawing) {
    for (const auto* part : {&drawing.visible, &drawing.hidden})
        for (const Fragment& other : *part)
            if (other.primitive == f.primitive) return &other;
    return nullptr;
}

void find_spreads(OtherList& given, Drawings moved) {
    for (auto* part : {&given.visible, &given.hidden})
        for (Fragment& f : *part) find_spread(f, moved);
    for (const OtherList* drawing : moved)
        if (given.has_opaque && drawing->has_opaque)
            given.behind_spread = std::max(given.behind_spread, most_apart(given.behind, drawing->behind));
}

EdgePixel edge_pixel_of(Drawings drawings) { return EdgeMaker{drawings}.make(); }

}  // namespace strata::oracle::verdict
