#include "app/input/cut_symmetry.h"

#include <fmt/format.h>

#include "app/program/file_kinds.h"
#include "stone/cuts/cuts.h"
#include "stone/solid/checks.h"
#include "stone/solid_input.h"
#include "stone/text/errors.h"

namespace culet {

GivenCut given_cut(const std::string& cut) {
    const Solid solid = is_solid_file(cut) ? load_solid(cut).solid : make_cut(cut);
    const std::optional<CutSymmetry> symmetry = symmetry_of(solid);
    if (!symmetry)
        throw InputError(cut, "this cut repeats no facet about its axis; leave --cut out");
    return {*symmetry, is_convex(solid)};
}

std::string words_of(const CutSymmetry& symmetry) {
    const std::string mirrored = symmetry.mirrors ? " and mirrored" : "";
    if (symmetry.order == 1) return "mirrored";
    return fmt::format("{} times around the axis{}", symmetry.order, mirrored);
}

}  // namespace culet
