// Scenes and their pictures.

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "python/bindings/arrays.h"
#include "python/bindings/bind_functions.h"
#include "python/bindings/long_work.h"
#include "python/bindings/python_picture.h"
#include "python/bindings/python_stone.h"
#include "render/image/exposure.h"
#include "render/render.h"
#include "render/scene/scene_io.h"
#include "render/scene/shown_picture.h"
#include "render/uncertainty/picture_uncertainty.h"
#include "stone/file_kind.h"

namespace py = pybind11;
namespace fs = std::filesystem;

namespace culet {

namespace {

void require_material(const PythonStone& stone, const StoneScene& choices) {
    if (!stone.has_material && choices.material.empty())
        throw InputError(stone.file,
                         "names no material: say which, material=\"diamond\", or "
                         "Stone.with_material(\"diamond\")");
}

void make(PythonScene& scene) {
    if (scene.file.empty()) {
        require_material(*scene.stone, scene.choices);
        scene.scene = scene_around(scene.stone->stone, scene.overrides, scene.choices);
    } else if (!scene.stone) {
        scene.scene = read_any_scene(scene.file, scene.overrides, scene.choices);
    } else {
        if (kind_of(scene.file) != FileKind::scene)
            throw InputError(scene.file, "is not a scene that another stone could be put into");
        require_material(*scene.stone, scene.choices);
        Stone stone = scene.stone->stone;
        scene.scene = read_scene(scene.file, scene.overrides, &stone, scene.choices.light);
    }
}

PythonScene made_scene(const std::string& file, const std::optional<PythonStone>& stone,
                       const std::vector<std::string>& overrides, const std::string& light,
                       const std::string& material, const std::optional<double>& width_mm) {
    PythonScene scene{file, stone, overrides, {material, light, width_mm}, {}};
    make(scene);
    return scene;
}

PythonScene with(PythonScene scene, const std::vector<std::string>& overrides,
                 const std::optional<PythonStone>& stone) {
    scene.overrides.insert(scene.overrides.end(), overrides.begin(), overrides.end());
    if (stone) scene.stone = stone;
    make(scene);
    return scene;
}

py::dict result_of(const RenderResult& result, const PythonScene& of, bool is_usable) {
    py::dict answer = arrays_of(result.picture);
    answer["stats"] = stats_json(result.stats);
    answer["usable"] = is_usable;
    std::vector<std::string> notes = of.scene.notes;
    notes.insert(notes.end(), result.stats.notes.begin(), result.stats.notes.end());
    answer["notes"] = notes;
    answer["exposure"] =
        shown_exposure("", of.scene)
            .value_or(exposure_for_stone(result.picture, of.scene.film.share_over_white));
    return answer;
}

py::dict render_of(const PythonScene& python, bool spectral, std::uint64_t seed, int threads,
                   const std::optional<PythonStone>& uncertain, int draws,
                   const py::object& progress) {
    Scene scene = python.scene;
    scene.settings.spectral = spectral;
    scene.settings.seed = seed;
    scene.settings.threads = threads;
    std::optional<StoneUncertainty> uncertainty;
    if (uncertain) uncertainty = uncertainty_for_scene(*uncertain, scene);
    const bool paced = allow_usual_time(scene);
    const RenderResult result = wait_for(progress, [&](const Progress& told) {
        RenderResult drawn = render(scene, told);
        if (uncertainty)
            add_layers(picture_uncertainty(scene, plan_drawn(scene, drawn.stats), *uncertainty,
                                           draws, told),
                       drawn.picture);
        return drawn;
    });
    return result_of(result, python, usable(result.stats, paced));
}

PythonStone stone_in(const PythonScene& scene) {
    PythonStone stone = scene.stone.value_or(PythonStone{});
    if (!scene.stone) stone.file = scene.file;
    stone.stone = scene.scene.stone;
    stone.has_material = true;
    return stone;
}

}  // namespace

StoneUncertainty uncertainty_for_scene(const PythonStone& stone, const Scene& scene) {
    if (!stone.uncertainty)
        throw InputError(stone.file, "knows nothing of its uncertainty: give a Fit");
    if (stone.uncertainty->facets.size() != scene.stone.solid.facets.size())
        throw InputError(stone.file,
                         "is not the stone of the scene: take the fit's own stone, "
                         "stone=fit.stone");
    return *stone.uncertainty;
}

void bind_scene(py::module_& module) {
    py::class_<PythonScene>(
        module, "Scene",
        "A stone among lights, seen by a camera: what culet.render draws. Made by culet.load of a "
        "scene file, or by culet.scene of a stone.")
        .def("with_settings", with, py::arg("overrides") = std::vector<std::string>(),
             py::arg("stone") = py::none(),
             "The same scene with keys of its file changed, [\"camera.size=[640,480]\", "
             "\"render.depth=8\"], and with another stone in its place.")
        .def_property_readonly("stone", stone_in, "The stone, as it stands in the scene.")
        .def_property_readonly(
            "size",
            [](const PythonScene& s) {
                return py::make_tuple(s.scene.camera.width, s.scene.camera.height);
            },
            "Width and height of its picture, pixels.")
        .def_property_readonly(
            "notes", [](const PythonScene& s) { return s.scene.notes; },
            "Notes from reading its file.")
        .def("__repr__", [](const PythonScene& s) {
            return fmt::format("<culet.Scene {}: {} x {} pixels>",
                               s.file.empty() ? s.scene.stone.name : s.file, s.scene.camera.width,
                               s.scene.camera.height);
        });
    module.def("scene", made_scene, py::arg("file"), py::arg("stone"), py::arg("overrides"),
               py::arg("light"), py::arg("material"), py::arg("width_mm"));
    module.def("render", render_of, py::arg("scene"), py::arg("spectral"), py::arg("seed"),
               py::arg("threads"), py::arg("uncertainty"), py::arg("draws"), py::arg("progress"));
}

}  // namespace culet
