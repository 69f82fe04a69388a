#pragma once
// Converts C++ vectors to numpy arrays and back. Arrays are copies.

#include <pybind11/numpy.h>

#include <algorithm>
#include <span>
#include <vector>

#include "stone/text/errors.h"

namespace culet {

template <class T>
pybind11::array_t<T> array_of(std::span<const T> values, std::vector<pybind11::ssize_t> shape) {
    pybind11::array_t<T> array(std::move(shape));
    check(static_cast<std::size_t>(array.size()) == values.size(), "an array's shape is its size");
    std::copy(values.begin(), values.end(), array.mutable_data());
    return array;
}
template <class T>
pybind11::array_t<T> array_of(const std::vector<T>& values, std::vector<pybind11::ssize_t> shape) {
    return array_of(std::span<const T>(values), std::move(shape));
}

/// C-contiguous arrays of the requested type; numpy converts others.
using FloatArray = pybind11::array_t<float, pybind11::array::c_style | pybind11::array::forcecast>;
using DoubleArray =
    pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

template <class Array>
auto values_of(const Array& array) {
    return std::vector(array.data(), array.data() + array.size());
}

}  // namespace culet
