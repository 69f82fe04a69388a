#pragma once
// The report page: one self-contained HTML file that needs no network.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/calibration/calibrated_verdict.h"
#include "compare/photo/photo.h"
#include "compare/scores/compare.h"
#include "stone/solid/solid.h"

namespace culet {

struct ReportFile {
    std::string role;  ///< "photograph", "render", "stone", ...
    std::string name;
};

/// Every part is optional: a section appears when its data is there.
struct Report {
    std::string title = "culet report";
    std::string version;  ///< of the program
    std::string command;  ///< as typed
    std::vector<ReportFile> files;

    std::optional<Comparison> comparison;  ///< photo against render
    std::optional<CalibratedVerdict> calibrated;
    std::string scores_json;  ///< the output of --json; empty: made from `comparison`

    std::string fit_json;           ///< the fit report, as written by `culet fit --report`
    std::optional<Solid> fitted;    ///< drawn with its facets coloured by their readings' residuals
    std::optional<Solid> starting;  ///< the hand-made or catalogue mesh, for the table of changes
    std::string length_unit = "mm";

    /// The same scene with the starting mesh and with the fitted one, in one size.
    std::optional<Photo> starting_render, fitted_render;
    double renders_white =
        0;  ///< linear value shown as white; 0: chosen so that the stone is well exposed

    /// PNG bytes: the photograph with the pose's edges; empty: none.
    std::string pose_overlay_png;
    bool pose_used = false;

    /// A viewer page with the stone, opened from the picture; empty: none.
    std::string viewer_html;

    std::string certificate;  ///< a page beside this one; empty: none

    std::string stats_json;  ///< of the renderer: plan, error bounds, times
    std::string settings;    ///< the job or scene as text
};

/// Throws InputError for invalid JSON texts.
std::string report_page(const Report& report);

/// What the page says of `report.comparison`, as HTML without a page around it: verdict, pictures,
/// maps, scores and registration. Empty without one.
std::string comparison_part(const Report& report);

/// Writes the whole page or nothing.
void write_report(const Report& report, const std::filesystem::path& file);

}  // namespace culet
