#pragma once
// A fit of a project's readings, with all that the readings screen shows of it.

#include <memory>
#include <string>

#include "stone/progress/progress.h"
#include "studio/project.h"

namespace culet {

/// JSON: `status`, `card_html`, `look_html`, `next`, `next_reading`, `rows` (line, off, checked,
/// flag), `drawings`, `seconds`, and `solid`, the fitted mesh as OBJ. `start` is the `solid` of an
/// earlier fit of the same stone, or empty. Throws InputError and Interrupted.
std::string fit_for_screen(const LoadedStone& loaded, const std::string& start,
                           const Progress& progress);

/// JSON: the drawing `mesh`, of a stone that was not fitted.
std::string plain_drawings(const Solid& solid);

}  // namespace culet
