#pragma once
// A form for the bench: the readings that calipers, a goniometer and a scale give of a stone, with
// the value of each left empty.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "stone/design/repeating_gear.h"
#include "stone/stone.h"

namespace culet {

/// Standard uncertainties of usual instruments, degrees, mm and carat.
///
/// Calipers: makers of digital ones state an error of up to 0.02 mm: 0.02 / sqrt 3 = 0.012, and
/// 0.01 for the jaws' place, added in squares. Table: its edge is sighted, through a loupe or a
/// graticule of 0.1 mm. Goniometer: those of the bench show 0.1 degrees; a facet of less than a
/// square millimetre hardly seats, one of less than 0.6 mm squared is read by its reflection alone.
/// A value for all facets of a tier is also off by as much as they differ from each other. Scale:
/// carat balances show 0.01 ct, of which half a step may be lost.
struct BenchSigmas {
    double caliper_mm = 0.015, table_mm = 0.03, scale_ct = 0.005;
    double large_facet_deg = 0.1, small_facet_deg = 0.2, tiny_facet_deg = 0.3, tier_deg = 0.3;
};

struct FormRow {
    std::string kind, of;
    double sigma = 0;
    std::string note;  ///< what the mesh would read, and at which index
};

struct ReadingsForm {
    std::string csv;
    std::vector<FormRow> rows;
    std::string up_facet;  ///< the table; empty: the mesh has none
};

/// Rows: the inclination of every main facet; of every other tier one row for all of its facets (a
/// pattern, or, where its names have none, their list); four widths, the depth, the table's width
/// in two directions, the weight. `note` tells what the mesh would read: the catalogue's value of a
/// standard cut. Names that a reading cannot hold are left out. The first lines say how the form
/// is filled in. `stone.up` is up; lengths are in `stone.unit`. `has_material`: without one the
/// weight's value is not known. Facets of a design's tier are named by its index (index_names.h).
ReadingsForm readings_form(const Stone& stone, bool has_material, double gear = k_usual_gear,
                           const BenchSigmas& sigmas = {});

/// A stone file for `culet fit`, of a mesh and a form that lie where these paths say, as seen from
/// `file`'s folder. `material` may be empty.
std::string stone_file_text(const Stone& stone, const std::filesystem::path& file,
                            const std::filesystem::path& mesh,
                            const std::filesystem::path& readings, const std::string& material,
                            const std::string& up_facet);

}  // namespace culet
