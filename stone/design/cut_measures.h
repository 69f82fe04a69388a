#pragma once
// The proportions by which the trade and its laboratories describe a cut. Which corners and facets
// count is decided once; while it stays so, the values are smooth functions of places of corners
// and of inclinations, from which a fit takes its uncertainties.
//
// - `diameter` of a round stone: mean caliper width in plan (perimeter / pi, Cauchy 1832;
//   stone/solid/caliper.h).
// - `width`, `length`: the smallest caliper width and the extent across it.
// - `caliper min`, `max`, `mean`: over all directions in plan. They differ for a girdle of few
//   flats (16 flats: by 2 %), though calipers laid on its corners all read the same.
// - Table of a round stone: twice the mean distance of its corners from their middle; `table min`,
//   `max`: between opposite corners. Of others: its extent along the width. `culet`: likewise.
// - Heights count from the mean heights of the corners of the girdle's edges, so crown, girdle and
//   pavilion add up to the depth. Of round stones also where mains meet the girdle, as
//   laboratories take them. `girdle min`, `max`, `mean`: of all places round the stone.
// - Crown and pavilion angles: mean, least and largest of the mains (`main_facets`).
// - `star length`: of a star, from the table's edge, relative to where the edge below its tip meets
//   the girdle; `lower half length`: from the girdle to the halves' common tip, relative to the
//   culet. Both in plan, means over the stone; of brilliants.
// - Of round stones, the symmetry parameters of Geurts et al. (Gems & Gemology 47 (2011) 286):
//   `out of round`, `table off-centre`, `culet off-centre`, `table/culet` (of the middles of table,
//   culet and outline in plan), and variations (largest less least) of `crown height`, `pavilion
//   depth` and `girdle` where mains meet it, `table`, `crown angle`, `pavilion angle`.
// Percentages are of a round stone's diameter, else of the width.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "stone/design/tiers.h"
#include "stone/solid/solid.h"

namespace culet {

struct CutMeasure {
    std::string name;
    std::string unit;  ///< "length" (of the places), %, deg, or empty
    double value = 0;
};

struct CutRoles {
    std::vector<StonePart> parts;  ///< of each facet
    std::vector<int> crown_mains, pavilion_mains;
};
CutRoles cut_roles(const Solid& solid, const Vec3& up = {0, 0, 1});

class CutMeasures {
public:
    /// z is up. Only the corners' order and places of the solid's facets are used.
    CutMeasures(const Solid& solid, const CutRoles& roles);
    ~CutMeasures();
    CutMeasures(CutMeasures&&) noexcept;

    /// Lengths and their ratios, from the places of the vertices; none without an extent in plan.
    std::vector<CutMeasure> lengths(const std::vector<Vec3>& at) const;
    /// The vertices on which they depend.
    const std::vector<int>& decisive() const;
    /// Angles, deg: sums of facets' inclinations (0 level .. pi / 2 upright, radians), each with
    /// its factor.
    struct Angle {
        std::string name;
        std::vector<std::pair<int, double>> of;
    };
    const std::vector<Angle>& angles() const;

private:
    struct Cut;
    class Values;
    std::unique_ptr<const Cut> cut_;
};

/// All of a solid, z up.
std::vector<CutMeasure> cut_measures(const Solid& solid);

/// What GIA and AGS print: tables to 1 %, crown angles to 0.5 and pavilion angles to 0.2 degrees;
/// or angles and percentages to 0.1.
enum class ReportStyle { plain, gia, ags };
/// The step to which a style rounds; 0: it prints the value as it is, or not at all.
double rounding_step(ReportStyle style, const std::string& name, const std::string& unit);
double rounded_to(double value, double step);

}  // namespace culet
