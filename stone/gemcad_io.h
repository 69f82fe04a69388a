#pragma once
// GemCad cut designs: .asc (text) and .gem (binary).

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "stone/mesh_io.h"
#include "stone/solid.h"

namespace culet {

/// What a cut file says beside its facets.
struct CutSheet {
    double gear = 96;  ///< index teeth; negative counts clockwise
    double gear_offset = 0;
    int symmetry = 1;
    bool mirror = false;
    std::optional<double> refractive_index;
    std::vector<std::string> headings, footnotes;
};

struct ReadCut {
    Solid solid;
    CutSheet sheet;
    std::vector<std::string> notes;
};

struct CutReading {
    /// Meets that miss by less than this fraction of the stone's width become one corner (0: none).
    /// Real files miss by 1e-5 to 3e-4.
    double meet_tolerance = 3e-4;
};

ReadCut read_gemcad_asc(const std::filesystem::path& file, const CutReading& how = {});
ReadCut read_gemcad_gem(const std::filesystem::path& file, const CutReading& how = {});

/// Writes angle, distance and index of every facet so that its plane reads back to 1e-12.
void write_gemcad_asc(const Solid& solid, const CutSheet& sheet, const std::filesystem::path& file);

}  // namespace culet
