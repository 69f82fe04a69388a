#pragma once
// What `rotation` and `mirror` readings mean for the model: pairs of facets and their images, extra
// unknowns, and the exact motions of the whole stone.

#include <optional>
#include <utility>
#include <vector>

#include "fit/model/frame.h"
#include "fit/model/orbits.h"
#include "fit/model/parameters.h"

namespace culet {

class Symmetries {
public:
    /// Appends the extra unknowns to `shape`. `splits`: some meet may come apart, so that the
    /// parameters keep no symmetry. Throws InputError where facets have no partners.
    Symmetries(const Stone& stone, const Frame& frame, const std::vector<Reading>& readings,
               bool splits, Shape& shape);

    /// Facets and their images under reading r.
    const std::vector<std::pair<int, int>>& pairs(std::size_t r) const { return pairs_[r]; }
    /// Index of the first extra unknown of reading r, or -1.
    int first_extra(std::size_t r) const { return first_extra_[r]; }
    /// The motions of exact rotations and mirrors of the whole stone. Empty when some meet is not
    /// exact. A mirror of facets in pairs is left out when a reading would see its azimuth.
    const std::vector<SymmetryMotion>& exact_motions() const { return exact_motions_; }
    /// Whether the parameters keep reading r exactly, so that it needs no equations.
    bool is_kept_by_parameters(std::size_t r) const {
        return first_extra_[r] >= 0 && fixed_extras_[std::size_t(first_extra_[r])];
    }
    /// The solver's parameters for `shape`, without what exact symmetry repeats.
    Parameters parameters(const Shape& shape, int up_facet) const;

private:
    void add_extras(const std::vector<Reading>& readings, Shape& shape);
    void find_exchanges(const Frame& frame, const std::vector<Reading>& readings);
    void pair_facets(const std::vector<Reading>& readings, const Shape& shape);
    void list_exact_motions(const Stone& stone, const Frame& frame,
                            const std::vector<Reading>& readings, Shape& shape);

    std::vector<int> first_extra_;
    std::vector<bool> fixed_extras_;
    std::vector<std::vector<std::pair<int, int>>> pairs_;
    std::vector<std::optional<Automorphism>> exchanges_;  // for readings of all facets
    std::vector<SymmetryMotion> exact_motions_;
};

}  // namespace culet
