#include "fit/mesh/orientation.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace culet {

void renew_plane(Solid& solid, Facet& facet) {
    std::vector<Vec3> loop;
    for (int corner : facet.corners) loop.push_back(solid.vertices[corner]);
    facet.plane = plane_through(loop);
}

void turn_round(Solid& solid) {
    for (Facet& facet : solid.facets) {
        std::reverse(facet.corners.begin(), facet.corners.end());
        renew_plane(solid, facet);
    }
}

std::optional<int> orient(Solid& solid) {
    std::map<std::pair<int, int>, std::vector<int>> of_side;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const std::vector<int>& loop = solid.facets[f].corners;
        for (std::size_t k = 0; k < loop.size(); ++k) {
            of_side[std::minmax(loop[k], loop[(k + 1) % loop.size()])].push_back(int(f));
        }
    }
    const auto runs = [&](int f, int from, int to) {
        const std::vector<int>& loop = solid.facets[f].corners;
        for (std::size_t k = 0; k < loop.size(); ++k) {
            if (loop[k] == from && loop[(k + 1) % loop.size()] == to) return true;
        }
        return false;
    };
    std::map<int, std::vector<std::pair<int, bool>>> next;  // and whether it must be turned
    for (const auto& [side, facets] : of_side) {
        if (facets.size() != 2 || facets[0] == facets[1]) return std::nullopt;
        const bool alike =
            runs(facets[0], side.first, side.second) == runs(facets[1], side.first, side.second);
        next[facets[0]].emplace_back(facets[1], alike);
        next[facets[1]].emplace_back(facets[0], alike);
    }
    std::vector<int> turn(solid.facets.size(), -1);
    std::vector<int> order{0};
    turn[0] = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (const auto& [g, alike] : next[order[i]]) {
            const int wanted = turn[order[i]] ^ (alike ? 1 : 0);
            if (turn[g] < 0) {
                turn[g] = wanted;
                order.push_back(g);
            } else if (turn[g] != wanted) {
                return std::nullopt;
            }
        }
    }
    if (order.size() != solid.facets.size()) return std::nullopt;
    const int turned = static_cast<int>(std::count(turn.begin(), turn.end(), 1));
    if (turned == 0) return 0;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        if (turn[f] == 0) continue;
        std::reverse(solid.facets[f].corners.begin(), solid.facets[f].corners.end());
        renew_plane(solid, solid.facets[f]);
    }
    if (volume(solid) > 0) return turned;
    turn_round(solid);
    return static_cast<int>(solid.facets.size()) - turned;
}

}  // namespace culet
