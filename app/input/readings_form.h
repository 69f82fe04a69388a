#pragma once
// --readings, --form and --stone of `cut` and `info`: a form for the bench, to be printed too, and
// a stone file beside it.

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
    double gear = k_usual_gear;  ///< teeth of the index wheel, the design's
};

/// Adds --readings, --form and --stone; --material is the command's own.
void add_form_options(CLI::App& command, FormOptions& options);

/// Throws InputError for what could not be written, and for a stone file without a form.
void require_form(const FormOptions& options);

/// Writes what was asked for. `mesh` is the file that holds `stone.solid`; `stone.name`, `unit` and
/// `up` are used, and its material unless `options` names one. Returns lines for people.
std::vector<std::string> write_form(const FormOptions& options, Stone stone, bool has_material,
                                    const std::filesystem::path& mesh);

/// An option's number as people write it, "6.5mm" or "6,5": in mm. Throws InputError that names
/// the option.
double length_mm(const std::string& text, const std::string& option);

/// The same for a number that counts in `unit`: mm, %, deg or nothing.
double number_in_unit(const std::string& text, const std::string& unit, const std::string& option);

/// Makes W of `culet info` (the smaller extent along x and y) so many mm: the solid is in mm then.
/// Throws InputError for a solid without extent and for a width that cannot be.
void scale_to_width(Solid& solid, double width_mm);

}  // namespace culet
