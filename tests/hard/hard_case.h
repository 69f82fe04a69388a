#pragma once
// The corpus: each case is a small TOML file in its section's folder. tests/hard/README.md
// describes the files.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "stone/text/toml_file.h"

namespace culet::hard {

/// The largest permitted error: the maximum of `limit`, of `per_condition` times the effect of one
/// unit in the last place (2^-52) of the input on the true answer, and of `per_x` times the sweep's
/// value.
struct Allowed {
    double limit = 0, per_condition = 0, per_x = 0;
};

struct HardPoint {
    double x = 0;  ///< NaN in a sweep over words
    std::string label;
    std::vector<std::string> overrides;  ///< of the case's file, for `read_toml`
};

struct HardCase {
    std::filesystem::path file;
    std::string section, name;
    std::string why;  ///< the comment at the top of the file
    std::string title, kind, x_label;
    bool log_x = true;
    std::vector<HardPoint> points;
    std::map<std::string, Allowed> invariants;
    std::string highlight;  ///< the invariant whose chart heads the page
    double seconds = 60;    ///< time limit after which it counts as hanging
    /// False: a library deliberately computes with NaN or the like; `why` says which.
    bool no_invalid_operations = true;
    bool may_be_refused = false;  ///< an InputError is also accepted
};

/// Sections in the page's order.
const std::vector<std::string>& sections();

/// All cases below `folder`, by section and name. Throws InputError for a file without a comment
/// that says why it is hard, without invariants, or with unknown keys.
std::vector<HardCase> read_corpus(const std::filesystem::path& folder);
HardCase read_case(const std::filesystem::path& file);

/// The case's [scene] table at a point as the text of a scene file for `mesh`.
std::string scene_text(const HardCase& hard_case, const HardPoint& point, const std::string& mesh);

}  // namespace culet::hard
