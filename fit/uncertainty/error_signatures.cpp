#include "fit/uncertainty/error_signatures.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace culet {

ErrorSignatures::ErrorSignatures(const System& system, const Shape& shape, const Outline& outline,
                                 const Linearised& linear)
    : system_(system), net_(shape, outline), linear_(linear), by_corner_(net_.places().size()) {
    for (std::size_t i = 0; i < linear.soft.size(); ++i) list(Index(i), outline);
}

std::vector<Eigen::Index> ErrorSignatures::touched_by(const CutOff& off) const {
    std::vector<Index> touched = volumes_;
    for (const int corner : off.gone) {
        const std::vector<Index>& here = by_corner_[std::size_t(corner)];
        touched.insert(touched.end(), here.begin(), here.end());
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    return touched;
}

std::vector<std::pair<Eigen::Index, double>> ErrorSignatures::of(
    const Plane& plane, const CutOff& off, const std::vector<Index>& touched) const {
    std::vector<std::pair<Index, double>> signature;
    for (const Index i : touched) {
        const double change = change_of(i, plane, off);
        if (change != 0) {
            signature.emplace_back(i, change / linear_.soft[std::size_t(i)].sigma);
        }
    }
    return signature;
}

const Reading& ErrorSignatures::reading_of(Index i) const {
    return system_.readings()[std::size_t(linear_.soft[std::size_t(i)].reading)];
}

// Which corners a reading depends on.
void ErrorSignatures::list(Index i, const Outline& outline) {
    const Equation& e = linear_.soft[std::size_t(i)];
    if (e.role != Equation::Role::reading || e.reading < 0) return;
    const Reading& reading = reading_of(i);
    switch (reading.kind) {
        case ReadingKind::edge:
            if (reading.aggregate == Aggregate::min || reading.aggregate == Aggregate::max) {
                return;
            }
            for (std::size_t k = 0; k + 1 < reading.facets.size(); k += 2) {
                if (const auto ends = net_.edge(reading.facets[k], reading.facets[k + 1])) {
                    by_corner_[std::size_t(ends->first)].push_back(i);
                    by_corner_[std::size_t(ends->second)].push_back(i);
                }
            }
            return;
        case ReadingKind::width:
        case ReadingKind::depth:
        case ReadingKind::table_width:
            for (const Corner& touched : e.touched) {
                const Vec3 side = &touched == e.touched.data() ? e.caliper : -e.caliper;
                const int facet =
                    reading.kind == ReadingKind::table_width ? system_.up_facet() : -1;
                const double most = net_.reach(side, {}, facet);
                for (std::size_t c = 0; c < net_.places().size(); ++c) {
                    // Corners as far out stand for each other.
                    if (glm::dot(side, net_.places()[c]) > most - 1e-9) {
                        by_corner_[c].push_back(i);
                    }
                }
            }
            return;
        case ReadingKind::distance:
            for (const Place& place : reading.places) {
                if (place.kind != Place::Kind::vertex) continue;
                for (std::size_t c = 0; c < outline.corners.size(); ++c) {
                    if (outline.corners[c].point == place.vertex) {
                        by_corner_[c].push_back(i);
                    }
                }
            }
            return;
        case ReadingKind::volume:
        case ReadingKind::weight:
            volumes_.push_back(i);
            return;
        default:
            return;
    }
}

double ErrorSignatures::change_of(Index i, const Plane& plane, const CutOff& off) const {
    const Equation& e = linear_.soft[std::size_t(i)];
    const Reading& reading = reading_of(i);
    switch (reading.kind) {
        case ReadingKind::edge: {
            double change = 0;
            for (std::size_t k = 0; k + 1 < reading.facets.size(); k += 2) {
                const auto ends = net_.edge(reading.facets[k], reading.facets[k + 1]);
                if (!ends) continue;
                change += net_.edge_length(ends->first, ends->second, off) -
                          net_.edge_length(ends->first, ends->second, {});
            }
            return change / (0.5 * double(reading.facets.size()));
        }
        case ReadingKind::width:
        case ReadingKind::depth:
        case ReadingKind::table_width: {
            const int facet = reading.kind == ReadingKind::table_width ? system_.up_facet() : -1;
            const Vec3& d = e.caliper;
            return net_.reach(d, off, facet) + net_.reach(-d, off, facet) -
                   net_.reach(d, {}, facet) - net_.reach(-d, {}, facet);
        }
        case ReadingKind::distance: {
            // From a facet to what is now the highest place above it.
            Place a = reading.places[0], b = reading.places[1];
            if (a.kind > b.kind) std::swap(a, b);
            if (a.kind != Place::Kind::facet || b.kind != Place::Kind::vertex) return 0;
            const Vec3 away = -normal_of(a.facet);
            double before = -1e300, after = -1e300;
            for (const int c : off.gone) {
                before = std::max(before, glm::dot(away, net_.places()[std::size_t(c)]));
            }
            for (const CutOff::NewCorner& c : off.made) {
                after = std::max(after, glm::dot(away, c.place));
            }
            return std::min(0.0, after - before);
        }
        default:
            return -net_.volume(plane, off);
    }
}

Vec3 ErrorSignatures::normal_of(int facet) const {
    const std::vector<int>& loop = net_.loop(facet);
    std::vector<Vec3> corners;
    for (const int c : loop) corners.push_back(net_.places()[std::size_t(c)]);
    return plane_through(corners).normal;
}

}  // namespace culet
