// Stones and their readings.

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "python/bindings/arrays.h"
#include "python/bindings/bind_functions.h"
#include "python/bindings/python_stone.h"
#include "stone/design/design.h"
#include "stone/file_kind.h"
#include "stone/material/material_io.h"
#include "stone/solid_input.h"
#include "stone/stone_io.h"

namespace py = pybind11;
namespace fs = std::filesystem;

namespace culet {

namespace {

PythonStone load_stone(const fs::path& file, const std::vector<std::string>& overrides,
                       const std::string& material) {
    PythonStone result;
    result.file = file.string();
    if (is_solid_file(file)) {
        SolidInput input = load_solid(file);
        result.stone.solid = std::move(input.solid);
        result.stone.changed = std::move(input.changed);
        result.stone.name = file.stem().string();
        result.notes = std::move(input.notes);
        if (const auto& design = result.stone.solid.design) result.index = design->refractive_index;
    } else {
        StoneFile read = read_stone(file, overrides);
        result.has_material = read.has_material;
        result.notes = std::move(read.notes);
        result.stone = std::move(read.stone);
        result.readings = read_readings(file, overrides);
        result.options = read_fit_options(file, overrides);
    }
    if (!material.empty()) {
        result.stone.material = material_called(material);
        result.has_material = true;
    }
    return result;
}

// Facets that get no part of the stone's surface are reported.
PythonStone stone_of_planes(const DoubleArray& normals, const DoubleArray& offsets,
                            std::vector<std::string> names, const std::string& material) {
    if (normals.ndim() != 2 || normals.shape(1) != 3 || offsets.ndim() != 1 ||
        offsets.shape(0) != normals.shape(0))
        throw InputError("planes are an array (F, 3) of normals and one (F,) of offsets");
    const auto count = static_cast<std::size_t>(normals.shape(0));
    if (!names.empty() && names.size() != count)
        throw InputError(fmt::format("{} names for {} planes", names.size(), count));
    std::vector<NamedPlane> planes;
    for (std::size_t i = 0; i < count; ++i) {
        const double* n = normals.data() + 3 * i;
        const double length = std::hypot(n[0], n[1], n[2]);
        if (!(length > 0) || !std::isfinite(length) || !std::isfinite(offsets.data()[i]))
            throw InputError(fmt::format("plane {} has no finite normal and offset", i));
        planes.push_back({names.empty() ? fmt::format("F{}", i + 1) : names[i],
                          {Vec3{n[0], n[1], n[2]} / length, offsets.data()[i] / length}});
    }
    HalfSpaceSolid cut = intersect_half_spaces(planes);
    if (!cut.bounded || cut.empty)
        throw InputError(cut.empty ? "no point lies below all of the planes"
                                   : "the planes leave the stone open");
    PythonStone result;
    result.file = "planes";
    result.stone.solid = std::move(cut.solid);
    result.stone.facets_are_whole = true;
    for (const int unused : cut.unused_planes)
        result.notes.push_back(fmt::format("{} bounds nothing", planes[std::size_t(unused)].name));
    if (!material.empty()) {
        result.stone.material = material_called(material);
        result.has_material = true;
    }
    return result;
}

py::dict as_dict(const WrittenReading& reading) {
    py::dict row;
    row["id"] = reading.id;
    row["kind"] = reading.kind;
    row["of"] = reading.of;
    row["value"] = reading.value;
    row["sigma"] = reading.sigma;
    row["rounding"] = reading.rounding;
    row["exact"] = reading.exact;
    row["released"] = reading.released;
    row["datum"] = reading.datum;
    row["side"] = reading.side;
    row["note"] = reading.note;
    return row;
}

std::vector<std::string> facets_in(const py::handle& of) {
    if (py::isinstance<py::str>(of)) return {of.cast<std::string>()};
    return of.cast<std::vector<std::string>>();
}

WrittenReading reading_of(const py::dict& row, long line) {
    WrittenReading reading;
    reading.file = "readings";
    reading.line = line;
    for (const auto& [key, value] : row) {
        const auto name = key.cast<std::string>();
        try {
            if (name == "id")
                reading.id = value.cast<std::string>();
            else if (name == "kind")
                reading.kind = value.cast<std::string>();
            else if (name == "of")
                reading.of = facets_in(value);
            else if (name == "value")
                reading.value = value.cast<std::optional<double>>();
            else if (name == "sigma")
                reading.sigma = value.cast<std::optional<double>>();
            else if (name == "rounding")
                reading.rounding = value.cast<std::optional<double>>();
            else if (name == "exact")
                reading.exact = value.cast<bool>();
            else if (name == "released")
                reading.released = value.cast<bool>();
            else if (name == "datum")
                reading.datum = value.cast<std::string>();
            else if (name == "side")
                reading.side = value.cast<std::string>();
            else if (name == "note")
                reading.note = value.cast<std::string>();
            else
                throw InputError(reading.file, line,
                                 fmt::format("no key \"{}\": a reading has kind, of, value, sigma, "
                                             "rounding, exact, released, datum, side, id, note",
                                             name));
        } catch (const py::cast_error&) {
            throw InputError(reading.file, line,
                             fmt::format("{} is of the wrong type: {}", name,
                                         py::repr(value).cast<std::string>()));
        }
    }
    if (reading.kind.empty()) throw InputError(reading.file, line, "the reading has no kind");
    return reading;
}

PythonStone with_readings(PythonStone stone, const py::iterable& rows) {
    stone.readings.clear();
    long line = 0;
    for (const py::handle& row : rows) {
        ++line;
        if (!py::isinstance<py::dict>(row))
            throw InputError("readings", line, "a reading is a dict, as Stone.readings has them");
        stone.readings.push_back(reading_of(row.cast<py::dict>(), line));
    }
    return stone;
}

void bind_description(py::class_<PythonStone>& stone) {
    stone
        .def_property_readonly(
            "name", [](const PythonStone& s) { return s.stone.name; }, "")
        .def_property_readonly(
            "unit", [](const PythonStone& s) { return std::string(name_of(s.stone.unit)); },
            "mm, cm, m or in.")
        .def_property_readonly(
            "material",
            [](const PythonStone& s) -> std::optional<std::string> {
                if (!s.has_material) return std::nullopt;
                return s.stone.material.id;
            },
            "Name of the material; None: it has none.")
        .def_property_readonly(
            "has_uncertainty", [](const PythonStone& s) { return s.uncertainty.has_value(); },
            "True of a fitted stone, which knows how sure its facets are.")
        .def_readonly("notes", &PythonStone::notes, "Notes from reading its file.")
        .def("__repr__", [](const PythonStone& s) {
            return fmt::format("<culet.Stone {}: {} facets, {}, {} readings>", s.stone.name,
                               s.stone.solid.facets.size(),
                               s.has_material ? s.stone.material.id : "no material",
                               s.readings.size());
        });
}

void bind_files(py::module_& module) {
    module.def("load_stone", load_stone, py::arg("file"), py::arg("overrides"),
               py::arg("material"));
    module.def(
        "kind_of",
        [](const fs::path& file) {
            switch (kind_of(file)) {
                case FileKind::solid:
                    return "solid";
                case FileKind::stone:
                    return "stone";
                case FileKind::scene:
                    return "scene";
                case FileKind::picture:
                    return "picture";
                default:
                    return "other";
            }
        },
        py::arg("file"));
    module.def(
        "words_for", [](const fs::path& file) { return words_for(kind_of(file)); },
        py::arg("file"));
}

}  // namespace

void bind_stone(py::module_& module) {
    py::class_<PythonStone> stone(
        module, "Stone",
        "A cut stone: facets with names that bound a solid, its material, and its readings where "
        "its file has them.\n\nFrame: right-handed, +z up through the table, +x at azimuth 0. "
        "Lengths are in `unit`, angles in degrees. Made by culet.load, by culet.fit, or of "
        "planes.");
    stone
        .def_static(
            "of_planes", stone_of_planes, py::arg("normals"), py::arg("offsets"),
            py::arg("names") = std::vector<std::string>(), py::arg("material") = "",
            "The convex stone below all planes normal . x <= offset.\n\nnormals: (F, 3), of "
            "any length; offsets: (F,), mm; names: of the facets (F1, F2, ... without "
            "them); material: of the catalogue, or a material file.")
        .def(
            "with_material",
            [](PythonStone s, const std::string& name) {
                s.stone.material = material_called(name);
                s.has_material = true;
                return s;
            },
            py::arg("name"), "The same stone of another material.")
        .def(
            "with_readings", with_readings, py::arg("rows"),
            "The same stone with these readings: dicts with the keys of a readings file (kind, of, "
            "value, sigma, ...). Angles in degrees, lengths in `unit`, weight in carat.")
        .def_property_readonly(
            "readings",
            [](const PythonStone& s) {
                py::list rows;
                for (const WrittenReading& r : s.readings) rows.append(as_dict(r));
                return rows;
            },
            "The readings of its file, a dict each.");
    bind_description(stone);
    bind_stone_shape(stone);
    bind_files(module);
}

}  // namespace culet
