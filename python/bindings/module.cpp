// The compiled half of Python's culet. Users call culet/*.py.

#include "python/bindings/bind_functions.h"
#include "stone/text/errors.h"

namespace py = pybind11;

PYBIND11_MODULE(_culet, module) {
    using namespace culet;
    module.doc() = "The compiled half of culet: import culet instead.";
    module.attr("version") = CULET_VERSION;
    // pybind11 tries the translator that was registered last first.
    const py::object& error =
        py::register_exception<InternalError>(module, "InternalError", PyExc_RuntimeError);
    error.doc() = "culet was wrong, not its input: please report it.";
    py::register_exception<InputError>(module, "InputError", PyExc_ValueError).doc() =
        "The input is wrong: one line with file, line and what to do.";
    py::register_exception<Interrupted>(module, "Interrupted", PyExc_RuntimeError).doc() =
        "A progress callback returned False, and the work was ended.";
    bind_stone(module);
    bind_fit(module);
    bind_scene(module);
    bind_picture(module);
    bind_grade(module);
    bind_compare(module);
}
