#pragma once
// What culet grade grades: stones, meshes and cut designs, and how sure their facets are.

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
    std::optional<double> index;  ///< as asked for, or of a cut design without a material
    std::optional<StoneUncertainty> uncertainty;
    bool as_drawn = false;  ///< the mesh that a fit began with
    bool trusted = true;    ///< false: a fit that should not be trusted; `notes` say why
    std::vector<std::string> notes;
};

struct GradeChoices {
    std::string material;          ///< catalogue name or material file; empty: the file's own
    std::optional<double> index;   ///< overrides the material's
    std::filesystem::path report;  ///< of a fit; empty: none
    std::vector<std::string> overrides;
    bool quiet = false;
    const char* command = "culet grade";  ///< who asks, for messages
    std::string given;                    ///< the command line, for the page
};

/// A stone file with readings is fitted; `drawn`: its mesh as it was drawn comes second. Throws
/// InputError.
std::vector<GradeInput> load_for_grade(const std::filesystem::path& file,
                                       const GradeChoices& choices, bool drawn);

/// The stone as fitted in place of the one as drawn, with how sure its facets are.
void take_fit(const FitResult& result, GradeInput& input);

/// What was asked for in place of the file's own material and index, and the stone table up, as
/// `load_for_grade` does it. Throws InputError where there is neither material nor index.
void make_ready(const GradeChoices& choices, GradeInput& input);

}  // namespace culet
