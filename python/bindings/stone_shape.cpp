// The facets of a stone as arrays.

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "python/bindings/arrays.h"
#include "python/bindings/bind_functions.h"
#include "python/bindings/python_stone.h"
#include "stone/solid/facet_triangles.h"
#include "stone/upright.h"

namespace py = pybind11;
namespace fs = std::filesystem;

namespace culet {

namespace {

using Sizes = std::vector<py::ssize_t>;

py::ssize_t size_of(const auto& list) {
    return static_cast<py::ssize_t>(list.size());
}

py::array_t<double> normals_of(const PythonStone& s) {
    std::vector<double> values;
    for (const Facet& f : s.stone.solid.facets)
        values.insert(values.end(), {f.plane.normal.x, f.plane.normal.y, f.plane.normal.z});
    return array_of(values, Sizes{size_of(s.stone.solid.facets), 3});
}

py::array_t<double> vertices_of(const PythonStone& s) {
    std::vector<double> values;
    for (const Vec3& v : s.stone.solid.vertices) values.insert(values.end(), {v.x, v.y, v.z});
    return array_of(values, Sizes{size_of(s.stone.solid.vertices), 3});
}

py::array_t<double> of_facets(const PythonStone& s, const auto& number) {
    std::vector<double> values;
    for (const Facet& f : s.stone.solid.facets) values.push_back(number(f));
    return array_of(values, Sizes{size_of(values)});
}

py::tuple triangles_of(const PythonStone& s) {
    std::vector<int> corners, facets;
    for (std::size_t f = 0; f < s.stone.solid.facets.size(); ++f) {
        for (const auto& t : facet_triangles(s.stone.solid, s.stone.solid.facets[f])) {
            corners.insert(corners.end(), t.begin(), t.end());
            facets.push_back(static_cast<int>(f));
        }
    }
    return py::make_tuple(array_of(corners, Sizes{size_of(facets), 3}),
                          array_of(facets, Sizes{size_of(facets)}));
}

}  // namespace

void bind_stone_shape(py::class_<PythonStone>& stone) {
    stone
        .def_property_readonly(
            "facets",
            [](const PythonStone& s) {
                std::vector<std::string> names;
                for (const Facet& f : s.stone.solid.facets) names.push_back(f.name);
                return names;
            },
            "Names of the facets, F of them.")
        .def_property_readonly("normals", normals_of, "(F, 3): unit normals, out of the stone.")
        .def_property_readonly(
            "offsets",
            [](const PythonStone& s) {
                return of_facets(s, [](const Facet& f) { return f.plane.offset; });
            },
            "(F,): a facet's points x satisfy normal . x = offset; in `unit`.")
        .def_property_readonly(
            "inclinations",
            [](const PythonStone& s) {
                const Vec3 up = up_of(s.stone);
                return of_facets(
                    s, [&](const Facet& f) { return degrees(inclination(f.plane.normal, up)); });
            },
            "(F,): degrees, 0 (table) to 90 (girdle), from the stone's up direction.")
        .def_property_readonly(
            "azimuths",
            [](const PythonStone& s) {
                return of_facets(s,
                                 [](const Facet& f) { return degrees(azimuth(f.plane.normal)); });
            },
            "(F,): degrees, counter-clockwise about +z from +x, seen from above.")
        .def_property_readonly(
            "areas",
            [](const PythonStone& s) {
                return of_facets(s, [&](const Facet& f) { return area(s.stone.solid, f); });
            },
            "(F,): in `unit` squared.")
        .def_property_readonly("vertices", vertices_of, "(V, 3): in `unit`.")
        .def_property_readonly(
            "corners",
            [](const PythonStone& s) {
                std::vector<std::vector<int>> corners;
                for (const Facet& f : s.stone.solid.facets) corners.push_back(f.corners);
                return corners;
            },
            "Of each facet the rows of `vertices`, counter-clockwise seen from outside.")
        .def_property_readonly("triangles", triangles_of,
                               "Two arrays: (T, 3) rows of `vertices`, and (T,) the facet of each.")
        .def_property_readonly(
            "volume", [](const PythonStone& s) { return volume(s.stone.solid); },
            "In `unit` cubed.")
        .def(
            "save",
            [](const PythonStone& s, const fs::path& file) {
                return write_solid(s.stone.solid, file);
            },
            py::arg("file"),
            "Writes the mesh or cut: .obj .off .ply .stl .asc .gem .gcs, by the name's ending. "
            "Returns notes on what the file does not keep.");
}

}  // namespace culet
