// source/results.cpp - the Python classes of pictures, layers, passes, fragments, histories and comparisons.
#include <strata/scenes/files/image_io.h>
#include <strata/tools/oracle/compare/drawings.h>

#include "bindings.h"

namespace strata::python {

namespace {

struct Asked {
    Algorithm algorithm;
    DeviceProfile profile;
    RenderOptions options;
    const Multisampling& sampling = options.sampling;
    Asked(const std::string& algorithm_name, const std::string& profile_name, const py::kwargs& keywords)
        : algorithm{strata::algorithm(algorithm_name)},
          profile{strata::profile(profile_name)},
          options{options_of_keywords(keywords, profile)} {}
};

py::dict audit_of(const AuditResult& audit) {
    py::dict all;
    all["layers_max"] = audit.layers_max;
    all["fragments_max"] = audit.fragments_max;
    all["order_errors"] = audit.order_errors;
    all["lost_by_ties"] = audit.lost_by_ties;
    all["hidden_by_opaque_ties"] = audit.hidden_by_opaque_ties;
    all["max_difference"] = audit.max_difference;
    return all;
}

py::list diagnostics_of(const Rendering& rendering) {
    py::list all;
    for (const Diagnostic& d : rendering.diagnostics()) {
        py::dict one;
        one["fault"] = std::string{pipeline::name(d.fault)};
        one["pixels"] = d.pixels;
        one["first"] = py::make_tuple(d.first_x, d.first_y);
        one["detail"] = d.detail;
        all.append(one);
    }
    return all;
}

void bind_rendering(py::module_& module) {
    using Held = std::shared_ptr<Rendering>;
    py::class_<Rendering, Held>(module, "Rendering", "A picture, or a refusal that no array can be had from.")
        .def_property_readonly("is_refused", [](const Rendering& r) { return r.is_refused(); })
        .def_property_readonly("refusal", [](const Rendering& r) { return r.refusal(); })
        .def_property_readonly("color", [](const Held& r) { return as_array(r, r->color()); })
        .def_property_readonly("depth", [](const Held& r) { return as_array(r, r->depth()); })
        .def_property_readonly("digest", [](const Rendering& r) { return r.digest(); })
        .def_property_readonly("audit", [](const Rendering& r) { return audit_of(r.audit()); })
        .def_property_readonly("diagnostics", [](const Rendering& r) { return diagnostics_of(r); })
        .def_property_readonly("geometry_passes", [](const Rendering& r) { return r.geometry_passes(); })
        .def("picture", [](const Rendering& r) { return r.picture(); })
        .def(
            "save",
            [](const Rendering& r, const std::string& path) {
                py::gil_scoped_release without_lock;
                scenes::write_image(path, {.color = r.color(), .depth = r.depth()});
            },
            py::arg("path"), "An .exr with all codes, or a .png.");
    module.def("_render", [](const Scene& scene, const std::string& algorithm, const std::string& profile,
                             const py::kwargs& keywords) {
        const Asked asked{algorithm, profile, keywords};
        return unlocked([&] { return render(scene, asked.algorithm, asked.profile, asked.options); });
    });
}

void bind_layers(py::module_& module) {
    module.def("_layers", [](const Scene& scene, const std::string& algorithm, const std::string& profile,
                             const py::kwargs& keywords) {
        const Asked asked{algorithm, profile, keywords};
        const auto found = unlocked([&] { return layers(scene, asked.algorithm, asked.profile, asked.options); });
        py::list all;
        for (const Layer& layer : *found)
            all.append(
                py::make_tuple(as_array(found, layer.color), as_array(found, layer.depth), layer.is_from_behind));
        return all;
    });
    module.def("_passes", [](const Scene& scene, const std::string& algorithm, const std::string& profile,
                             const py::kwargs& keywords) {
        const Asked asked{algorithm, profile, keywords};
        const auto found = unlocked([&] { return passes(scene, asked.algorithm, asked.profile, asked.options); });
        py::list all;
        for (const oracle::PassReport& pass : *found) {
            py::dict targets, one;
            for (const oracle::NamedImage& target : pass.targets)
                targets[py::str(target.name)] = as_array(found, target.image);
            py::list queries;
            for (const oracle::Query& query : pass.queries) queries.append(py::make_tuple(query.count, query.goes_on));
            one["number"] = pass.number;
            one["kind"] = std::string{oracle::name(pass.kind)};
            one["iteration"] = pass.iteration;
            one["before"] = pass.before;
            one["reads"] = pass.reads;
            one["writes"] = pass.writes;
            one["passed"] = pass.passed;
            one["queries"] = queries;
            one["targets"] = targets;
            all.append(one);
        }
        return all;
    });
}

void expect_one_sample(const Asked& asked) {
    if (asked.options.sampling.samples != 1)
        throw InputError("options", "samples", "1 for fragments", std::to_string(asked.options.sampling.samples));
}

void bind_fragments(py::module_& module) {
    module.def("_fragments", [](const Scene& scene, const std::string& algorithm, const std::string& profile,
                                const py::kwargs& keywords) {
        const Asked asked{algorithm, profile, keywords};
        expect_one_sample(asked);
        const auto all = unlocked([&] { return fragments(scene, asked.algorithm, asked.profile, asked.options); });
        const auto count = static_cast<py::ssize_t>(all->size());
        constexpr py::ssize_t stride = sizeof(CapturedFragment);
        const CapturedFragment none{};
        const CapturedFragment& first = all->empty() ? none : all->front();
        py::dict found;
        found["pixel"] = shared_array(py::dtype{"u4"}, {count}, {stride}, &first.pixel, all);
        found["primitive"] = shared_array(py::dtype{"u4"}, {count}, {stride}, &first.primitive, all);
        found["code"] = shared_array(py::dtype{"u4"}, {count}, {stride}, &first.code, all);
        found["z"] = shared_array(py::dtype{"f4"}, {count}, {stride}, &first.shader_z, all);
        found["color"] = shared_array(py::dtype{"f4"}, {count, 4}, {stride, 4}, &first.color.x, all);
        return found;
    });
}

// Each of several samples by itself.
std::vector<oracle::SampledHistory> single_samples(const oracle::SampledHistory& history) {
    std::vector<oracle::SampledHistory> all;
    for (const oracle::History& sample : history.samples) all.push_back({.samples = {sample}});
    return all;
}

void bind_history(py::module_& module) {
    using oracle::SampledHistory;
    py::class_<SampledHistory>(module, "History", "What happened at a pixel, in every pass.")
        .def_property_readonly("text", [](const SampledHistory& h) { return oracle::to_text(h); })
        .def_property_readonly(
            "json_text",
            [](const SampledHistory& h) {
                return h.samples.size() == 1 ? oracle::to_json(h.samples[0]) : oracle::to_json(std::span{&h, 1});
            })
        .def_property_readonly("svg",
                               [](const SampledHistory& h) {
                                   return oracle::to_svg({&h.samples.at(0), 1});
                               })
        .def_property_readonly("layers", [](const SampledHistory& h) { return oracle::composited(h.samples.at(0)); })
        .def_property_readonly("samples", single_samples);
    module.def("_explain", [](const Scene& scene, int x, int y, const std::string& algorithm,
                              const std::string& profile, const py::kwargs& keywords) {
        const Asked asked{algorithm, profile, keywords};
        py::gil_scoped_release without_lock;
        return explain_samples(scene, x, y, asked.algorithm, asked.profile, asked.options);
    });
}

void bind_folders(py::module_& module) {
    py::class_<ComparedFolders>(module, "ComparedFolders", "Which pictures of two folders differ, by name.")
        .def_property_readonly("accepted", &ComparedFolders::is_accepted)
        .def_property_readonly("failed", [](const ComparedFolders& c) { return c.summary.failed(); })
        .def_property_readonly("states",
                               [](const ComparedFolders& c) {
                                   py::dict all;
                                   for (const oracle::FolderCase& one : c.cases)
                                       all[py::str(one.name)] = std::string{oracle::name(one.state)};
                                   return all;
                               })
        .def_property_readonly("text", [](const ComparedFolders& c) { return to_text(c); })
        .def_property_readonly("json_text", [](const ComparedFolders& c) { return to_json(c); })
        .def_property_readonly("junit", [](const ComparedFolders& c) { return to_junit(c); });
    module.def("_compare_folders",
               [](const std::string& reference, const std::string& candidate, const Tolerances& tolerances,
                  const std::string& names, const std::string& baselines) {
                   py::gil_scoped_release without_lock;
                   return compare_folders(reference, candidate, tolerances, {names, baselines});
               });
}

void bind_compare(py::module_& module) {
    py::class_<Picture>(module, "Picture", "Targets with their codes, to be compared.")
        .def_property_readonly("arrays",
                               [](const Picture& picture) {
                                   py::dict all;
                                   for (const oracle::TargetImage& target : picture.targets)
                                       all[py::str((target.part.empty() ? "" : target.part + ".") + target.name)] =
                                           as_array(oracle::TargetImage{target});
                                   return all;
                               })
        .def("__repr__", [](const Picture& picture) { return "<strata.Picture " + size_text(picture) + ">"; });
    module.def("_picture", &picture_of_array);
    module.def(
        "read",
        [](const std::string& path, const std::string& algorithm) {
            py::gil_scoped_release without_lock;
            return Reference{path, algorithm}.picture();
        },
        py::arg("path"), py::arg("algorithm") = "",
        "An .exr, .png or .npy file, or what a golden pack expects of one of its algorithms, without changing a bit.");
    using Held = std::shared_ptr<Comparison>;
    py::class_<Comparison, Held>(module, "Comparison", "How a candidate differs from a reference.")
        .def_readonly("equal", &Comparison::equal)
        .def_readonly("accepted", &Comparison::accepted)
        .def_readonly("differing", &Comparison::differing)
        .def_property_readonly("text", [](const Comparison& c) { return oracle::to_text(c); })
        .def_property_readonly("json_text", [](const Comparison& c) { return oracle::to_json(c); })
        .def_property_readonly("junit", [](const Comparison& c) { return oracle::to_junit(c); })
        .def_property_readonly(
            "heat", [](const Comparison& c) { return as_array(std::make_shared<const Image>(oracle::heat_map(c))); })
        .def_property_readonly("distance", [](const Held& c) {
            return shared_array(py::dtype{"u4"}, {c->height, c->width}, {}, c->distance_of.data(), c);
        });
    module.def("_compare", [](const Picture& reference, const Picture& candidate, const Tolerances& tolerances) {
        return unlocked([&] { return compare(reference, candidate, tolerances); });
    });
    module.def("_check", [](const Picture& candidate, const Picture& reference, const std::string& name,
                            const Tolerances& tolerances) {
        py::gil_scoped_release without_lock;
        const Checked checked = check(candidate, Reference{reference, name}, tolerances);
        return std::make_pair(checked.is_accepted, checked.message);
    });
    bind_folders(module);
    py::class_<Tolerances>(module, "Tolerances", "What may be forgiven; nothing unless it is said.")
        .def(py::init([](std::uint32_t color, std::uint32_t depth, std::uint64_t coverage, std::uint64_t pixels) {
                 return Tolerances{.color_codes = color,
                                   .depth_codes = depth,
                                   .coverage = {.pixels = coverage},
                                   .pixels = {.pixels = pixels}};
             }),
             py::kw_only(), py::arg("color") = 0, py::arg("depth") = 0, py::arg("coverage") = 0, py::arg("pixels") = 0);
}

void bind_judgement(py::module_& module) {
    py::class_<Judgement>(module, "Judgement",
                          "Whether a picture of a scene is right, apart from formats and rounding.")
        .def_property_readonly("state", [](const Judgement& j) { return std::string{oracle::name(j.state)}; })
        .def_readonly("is_right", &Judgement::is_right)
        .def_readonly("is_undecided", &Judgement::is_undecided)
        .def_readonly("sentence", &Judgement::sentence)
        .def_readonly("mistakes", &Judgement::mistakes)
        .def_readonly("forgotten", &Judgement::forgotten)
        .def_readonly("leads", &Judgement::leads)
        .def_readonly("text", &Judgement::text)
        .def_readonly("json_text", &Judgement::json)
        .def("__bool__", [](const Judgement& j) { return j.is_right; })
        .def("__repr__", [](const Judgement& j) { return "<strata.Judgement " + j.sentence + ">"; });
    module.def("_judge", [](const Scene& scene, const Picture& candidate, const std::string& profile_name,
                            const std::string& ran, const py::kwargs& keywords) {
        DeviceProfile profile = strata::profile(profile_name);
        const RenderOptions options = options_of_keywords(keywords, profile);
        const Algorithm* stated = ran.empty() ? nullptr : &strata::algorithm(ran);
        py::gil_scoped_release without_lock;
        return judge(scene, candidate, profile, options, stated);
    });
}

void bind_diagnosis(py::module_& module) {
    py::class_<Diagnosed>(module, "Diagnosis", "Which known mistake made a picture.")
        .def_property_readonly("is_right", &Diagnosed::is_right)
        .def_property_readonly("verdict", &Diagnosed::verdict)
        .def_property_readonly("mistakes", &Diagnosed::mistakes)
        .def_property_readonly("alike", &Diagnosed::alike)
        .def_property_readonly("differing", [](const Diagnosed& d) { return d.comparison.differing; })
        .def_property_readonly("state", [](const Diagnosed& d) { return std::string{oracle::name(d.judgement.state)}; })
        .def_property_readonly("sentence", &Diagnosed::sentence)
        .def_property_readonly("text", &Diagnosed::text)
        .def_property_readonly("json_text", &Diagnosed::json);
    module.def("_diagnose", [](const Scene& scene, const Picture& candidate, const std::string& algorithm,
                               const std::string& profile, const Tolerances& tolerances, const py::kwargs& keywords) {
        const Asked asked{algorithm, profile, keywords};
        py::gil_scoped_release without_lock;
        return diagnose(scene, candidate, asked.algorithm, asked.profile, asked.options, tolerances);
    });
}

}  // namespace

void bind_results(py::module_& module) {
    bind_compare(module);
    bind_judgement(module);
    bind_diagnosis(module);
    bind_rendering(module);
    bind_layers(module);
    bind_fragments(module);
    bind_history(module);
}

}  // namespace strata::python
