// Grades: what a cut does with light.

#include "render/grade/grade.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "python/bindings/bind_functions.h"
#include "python/bindings/long_work.h"
#include "python/bindings/python_stone.h"
#include "render/grade/grade_json.h"
#include "render/grade/grade_sigma.h"
#include "stone/text/errors.h"
#include "stone/upright.h"

namespace py = pybind11;

namespace culet {

namespace {

std::string grade_of(const PythonStone& python, const std::optional<double>& index, double head_deg,
                     const std::vector<double>& tilts_deg, int draws, std::uint64_t seed,
                     int threads, const py::object& progress) {
    if (index && !(*index > 1 && *index < 10))
        throw InputError(fmt::format("index is a refractive index above 1, found {:g}", *index));
    if (!(head_deg >= 0 && head_deg < 90))
        throw InputError(
            fmt::format("head is a half angle from 0 to 90 degrees, found {:g}", head_deg));
    const Stone stone = standing_upright(python.stone);
    const Material* material = python.has_material ? &stone.material : nullptr;
    const std::optional<double> n = index || material ? index : python.index;
    if (material == nullptr && !n)
        throw InputError(python.file,
                         "names no material: say index=1.54, or load it with "
                         "material=\"quartz\"");
    GradeOptions options;
    options.head = radians(head_deg);
    for (const double tilt : tilts_deg) {
        if (!(std::abs(tilt) <= k_most_tilt_deg))
            throw InputError(
                fmt::format("tilts are within {:g} degrees, found {:g}", k_most_tilt_deg, tilt));
        options.tilts.push_back(radians(tilt));
    }
    options.seed = seed;
    options.threads = threads;
    const GradeIndex indices = grade_index(material, n);
    const bool with_sigma = python.uncertainty && draws > 0;
    if (with_sigma && draws < 2) throw InputError("draws are 2 or more, or 0 for no sigmas");
    return wait_for(progress, [&](const Progress& told) {
        const Grade grade = grade_stone(stone.solid, indices, options, told);
        GradeSigma sigma;
        if (with_sigma)
            sigma = grade_sigma(stone.solid, indices, options, *python.uncertainty, draws, told);
        GradeContext context = grade_context(stone.solid, material, options);
        context.name = stone.name;
        context.file = python.file;
        if (with_sigma) context.sigma = &sigma;
        context.costs = facet_costs(stone.solid, indices, options);
        context.notes = python.notes;
        context.changed = stone.changed;
        return grade_json(grade, context);
    });
}

}  // namespace

void bind_grade(py::module_& module) {
    module.def("grade", grade_of, py::arg("stone"), py::arg("index"), py::arg("head"),
               py::arg("tilts"), py::arg("draws"), py::arg("seed"), py::arg("threads"),
               py::arg("progress"));
}

}  // namespace culet
