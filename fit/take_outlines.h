#pragma once
// The [[silhouette]] tables of a stone in its fit: the outlines move the mesh first, and what they
// tell of its planes is then weighed against all other readings. Private to the room.

#include <string>
#include <vector>

#include "fit/findings/result.h"
#include "fit/model/options.h"
#include "fit/readings/measurement.h"
#include "stone/stone.h"

namespace culet {

/// Outlines in the mesh's frame turn with the mesh (Stone::file_up).
std::vector<WrittenReading> outlines_turned(const Vec3& file_up,
                                            std::vector<WrittenReading> written);

struct TakenOutlines {
    Stone stone;                    ///< the mesh as the outlines show it
    std::vector<Reading> readings;  ///< of kind silhouette; empty: there are no outlines
    std::vector<std::string> notes;
};
/// Of the written readings those with outlines. Throws InputError for corners of the mesh that are
/// named by number, which outlines move and part.
TakenOutlines take_outlines(const Stone& mesh, const std::vector<WrittenReading>& written);

/// Appends them to the other readings of the stone. Throws InputError for an id that is taken.
void add_outlines(TakenOutlines taken, std::vector<Reading>& readings,
                  std::vector<std::string>& notes);

bool has_outlines(const std::vector<Reading>& readings);
bool has_photographs(const std::vector<Reading>& readings);

/// Each plane lies where it is known to be, and meets are as they come: so beside outlines and
/// photographs. The fit goes on from `stone`, unless it has a start.
FitOptions with_free_corners(const Stone& stone, FitOptions options);

/// The fit goes on from the stone of the outlines, whose corners are where its planes meet. Throws
/// InputError when its options ask for meets of the mesh.
void prepare_for_outlines(const Stone& stone, FitOptions& options);

/// How far the outlines lie from the fitted stone; and whether by more than they are said to.
void describe_outlines(const std::vector<Reading>& readings, FitResult& result);

}  // namespace culet
