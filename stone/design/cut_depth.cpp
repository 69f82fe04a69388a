#include "stone/design/cut_depth.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <set>

#include "stone/solid/checks.h"

namespace culet {

namespace {

// Least miss per length that facets are cut deeper. The girdle of a standard brilliant, whose mains
// and halves differ by a degree, has 0.006; facets that meet by symmetry have 1e-5, from the
// rounding of the index settings.
constexpr double k_least_miss = 1e-3;
// Cosine: opposite within 2 degrees.
constexpr double k_opposite = -0.9994;

class Depths {
public:
    Depths(const Solid& solid, const std::vector<Vec3>& normals,
           const std::vector<CuttingStep>& list)
        : solid_(solid), normals_(normals), list_(list), at_(solid.vertices.size()) {
        step_of_.assign(solid.facets.size(), list.size());
        for (std::size_t s = 0; s < list.size(); ++s) {
            for (const int f : list[s].facets) step_of_[std::size_t(f)] = s;
        }
        for (std::size_t f = 0; f < solid.facets.size(); ++f) {
            for (const int c : solid.facets[f].corners) at_[std::size_t(c)].push_back(f);
        }
        find_middle();
    }

    CutDepth of(std::size_t step) const {
        const CuttingStep& cut = list_[step];
        if (cut.facets.empty()) return {};
        if (CutDepth stop = stop_of(step); stop.to != CutDepth::To::none) return stop;
        const Facet& facet = facet_of(cut);
        if (cut.part == StonePart::girdle) return across(step);
        const bool level = cut.part == StonePart::table || cut.part == StonePart::culet;
        if (CutDepth across_it = level ? height(step) : CutDepth{};
            across_it.to != CutDepth::To::none)
            return across_it;
        if (CutDepth left = left_of_a_neighbour(step); left.to != CutDepth::To::none) return left;
        if (!level && meet_over_the_middle(cut.facets)) {
            const double top = height_over_middle(facet.plane);
            return {CutDepth::To::point, {}, std::abs(top - rim(cut.part))};
        }
        return {CutDepth::To::distance, {}, std::abs(height_above(facet.plane, middle_))};
    }

private:
    const Facet& facet_of(const CuttingStep& cut) const {
        return solid_.facets[std::size_t(cut.facets.front())];
    }

    // The axis of the index wheel: the design's, or the outline's middle; at the girdle's height.
    void find_middle() {
        Vec3 low(std::numeric_limits<double>::max()), high = -low;
        double sum = 0;
        int count = 0;
        for (std::size_t v = 0; v < solid_.vertices.size(); ++v) {
            low = glm::min(low, solid_.vertices[v]);
            high = glm::max(high, solid_.vertices[v]);
            if (!touches(v, StonePart::girdle)) continue;
            sum += solid_.vertices[v].z;
            ++count;
        }
        middle_ = solid_.design ? Vec3(0) : 0.5 * (low + high);
        middle_.z = count > 0 ? sum / count : 0.5 * (low.z + high.z);
    }

    bool touches(std::size_t corner, StonePart part) const {
        return std::any_of(at_[corner].begin(), at_[corner].end(), [&](std::size_t f) {
            return step_of_[f] < list_.size() && list_[step_of_[f]].part == part;
        });
    }

    // Height of the girdle's edge towards the crown or the pavilion.
    double rim(StonePart part) const {
        double rim = middle_.z;
        bool any = false;
        for (std::size_t v = 0; v < solid_.vertices.size(); ++v) {
            if (!touches(v, part) || !touches(v, StonePart::girdle)) continue;
            const double z = solid_.vertices[v].z;
            const bool outer = part == StonePart::crown ? z < rim : z > rim;
            if (!any || outer) rim = z;
            any = true;
        }
        return rim;
    }

    double height_over_middle(const Plane& plane) const {
        return (plane.offset - plane.normal.x * middle_.x - plane.normal.y * middle_.y) /
               plane.normal.z;
    }

    // True if the facets would meet if nothing else were cut, as nearly as in real designs.
    bool meet_over_the_middle(const std::vector<int>& facets) const {
        double least = 0, most = 0;
        for (std::size_t i = 0; i < facets.size(); ++i) {
            const double z = height_over_middle(solid_.facets[std::size_t(facets[i])].plane);
            least = i == 0 ? z : std::min(least, z);
            most = i == 0 ? z : std::max(most, z);
        }
        return facets.size() >= 3 && most - least <= k_largest_miss * diameter(solid_);
    }

    // By how much the planes at a corner miss (least squares) when those of `step` are cut one unit
    // deeper.
    double miss_of(std::size_t corner, std::size_t step) const {
        glm::dmat3 normal_matrix(0.0);
        Vec3 right(0);
        const auto each = [&](auto use) {
            for (const std::size_t f : at_[corner]) {
                if (step_of_[f] <= step) use(normals_[f], step_of_[f] == step ? 1.0 : 0.0);
            }
        };
        each([&](const Vec3& n, double deeper) {
            normal_matrix += glm::outerProduct(n, n);
            right += deeper * n;
        });
        if (std::abs(glm::determinant(normal_matrix)) < 1e-12) return 0;
        const Vec3 moved = glm::inverse(normal_matrix) * right;
        double squares = 0;
        each([&](const Vec3& n, double deeper) {
            squares += std::pow(glm::dot(n, moved) - deeper, 2);
        });
        return std::sqrt(squares);
    }

    // Of the corners that stop the tier, the one with most facets cut before.
    CutDepth stop_of(std::size_t step) const {
        CutDepth best;
        std::size_t most = 0;
        for (const int facet : list_[step].facets) {
            for (const int c : solid_.facets[std::size_t(facet)].corners) {
                const std::size_t corner = std::size_t(c);
                std::set<std::size_t> tiers;
                std::size_t before = 0, own = 0;
                for (const std::size_t f : at_[corner]) {
                    own += step_of_[f] == step;
                    if (step_of_[f] >= step) continue;
                    ++before;
                    tiers.insert(step_of_[f]);
                }
                const bool meets = before >= 3, pairs = before == 2 && own >= 2;
                if ((!meets && !pairs) || before <= most || miss_of(corner, step) < k_least_miss)
                    continue;
                most = before;
                best.to = meets ? CutDepth::To::meet : CutDepth::To::pair;
                best.at.clear();
                for (const std::size_t tier : tiers) best.at.push_back(list_[tier].tier);
            }
        }
        return best;
    }

    CutDepth across(std::size_t step) const {
        const Plane& plane = facet_of(list_[step]).plane;
        for (std::size_t f = 0; f < solid_.facets.size(); ++f) {
            const Plane& other = solid_.facets[f].plane;
            if (step_of_[f] <= step && glm::dot(plane.normal, other.normal) < k_opposite)
                return {CutDepth::To::width, {}, plane.offset + other.offset};
        }
        return {CutDepth::To::distance, {}, std::abs(height_above(plane, middle_))};
    }

    // The height to the other side, if that is cut already.
    CutDepth height(std::size_t step) const {
        const Plane& plane = facet_of(list_[step]).plane;
        double most = 0;
        bool cut_before = false;
        for (std::size_t v = 0; v < solid_.vertices.size(); ++v) {
            const double below = -height_above(plane, solid_.vertices[v]);
            if (below < most) continue;
            most = below;
            cut_before = std::all_of(at_[v].begin(), at_[v].end(),
                                     [&](std::size_t f) { return step_of_[f] < step; });
        }
        return cut_before ? CutDepth{CutDepth::To::height, {}, most} : CutDepth{};
    }

    // The remaining width of a facet cut before, from its edge with this tier to its farthest
    // corner if that is cut. Girdle facets come first.
    CutDepth left_of_a_neighbour(std::size_t step) const {
        const Facet& facet = facet_of(list_[step]);
        CutDepth best;
        bool of_girdle = false;
        const std::size_t n = facet.corners.size();
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t a = std::size_t(facet.corners[i]),
                              b = std::size_t(facet.corners[(i + 1) % n]);
            for (const std::size_t f : at_[a]) {
                const bool neighbour = std::find(at_[b].begin(), at_[b].end(), f) != at_[b].end();
                if (step_of_[f] >= step || !neighbour) continue;
                const bool girdle = list_[step_of_[f]].part == StonePart::girdle;
                const double left = width_from(solid_.facets[f], a, b, step);
                if (!(left > 0) || (best.to != CutDepth::To::none && (of_girdle || !girdle)))
                    continue;
                best = {CutDepth::To::leave, {list_[step_of_[f]].tier}, left};
                of_girdle = girdle;
            }
        }
        return best;
    }

    // 0 where the farthest corner is not cut yet.
    double width_from(const Facet& facet, std::size_t a, std::size_t b, std::size_t step) const {
        const Vec3 along = glm::normalize(solid_.vertices[b] - solid_.vertices[a]);
        double most = 0;
        bool known = false;
        for (const int c : facet.corners) {
            const Vec3 r = solid_.vertices[std::size_t(c)] - solid_.vertices[a];
            const double away = glm::length(r - glm::dot(r, along) * along);
            if (away <= most) continue;
            most = away;
            const std::vector<std::size_t>& here = at_[std::size_t(c)];
            known = std::count_if(here.begin(), here.end(),
                                  [&](std::size_t f) { return step_of_[f] < step; }) >= 3;
        }
        return known ? most : 0;
    }

    const Solid& solid_;
    const std::vector<Vec3>& normals_;
    const std::vector<CuttingStep>& list_;
    std::vector<std::size_t> step_of_;
    std::vector<std::vector<std::size_t>> at_;  // facets by corner
    Vec3 middle_{0, 0, 0};
};

}  // namespace

void find_depths(const Solid& solid, const std::vector<Vec3>& normals,
                 std::vector<CuttingStep>& list) {
    const Depths depths(solid, normals, list);
    for (std::size_t s = 0; s < list.size(); ++s) list[s].depth = depths.of(s);
}

}  // namespace culet
