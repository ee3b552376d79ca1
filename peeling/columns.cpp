#include "peeling/columns.h"

#include <algorithm>

#include "peeling/programs.h"
#include "pipeline/arena.h"
#include "pipeline/lane_mask.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

constexpr std::size_t slot_bytes = 4 + 2 + 4 * sizeof(float);
constexpr std::size_t cached_bytes = std::size_t{768} << 10;  // of one band: what a second-level cache holds beside the targets
// What the fragments of small triangles fit into: cheaper to keep than to rasterize twice.
constexpr std::size_t remembered_bytes = std::size_t{1} << 20;
constexpr std::uint32_t most_arrivals = 0xffff;               // `order` is 16 bits wide

[[nodiscard]] std::size_t blocks_of(std::size_t pixels) noexcept { return (pixels + block_lanes - 1) / block_lanes; }

// How much these pixels take, the first of them a block's first.
[[nodiscard]] std::size_t slots_of(std::span<const std::uint32_t> coverage) noexcept {
    std::size_t slots = 0;
    for (std::size_t first = 0; first < coverage.size(); first += block_lanes) {
        const auto block = coverage.subspan(first, std::min(block_lanes, coverage.size() - first));
        slots += block_lanes * *std::max_element(block.begin(), block.end());
    }
    return slots;
}

class Bands {
  public:
    Bands(Region& region, const std::function<void(const Columns&)>& body)
        : region_{region}, body_{body}, coverage_{region.arena().take<std::uint32_t>(region.rect().area())},
          bytes_{region.frame().replay.bytes}, by_shader_z_{region.frame().key == DepthKey::shader_z} {
        std::ranges::fill(coverage_, 0u);
        const std::uint64_t limit = std::min<std::uint64_t>(remembered_bytes, region.frame().replay.bytes / 2);
        remembers_ = region.remember(needs(), limit);
        if (remembers_) bytes_ -= limit;
        region.count_coverage(coverage_);
    }

    // False: a single row is too much.
    [[nodiscard]] bool plan() {
        if (std::ranges::any_of(coverage_, [](std::uint32_t n) { return n > most_arrivals; })) return false;
        const rasterizer::Rect rect = region_.rect();
        const std::uint64_t band_bytes = remembers_ ? bytes_ : std::min<std::uint64_t>(bytes_, cached_bytes);
        std::size_t slots = 0;
        int begin = rect.y0;
        for (int y = rect.y0; y < rect.y1; ++y) {
            const std::size_t row = slots_of_row(y);
            if (row * slot_bytes > bytes_) return false;
            if (y > begin && (slots + row) * slot_bytes > band_bytes) {
                bands_.push_back({rect.x0, begin, rect.x1, y});
                begin = y;
                slots = 0;
            }
            slots += row;
            most_slots_ = std::max(most_slots_, slots);
        }
        bands_.push_back({rect.x0, begin, rect.x1, rect.y1});
        return true;
    }

    RegionFragments run() {
        take_memory();
        RegionFragments fragments;
        for (const rasterizer::Rect& band : bands_) {
            open(band);
            place(fragments);
            for (std::size_t b = 0; b < columns_.blocks.size(); ++b) sort(b);
            body_(columns_);
        }
        return fragments;
    }

  private:
    [[nodiscard]] rasterizer::FragmentNeeds needs() const noexcept {
        return {by_shader_z_, !by_shader_z_, false, true, false, false};
    }

    [[nodiscard]] std::span<const std::uint32_t> rows(int begin, int end) const {
        const rasterizer::Rect rect = region_.rect();
        const auto width = static_cast<std::size_t>(rect.width());
        return coverage_.subspan(static_cast<std::size_t>(begin - rect.y0) * width,
                                 static_cast<std::size_t>(end - begin) * width);
    }

    // At most; blocks that reach from one row into the next are as deep as the deeper of the two.
    [[nodiscard]] std::size_t slots_of_row(int y) const {
        const auto row = rows(y, y + 1);
        if (row.size() % block_lanes == 0) return slots_of(row);
        return (blocks_of(row.size()) + 1) * block_lanes * *std::ranges::max_element(row);
    }

    void take_memory() {
        Arena& arena = region_.arena();
        const std::size_t blocks = blocks_of(region_.rect().area());
        all_.blocks = arena.take<ColumnBlock>(blocks);
        for (auto* const pixels : {&all_.visible, &all_.alive, &all_.at_surface})
            *pixels = arena.take<std::uint32_t>(blocks * block_lanes);
        next_ = arena.take<std::uint32_t>(blocks * block_lanes);
        all_.key = arena.take<std::uint32_t>(most_slots_);
        all_.order = arena.take<std::uint16_t>(most_slots_);
        for (auto& channel : all_.color) channel = arena.take<float>(most_slots_);
        std::uint32_t deepest = 0;
        for (const std::uint32_t n : coverage_) deepest = std::max(deepest, n);
        sorting_ = arena.take<std::uint64_t>(std::size_t{deepest} * block_lanes);
    }

    void open(const rasterizer::Rect& band) {
        columns_ = all_;
        columns_.band = band;
        columns_.blocks = all_.blocks.first(blocks_of(band.area()));
        const auto coverage = rows(band.y0, band.y1);
        std::size_t slots = 0;
        for (std::size_t b = 0; b < columns_.blocks.size(); ++b) {
            columns_.blocks[b] = {slots, 0, false};
            slots += slots_of(coverage.subspan(b * block_lanes, std::min(block_lanes, coverage.size() - b * block_lanes)));
        }
        for (auto* const pixels : {&columns_.visible, &columns_.alive, &columns_.at_surface}) {
            *pixels = pixels->first(columns_.blocks.size() * block_lanes);
            std::ranges::fill(*pixels, 0u);
        }
        for (std::size_t pixel = 0; pixel < columns_.visible.size(); ++pixel)
            next_[pixel] = static_cast<std::uint32_t>(columns_.slot(pixel, 0));
    }

    void place(RegionFragments& fragments) {
        const std::size_t first = static_cast<std::size_t>(columns_.band.y0 - region_.rect().y0) *
                                  static_cast<std::size_t>(region_.rect().width());
        opaque_ = region_.storage(region_.opaque_depth()).depth(0) + first;
        region_.look(needs(), columns_.band, [&](const FragmentBatch& in, const Loads&, Outputs& out) {
            fragments.rasterized += lanes(in);
            Lanes<std::uint32_t> key, is_visible;
            if (by_shader_z_) key_of_shader_z(in, opaque_, key, is_visible);
            else key_of_code(in, opaque_, key, is_visible);
            for (std::size_t i = 0; i < lanes(in);) {
                if (place_row(in, i, key, is_visible, out.alive)) {
                    i += block_lanes;
                    continue;
                }
                fragments.masked += out.alive[i] == 0 ? 1 : 0;
                if (out.alive[i] != 0) place_one(in, i, key[i], is_visible[i] != 0);
                ++i;
            }
        });
    }

    void place_one(const FragmentBatch& in, std::size_t i, std::uint32_t key, bool is_visible) {
        const std::uint32_t pixel = in.pixel[i];
        ++columns_.alive[pixel];
        if (!is_visible) {
            columns_.at_surface[pixel] += !by_shader_z_ && key == opaque_[pixel] ? 1 : 0;
            return;
        }
        const std::size_t slot = next_[pixel];
        next_[pixel] += block_lanes;
        columns_.key[slot] = key;
        for (std::size_t c = 0; c < 4; ++c) columns_.color[c][slot] = in.color[c][i];
    }

    // A whole row of a block at once, where the fragments from `i` on are its sixteen pixels and each is visible and its column's
    // k-th: what large triangles mostly bring.
    [[nodiscard]] bool place_row(const FragmentBatch& in, std::size_t i, const Lanes<std::uint32_t>& key,
                                 const Lanes<std::uint32_t>& is_visible, const Lanes<std::uint32_t>& alive) {
        const std::uint32_t pixel = in.pixel[i];
        if (pixel % block_lanes != 0 || i + block_lanes > lanes(in) || in.pixel[i + block_lanes - 1] != pixel + block_lanes - 1)
            return false;
        std::uint32_t* const next = &next_[pixel];
        const std::uint32_t slot = next[0];
        std::uint32_t all = ~0u, other = 0;
        for (std::size_t lane = 0; lane < block_lanes; ++lane) {
            all &= is_visible[i + lane] & alive[i + lane];
            other |= (next[lane] - slot - static_cast<std::uint32_t>(lane)) | (in.pixel[i + lane] - pixel - static_cast<std::uint32_t>(lane));
        }
        if (all == 0 || other != 0) return false;
        std::copy_n(&key[i], block_lanes, &columns_.key[slot]);
        for (std::size_t c = 0; c < 4; ++c) std::copy_n(&in.color[c][i], block_lanes, &columns_.color[c][slot]);
        for (std::size_t lane = 0; lane < block_lanes; ++lane) {
            next[lane] += block_lanes;
            ++columns_.alive[pixel + lane];
        }
        return true;
    }

    static void key_of_shader_z(const FragmentBatch& in, const std::uint32_t* opaque, Lanes<std::uint32_t>& key,
                                Lanes<std::uint32_t>& is_visible) noexcept {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            key[i] = ordered_code(in.shader_z[i]);
            is_visible[i] = in.shader_z[i] < std::bit_cast<float>(opaque[in.pixel[i]]) ? ~0u : 0u;
        }
    }
    static void key_of_code(const FragmentBatch& in, const std::uint32_t* opaque, Lanes<std::uint32_t>& key,
                            Lanes<std::uint32_t>& is_visible) noexcept {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            key[i] = in.code[i];
            is_visible[i] = in.code[i] < opaque[in.pixel[i]] ? ~0u : 0u;
        }
    }

    // The arrival in the low half makes every value of a column different, and the sort stable.
    void sort(std::size_t b) {
        ColumnBlock& block = columns_.blocks[b];
        std::uint32_t* const visible = &columns_.visible[b * block_lanes];
        for (std::size_t lane = 0; lane < block_lanes; ++lane)
            visible[lane] = static_cast<std::uint32_t>((next_[b * block_lanes + lane] - block.first) / block_lanes);
        block.depth = *std::max_element(visible, visible + block_lanes);
        std::uint32_t* const key = columns_.key.data() + block.first;
        for (std::uint32_t k = 0; k < block.depth; ++k)
            for (std::size_t lane = 0; lane < block_lanes; ++lane) {
                const std::size_t i = k * block_lanes + lane;
                const std::uint64_t beyond = k < visible[lane] ? 0 : ~std::uint64_t{0};
                sorting_[i] = (std::uint64_t{key[i]} << 32 | k) | beyond;
            }
        sort_columns(sorting_.data(), block.depth);
        std::uint16_t* const order = columns_.order.data() + block.first;
        std::uint32_t ties = 0;
        for (std::size_t i = 0; i < block.depth * block_lanes; ++i) {
            key[i] = static_cast<std::uint32_t>(sorting_[i] >> 32);
            order[i] = static_cast<std::uint16_t>(sorting_[i]);
        }
        for (std::size_t i = block_lanes; i < block.depth * block_lanes; ++i)
            ties |= pipeline::mask(key[i] == key[i - block_lanes]) & pipeline::mask(key[i] != ~0u);
        block.has_ties = ties != 0;
    }

    Region& region_;
    const std::function<void(const Columns&)>& body_;
    std::span<std::uint32_t> coverage_;
    std::uint64_t bytes_;  // for columns: what the kept fragments leave of the region's share
    bool by_shader_z_, remembers_ = false;
    const std::uint32_t* opaque_ = nullptr;  // of the present band
    std::vector<rasterizer::Rect> bands_;
    std::size_t most_slots_ = 0;
    Columns all_, columns_;  // the memory, and the part of it that the present band uses
    std::span<std::uint32_t> next_;  // by pixel of the band: the slot of its next arrival
    std::span<std::uint64_t> sorting_;
};

}  // namespace

std::optional<RegionFragments> for_each_band(Region& region, const std::function<void(const Columns&)>& body) {
    Bands bands{region, body};
    if (!bands.plan()) return std::nullopt;
    return bands.run();
}

}  // namespace strata::peeling
