#pragma once
// A fit of a project's readings, with all that the readings screen shows of it.

#include <memory>
#include <string>

#include "stone/progress/progress.h"
#include "studio/project.h"

namespace culet {

/// JSON: `status`, `card_html`, `look_html`, `stone_html`, `next`, `next_reading`, `rows` (line,
/// off, checked, flag), `drawings`, `seconds`; `solid`, the fitted mesh as OBJ, and `report`, as of
/// culet fit. `start` is the `solid` of an earlier fit of the same stone, or empty. Throws
/// InputError and Interrupted.
std::string fit_for_screen(const LoadedStone& loaded, const std::string& start,
                           const Progress& progress);

/// JSON: the drawing `mesh`, of a stone that was not fitted.
std::string plain_drawings(const Solid& solid);

/// The stone as fitted: `solid` is the mesh of its fit; empty: as its mesh has it. Without a
/// material it is diamond. Throws InputError.
Stone stone_shown(const LoadedStone& loaded, const std::string& solid);

/// The viewer's page (culet view), in which the fitted stone turns beside its mesh. Before a fit,
/// with `solid` and `report` empty, the mesh alone. Throws InputError.
std::string page_of_stone(const LoadedStone& loaded, const std::string& solid,
                          const std::string& report, const std::string& version);

}  // namespace culet
