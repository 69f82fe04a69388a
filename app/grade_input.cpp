#include "app/grade_input.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "app/file_kinds.h"
#include "stone/solid_input.h"
#include "app/terminal.h"
#include "fit/fit.h"
#include "fit/readings/measurement.h"
#include "render/grade/upright.h"
#include "stone/errors.h"
#include "stone/material_io.h"
#include "stone/output_file.h"
#include "stone/stone_io.h"

namespace culet {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;

Material material_called(const std::string& name) {
    return fs::path(name).extension() == ".toml" ? read_material(name) : catalogue_material(name);
}

// null, which stands for what is not known (the azimuth of a level facet), is 0.
double number_of(const Json& facet, const char* key) {
    const auto found = facet.find(key);
    return found != facet.end() && found->is_number() ? found->get<double>() : 0;
}

double known(double sigma) {
    return std::isfinite(sigma) ? sigma : 0;
}

// The report's facets are the mesh's, of which the planes may have left some no room.
StoneUncertainty uncertainty_of(const FitResult& result) {
    StoneUncertainty uncertainty;
    std::vector<std::size_t> rows;  // of the covariance
    for (const Facet& facet : result.solid.facets) {
        for (std::size_t f = 0; f < result.facets.size(); ++f) {
            const FittedFacet& fitted = result.facets[f];
            if (fitted.name != facet.name) continue;
            uncertainty.facets.push_back({known(fitted.sigma_inclination),
                                          known(fitted.sigma_azimuth), known(fitted.sigma_offset)});
            for (std::size_t k = 0; k < 3; ++k) rows.push_back(3 * f + k);
            break;
        }
    }
    if (result.facet_covariance.empty()) return uncertainty;
    const std::size_t size = 3 * result.facets.size();
    for (const std::size_t i : rows) {
        for (const std::size_t j : rows)
            uncertainty.covariance.push_back(known(result.facet_covariance[i * size + j]));
    }
    return uncertainty;
}

void take_material(const GradeChoices& choices, GradeInput& input) {
    if (!choices.material.empty()) {
        input.stone.material = material_called(choices.material);
        input.has_material = true;
    }
    if (choices.index) input.index = choices.index;
    if (!input.has_material && !input.index) {
        throw InputError(input.file,
                         "names no material: say which with --material NAME (culet info "
                         "--materials lists them), or --index N");
    }
    // A design's own index is for who names no material.
    if (input.has_material && !choices.index) input.index.reset();
}

std::vector<GradeInput> load_stone_file(const fs::path& file, const GradeChoices& choices,
                                        bool drawn) {
    StoneFile read = read_stone(file, choices.overrides);
    GradeInput input;
    input.file = file.string();
    input.name = read.stone.name.empty() ? file.stem().string() : read.stone.name;
    input.has_material = read.has_material;
    input.notes = read.notes;
    input.stone = read.stone;
    const std::vector<WrittenReading> readings = read_readings(file, choices.overrides);
    if (readings.empty()) return {input};
    if (read.density_g_cm3) read.stone.material.density_g_cm3 = read.density_g_cm3;
    std::vector<GradeInput> both;
    try {
        const FitInput problem = fit_input(read.stone, readings);
        const FitResult result = fit_stone(problem, read_fit_options(file, choices.overrides),
                                           progress_line("fit", choices.quiet));
        GradeInput fitted = input;
        fitted.stone.solid = result.solid;
        fitted.stone.unit = result.unit;
        fitted.stone.up_facet.clear();
        fitted.stone.up = {0, 0, 1};
        fitted.uncertainty = uncertainty_of(result);
        fitted.trusted = result.usable();
        fitted.notes.push_back(fmt::format("fitted to its readings: {}", name_of(result.status)));
        if (!result.usable()) fitted.notes.push_back(result.message);
        both.push_back(std::move(fitted));
    } catch (const InputError& error) {
        throw InputError(read.mesh_file, error.what());
    }
    if (drawn) {
        input.name += " (as drawn)";
        input.as_drawn = true;
        both.push_back(std::move(input));
    }
    return both;
}

}  // namespace

StoneUncertainty uncertainty_in(const fs::path& report, const Solid& solid) {
    const Json json = Json::parse(read_text(report), nullptr, false);
    if (!json.is_object() || !json.contains("facets") || !json["facets"].is_array())
        throw InputError(report, "is no report of culet fit (--report FIT.json writes one)");
    StoneUncertainty uncertainty;
    for (const Facet& facet : solid.facets) {
        const Json* found = nullptr;
        for (const Json& one : json["facets"]) {
            if (one.is_object() && one.value("name", std::string()) == facet.name) found = &one;
        }
        if (found == nullptr) {
            throw InputError(
                report,
                fmt::format("has no facet \"{}\": it is the report of another stone", facet.name));
        }
        uncertainty.facets.push_back({radians(number_of(*found, "sigma_inclination")),
                                      radians(number_of(*found, "sigma_azimuth")),
                                      number_of(*found, "sigma_offset")});
    }
    return uncertainty;
}

std::vector<GradeInput> load_for_grade(const fs::path& file, const GradeChoices& choices,
                                       bool drawn) {
    if (choices.index && !(*choices.index > 1 && *choices.index < 10))
        throw InputError(
            fmt::format("--index is a refractive index above 1, found {:g}", *choices.index));
    require_kind(file, {FileKind::solid, FileKind::stone}, choices.command, choices.overrides);
    std::vector<GradeInput> inputs;
    if (kind_of(file, choices.overrides) == FileKind::stone) {
        inputs = load_stone_file(file, choices, drawn);
    } else {
        SolidInput solid = load_solid(file);
        GradeInput input;
        input.file = file.string();
        input.name = file.stem().string();
        input.stone.solid = std::move(solid.solid);
        input.notes = std::move(solid.notes);
        if (solid.sheet && solid.sheet->refractive_index && *solid.sheet->refractive_index > 1)
            input.index = solid.sheet->refractive_index;
        inputs.push_back(std::move(input));
    }
    for (GradeInput& input : inputs) {
        take_material(choices, input);
        input.stone = standing_upright(input.stone);
        if (!choices.report.empty())
            input.uncertainty = uncertainty_in(choices.report, input.stone.solid);
    }
    return inputs;
}

}  // namespace culet
