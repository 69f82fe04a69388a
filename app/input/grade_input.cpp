#include "app/input/grade_input.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "app/program/file_kinds.h"
#include "app/program/terminal.h"
#include "fit/fit.h"
#include "fit/readings/measurement.h"
#include "refine/fit_uncertainty.h"
#include "stone/cuts/cuts.h"
#include "stone/design/design.h"
#include "stone/material/material_io.h"
#include "stone/solid_input.h"
#include "stone/stone_io.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/upright.h"

namespace culet {

namespace fs = std::filesystem;

namespace {

void take_material(const GradeChoices& choices, GradeInput& input) {
    if (!choices.material.empty()) {
        input.stone.material = material_called(choices.material);
        input.has_material = true;
    }
    const std::vector<std::string>& said = input.stone.material.notes;
    input.notes.insert(input.notes.end(), said.begin(), said.end());
    if (choices.index) input.index = choices.index;
    if (!input.has_material && !input.index) {
        throw InputError(input.file,
                         "names no material: say which with --material NAME (culet info "
                         "--materials lists them), or --index N");
    }
    // A design's own index is used only if no material is named.
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
    std::vector<GradeInput> both;
    try {
        const FitInput problem = fit_input(read.stone, readings);
        const FitResult result = fit_stone(problem, read_fit_options(file, choices.overrides),
                                           progress_line("fit", choices.quiet));
        GradeInput fitted = input;
        take_fit(result, fitted);
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

void take_fit(const FitResult& result, GradeInput& input) {
    input.stone = fitted_stone(input.stone, result);
    input.uncertainty = uncertainty_of(result);
    input.trusted = result.usable();
    input.notes.push_back(fmt::format("fitted to its readings: {}", name_of(result.status)));
    if (!result.usable()) input.notes.push_back(result.message);
}

void make_ready(const GradeChoices& choices, GradeInput& input) {
    take_material(choices, input);
    input.stone = standing_upright(input.stone);
}

std::vector<GradeInput> load_for_grade(const fs::path& file, const GradeChoices& choices,
                                       bool drawn) {
    if (choices.index && !(*choices.index > 1 && *choices.index < 10))
        throw InputError(
            fmt::format("--index is a refractive index above 1, found {:g}", *choices.index));
    std::vector<GradeInput> inputs;
    const bool is_cut = is_cut_name(file.string());
    if (!is_cut)
        require_kind(file, {FileKind::solid, FileKind::stone}, choices.command, choices.overrides);
    if (is_cut) {
        GradeInput input;
        input.file = input.name = file.string();
        input.stone.solid = make_cut(input.name);
        inputs.push_back(std::move(input));
    } else if (kind_of(file, choices.overrides) == FileKind::stone) {
        inputs = load_stone_file(file, choices, drawn);
    } else {
        SolidInput solid = load_solid(file);
        GradeInput input;
        input.file = file.string();
        input.name = file.stem().string();
        input.stone.solid = std::move(solid.solid);
        input.stone.changed = std::move(solid.changed);
        input.notes = std::move(solid.notes);
        const Design* const design = input.stone.solid.design.get();
        if (std::string ask = question_of_up(input.stone.solid); !ask.empty() && !design)
            input.notes.push_back(std::move(ask));
        if (design && design->refractive_index && *design->refractive_index > 1)
            input.index = design->refractive_index;
        inputs.push_back(std::move(input));
    }
    for (GradeInput& input : inputs) {
        make_ready(choices, input);
        if (const std::string frosted = frosted_tiers(input.stone.solid); !frosted.empty())
            input.notes.push_back(
                fmt::format("frosted tiers are graded as if polished: {}", frosted));
        if (!choices.report.empty())
            input.uncertainty = uncertainty_in(choices.report, input.stone);
    }
    return inputs;
}

}  // namespace culet
