// source/own_algorithm.cpp - an algorithm that is a Python function of the whole frame: it gets the visible fragments
// as arrays and returns the colours.
#include <strata/pipeline/region/region.h>
#include <strata/pipeline/region/region_shortcuts.h>

#include <algorithm>
#include <exception>
#include <iterator>

#include "bindings.h"

namespace strata::python {

namespace {

using pipeline::Region;
using pipeline::Target;

// The fragments in front of the opaque surfaces, in submission order.
std::vector<CapturedFragment> visible_fragments(Region& region) {
    std::vector<CapturedFragment> all = pipeline::RegionShortcuts{region}.capture(pipeline::Counting::counted);
    const std::uint32_t* const opaque = region.storage(region.opaque_depth()).depth(0);
    const auto area = static_cast<std::uint32_t>(region.rect().area());
    std::erase_if(all, [&](const CapturedFragment& f) { return f.code >= opaque[f.sample * area + f.pixel]; });
    return all;
}

// Copies a member of each fragment, with `channels` elements, to an array.
template <class Element, class Values>
py::array column(const std::vector<CapturedFragment>& fragments, std::vector<py::ssize_t> shape, Values values) {
    py::array_t<Element> array(std::move(shape));
    Element* to = array.mutable_data();
    for (const CapturedFragment& f : fragments) to = values(f, to);
    return std::move(array);
}

py::dict arrays_of(const std::vector<CapturedFragment>& fragments) {
    const auto count = static_cast<py::ssize_t>(fragments.size());
    const auto member = [](auto of) {
        return [of](const CapturedFragment& f, auto* to) {
            *to = of(f);
            return to + 1;
        };
    };
    py::dict arrays;
    arrays["pixel"] = column<std::uint32_t>(fragments, {count}, member([](const auto& f) { return f.pixel; }));
    arrays["primitive"] = column<std::uint32_t>(fragments, {count}, member([](const auto& f) { return f.primitive; }));
    arrays["code"] = column<std::uint32_t>(fragments, {count}, member([](const auto& f) { return f.code; }));
    arrays["z"] = column<float>(fragments, {count}, member([](const auto& f) { return f.shader_z; }));
    arrays["color"] = column<float>(fragments, {count, 4}, [](const CapturedFragment& f, float* to) {
        for (std::size_t c = 0; c < 4; ++c) *to++ = f.color[c];
        return to;
    });
    return arrays;
}

using Colors = py::array_t<float, py::array::c_style | py::array::forcecast>;

Colors colors_behind(Region& region, std::uint32_t sample, int width, int height) {
    Colors colors({height, width, 4});
    float* to = colors.mutable_data();
    const auto area = static_cast<std::uint32_t>(region.rect().area());
    for (std::uint32_t pixel = 0; pixel < area; ++pixel) {
        const Rgba color = region.targets().color(region.opaque_color(), sample * area + pixel);
        for (std::size_t c = 0; c < 4; ++c) *to++ = color[c];
    }
    return colors;
}

// Called with the interpreter's lock, for each sample of the pixels.
Colors called(Region& region, const py::function& body, std::uint32_t sample,
              const std::vector<CapturedFragment>& fragments) {
    const int width = region.rect().width(), height = region.rect().height();
    std::vector<CapturedFragment> own;
    std::ranges::copy_if(fragments, std::back_inserter(own), [&](const auto& f) { return f.sample == sample; });
    const auto colors =
        Colors::ensure(body(width, height, arrays_of(own), colors_behind(region, sample, width, height)));
    if (!colors || colors.ndim() != 3 || colors.shape(0) != height || colors.shape(1) != width || colors.shape(2) != 4)
        throw InputError("algorithm", "result", "an array of shape (height, width, 4)", "another value");
    return colors;
}

void run(Region& region, const py::function& body, std::exception_ptr& failed) {
    const Target result = region.make(region.frame().picture_format());
    region.set_name(result, "result");
    region.begin_iteration();
    pipeline::copy_color(region, region.opaque_color(), result);
    const std::vector<CapturedFragment> fragments = visible_fragments(region);
    {
        const py::gil_scoped_acquire lock;
        try {
            const auto area = static_cast<std::uint32_t>(region.rect().area());
            for (std::uint32_t sample = 0; sample * area < region.elements(); ++sample) {
                const Colors colors = called(region, body, sample, fragments);
                const float* c = colors.data();
                for (std::uint32_t pixel = 0; pixel < area; ++pixel, c += 4)
                    pipeline::RegionShortcuts{region}.store_pixel(result, sample * area + pixel,
                                                                  {c[0], c[1], c[2], c[3]});
            }
        } catch (...) {
            failed = std::current_exception();
        }
    }
    region.publish(result);
}

}  // namespace

void bind_own_algorithm(py::module_& module) {
    module.def("_render_own", [](const Scene& scene, const py::function& body, const std::string& name,
                                 const std::string& profile_name, const py::kwargs& keywords) {
        DeviceProfile profile = strata::profile(profile_name);
        const RenderOptions options = options_of_keywords(keywords, profile);
        std::exception_ptr failed;
        const auto result = [&] {
            const Algorithm own = own_algorithm(
                name, [&](Region& region) { run(region, body, failed); }, true);
            return unlocked([&] { return render(scene, own, profile, options); });
        }();
        if (failed) std::rethrow_exception(failed);
        return result;
    });
}

}  // namespace strata::python
