#pragma once
// Takes a stone's [[silhouette]] tables into its fit. The outlines first move the mesh; what they
// tell of its planes is then weighted like all other readings. Private to the room.

#include <string>
#include <vector>

#include "fit/findings/result.h"
#include "fit/model/options.h"
#include "fit/readings/measurement.h"
#include "stone/stone.h"

namespace culet {

/// Turns outlines and projections given in the file's frame as the mesh was (Stone::file_up).
std::vector<WrittenReading> turned_with_mesh(const Vec3& file_up,
                                             std::vector<WrittenReading> written);

struct TakenOutlines {
    Stone stone;                    ///< the mesh, fitted to the outlines
    std::vector<Reading> readings;  ///< of kind silhouette; empty without outlines
    std::vector<std::string> notes;
};
/// Throws InputError for corners of the mesh that are named by number: outlines move and split
/// them.
TakenOutlines take_outlines(const Stone& mesh, const std::vector<WrittenReading>& written);

/// Throws InputError when an id is taken.
void add_outlines(TakenOutlines taken, std::vector<Reading>& readings,
                  std::vector<std::string>& notes);

bool has_outlines(const std::vector<Reading>& readings);
bool has_photographs(const std::vector<Reading>& readings);

/// For readings of outlines and photographs, which locate each plane: meets are released, and the
/// fit starts from `stone` unless the options have a start.
FitOptions with_free_corners(const Stone& stone, FitOptions options);

/// Starts the fit from the stone of the outlines, with released meets. Throws InputError when the
/// options ask for other meets.
void prepare_for_outlines(const Stone& stone, FitOptions& options);

/// Reports how far the outlines lie from the fitted stone, and marks the result contradictory when
/// that is more than their sigma allows.
void describe_outlines(const std::vector<Reading>& readings, FitResult& result);

}  // namespace culet
