#pragma once
// --readings, --form and --stone of `cut` and `info`: a form for readings, also as a page to print,
// and a stone file that goes with it.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

#include "stone/design/repeating_gear.h"
#include "stone/stone.h"

namespace culet {

struct FormOptions {
    std::filesystem::path readings, page, stone;
    std::string material;
    double gear = k_usual_gear;  ///< teeth of the design's index wheel
};

/// Adds --readings, --form and --stone; the command itself adds --material.
void add_form_options(CLI::App& command, FormOptions& options);

/// Throws InputError for unwritable files, and for a stone file without a form.
void require_form(const FormOptions& options);

/// `mesh` is the file that holds `stone.solid`. Uses `stone.name`, `unit`, `up`, and the stone's
/// material unless `options` names one. Returns lines for people.
std::vector<std::string> write_form(const FormOptions& options, Stone stone, bool has_material,
                                    const std::filesystem::path& mesh);

/// Reads "6.5mm" or "6,5"; the result is in mm. Throws InputError that names the option.
double length_mm(const std::string& text, const std::string& option);

/// The same for a number in `unit`: mm, %, deg or nothing.
double number_in_unit(const std::string& text, const std::string& unit, const std::string& option);

/// Scales W of `culet info`, the smaller extent along x and y. Throws InputError for a solid
/// without extent and for an impossible width.
void scale_to_width(Solid& solid, double width_mm);

}  // namespace culet
