#pragma once
// Makes a form for the bench: readings for calipers, goniometer and scale, with empty values.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "stone/design/repeating_gear.h"
#include "stone/stone.h"

namespace culet {

/// Standard uncertainties of usual instruments: degrees, mm and carats.
///
/// - Calipers: digital ones are stated to 0.02 mm; 0.02 / sqrt 3 = 0.012, and 0.01 for placing the
///   jaws, in quadrature.
/// - Table: its edge is sighted through a loupe or a graticule of 0.1 mm.
/// - Goniometer: usual ones show 0.1 degrees. A facet below one square millimetre hardly seats; one
///   below 0.6 mm squared is read by its reflection. A value for a whole tier is also off by its
///   differences.
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

/// Rows: the inclination of every main facet; one row for every other tier (a pattern, or a list if
/// none matches); four widths, the depth, two table widths, the weight. `note` has the mesh's
/// value, which is the catalogue's for a standard cut. Names that a reading cannot hold are left
/// out. The first lines explain the form. `stone.up` is up; lengths are in `stone.unit`. Without
/// `has_material` the weight's value is unknown. Facets of a design's tier are named by index
/// (index_names.h).
ReadingsForm readings_form(const Stone& stone, bool has_material, double gear = k_usual_gear,
                           const BenchSigmas& sigmas = {});

/// A stone file for `culet fit`, with paths relative to the folder of `file`. `material` may be
/// empty.
std::string stone_file_text(const Stone& stone, const std::filesystem::path& file,
                            const std::filesystem::path& mesh,
                            const std::filesystem::path& readings, const std::string& material,
                            const std::string& up_facet);

}  // namespace culet
