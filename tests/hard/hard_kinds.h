#pragma once
// What can be asked of a hard case. A kind of case makes, from the parameters of its file, a
// subject: what its invariants measure, by the names that the file uses.

#include <functional>
#include <limits>
#include <map>
#include <string>

#include "tests/hard/hard_case.h"

namespace culet::hard {

struct Measured {
    double error = 0;  ///< against the invariant's limit; NaN fails
    /// How much more than itself one unit in the last place of the input does to the true answer;
    /// NaN: not measured.
    double condition = std::numeric_limits<double>::quiet_NaN();
    std::string about;  ///< for people, when it fails
};

using Measure = std::function<Measured()>;

struct Subject {
    std::map<std::string, Measure> invariants;
    /// Textbook ways to the same figure as the invariant of that name.
    struct Contrast {
        std::string invariant, name;
        Measure measure;
    };
    std::vector<Contrast> contrasts;
};

using MakeSubject = Subject (*)(const HardCase&, const HardPoint&, const TomlTable& parameters);

Subject solid_subject(const HardCase&, const HardPoint&, const TomlTable&);
Subject face_subject(const HardCase&, const HardPoint&, const TomlTable&);
Subject crystal_subject(const HardCase&, const HardPoint&, const TomlTable&);
Subject ray_subject(const HardCase&, const HardPoint&, const TomlTable&);
Subject picture_subject(const HardCase&, const HardPoint&, const TomlTable&);
Subject fit_subject(const HardCase&, const HardPoint&, const TomlTable&);
Subject photograph_subject(const HardCase&, const HardPoint&, const TomlTable&);

}  // namespace culet::hard
