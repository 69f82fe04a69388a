#pragma once
// The options of `culet optimize`.

#include <optional>
#include <string>

#include "app/input/grade_input.h"
#include "app/program/options.h"

namespace culet {

struct OptimizeCommand {
    CommonOptions common;
    std::string file, out, page, json;
    GradeChoices choices;
    std::string objective = "brilliance", model = "cos", table;
    std::optional<double> index;
    double head_deg = 10, range_deg = 8, over_critical_deg = 0, least_volume_percent = 80;
    int evaluations = 400;
    bool recut = false;
    double gain = 0, most_loss_percent = 10;
};

/// `command` must outlive `optimize`.
void add_optimize_options(CLI::App& optimize, OptimizeCommand& command);

}  // namespace culet
