#pragma once
// Reads the stone that culet convert writes for other programs.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "stone/gemcad/gemcad_io.h"
#include "stone/stone.h"

namespace culet {

struct ExportChoices {
    std::vector<std::string> overrides;  ///< for a stone file or scene
    CutReading cut;
    std::string material;  ///< catalogue name or material file; empty: the file's own
    std::optional<double> width_mm;
};

struct ExportInput {
    Stone stone;  ///< in mm, in the frame of `in_export_frame`
    bool has_material = false;
    std::vector<std::string> notes, details;
};

/// A mesh (in mm), a cut design, a stone file (as drawn, without a fit) or the stone of a scene.
/// What has no size gets the usual width, with a note. Throws InputError.
ExportInput read_for_export(const std::filesystem::path& file, const ExportChoices& choices);

}  // namespace culet
