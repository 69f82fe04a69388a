#pragma once
// Reads what culet grade grades: stones, meshes and cut designs, with their facets' uncertainty.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fit/findings/result.h"
#include "render/grade/grade.h"
#include "render/uncertainty/drawn_stones.h"
#include "stone/stone.h"

namespace culet {

struct GradeInput {
    std::string name, file;
    Stone stone;  ///< table up; its material counts where `has_material`
    bool has_material = false;
    std::optional<double> index;  ///< the requested one, or that of a cut design without a material
    std::optional<StoneUncertainty> uncertainty;
    bool as_drawn = false;  ///< the mesh that a fit started from
    bool trusted = true;    ///< false: a fit that should not be trusted; `notes` say why
    std::vector<std::string> notes;
};

struct GradeChoices {
    std::string material;          ///< catalogue name or material file; empty: the file's own
    std::optional<double> index;   ///< overrides the material's
    std::filesystem::path report;  ///< of a fit; empty: none
    std::vector<std::string> overrides;
    bool quiet = false;
    const char* command = "culet grade";  ///< the calling command, for messages
    std::string given;                    ///< the command line, for the page
};

/// Fits a stone file that has readings; with `drawn`, its mesh as drawn comes second. Throws
/// InputError.
std::vector<GradeInput> load_for_grade(const std::filesystem::path& file,
                                       const GradeChoices& choices, bool drawn);

void take_fit(const FitResult& result, GradeInput& input);

/// Applies the requested material and index, and turns the stone table up. Throws InputError
/// without material and index.
void make_ready(const GradeChoices& choices, GradeInput& input);

}  // namespace culet
