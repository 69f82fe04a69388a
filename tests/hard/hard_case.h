#pragma once
// The corpus: each case is a small TOML file in a folder that names its section.
// tests/hard/README.md says what stands in it.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "stone/text/toml_file.h"

namespace culet::hard {

/// How far a figure may be off: `limit`, or `per_condition` times what one unit in the last place
/// (2^-52) of the input does to the true answer, or `per_x` times the sweep's value, whichever is
/// most.
struct Allowed {
    double limit = 0, per_condition = 0, per_x = 0;
};

/// One step of a sweep.
struct HardPoint {
    double x = 0;  ///< NaN where the sweep is over words
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
    std::string highlight;  ///< the invariant whose chart stands at the top of the page
    double seconds = 60;    ///< after which it counts as hanging
    /// False: a library behind it computes with NaN or the like on purpose; `why` says which.
    bool no_invalid_operations = true;
    bool may_be_refused = false;  ///< an InputError is as good an answer
};

/// Sections in the order of the page.
const std::vector<std::string>& sections();

/// All cases below `folder`, by section and name. Throws InputError for a file without a comment
/// that says why it is hard, without invariants, or with unknown keys.
std::vector<HardCase> read_corpus(const std::filesystem::path& folder);
HardCase read_case(const std::filesystem::path& file);

/// The case's [scene] table at a point as the text of a scene file of its own, around `mesh`.
std::string scene_text(const HardCase& hard_case, const HardPoint& point, const std::string& mesh);

}  // namespace culet::hard
