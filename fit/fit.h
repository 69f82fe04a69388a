#pragma once
// Front door of the room: which stone explains the measurements.
//
// The mesh gives the facets, which of them meet where, and a start; the readings move it. Facet
// planes and meets are fitted together by least squares, each reading weighted by 1/sigma^2, under
// hard constraints: every facet is planar, exact readings hold exactly, and so do the meets of the
// mesh unless they are told to be soft or released.

#include <filesystem>

#include "fit/findings/result.h"
#include "fit/model/options.h"
#include "stone/progress/progress.h"

namespace culet {

/// A mesh and the readings that are bound to it.
struct FitInput {
    Stone stone;
    std::vector<Reading> readings;
    std::vector<std::string> notes;  ///< what was done to the mesh, and what was taken for what
};

/// Repairs the mesh as it was drawn and binds the readings to it. Throws InputError, with file and
/// line, as `bind_readings` does.
FitInput fit_input(const Stone& drawn, const std::vector<WrittenReading>& written);

/// Fits the stone to its readings. The result keeps the mesh's facet names and its pose, but for
/// one turn: an up direction within 20 degrees of a coordinate axis comes to lie on it exactly.
/// Throws InputError when the mesh is not a closed solid or a relation cannot be found on it.
FitResult fit_stone(const FitInput& input, const FitOptions& options = {},
                    const Progress& progress = {});

/// The same for a mesh that needs no repair, and readings bound to it.
FitResult fit_stone(const Stone& stone, const std::vector<Reading>& readings,
                    const FitOptions& options = {}, const Progress& progress = {});

/// Which symmetry the readings support, and how well they could have told otherwise
/// (findings/symmetry_tests.h): of a fit without the readings that declare it. `options.start` may
/// be the stone as fitted with them. Throws InputError as `fit_stone` does.
SymmetryReport find_symmetry(const Stone& stone, const std::vector<Reading>& readings,
                             const FitOptions& options = {}, const Progress& progress = {});

/// The stone with the fitted solid, which stands upright: its up direction is +z.
Stone fitted_stone(const Stone& drawn, const FitResult& result);

/// Throws InputError, which names `file`, unless `start` has every facet of the mesh: an earlier
/// result of the same stone, for FitOptions::start.
void require_earlier_result(const Solid& start, const Solid& mesh,
                            const std::filesystem::path& file);

/// One JSON object, degrees and the stone's unit (`schema` 1).
std::string fit_report(const FitResult& result);

}  // namespace culet
