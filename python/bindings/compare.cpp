// Compares photographs with renders and scenes.

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "compare/calibration/picture_comparison.h"
#include "compare/calibration/scene_comparison.h"
#include "compare/photo/rendered_photo.h"
#include "compare/report/report.h"
#include "compare/report/scores_json.h"
#include "python/bindings/bind_functions.h"
#include "python/bindings/long_work.h"
#include "python/bindings/python_picture.h"
#include "python/bindings/python_stone.h"

namespace py = pybind11;
namespace fs = std::filesystem;

namespace culet {

namespace {

struct PythonPhoto {
    std::string file;
    Photo photo;
};

struct PythonComparison {
    Comparison comparison;
    std::optional<CalibratedVerdict> calibrated;
    std::string scores, page;
};

PythonPhoto photo_of_arrays(const py::dict& arrays, const std::string& name) {
    PythonPhoto photo{name, photo_of(picture_of(arrays))};
    for (float& light : photo.photo.rgb) {
        if (light >= 0 && std::isfinite(light)) continue;
        light = 0;
        ++photo.photo.not_finite;
    }
    return photo;
}

std::vector<float> mask_of(const py::object& mask, const Photo& photo) {
    if (mask.is_none()) return {};
    if (py::isinstance<py::str>(mask) || py::hasattr(mask, "__fspath__"))
        return read_mask(mask.cast<fs::path>(), photo.width, photo.height);
    const auto array = FloatArray::ensure(mask);
    if (!array || array.ndim() != 2 || array.shape(0) != photo.height ||
        array.shape(1) != photo.width)
        throw InputError(
            fmt::format("a mask is a file or an array of the photograph's shape "
                        "({}, {})",
                        photo.height, photo.width));
    std::vector<float> values = values_of(array);
    for (float& value : values) value = value > 0.5f ? 1.0f : 0.0f;
    return values;
}

Photo masked(const PythonPhoto& given, const py::object& mask, const py::object& ignored) {
    Photo photo = given.photo;
    photo.mask = mask_of(mask, photo);
    photo.ignored = mask_of(ignored, photo);
    return photo;
}

CompareOptions options_of(bool simulated, std::uint64_t seed, int threads) {
    CompareOptions options;
    options.simulated = simulated;
    options.seed = seed;
    options.threads = threads;
    return options;
}

Report page_of(const PythonComparison& result, const PythonPhoto& photo,
               const std::string& against) {
    Report report;
    report.title = fmt::format("{} against {}", fs::path(photo.file).filename().string(),
                               fs::path(against).filename().string());
    report.version = CULET_VERSION;
    report.files = {
        {result.comparison.simulated ? "simulated photograph" : "photograph", photo.file},
        {"render", against}};
    report.comparison = result.comparison;
    report.calibrated = result.calibrated;
    report.scores_json = result.scores;
    return report;
}

PythonComparison compare_pictures(const PythonPhoto& photo, const PythonPhoto& render,
                                  const py::object& mask, const py::object& ignored, bool simulated,
                                  std::uint64_t seed, int threads, const py::object& progress) {
    const Photo shown = masked(photo, mask, ignored);
    const CompareOptions options = options_of(simulated, seed, threads);
    return wait_for(progress, [&](const Progress& told) {
        PythonComparison result;
        result.comparison = compare(shown, render.photo, options, told);
        result.scores = scores_json(result.comparison, {photo.file, render.file, ""});
        result.page = report_page(page_of(result, photo, render.file));
        return result;
    });
}

PythonComparison compare_scene(const PythonPhoto& photo, const PythonScene& scene,
                               const py::object& mask, const py::object& ignored, bool simulated,
                               bool find_pose, bool calibrate, double budget, int draws,
                               const std::string& cache, const std::optional<PythonStone>& start,
                               const std::optional<PythonStone>& uncertain, std::uint64_t seed,
                               int threads, const py::object& progress) {
    if (draws < 2) throw InputError("draws are 2 or more");
    const Photo shown = masked(photo, mask, ignored);
    SceneCompareOptions options;
    options.compare = options_of(simulated, seed, threads);
    options.find_pose = find_pose;
    options.calibrate = calibrate;
    options.budget_seconds = budget;
    options.draws = draws;
    options.cache = cache;
    if (start) options.start = start->stone.solid;
    if (uncertain) options.uncertainty = uncertainty_for_scene(*uncertain, scene.scene);
    Scene drawn = scene.scene;
    drawn.settings.threads = threads;
    const std::string name = scene.file.empty() ? "a scene" : scene.file;
    return wait_for(progress, [&](const Progress& told) {
        SceneComparison compared = compare_with_scene(shown, drawn, options, told);
        PythonComparison result;
        result.comparison = std::move(compared.comparison);
        result.calibrated = std::move(compared.calibrated);
        CompareSources sources{photo.file, name, ""};
        if (compared.pose) sources.pose = pose_json(*compared.pose);
        result.scores = scores_json(result.comparison, sources, result.calibrated);
        Report page = page_of(result, photo, name);
        page.stats_json = stats_json(compared.stats);
        if (compared.pose) {
            page.pose_overlay_png =
                pose_overlay(photo.photo, scene.scene.stone.solid, *compared.pose);
            page.pose_used = compared.pose_used;
        }
        result.page = report_page(page);
        return result;
    });
}

py::dict maps_of(const PythonComparison& compared) {
    const ComparedPictures& pictures = compared.comparison.pictures;
    py::dict maps;
    const auto add = [&](const char* name, const PixelMap& map) {
        if (!map.values.empty()) maps[name] = array_of(map.values, {map.height, map.width});
    };
    add("luminance_difference", pictures.luminance_difference);
    add("colour_difference", pictures.colour_difference);
    add("visible_difference", pictures.visible_difference);
    add("similarity", pictures.similarity);
    if (compared.comparison.within) add("within_readings", compared.comparison.within->map);
    for (const auto& [name, photo] :
         {std::pair<const char*, const Photo*>{"photo", &pictures.photo},
          {"render", &pictures.render}}) {
        if (!photo->rgb.empty())
            maps[name] = array_of(photo->rgb, {photo->height, photo->width, 3});
    }
    return maps;
}

}  // namespace

void bind_compare(py::module_& module) {
    py::class_<PythonPhoto>(module, "Photo")
        .def_static(
            "read",
            [](const fs::path& file) {
                return PythonPhoto{file.string(), read_photo(file)};
            },
            py::arg("file"))
        .def_static("of_arrays", photo_of_arrays, py::arg("arrays"), py::arg("name"));
    py::class_<PythonComparison>(module, "ComparisonResult")
        .def_property_readonly(
            "verdict", [](const PythonComparison& c) { return name_of(c.comparison.verdict); })
        .def_property_readonly("reason",
                               [](const PythonComparison& c) { return c.comparison.reason; })
        .def_property_readonly("usable",
                               [](const PythonComparison& c) { return c.comparison.usable(); })
        .def_readonly("scores", &PythonComparison::scores)
        .def_readonly("page", &PythonComparison::page)
        .def_property_readonly("maps", maps_of);
    module.def("compare_pictures", compare_pictures, py::arg("photo"), py::arg("render"),
               py::arg("mask"), py::arg("ignored"), py::arg("simulated"), py::arg("seed"),
               py::arg("threads"), py::arg("progress"));
    module.def("compare_scene", compare_scene, py::arg("photo"), py::arg("scene"), py::arg("mask"),
               py::arg("ignored"), py::arg("simulated"), py::arg("find_pose"), py::arg("calibrate"),
               py::arg("budget"), py::arg("draws"), py::arg("cache"), py::arg("start"),
               py::arg("uncertainty"), py::arg("seed"), py::arg("threads"), py::arg("progress"));
}

}  // namespace culet
