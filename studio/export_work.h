#pragma once
// Files that are made of a project's stone for people and other programs.

#include <string>

#include "stone/progress/progress.h"
#include "studio/project.h"

namespace culet {

struct FittedStone {
    std::string solid, report;  ///< of the last fit (fit_work.h); empty: none
};

/// A file of the kind that an ending names: html, the report; png, a picture; or one of
/// `exported` (exported_stone.h). One line of JSON with `file`, its name, and `notes`, what the
/// format could not keep; then the file's bytes. It shows the fitted stone, or before a fit the
/// mesh. Writes nothing. Throws InputError and Interrupted.
std::string exported_file(const LoadedStone& loaded, const FittedStone& fitted,
                          const std::string& kind, const std::string& version,
                          const Progress& progress);

}  // namespace culet
