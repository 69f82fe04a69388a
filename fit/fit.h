#pragma once
// The room's main header: finds the stone that explains the measurements.
//
// The mesh gives the facets, the meets and a start; the readings move it. Facet planes and meets
// are fitted together by least squares. Each reading is weighted by 1/sigma^2. Constraints are
// hard: every facet is planar, exact readings hold exactly, and so do the mesh's meets unless they
// are soft or released.

#include <filesystem>

#include "fit/findings/result.h"
#include "fit/model/options.h"
#include "stone/progress/progress.h"

namespace culet {

/// A mesh and the readings that are bound to it.
struct FitInput {
    Stone stone;
    std::vector<Reading> readings;
    std::vector<std::string> notes;  ///< changes made to the mesh, and how readings were taken
};

/// Repairs the mesh and binds the readings to it. Throws InputError with file and line, as
/// `bind_readings` does.
FitInput fit_input(const Stone& drawn, const std::vector<WrittenReading>& written);

/// Fits the stone to its readings. The result keeps the mesh's facet names and its pose, with one
/// exception: an up direction within 20 degrees of a coordinate axis is turned exactly onto it.
/// Throws InputError when the mesh is not a closed solid or lacks facets that a relation (symmetry,
/// parallel facets) needs.
FitResult fit_stone(const FitInput& input, const FitOptions& options = {},
                    const Progress& progress = {});

/// The same for a mesh that needs no repair, and readings bound to it.
FitResult fit_stone(const Stone& stone, const std::vector<Reading>& readings,
                    const FitOptions& options = {}, const Progress& progress = {});

/// Fits the stone without the readings that declare its symmetry, and reports which symmetry the
/// other readings support and how well they could have detected deviations
/// (findings/symmetry_tests.h). `options.start` may be the stone as fitted with them. Throws
/// InputError as `fit_stone` does.
SymmetryReport find_symmetry(const Stone& stone, const std::vector<Reading>& readings,
                             const FitOptions& options = {}, const Progress& progress = {});

/// Replaces the stone's solid by the fitted one, which is upright: up is +z.
Stone fitted_stone(const Stone& drawn, const FitResult& result);

/// Throws InputError, naming `file`, unless `start` has every facet of the mesh. `start` is an
/// earlier result of the same stone, for FitOptions::start.
void require_earlier_result(const Solid& start, const Solid& mesh,
                            const std::filesystem::path& file);

/// Returns one JSON object in degrees and the stone's unit (`schema` 1).
std::string fit_report(const FitResult& result);

}  // namespace culet
