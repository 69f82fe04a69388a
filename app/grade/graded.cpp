#include "app/grade/graded.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "app/program/options.h"
#include "app/program/terminal.h"
#include "render/grade/grade_json.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr std::size_t k_most_tilts = 361;

// "FROM:TO:STEP", or angles separated by commas; radians.
std::vector<double> tilts_in(const std::string& text) {
    const std::string expected =
        "--tilts is FROM:TO:STEP or a list of angles, in degrees, within " +
        fmt::format("{:g}", k_most_tilt_deg);
    std::vector<double> tilts;
    if (text.find(':') == std::string::npos) {
        tilts = numbers_in(text, 1, k_most_tilts, expected);
    } else {
        std::string list = text;
        for (char& c : list) c = c == ':' ? ',' : c;
        const std::vector<double> range = numbers_in(list, 3, 3, expected);
        const double steps = (range[1] - range[0]) / range[2];
        if (!(range[2] != 0) || !(steps >= 0) || !(steps < k_most_tilts))
            throw InputError(
                fmt::format("{}, at most {} of them, found {}", expected, k_most_tilts, text));
        const int count = static_cast<int>(steps + 1e-9);
        for (int i = 0; i <= count; ++i) tilts.push_back(range[0] + i * range[2]);
    }
    for (double& tilt : tilts) {
        if (!(std::abs(tilt) <= k_most_tilt_deg))
            throw InputError(fmt::format("{}, found {}", expected, text));
        tilt = radians(tilt);
    }
    return tilts;
}

}  // namespace

GradeOptions grade_options(double head_deg, const std::string& tilts) {
    GradeOptions options;
    if (!(head_deg >= 0 && head_deg < 90))
        throw InputError(
            fmt::format("--head is a half angle from 0 to 90 degrees, found {:g}", head_deg));
    options.head = radians(head_deg);
    options.tilts = tilts_in(tilts);
    return options;
}

Graded grade_input(GradeInput input, const GradeOptions& options, int draws, bool quiet) {
    Graded graded;
    const Material* material = input.has_material ? &input.stone.material : nullptr;
    const GradeIndex index = grade_index(material, input.index);
    const Solid& solid = input.stone.solid;
    try {
        graded.grade = grade_stone(solid, index, options, progress_line("grade", quiet));
    } catch (const InputError& error) {
        throw InputError(input.file, error.what());
    }
    if (draws == 0) input.uncertainty.reset();
    if (input.uncertainty)
        graded.sigma = grade_sigma(solid, index, options, *input.uncertainty, draws,
                                   progress_line("uncertainty", quiet));
    graded.costs = facet_costs(solid, index, options);
    GradeContext context = grade_context(solid, material, options);
    context.name = input.name;
    context.file = input.file;
    if (input.uncertainty) context.sigma = &graded.sigma;
    context.costs = graded.costs;
    context.notes = input.notes;
    context.changed = input.stone.changed;
    graded.json = grade_json(graded.grade, context);
    graded.input = std::move(input);
    return graded;
}

}  // namespace culet
