#pragma once
// Makes a form for the bench: the readings that calipers, a goniometer and a scale give of a stone,
// with empty values.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "stone/design/repeating_gear.h"
#include "stone/stone.h"

namespace culet {

/// Standard uncertainties of usual instruments: degrees, mm and carats.
///
/// - Calipers: makers of digital ones state an error of up to 0.02 mm; 0.02 / sqrt 3 = 0.012, and
///   0.01 for the placing of the jaws, in quadrature.
/// - Table: its edge is sighted through a loupe or a graticule of 0.1 mm.
/// - Goniometer: usual ones show 0.1 degrees. A facet below one square millimetre hardly seats; one
///   below 0.6 mm squared is read by its reflection alone. A value for all facets of a tier is also
///   off by their differences.
/// - Scale: carat balances show 0.01 ct; half a step may be lost.
struct BenchSigmas {
    double caliper_mm = 0.015, table_mm = 0.03, scale_ct = 0.005;
    double large_facet_deg = 0.1, small_facet_deg = 0.2, tiny_facet_deg = 0.3, tier_deg = 0.3;
};

struct FormRow {
    std::string kind, of;
    double sigma = 0;
    std::string note;  ///< the mesh's value and index
};

struct ReadingsForm {
    std::string csv;
    std::vector<FormRow> rows;
    std::string up_facet;  ///< the table; empty if the mesh has none
};

/// Makes the form. Its rows are the inclination of every main facet; for every other tier one row
/// for all its facets (a pattern, or a list if no pattern matches them); four widths, the depth,
/// the table's width in two directions, and the weight. `note` has the mesh's value, which is the
/// catalogue's for a standard cut. Names that a reading cannot hold are left out. The first lines
/// explain how to fill in the form.
/// Up is `stone.up`; lengths are in `stone.unit`. Without `has_material` the weight's value is
/// unknown. Facets of a design's tier are named by index (index_names.h).
ReadingsForm readings_form(const Stone& stone, bool has_material, double gear = k_usual_gear,
                           const BenchSigmas& sigmas = {});

/// Makes a stone file for `culet fit`, with the paths of mesh and form relative to the folder of
/// `file`. `material` may be empty.
std::string stone_file_text(const Stone& stone, const std::filesystem::path& file,
                            const std::filesystem::path& mesh,
                            const std::filesystem::path& readings, const std::string& material,
                            const std::string& up_facet);

}  // namespace culet
