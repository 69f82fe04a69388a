// Pictures: as arrays, as PNG for notebooks, in files.

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "python/bindings/bind_functions.h"
#include "python/bindings/python_picture.h"
#include "render/image/exposure.h"
#include "render/image/image_io.h"

namespace py = pybind11;
namespace fs = std::filesystem;

namespace culet {

namespace {

using Shape = std::vector<py::ssize_t>;
constexpr py::ssize_t k_largest_side = 1 << 16;

void append(std::vector<float>& to, const std::vector<std::vector<float>>& planes) {
    for (const std::vector<float>& plane : planes) to.insert(to.end(), plane.begin(), plane.end());
}

// The array under a key, checked for its shape; empty: missing.
std::vector<float> floats_in(const py::dict& arrays, const char* key, const Shape& shape) {
    if (!arrays.contains(key) || arrays[key].is_none()) return {};
    const auto array = FloatArray::ensure(arrays[key]);
    if (!array) throw InputError(fmt::format("{} is not an array of numbers", key));
    if (Shape(array.shape(), array.shape() + array.ndim()) != shape)
        throw InputError(fmt::format("{} must have shape ({})", key, fmt::join(shape, ", ")));
    return values_of(array);
}

std::vector<std::vector<float>> planes_in(const std::vector<float>& values, std::size_t first,
                                          std::size_t count, std::size_t pixels) {
    std::vector<std::vector<float>> planes;
    for (std::size_t i = first; i < first + count; ++i)
        planes.emplace_back(values.begin() + std::ptrdiff_t(i * pixels),
                            values.begin() + std::ptrdiff_t((i + 1) * pixels));
    return planes;
}

void take_spectral(const py::dict& arrays, Picture& picture) {
    if (!arrays.contains("wavelengths_nm") || arrays["wavelengths_nm"].is_none()) return;
    const auto wavelengths = DoubleArray::ensure(arrays["wavelengths_nm"]);
    if (!wavelengths) throw InputError("wavelengths_nm is not an array of numbers");
    const auto bands = static_cast<std::size_t>(wavelengths.size());
    const Shape one{py::ssize_t(bands), picture.height, picture.width};
    const std::vector<float> spectral = floats_in(arrays, "spectral", one);
    if (spectral.empty()) return;
    picture.wavelengths_nm = values_of(wavelengths);
    picture.spectral = planes_in(spectral, 0, bands, picture.pixels());
    const std::vector<float> stokes =
        floats_in(arrays, "stokes", {4, py::ssize_t(bands), picture.height, picture.width});
    if (stokes.empty()) return;
    for (std::size_t k = 0; k < 3; ++k)
        picture.polarised[k] = planes_in(stokes, (k + 1) * bands, bands, picture.pixels());
}

py::bytes png_bytes(const py::dict& arrays, const std::optional<double>& exposure, bool alpha) {
    const Picture picture = picture_of(arrays);
    PngLook look;
    look.exposure = exposure.value_or(exposure_for_stone(picture));
    look.alpha = alpha;
    return png_of(picture, look);
}

void save_picture(const py::dict& arrays, const fs::path& file,
                  const std::optional<double>& exposure) {
    const Picture picture = picture_of(arrays);
    PngLook look;
    look.exposure = exposure.value_or(exposure_for_stone(picture));
    write_picture(picture, file, look);
}

}  // namespace

py::dict arrays_of(const Picture& picture) {
    const py::ssize_t width = picture.width, height = picture.height;
    const auto bands = static_cast<py::ssize_t>(picture.spectral.size());
    py::dict arrays;
    arrays["rgb"] = array_of(picture.rgb, {height, width, 3});
    for (const char* key : {"coverage", "wavelengths_nm", "spectral", "stokes"})
        arrays[key] = py::none();
    if (!picture.coverage.empty()) arrays["coverage"] = array_of(picture.coverage, {height, width});
    if (bands > 0) {
        std::vector<float> values;
        append(values, picture.spectral);
        arrays["wavelengths_nm"] = array_of(picture.wavelengths_nm, {bands});
        arrays["spectral"] = array_of(values, {bands, height, width});
        if (!picture.polarised[0].empty()) {
            for (const auto& planes : picture.polarised) append(values, planes);
            arrays["stokes"] = array_of(values, {4, bands, height, width});
        }
    }
    py::dict planes;
    for (const Picture::Plane& plane : picture.planes)
        planes[py::str(plane.channel)] = array_of(plane.values, {height, width});
    arrays["planes"] = planes;
    return arrays;
}

Picture picture_of(const py::dict& arrays) {
    const auto rgb = FloatArray::ensure(arrays["rgb"]);
    if (!rgb || rgb.ndim() != 3 || rgb.shape(2) != 3 || rgb.size() == 0 ||
        rgb.shape(0) > k_largest_side || rgb.shape(1) > k_largest_side)
        throw InputError("a picture is an array (H, W, 3) of linear light, in float");
    Picture picture;
    picture.height = static_cast<int>(rgb.shape(0));
    picture.width = static_cast<int>(rgb.shape(1));
    picture.rgb = values_of(rgb);
    picture.coverage = floats_in(arrays, "coverage", {rgb.shape(0), rgb.shape(1)});
    take_spectral(arrays, picture);
    if (arrays.contains("planes")) {
        const auto planes = arrays["planes"].cast<py::dict>();
        for (const auto& [name, values] : planes) {
            const auto channel = name.cast<std::string>();
            picture.planes.push_back(
                {channel, floats_in(planes, channel.c_str(), {rgb.shape(0), rgb.shape(1)})});
        }
    }
    return picture;
}

void bind_picture(py::module_& module) {
    module.def("png", png_bytes, py::arg("arrays"), py::arg("exposure"), py::arg("alpha"));
    module.def("save_picture", save_picture, py::arg("arrays"), py::arg("file"),
               py::arg("exposure"));
    module.def(
        "read_picture",
        [](const fs::path& file) {
            ReadPicture read = read_picture(file);
            py::dict arrays = arrays_of(read.picture);
            if (!read.not_photometric.empty())
                read.notes.push_back(read.not_photometric + ": the picture is not photometric");
            arrays["notes"] = read.notes;
            return arrays;
        },
        py::arg("file"));
}

}  // namespace culet
