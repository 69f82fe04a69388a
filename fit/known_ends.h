#pragma once
// Ends that the last stage has come to, and the ways there. From another start, or from another
// proposal, steps often join a way that was gone before: they need not go it again. Private to the
// room.

#include <vector>

#include "fit/settle.h"

namespace culet {

/// All corners within a hundred-thousandth of the half diameter: far below what anything reads.
bool is_same_place(const Shape& one, const Shape& other);

/// Of one relaxation, without corners that are held.
class KnownEnds {
public:
    /// `ways`: shapes at which the readings were asked what they mean, one after another.
    void add(const std::vector<Shape>& ways, const Settled& end);
    /// Where steps from here led before; none: nobody came by.
    const Settled* end_from(const Shape& shape) const;

private:
    struct Known {
        std::vector<Shape> ways;
        Settled end;
    };
    std::vector<Known> known_;
};

}  // namespace culet
