// Finds the image of each facet under a rotation or a mirror.

#include "fit/model/symmetries.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

#include "stone/text/errors.h"

namespace culet {

namespace {

using Pairs = std::vector<std::pair<int, int>>;

// The best partner of each facet under a map of planes; empty when two share one.
template <typename Map>
std::vector<int> partners(const Shape& shape, const std::vector<int>& facets, Map map) {
    std::vector<int> result;
    std::set<int> taken;
    for (int f : facets) {
        const Plane image = map(Plane{shape.normals[f], shape.offsets[f]});
        int best = -1;
        double least = 1e300;
        for (int g : facets) {
            const Vec3 d = image.normal - shape.normals[g];
            const double shift = image.offset - shape.offsets[g];
            const double distance = glm::dot(d, d) + shift * shift;
            if (distance < least) {
                least = distance;
                best = g;
            }
        }
        if (!taken.insert(best).second) return {};
        result.push_back(best);
    }
    return result;
}

std::vector<int> all_facets(const Shape& shape) {
    std::vector<int> facets(shape.normals.size());
    for (std::size_t f = 0; f < facets.size(); ++f) facets[f] = static_cast<int>(f);
    return facets;
}

std::vector<int> rotation_partners(const Shape& shape, const Reading& reading,
                                   const std::vector<int>& facets) {
    const double angle = 2 * std::numbers::pi / reading.order;
    const glm::dmat3 turn = turn_about_z(angle);
    std::vector<int> found = partners(shape, facets, [&](const Plane& plane) {
        return Plane{turn * plane.normal, plane.offset};
    });
    if (!found.empty()) return found;
    // On a rough mesh, order the facets of one tier by azimuth.
    const std::size_t order = static_cast<std::size_t>(reading.order);
    if (!reading.facets.empty() && facets.size() % order == 0) {
        std::vector<std::size_t> by_azimuth(facets.size());
        for (std::size_t i = 0; i < facets.size(); ++i) by_azimuth[i] = i;
        std::sort(by_azimuth.begin(), by_azimuth.end(), [&](std::size_t a, std::size_t b) {
            return azimuth(shape.normals[facets[a]]) < azimuth(shape.normals[facets[b]]);
        });
        found.assign(facets.size(), -1);
        for (std::size_t i = 0; i < facets.size(); ++i) {
            const std::size_t next = (i + facets.size() / order) % facets.size();
            found[by_azimuth[i]] = facets[by_azimuth[next]];
        }
        return found;
    }
    throw InputError(
        reading.file, reading.line,
        fmt::format("rotation '{}': the mesh does not look like itself after a turn of 1/{}; name "
                    "the facets that do",
                    reading.id, reading.order));
}

std::vector<int> mirror_partners(const Shape& shape, const Reading& reading,
                                 const std::vector<int>& facets) {
    const Vec3 m{std::cos(reading.azimuth), std::sin(reading.azimuth), 0};
    const std::vector<int> found = partners(shape, facets, [&](const Plane& plane) {
        return Plane{plane.normal - 2 * glm::dot(m, plane.normal) * m, plane.offset};
    });
    if (!found.empty()) return found;
    throw InputError(
        reading.file, reading.line,
        fmt::format("mirror '{}': the mesh does not look like its mirror image; name the facets in "
                    "pairs",
                    reading.id));
}

}  // namespace

void Symmetries::pair_facets(const std::vector<Reading>& readings, const Shape& shape) {
    pairs_.resize(readings.size());
    for (std::size_t r = 0; r < readings.size(); ++r) {
        const Reading& reading = readings[r];
        Pairs& pairs = pairs_[r];
        const std::vector<int> facets = reading.facets.empty() ? all_facets(shape) : reading.facets;
        // The images by the topology's symmetry, where it is known.
        const auto images_of = [&](const std::vector<int>& of, auto otherwise) {
            if (!exchanges_[r]) return otherwise();
            std::vector<int> images;
            for (int f : of) images.push_back(exchanges_[r]->facets[f]);
            return images;
        };
        if (reading.kind == ReadingKind::mirror && !reading.has_direction) {
            for (std::size_t i = 0; i + 1 < reading.facets.size(); i += 2) {
                pairs.emplace_back(reading.facets[i], reading.facets[i + 1]);
            }
        } else if (reading.kind == ReadingKind::mirror) {
            const std::vector<int> images =
                images_of(facets, [&] { return mirror_partners(shape, reading, facets); });
            for (std::size_t i = 0; i < facets.size(); ++i) {
                if (facets[i] <= images[i]) pairs.emplace_back(facets[i], images[i]);
            }
        } else if (reading.kind == ReadingKind::rotation) {
            const std::vector<int> images =
                images_of(facets, [&] { return rotation_partners(shape, reading, facets); });
            // The last turn of an orbit follows from the others.
            std::set<int> seen;
            for (std::size_t i = 0; i < facets.size(); ++i) {
                int at = static_cast<int>(i);
                while (seen.insert(facets[at]).second) {
                    const int image = images[at];
                    if (seen.count(image) == 0 || image == facets[at] || !reading.exact) {
                        pairs.emplace_back(facets[at], image);
                    }
                    at = static_cast<int>(std::find(facets.begin(), facets.end(), image) -
                                          facets.begin());
                }
            }
        }
    }
}

}  // namespace culet
