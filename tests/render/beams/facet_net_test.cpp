// Expectations: Euler's formula, V - E + F = 2, for one closed surface without holes; and counts
// from the definitions of the cuts.

#include "render/beams/facet_net.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "tests/render/beams/beam_scenes.h"

namespace {

using namespace culet;

struct Counts {
    int facets = 0, lines = 0, corners = 0, most_at_a_corner = 0;
};
Counts expect_closed(const FacetNet& net) {
    std::map<int, std::vector<std::pair<int, const NetEdge*>>> by_line;
    std::set<int> corners;
    std::map<int, int> at_corner;
    Counts counts;
    for (int f = 0; f < net.facets(); ++f) {
        const auto& edges = net.edges(f);
        counts.facets += !edges.empty();
        EXPECT_TRUE(edges.empty() || edges.size() > 2) << "facet " << f;
        for (std::size_t i = 0; i < edges.size(); ++i) {
            EXPECT_EQ(edges[i].to, edges[(i + 1) % edges.size()].from) << "facet " << f;
            EXPECT_NE(edges[i].beyond, f);
            by_line[edges[i].line].emplace_back(f, &edges[i]);
            corners.insert(edges[i].from);
            ++at_corner[edges[i].from];
        }
    }
    for (const auto& [line, sides] : by_line) {
        EXPECT_EQ(sides.size(), 2u) << "line " << line;
        if (sides.size() != 2) continue;
        const auto& [f, a] = sides[0];
        const auto& [g, b] = sides[1];
        EXPECT_EQ(a->from, b->to);
        EXPECT_EQ(a->to, b->from);
        EXPECT_EQ(a->beyond, g);
        EXPECT_EQ(b->beyond, f);
    }
    for (const auto& [corner, facets] : at_corner)
        counts.most_at_a_corner = std::max(counts.most_at_a_corner, facets);
    counts.lines = static_cast<int>(by_line.size());
    counts.corners = static_cast<int>(corners.size());
    EXPECT_EQ(counts.lines, net.lines());
    EXPECT_EQ(counts.corners - counts.lines + counts.facets, 2);
    return counts;
}

// Corners lie on the planes of their facets, except where joining moved them.
void expect_on_planes(const FacetNet& net) {
    const double most = 4 * std::sqrt(2.3e-16) * net.size();
    for (int f = 0; f < net.facets(); ++f) {
        for (const NetEdge& edge : net.edges(f)) {
            const Vec3& corner = net.corners()[static_cast<std::size_t>(edge.from)];
            EXPECT_NEAR(height_above(net.plane(f), corner), 0, most);
        }
    }
}

TEST(Net, OfARoundBrilliantHasItsCorners) {
    for (const int mains : {8, 16}) {
        SCOPED_TRACE(mains);
        const FacetNet net(round_brilliant(mains));
        const Counts counts = expect_closed(net);
        expect_on_planes(net);
        // Table, stars, mains and halves of the crown, girdle, halves and mains of the pavilion.
        EXPECT_EQ(counts.facets, 1 + mains * (1 + 1 + 2 + 2 + 2 + 1));
        EXPECT_EQ(counts.most_at_a_corner, mains);
    }
}

TEST(Net, OfEveryStandardCutIsClosed) {
    for (const CutKind& kind : cut_kinds()) {
        if (!kind.convex) continue;
        SCOPED_TRACE(kind.name);
        const FacetNet net(make_cut(kind.name));
        expect_closed(net);
        expect_on_planes(net);
    }
}

TEST(Net, OfRandomStonesAndSliversIsClosed) {
    std::mt19937_64 random(20268);
    for (int i = 0; i < 40; ++i) {
        SCOPED_TRACE("seed 20268, stone " + std::to_string(i));
        const FacetNet net(i % 2 ? random_stone(random, 4 + i) : stone_with_slivers(random, 4 + i));
        expect_closed(net);
        expect_on_planes(net);
    }
}

// The same brilliant with every plane moved by up to `miss`: meets become short edges, until they
// merge into one corner again.
TEST(Net, OfNearMissMeetsIsClosed) {
    std::mt19937_64 random(20269);
    std::uniform_real_distribution<double> move(-1, 1);
    for (const double miss : {1e-16, 1e-12, 1e-9, 3e-8, 1e-6, 1e-4, 1e-2}) {
        for (int i = 0; i < 4; ++i) {
            SCOPED_TRACE("seed 20269, miss " + std::to_string(miss));
            Solid solid = round_brilliant(i % 2 ? 16 : 8);
            for (Facet& facet : solid.facets) facet.plane.offset += miss * move(random);
            const FacetNet net(solid);
            expect_closed(net);
            expect_on_planes(net);
        }
    }
}

TEST(Net, APlaneThatBoundsNothingHasNoEdges) {
    Solid solid = round_brilliant();
    Facet more = solid.facets.front();
    more.name = "above the table";
    more.plane.offset += 0.1;
    solid.facets.push_back(more);
    const FacetNet net(solid);
    EXPECT_TRUE(net.edges(net.facets() - 1).empty());
    expect_closed(net);
}

}  // namespace
