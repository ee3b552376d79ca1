// tools/oracle/reduce/reduce.cpp - removes triangles, rows, columns and state while the candidate's picture still
// differs in the same kind (reduce.h).
#include "tools/oracle/reduce/reduce.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "peeling/render.h"
#include "pipeline/device/check.h"
#include "rasterizer/base/input_error.h"
#include "tools/oracle/reduce/cut_scene.h"
#include "tools/oracle/reduce/defaults.h"

namespace strata::oracle {

namespace {

using rasterizer::Rect;

constexpr std::size_t most_pixels = 8;  // limit on pixels around which windows are tried
constexpr int largest_window = 64;      // in pixels, per side

// Only tolerances of codes, which apply in any frame.
Tolerances without_budgets(Tolerances tolerances) {
    for (PixelBudget* budget : {&tolerances.coverage, &tolerances.background, &tolerances.layers, &tolerances.depth,
                                &tolerances.color, &tolerances.pixels})
        *budget = {};
    return tolerances;
}

// Keeps only the window's pixels of every target.
void keep(Picture& picture, const Rect& window) {
    for (TargetImage& target : picture.targets) {
        const auto channels = static_cast<std::size_t>(target.channels);
        const std::size_t row = static_cast<std::size_t>(target.width) * channels,
                          kept = static_cast<std::size_t>(window.width()) * channels;
        std::vector<std::uint32_t> codes;
        for (int y = window.y0; y < window.y1; ++y) {
            const std::size_t first =
                static_cast<std::size_t>(y) * row + static_cast<std::size_t>(window.x0) * channels;
            codes.insert(codes.end(), target.codes.begin() + static_cast<std::ptrdiff_t>(first),
                         target.codes.begin() + static_cast<std::ptrdiff_t>(first + kept));
        }
        target.codes = std::move(codes);
        target.width = window.width();
        target.height = window.height();
    }
}

// Removes the names of --only that the scene no longer has; without one, the offset moves nothing.
void forget_names(Golden& scene) {
    peeling::RenderOptions& options = scene.options;
    if (options.offset_only.empty()) return;
    const pipeline::DrawList& list = scene.scene.list;
    std::erase_if(options.offset_only, [&](const std::string& name) {
        return std::ranges::none_of(list.instances, [&](const auto& i) { return has_name(list, i, name); });
    });
    if (options.offset_only.empty()) options.raster.polygon_offset = {};
}

// A scene of the search: triangles by their indices in the whole scene, and a window of the whole frame.
struct Cut {
    std::vector<TriangleName> triangles{};
    Rect window{};
};

class Reducer {
  public:
    Reducer(const Golden& scene, const Candidate& candidate, const std::function<void(const Golden&)>& on_run,
            const ReduceRules& rules)
        : whole_{scene}, candidate_{candidate}, on_run_{on_run}, frame_{rules.frame}, tolerances_{rules.tolerances} {
        whole_.options.audit = whole_.options.keep_layers = whole_.options.nearest_depth = false;
        best_ = {triangles_of(whole_.scene.list), {0, 0, whole_.options.width, whole_.options.height}};
        if (frame_ == FrameExtent::whole && whole_.options.raster.scissor)
            best_.window = intersection(best_.window, *whole_.options.raster.scissor);
    }

    [[nodiscard]] std::optional<Reduction> run() {
        Reduction result;
        result.triangles_before = best_.triangles.size();
        result.width_before = whole_.options.width;
        result.height_before = whole_.options.height;
        const auto drawn = comparison_of(whole_, best_.window);
        if (!drawn) throw InputError("candidate", "picture", "a picture of the scene's size", "no such picture");
        if (drawn->accepted) return std::nullopt;
        const auto most = std::ranges::max_element(drawn->kinds, {}, &KindReport::beyond);
        result.kind = kind_ = most->kind;
        tolerances_ = without_budgets(tolerances_);
        find_window(*drawn);
        for (bool is_smaller = true; is_smaller;) {
            is_smaller = leave_out_triangles();
            is_smaller |= cut_frame();
            is_smaller |= take_defaults(result.defaults);
        }
        result.scene = scene_of(best_);
        result.triangles = best_.triangles.size();
        result.window =
            frame_ == FrameExtent::whole ? best_.window : Rect{0, 0, best_.window.width(), best_.window.height()};
        result.comparison = *difference(best_);
        result.runs = runs_;
        result.undrawn = undrawn_;
        return result;
    }

  private:
    [[nodiscard]] Golden scene_of(const Cut& cut) const {
        Golden scene = whole_;
        scene.scene.list = oracle::cut(whole_.scene.list, cut.triangles);
        forget_names(scene);
        auto& scissor = scene.options.raster.scissor;
        const Rect frame{0, 0, whole_.options.width, whole_.options.height};
        if (frame_ == FrameExtent::whole) {
            scissor = cut.window == frame ? std::nullopt : std::optional(cut.window);
            return scene;
        }
        scene.scene.own_view = through(*whole_.scene.own_view, frame.x1, frame.y1, cut.window);
        scene.options.width = cut.window.width();
        scene.options.height = cut.window.height();
        if (scissor) scissor = moved(intersection(*scissor, cut.window), cut.window);
        return scene;
    }

    // The rectangle in a frame that begins at the window's corner.
    [[nodiscard]] static Rect moved(const Rect& rect, const Rect& window) {
        return {rect.x0 - window.x0, rect.y0 - window.y0, rect.x1 - window.x0, rect.y1 - window.y0};
    }

    // Empty if the candidate does not draw it.
    [[nodiscard]] std::optional<Comparison> comparison_of(const Golden& scene, const Rect& window) {
        ++runs_;
        if (on_run_) on_run_(scene);
        Picture right = right_picture(scene);
        auto found = candidate_(scene);
        const bool is_drawn = found && !found->targets.empty() && found->targets[0].width == scene.options.width &&
                              found->targets[0].height == scene.options.height;
        if (!is_drawn) {
            ++undrawn_;
            return std::nullopt;
        }
        if (frame_ == FrameExtent::whole)
            for (Picture* picture : {&right, &*found}) keep(*picture, window);
        return compare(right, *found, tolerances_, background_of(scene));
    }

    // Empty if the candidate draws it correctly, wrong in another kind, or not at all.
    [[nodiscard]] std::optional<Comparison> difference(const Cut& cut) {
        try {
            auto comparison = comparison_of(scene_of(cut), cut.window);
            const auto is_failure = [&](const KindReport& found) { return found.kind == kind_ && found.beyond > 0; };
            if (!comparison || std::ranges::none_of(comparison->kinds, is_failure)) return std::nullopt;
            return comparison;
        } catch (const pipeline::Refused&) {
            return std::nullopt;
        }
    }

    [[nodiscard]] bool fails(const Cut& cut) { return !cut.triangles.empty() && difference(cut).has_value(); }

    // The triangles that have a fragment in the window, even if hidden, in their order.
    [[nodiscard]] std::vector<TriangleName> covering(const Rect& window) const {
        Golden scene = scene_of({best_.triangles, window});
        scene.options.alpha = 1.0f;  // so that opaque ones are captured, too
        scene.options.sort = {};
        scene.options.raster.cull = rasterizer::CullFace::none;
        peeling::Renderer renderer{scene.request()};
        std::set<std::uint32_t> numbers;
        for (const pipeline::CapturedFragment& f : renderer.fragments(*scene.algorithms[0]).all)
            numbers.insert(f.primitive);
        std::vector<TriangleName> found;
        for (const std::uint32_t number : numbers) found.push_back(best_.triangles[number]);
        return found;
    }

    // Tries windows around some of the differing pixels, spread over the frame, with the triangles that cover them: the
    // smallest window that fails is used.
    void find_window(const Comparison& comparison) {
        std::vector<std::size_t> differing;
        for (std::size_t i = 0; i < comparison.kind_of.size(); ++i)
            if (comparison.kind_of[i] == kind_ && comparison.is_beyond[i]) differing.push_back(i);
        const std::size_t step = std::max<std::size_t>(1, differing.size() / most_pixels);
        for (int side = 1; side <= largest_window; side *= 2)
            for (std::size_t i = step / 2; i < differing.size(); i += step) {
                const int x = best_.window.x0 + static_cast<int>(differing[i]) % comparison.width,
                          y = best_.window.y0 + static_cast<int>(differing[i]) / comparison.width;
                const Rect around{x - (side - 1) / 2, y - (side - 1) / 2, x + side / 2 + 1, y + side / 2 + 1};
                const Rect window = intersection(around, best_.window);
                Cut tried{{}, window};
                try {
                    tried.triangles = covering(window);
                } catch (const InputError&) {  // more fragments than memory: try a smaller part of the frame
                    continue;
                }
                if (!fails(tried)) continue;
                best_ = std::move(tried);
                return;
            }
    }

    // ddmin: removes chunks of the list, the smaller the fewer can be removed; true if some were.
    [[nodiscard]] bool leave_out_triangles() {
        const std::size_t before = best_.triangles.size();
        for (std::size_t chunk = (before + 1) / 2; chunk >= 1; chunk = chunk == 1 ? 0 : (chunk + 1) / 2)
            for (std::size_t from = 0; from < best_.triangles.size();) {
                Cut tried = best_;
                const auto begin = tried.triangles.begin() + static_cast<std::ptrdiff_t>(from);
                tried.triangles.erase(
                    begin, begin + static_cast<std::ptrdiff_t>(std::min(chunk, tried.triangles.size() - from)));
                if (fails(tried))
                    best_ = std::move(tried);
                else
                    from += chunk;
            }
        return best_.triangles.size() < before;
    }

    // Removes halves of the window, then single rows and columns.
    [[nodiscard]] bool cut_frame() {
        const std::size_t before = best_.window.area();
        for (bool is_smaller = true; is_smaller;) {
            is_smaller = false;
            for (const Rect& part : parts_of(best_.window)) {
                Cut tried{best_.triangles, part};
                if (!fails(tried)) continue;
                best_ = std::move(tried);
                is_smaller = true;
                break;
            }
        }
        return best_.window.area() < before;
    }

    [[nodiscard]] static std::vector<Rect> parts_of(const Rect& w) {
        std::vector<Rect> parts;
        const auto add = [&](const Rect& part) {
            if (part.area() > 0 && part.area() < w.area()) parts.push_back(part);
        };
        const int middle_x = (w.x0 + w.x1) / 2, middle_y = (w.y0 + w.y1) / 2;
        add({w.x0, w.y0, middle_x, w.y1});
        add({middle_x, w.y0, w.x1, w.y1});
        add({w.x0, w.y0, w.x1, middle_y});
        add({w.x0, middle_y, w.x1, w.y1});
        add({w.x0 + 1, w.y0, w.x1, w.y1});
        add({w.x0, w.y0, w.x1 - 1, w.y1});
        add({w.x0, w.y0 + 1, w.x1, w.y1});
        add({w.x0, w.y0, w.x1, w.y1 - 1});
        return parts;
    }

    // Keeps each change with which the scene still fails.
    [[nodiscard]] bool take_defaults(std::vector<std::string>& taken) {
        bool has_changed = false;
        for (const Simplification& simpler : simplifications()) {
            Golden before = whole_;
            if (!simpler.make(whole_)) continue;
            if (fails(best_)) {
                has_changed = true;
                if (std::ranges::find(taken, simpler.name) == taken.end()) taken.emplace_back(simpler.name);
            } else {
                whole_ = std::move(before);
            }
        }
        return has_changed;
    }

    Golden whole_;
    const Candidate& candidate_;
    const std::function<void(const Golden&)>& on_run_;
    FrameExtent frame_;
    Tolerances tolerances_;
    Cut best_;
    Kind kind_ = Kind::none;
    int runs_ = 0, undrawn_ = 0;
};

std::string number_of(std::size_t count, const char* thing) {
    return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

}  // namespace

Picture right_picture(const Golden& scene) {
    peeling::RenderOptions options = scene.options;
    options.audit = options.keep_layers = options.nearest_depth = false;
    peeling::Renderer renderer{scene.request().with(options)};
    peeling::RenderResult result = renderer.render(*scene.algorithms.at(0));
    if (result.outcome == peeling::Outcome::refused) throw pipeline::Refused{scene.profile, *std::move(result.refusal)};
    Picture picture{.file = "", .targets = {as_target(result.frame.color, "color")}};
    picture.targets[0].alpha_form = AlphaForm::premultiplied;
    return picture;
}

Background background_of(const Golden& scene) {
    Golden empty = scene;
    empty.scene.list = cut(scene.scene.list, {});
    empty.options.width = empty.options.height = 1;
    empty.options.raster.scissor.reset();
    const TargetImage color = right_picture(empty).targets[0];
    Background background;
    for (int c = 0; c < color.channels; ++c) background.push_back(color.value_at(0, c));
    return background;
}

std::optional<Reduction> reduce(const Golden& scene, const Candidate& candidate,
                                const std::function<void(const Golden&)>& on_run, const ReduceRules& rules) {
    return Reducer{scene, candidate, on_run, rules}.run();
}

std::string Reduction::description() const {
    const bool is_whole = window == Rect{0, 0, scene.options.width, scene.options.height};
    const bool are_triangles = std::ranges::all_of(scene.scene.list.meshes, [](const pipeline::Mesh& mesh) {
        return mesh.primitive == pipeline::Primitive::triangles;
    });
    const std::string of = is_whole ? "" : fmt::format("{}x{} pixels of ", window.width(), window.height());
    std::string text =
        fmt::format("{} in {}a frame of {}x{} still differ{} in {}: {} of {} in {}x{}, after {} runs",
                    number_of(triangles, are_triangles ? "triangle" : "primitive"), of, scene.options.width,
                    scene.options.height, triangles == 1 ? "s" : "", number_of(comparison.differing, "pixel"),
                    triangles, triangles_before, width_before, height_before, runs);
    const auto first = std::ranges::find(comparison.kinds, kind, &KindReport::kind);
    if (first != comparison.kinds.end())
        text += fmt::format("; the first at {},{} ({})", window.x0 + first->first_x, window.y0 + first->first_y,
                            name(kind));
    if (undrawn > 0) text += "; " + number_of(static_cast<std::size_t>(undrawn), "run") + " drew nothing";
    if (!defaults.empty()) text += "; not needed: " + fmt::format("{}", fmt::join(defaults, ", "));
    return text;
}

}  // namespace strata::oracle
