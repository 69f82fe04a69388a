#pragma once
// The kinds of hard cases. A kind builds a subject from the parameters of a case's file; the
// subject measures the invariants that the file names.

#include <functional>
#include <limits>
#include <map>
#include <string>

#include "tests/hard/hard_case.h"

namespace culet::hard {

struct Measured {
    double error = 0;  ///< compared with the invariant's limit; NaN fails
    /// Change of the true answer, in units in its last place, per unit in the last place of the
    /// input; NaN: not measured.
    double condition = std::numeric_limits<double>::quiet_NaN();
    std::string about;  ///< for people, when it fails
};

using Measure = std::function<Measured()>;

struct Subject {
    std::map<std::string, Measure> invariants;
    /// Textbook methods for the same figure as the invariant of that name.
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
