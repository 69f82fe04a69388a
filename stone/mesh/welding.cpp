#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "stone/mesh/face_soup.h"

namespace culet {

namespace {

/// Half-edges without one in the opposite direction.
std::size_t open_edges(const FaceSoup& soup, const std::vector<int>& welded) {
    std::vector<std::pair<int, int>> edges;
    for (const SoupFace& face : soup.faces) {
        for (std::size_t i = 0; i < face.corners.size(); ++i) {
            const int a = welded[face.corners[i]];
            const int b = welded[face.corners[(i + 1) % face.corners.size()]];
            if (a != b) edges.emplace_back(std::min(a, b), std::max(a, b));
        }
    }
    std::sort(edges.begin(), edges.end());
    std::size_t open = 0;
    for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
        for (end = i; end < edges.size() && edges[end] == edges[i];) ++end;
        if (end - i == 1) ++open;
    }
    return open;
}

std::vector<int> weld_equal(const std::vector<Vec3>& vertices) {
    std::vector<int> order(vertices.size());
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](int i) { return std::tuple(vertices[i].x, vertices[i].y, vertices[i].z); };
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return key(a) < key(b) || (key(a) == key(b) && a < b); });
    std::vector<int> welded(vertices.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool repeated = i > 0 && key(order[i]) == key(order[i - 1]);
        welded[order[i]] = repeated ? welded[order[i - 1]] : order[i];
    }
    return welded;
}

/// Merges chains too, in addition to `welded`.
std::vector<int> weld_close(const std::vector<Vec3>& vertices, std::vector<int> welded,
                            double reach) {
    using Cell = std::array<std::int64_t, 3>;
    std::map<Cell, std::vector<int>> cells;
    const auto root = [&](int i) {
        while (welded[i] != i) i = welded[i];
        return i;
    };
    for (int i = 0; i < static_cast<int>(vertices.size()); ++i) {
        if (welded[i] != i) continue;
        Cell home{};
        for (int axis = 0; axis < 3; ++axis) {
            home[axis] = static_cast<std::int64_t>(std::floor(vertices[i][axis] / reach));
        }
        for (int k = 0; k < 27; ++k) {
            const auto at =
                cells.find({home[0] + k % 3 - 1, home[1] + k / 3 % 3 - 1, home[2] + k / 9 - 1});
            if (at == cells.end()) continue;
            for (const int j : at->second) {
                if (glm::length(vertices[i] - vertices[j]) > reach) continue;
                const int a = root(i), b = root(j);
                welded[std::max(a, b)] = std::min(a, b);
            }
        }
        cells[home].push_back(i);
    }
    for (int i = 0; i < static_cast<int>(welded.size()); ++i) welded[i] = root(i);
    return welded;
}

}  // namespace

void weld_vertices(FaceSoup& soup) {
    if (soup.vertices.empty()) return;
    std::vector<int> welded = weld_equal(soup.vertices);
    const std::size_t open = open_edges(soup, welded);
    // Two roundings of one place differ by at most twice the rounding error in each coordinate.
    const double reach = merging_tolerance(soup, size_of(soup));
    if (open > 0 && reach > 0) {
        std::vector<int> closer = weld_close(soup.vertices, welded, reach);
        if (open_edges(soup, closer) < open) {
            std::size_t joined = 0;
            for (std::size_t i = 0; i < closer.size(); ++i) {
                joined += closer[i] != static_cast<int>(i) && welded[i] == static_cast<int>(i);
            }
            soup.notes.push_back(
                fmt::format("welded {} corners that rounding had moved apart (by up to {:.2g})",
                            joined, reach));
            welded = std::move(closer);
        }
    }
    for (SoupFace& face : soup.faces) {
        for (int& corner : face.corners) corner = welded[corner];
    }
}

}  // namespace culet
