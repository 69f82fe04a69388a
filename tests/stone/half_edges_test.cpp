#include "stone/solid/half_edges.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "stone/text/errors.h"
#include "tests/stone/synthetic_solids.h"

namespace culet {
namespace {

using namespace culet::test;

TEST(HalfEdges, EdgesAreSortedAndRunWithTheirLeftFacet) {
    const Solid solid = random_solid(60, 4);
    const HalfEdges table = half_edges(solid);
    EXPECT_EQ(static_cast<int>(table.edges.size()), edge_count(solid));
    for (std::size_t i = 0; i < table.edges.size(); ++i) {
        const Edge& edge = table.edges[i];
        EXPECT_LT(edge.from, edge.to);
        if (i > 0) {
            EXPECT_LT(std::pair(table.edges[i - 1].from, table.edges[i - 1].to),
                      std::pair(edge.from, edge.to));
        }
        const auto runs = [&](int facet, int from, int to) {
            const std::vector<int>& corners = solid.facets[facet].corners;
            const auto at = std::find(corners.begin(), corners.end(), from);
            return at != corners.end() &&
                   (at + 1 == corners.end() ? corners.front() : *(at + 1)) == to;
        };
        EXPECT_TRUE(runs(edge.left, edge.from, edge.to));
        EXPECT_TRUE(runs(edge.right, edge.to, edge.from));
    }
}

// A facet with corners p, v, n in this order covers the angle at v counter-clockwise from the edge
// to n to the edge to p; the next one round v must begin there.
TEST(HalfEdges, FacetsRoundAVertexRunCounterClockwise) {
    const Solid solid = random_solid(60, 4);
    const HalfEdges table = half_edges(solid);
    const auto beside = [&](int facet, int vertex, bool after) {
        const std::vector<int>& corners = solid.facets[facet].corners;
        const std::size_t n = corners.size();
        const std::size_t at = std::find(corners.begin(), corners.end(), vertex) - corners.begin();
        return corners[(at + (after ? 1 : n - 1)) % n];
    };
    for (int v = 0; v < static_cast<int>(solid.vertices.size()); ++v) {
        const std::vector<int>& facets = table.facets_of_vertex[v];
        ASSERT_GE(facets.size(), 3u);
        for (std::size_t i = 0; i < facets.size(); ++i) {
            EXPECT_EQ(beside(facets[i], v, false),
                      beside(facets[(i + 1) % facets.size()], v, true));
        }
    }
}

TEST(HalfEdges, OpenSurfaceIsRefused) {
    Solid solid = cube();
    solid.facets.pop_back();
    EXPECT_THROW(half_edges(solid), InternalError);
}

TEST(HalfEdges, EdgeWithThreeFacetsIsRefused) {
    Solid solid = cube();
    solid.facets.push_back(solid.facets.front());
    EXPECT_THROW(half_edges(solid), InternalError);
}

TEST(HalfEdges, TwoConesThatShareATipAreRefused) {
    Solid solid;
    solid.vertices = {{0, 0, 0},  {1, 0, 1},   {-1, 1, 1},  {-1, -1, 1},
                      {1, 0, -1}, {-1, 1, -1}, {-1, -1, -1}};
    const auto add = [&](std::vector<int> corners) {
        solid.facets.push_back({"f", {}, std::move(corners)});
    };
    add({0, 2, 1}), add({0, 3, 2}), add({0, 1, 3}), add({1, 2, 3});
    add({0, 4, 5}), add({0, 5, 6}), add({0, 6, 4}), add({4, 6, 5});
    EXPECT_THROW(half_edges(solid), InternalError);
}

TEST(HalfEdges, CornersThatDoNotExistAreRefused) {
    Solid solid = cube();
    solid.facets[0].corners[0] = 99;
    EXPECT_THROW(half_edges(solid), InternalError);
    solid.facets[0].corners[0] = -1;
    EXPECT_THROW(half_edges(solid), InternalError);
    EXPECT_NO_THROW(half_edges(Solid{}));
}

}  // namespace
}  // namespace culet
