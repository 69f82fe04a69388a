// Fits, with the uncertainty of each facet.

#include "fit/fit.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "fit/findings/summary.h"
#include "python/bindings/arrays.h"
#include "python/bindings/bind_functions.h"
#include "python/bindings/long_work.h"
#include "python/bindings/python_stone.h"
#include "refine/fit_uncertainty.h"

namespace py = pybind11;

namespace culet {

namespace {

struct PythonFit {
    FitResult result;
    PythonStone stone;
    std::string report;
};

template <class Choice>
Choice choice_named(const std::string& name, std::initializer_list<Choice> choices,
                    const char* keyword) {
    std::string known;
    for (const Choice choice : choices) {
        if (name == name_of(choice)) return choice;
        known += (known.empty() ? "" : ", ") + std::string(name_of(choice));
    }
    throw InputError(fmt::format("{} is one of {}, found \"{}\"", keyword, known, name));
}

FitOptions options_of(const PythonStone& stone, const py::kwargs& asked) {
    FitOptions options = stone.options;
    for (const auto& [key, value] : asked) {
        if (value.is_none()) continue;
        const auto name = key.cast<std::string>();
        if (name == "iterations") options.iterations = value.cast<int>();
        if (name == "starts") options.starts = value.cast<int>();
        if (name == "find_symmetry") options.find_symmetry |= value.cast<bool>();
        if (name == "allow_topology") options.allow_topology |= value.cast<bool>();
        if (name == "meets") {
            using enum MeetTreatment;
            options.meets =
                choice_named(value.cast<std::string>(), {exact, soft, released}, "meets");
            options.meets_named = true;
        }
        if (name == "loss") {
            using enum Loss;
            options.loss = choice_named(value.cast<std::string>(), {none, huber, cauchy}, "loss");
        }
        if (name == "start") options.start = value.cast<const PythonStone&>().stone.solid;
    }
    if (options.iterations < 1 || options.starts < 1)
        throw InputError("iterations and starts are 1 or more");
    return options;
}

PythonFit fit_of(const PythonStone& drawn, const py::object& progress, const py::kwargs& asked) {
    if (drawn.readings.empty())
        throw InputError(drawn.file,
                         "has no readings to fit to: name a stone file (.toml) with "
                         "readings, or add them with Stone.with_readings");
    const FitInput input = fit_input(drawn.stone, drawn.readings);
    const FitOptions options = options_of(drawn, asked);
    if (options.start) require_earlier_result(*options.start, input.stone.solid, "start");
    PythonFit fit;
    fit.result =
        wait_for(progress, [&](const Progress& told) { return fit_stone(input, options, told); });
    fit.report = fit_report(fit.result);
    fit.stone = drawn;
    fit.stone.stone = fitted_stone(drawn.stone, fit.result);
    fit.stone.uncertainty = uncertainty_of(fit.result);
    return fit;
}

template <class Number>
py::array_t<double> of_facets(const PythonFit& fit, Number number) {
    std::vector<double> values;
    for (const FittedFacet& f : fit.result.facets) values.push_back(number(f));
    return array_of(values, {static_cast<py::ssize_t>(values.size())});
}

// In degrees and the stone's unit; None if empty.
py::object covariance_of(const PythonFit& fit) {
    std::vector<double> values = fit.result.facet_covariance;
    if (values.empty()) return py::none();
    const std::size_t size = 3 * fit.result.facets.size();
    const auto unit = [](std::size_t i) { return i % 3 == 2 ? 1.0 : degrees(1); };
    for (std::size_t i = 0; i < values.size(); ++i) values[i] *= unit(i / size) * unit(i % size);
    return array_of(values, {static_cast<py::ssize_t>(size), static_cast<py::ssize_t>(size)});
}

}  // namespace

void bind_fit(py::module_& module) {
    py::class_<PythonFit>(module, "FitResult")
        .def_readonly("stone", &PythonFit::stone)
        .def_readonly("report", &PythonFit::report)
        .def_property_readonly("status",
                               [](const PythonFit& f) { return name_of(f.result.status); })
        .def_property_readonly("message", [](const PythonFit& f) { return f.result.message; })
        .def_property_readonly("usable", [](const PythonFit& f) { return f.result.usable(); })
        .def_property_readonly("summary", [](const PythonFit& f) { return fit_summary(f.result); })
        .def_property_readonly("facets",
                               [](const PythonFit& fit) {
                                   std::vector<std::string> names;
                                   for (const FittedFacet& f : fit.result.facets)
                                       names.push_back(f.name);
                                   return names;
                               })
        .def_property_readonly(
            "inclinations",
            [](const PythonFit& fit) {
                return of_facets(fit, [](const FittedFacet& f) { return degrees(f.inclination); });
            })
        .def_property_readonly(
            "azimuths",
            [](const PythonFit& fit) {
                return of_facets(fit, [](const FittedFacet& f) { return degrees(f.azimuth); });
            })
        .def_property_readonly("offsets",
                               [](const PythonFit& fit) {
                                   return of_facets(
                                       fit, [](const FittedFacet& f) { return f.plane.offset; });
                               })
        .def_property_readonly("sigma_inclinations",
                               [](const PythonFit& fit) {
                                   return of_facets(fit, [](const FittedFacet& f) {
                                       return degrees(f.sigma_inclination);
                                   });
                               })
        .def_property_readonly("sigma_azimuths",
                               [](const PythonFit& fit) {
                                   return of_facets(fit, [](const FittedFacet& f) {
                                       return degrees(f.sigma_azimuth);
                                   });
                               })
        .def_property_readonly("sigma_offsets",
                               [](const PythonFit& fit) {
                                   return of_facets(
                                       fit, [](const FittedFacet& f) { return f.sigma_offset; });
                               })
        .def_property_readonly("covariance", covariance_of);
    module.def("fit", fit_of, py::arg("stone"), py::arg("progress"));
}

}  // namespace culet
