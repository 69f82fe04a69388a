#pragma once
// What each file of bindings adds to the module.

#include <pybind11/pybind11.h>

namespace culet {

struct PythonStone;

void bind_stone(pybind11::module_& module);
void bind_stone_shape(pybind11::class_<PythonStone>& stone);
void bind_fit(pybind11::module_& module);
void bind_scene(pybind11::module_& module);
void bind_picture(pybind11::module_& module);
void bind_grade(pybind11::module_& module);
void bind_compare(pybind11::module_& module);

}  // namespace culet
