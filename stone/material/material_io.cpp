#include "stone/material/material_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stone/material/wavelength_table.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr double k_least_index = 1.0, k_largest_index = 10.0;

RefractiveIndex index_of(const TomlTable& table, const std::string& key,
                         std::vector<std::string>& notes) {
    RefractiveIndex index;
    switch (table.kind(key)) {
        case TomlTable::Kind::number:
            index.n = *table.number(key);
            break;
        case TomlTable::Kind::table: {
            const TomlTable form = *table.table(key);
            form.refuse_unknown({"cauchy", "sellmeier", "table"});
            if (const auto cauchy = form.numbers("cauchy")) {
                if (cauchy->empty() || cauchy->size() > 3) {
                    form.fail("cauchy",
                              "cauchy has one to three numbers: A, B, C with micrometres");
                }
                index.form = RefractiveIndex::Form::cauchy;
                std::copy(cauchy->begin(), cauchy->end(), index.cauchy.begin());
            } else if (const auto sellmeier = form.table("sellmeier")) {
                sellmeier->refuse_unknown({"a0", "B", "C", "d"});
                index.form = RefractiveIndex::Form::sellmeier;
                index.a0 = sellmeier->number("a0").value_or(1.0);
                index.d = sellmeier->number("d").value_or(0.0);
                index.B = sellmeier->numbers("B").value_or(std::vector<double>{});
                index.C = sellmeier->numbers("C").value_or(std::vector<double>{});
                if (index.B.size() != index.C.size()) {
                    form.fail("sellmeier", "sellmeier needs as many C as B");
                }
            } else if (const auto file = form.path("table")) {
                index.form = RefractiveIndex::Form::table;
                index.table = read_wavelength_table(*file, "refractive index", notes);
            } else {
                table.fail(key, fmt::format("index {} needs cauchy, sellmeier or table", key));
            }
            break;
        }
        case TomlTable::Kind::missing:
            table.fail("", fmt::format("the index of ray \"{}\" is missing", key));
        default:
            table.fail(key, fmt::format("index {} must be a number or a table", key));
    }
    for (const double nm : {380.0, k_d_line_nm, 780.0}) {
        const double n = index.at(nm);
        if (!(n >= k_least_index && n <= k_largest_index)) {
            table.fail(key,
                       fmt::format(
                           "index {} is {} at {} nm; expected {} to {} (formulas take micrometres)",
                           key, n, nm, k_least_index, k_largest_index));
        }
    }
    return index;
}

Spectrum absorption_of(const TomlTable& table, const std::string& key, OpticCharacter optic,
                       int ray, Material& material) {
    Spectrum absorption;
    switch (table.kind(key)) {
        case TomlTable::Kind::missing:
            return absorption;
        case TomlTable::Kind::number:
            absorption = Spectrum(*table.number(key));
            break;
        case TomlTable::Kind::table: {
            const TomlTable form = *table.table(key);
            form.refuse_unknown({"rgb", "table", "catalogue", "scale"});
            if (const auto rgb = form.numbers("rgb")) {
                if (rgb->size() != 3) form.fail("rgb", "rgb has three numbers, per mm");
                absorption = Spectrum({465, 545, 610}, {(*rgb)[2], (*rgb)[1], (*rgb)[0]});
                material.absorption_from_rgb = true;
            } else if (const auto file = form.path("table")) {
                absorption = read_wavelength_table(*file, "absorption", material.notes);
            } else if (const auto name = form.text("catalogue")) {
                const Material other = catalogue_material(*name);
                if (other.optic != optic) {
                    form.fail("catalogue", fmt::format("{} is of another optic character", *name));
                }
                absorption = other.absorption_per_mm[ray];
            } else {
                table.fail(key, fmt::format("absorption {} needs rgb, table or catalogue", key));
            }
            if (const auto scale = form.number("scale")) absorption = absorption.scaled(*scale);
            break;
        }
        default:
            table.fail(key, fmt::format("absorption {} must be a number or a table", key));
    }
    if (absorption.min() < 0) table.fail(key, fmt::format("absorption {} is negative", key));
    return absorption;
}

OpticCharacter optic_in(const TomlTable& table) {
    const std::string optic = table.text("optic").value_or("isotropic");
    if (optic == "isotropic") return OpticCharacter::isotropic;
    if (optic == "uniaxial") return OpticCharacter::uniaxial;
    if (optic == "biaxial") return OpticCharacter::biaxial;
    table.fail("optic",
               fmt::format("optic is \"{}\"; expected isotropic, uniaxial or biaxial", optic));
}

void require_rays(const TomlTable& table, int rays) {
    if (rays == 1) table.refuse_unknown({"n"});
    if (rays == 2) table.refuse_unknown({"o", "e"});
    if (rays == 3) table.refuse_unknown({"alpha", "beta", "gamma"});
}

void read_index(const TomlTable& table, Material& material) {
    const int rays = ray_count(material.optic);
    const auto index_kind = table.kind("index");
    if (index_kind == TomlTable::Kind::missing) table.fail("", "the material has no index");
    const bool one_value =
        rays == 1 && index_kind == TomlTable::Kind::table && !table.table("index")->has("n");
    if (index_kind == TomlTable::Kind::number || one_value) {
        // `index = 1.54` or `index = { cauchy = [...] }`: one index for every ray.
        for (int ray = 0; ray < rays; ++ray)
            material.index[ray] = index_of(table, "index", material.notes);
    } else {
        const TomlTable index = *table.table("index");
        require_rays(index, rays);
        for (int ray = 0; ray < rays; ++ray) {
            material.index[ray] = index_of(index, ray_name(material.optic, ray), material.notes);
        }
    }
}

void read_absorption(const TomlTable& table, Material& material) {
    const int rays = ray_count(material.optic);
    bool per_ray = false;
    if (table.kind("absorption") == TomlTable::Kind::table) {
        const TomlTable form = *table.table("absorption");
        for (const char* ray : {"n", "o", "e", "alpha", "beta", "gamma"})
            per_ray = per_ray || form.has(ray);
        if (per_ray) require_rays(form, rays);
    }
    for (int ray = 0; ray < rays; ++ray) {
        material.absorption_per_mm[ray] =
            per_ray ? absorption_of(*table.table("absorption"), ray_name(material.optic, ray),
                                    material.optic, ray, material)
                    : absorption_of(table, "absorption", material.optic, ray, material);
    }
}

}  // namespace

Material material_of(const TomlTable& table) {
    table.refuse_unknown({"name", "optic", "density", "index", "absorption", "source"});
    Material material;
    material.id = "user";
    material.name = table.text("name").value_or("material of " + table.file().filename().string());
    material.source = table.text("source").value_or(table.file().filename().string());
    material.optic = optic_in(table);
    material.density_g_cm3 = table.number("density");
    if (material.density_g_cm3 &&
        !(*material.density_g_cm3 > 0.1 && *material.density_g_cm3 < 30)) {
        table.fail("density", fmt::format("density is {}; expected g/cm3 between 0.1 and 30",
                                          *material.density_g_cm3));
    }
    read_index(table, material);
    read_absorption(table, material);
    // A table that serves several rays gives its notes several times.
    std::vector<std::string>& notes = material.notes;
    std::sort(notes.begin(), notes.end());
    notes.erase(std::unique(notes.begin(), notes.end()), notes.end());
    return material;
}

Material read_material(const std::filesystem::path& file,
                       const std::vector<std::string>& overrides) {
    const TomlTable root = read_toml(file, overrides);
    const auto table = root.table("material");
    if (!table) root.fail("", "there is no [material] table");
    return material_of(*table);
}

Material material_called(const std::string& name) {
    return std::filesystem::path(name).extension() == ".toml" ? read_material(name)
                                                              : catalogue_material(name);
}

}  // namespace culet
