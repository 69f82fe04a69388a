#include "page/drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <regex>
#include <sstream>

#include "page/facet_labels.h"
#include "page/fit_paint.h"
#include "stone/cuts/cuts.h"
#include "stone/text/errors.h"
#include "tests/page/xml.h"

namespace culet {
namespace {

using test::count_of;
using test::xml_fault;
using ::testing::HasSubstr;
using ::testing::Not;

const ViewSide k_sides[] = {ViewSide::crown, ViewSide::pavilion, ViewSide::girdle};

Vec3 towards_viewer(ViewSide side) {
    return side == ViewSide::crown      ? Vec3(0, 0, 1)
           : side == ViewSide::pavilion ? Vec3(0, 0, -1)
                                        : Vec3(0, -1, 0);
}

// A cube with a bevelled edge: its top and the bevel are visible from above, its base from below.
Solid bevelled(const std::string& top = "T") {
    const NamedPlane planes[] = {{top, {Vec3(0, 0, 1), 1}},      {"B", {Vec3(0, 0, -1), 1}},
                                 {"E", {Vec3(1, 0, 0), 1}},      {"W", {Vec3(-1, 0, 0), 1}},
                                 {"N", {Vec3(0, 1, 0), 1}},      {"S", {Vec3(0, -1, 0), 1}},
                                 {"C", {Vec3(0.6, 0, 0.8), 1.2}}};
    return intersect_half_spaces(planes).solid;
}

double area_of(const std::vector<glm::dvec2>& corners) {
    double twice = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto &a = corners[i], &b = corners[(i + 1) % corners.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return std::abs(twice) / 2;
}

std::vector<glm::dvec2> drawn(const std::string& svg, const std::string& name) {
    const std::size_t facet = svg.find("<title>" + name + "</title>");
    if (facet == std::string::npos) return {};
    const std::size_t from = svg.find("points=\"", facet) + 8;
    std::string list = svg.substr(from, svg.find('"', from) - from);
    std::replace(list.begin(), list.end(), ',', ' ');
    std::istringstream numbers(list);
    std::vector<glm::dvec2> corners;
    for (glm::dvec2 c; numbers >> c.x >> c.y;) corners.push_back(c);
    return corners;
}

std::vector<Solid> stones() {
    std::vector<Solid> all;
    for (const char* name : {"round-brilliant", "step", "pear", "trillion"}) {
        all.push_back(make_cut(name));
    }
    all.push_back(bevelled());
    return all;
}

// Orthographic projection: a facet's picture has its area times the cosine of its tilt (closed
// form), to the two decimals of corners.
TEST(Drawing, HasTheProjectedAreas) {
    for (const Solid& solid : stones()) {
        for (const ViewSide side : k_sides) {
            const double scale = view_of(solid, side, 1000).scale;
            const std::string svg = draw_facets_svg(solid, side);
            double all = 0;
            for (const Facet& facet : solid.facets) {
                const double cosine = glm::dot(facet.plane.normal, towards_viewer(side));
                const auto corners = drawn(svg, facet.name);
                EXPECT_EQ(corners.empty(), cosine <= 0.01) << facet.name;
                if (corners.empty()) continue;
                const double expected = area(solid, facet) * cosine * scale * scale;
                EXPECT_NEAR(area_of(corners), expected, 0.005 * 4000) << facet.name;
                EXPECT_NEAR(area_of(corners) / expected, 1, 0.01) << facet.name;
                all += area_of(corners);
            }
            // Hidden facets are not drawn: the visible ones fill the outline once.
            double front = 0;
            for (const Facet& facet : solid.facets) {
                front += area(solid, facet) *
                         std::max(0.0, glm::dot(facet.plane.normal, towards_viewer(side)));
            }
            EXPECT_NEAR(all / (front * scale * scale), 1, 1e-3);
        }
    }
}

TEST(Drawing, NamesEveryFacetInSightOnce) {
    for (const Solid& solid : stones()) {
        for (const ViewSide side : k_sides) {
            const std::string svg = draw_facets_svg(solid, side);
            EXPECT_EQ(xml_fault(svg), "");
            const FacetView view = view_of(solid, side, 1000);
            EXPECT_EQ(count_of(svg, "<title>"), static_cast<int>(view.facets.size()));
            for (const SeenFacet& seen : view.facets) {
                const std::string& name = solid.facets[static_cast<std::size_t>(seen.facet)].name;
                EXPECT_EQ(count_of(svg, "<title>" + name + "</title>"), 1) << name;
                EXPECT_EQ(count_of(svg, ">" + name + "</text>"), 1) << name;
            }
        }
    }
}

TEST(Drawing, KeepsNamesWithinTheirFacets) {
    for (const Solid& solid : stones()) {
        for (const ViewSide side : k_sides) {
            const FacetView view = view_of(solid, side, 1000);
            const FacetLabels labels = place_labels(solid, view);
            ASSERT_EQ(labels.labels.size(), view.facets.size());
            for (std::size_t i = 0; i < view.facets.size(); ++i) {
                const FacetLabel& label = labels.labels[i];
                if (label.has_leader) continue;
                EXPECT_GE(label.size, 17);
                const double angle = label.turn_deg * std::numbers::pi / 180;
                const glm::dvec2 along(std::cos(angle), std::sin(angle)), across(-along.y, along.x);
                const double half = 0.3 * label.size * static_cast<double>(label.text.size());
                const auto& corners = view.facets[i].corners;
                double turn = 0;
                for (std::size_t k = 0; k < corners.size(); ++k) {
                    const auto &a = corners[k], &b = corners[(k + 1) % corners.size()];
                    turn += a.x * b.y - a.y * b.x;
                }
                for (const double u : {-half, half}) {
                    for (const double v : {-0.4 * label.size, 0.4 * label.size}) {
                        const glm::dvec2 p = label.at + u * along + v * across;
                        for (std::size_t k = 0; k < corners.size(); ++k) {
                            const glm::dvec2 a = corners[k],
                                             e = corners[(k + 1) % corners.size()] - a, d = p - a;
                            EXPECT_GT(std::copysign(1, turn) * (e.x * d.y - e.y * d.x), 0)
                                << label.text;
                        }
                    }
                }
            }
        }
    }
}

TEST(Drawing, KeepsLedNamesApart) {
    const Solid solid = make_cut("round-brilliant");
    const FacetView view = view_of(solid, ViewSide::girdle, 1000);
    const FacetLabels labels = place_labels(solid, view);
    int led = 0;
    for (const FacetLabel& a : labels.labels) {
        led += a.has_leader;
        for (const FacetLabel& b : labels.labels) {
            if (&a == &b || !a.has_leader || !b.has_leader || a.at_right != b.at_right) continue;
            EXPECT_GE(std::abs(a.at.y - b.at.y), 0.99 * std::max(a.size, b.size));
        }
    }
    EXPECT_GT(led, 0);
}

TEST(Drawing, ShowsTheFacetsThatFaceTheViewer) {
    const std::string crown = draw_facets_svg(bevelled(), ViewSide::crown);
    const std::string pavilion = draw_facets_svg(bevelled(), ViewSide::pavilion);
    EXPECT_THAT(crown, HasSubstr("aria-label=\"T\""));
    EXPECT_THAT(crown, HasSubstr("aria-label=\"C\""));
    EXPECT_THAT(crown, Not(HasSubstr("aria-label=\"B\"")));
    EXPECT_THAT(crown, Not(HasSubstr("aria-label=\"E\"")));  // edge-on
    EXPECT_THAT(pavilion, HasSubstr("aria-label=\"B\""));
    EXPECT_THAT(pavilion, Not(HasSubstr("aria-label=\"T\"")));
    const std::string girdle = draw_facets_svg(bevelled(), ViewSide::girdle);
    EXPECT_THAT(girdle, HasSubstr("aria-label=\"S\""));
    EXPECT_THAT(girdle, Not(HasSubstr("aria-label=\"N\"")));
}

// The bevel lies at +x: right of the top from above, left when the stone is turned over.
TEST(Drawing, HasTheFramesItPromises) {
    const std::string crown = draw_facets_svg(bevelled(), ViewSide::crown);
    EXPECT_THAT(crown, HasSubstr("viewBox=\"0 0 1000 1000\""));
    for (const auto& c : drawn(crown, "C")) EXPECT_GT(c.x, 500);
    // A step along the length of a stone whose bevel is below: x runs to the left.
    Solid below = bevelled();
    for (Vec3& v : below.vertices) v.z = -v.z;
    for (Facet& f : below.facets) {
        f.plane.normal.z = -f.plane.normal.z;
        std::reverse(f.corners.begin(), f.corners.end());
    }
    for (const auto& c : drawn(draw_facets_svg(below, ViewSide::pavilion), "C")) {
        EXPECT_LT(c.x, 500);
    }
    // From the side z is up: the top's edge is the highest, so no point of S is above it.
    const auto side = drawn(draw_facets_svg(bevelled(), ViewSide::girdle), "S");
    ASSERT_GE(side.size(), 5u);
    double high = 1000, right_of_high = 0;
    for (const auto& c : side) {
        if (c.y < high + 1e-9) right_of_high = std::max(c.y < high ? 0 : right_of_high, c.x);
        high = std::min(high, c.y);
    }
    EXPECT_LT(right_of_high, 900);  // the bevel cuts the upper right corner
}

// A stone with a notch: the nearer wall is drawn after what it hides.
TEST(Drawing, DrawsNearFacetsLast) {
    const Solid heart = make_cut("heart");
    const FacetView view = view_of(heart, ViewSide::girdle, 1000);
    double before = -std::numeric_limits<double>::max();
    for (const SeenFacet& seen : view.facets) {
        const double depth =
            -corner_mean(heart, heart.facets[static_cast<std::size_t>(seen.facet)]).y;
        EXPECT_GE(depth, before - 1e-12);
        before = depth;
    }
}

TEST(Drawing, OfABrokenSolidIsEmptyOrWhole) {
    Solid solid = bevelled();
    EXPECT_EQ(draw_facets_svg(Solid{}, ViewSide::crown), "");
    solid.vertices[0].x = std::nan("");
    solid.facets[0].corners.push_back(999);
    solid.facets[0].corners.push_back(-4);
    EXPECT_EQ(xml_fault(draw_facets_svg(solid, ViewSide::crown)), "");
    EXPECT_EQ(xml_fault(drawing_svg("a", "b", solid, {}, {})), "");
    for (Vec3& v : solid.vertices) v = Vec3(1, 1, 1);
    EXPECT_EQ(draw_facets_svg(solid, ViewSide::crown), "");
    EXPECT_EQ(xml_fault(drawing_svg("a", "b", solid, {}, {})), "");
}

TEST(Drawing, EscapesAndShortensHostileNames) {
    const std::string hostile = "<script>alert('x')</script>&\"\xff" + std::string(100000, 'W');
    const Solid solid = bevelled(hostile);
    PaintLegend legend;
    legend.what = legend.mark = hostile;
    const std::string svg = drawing_svg(hostile, hostile, solid, {{"red", hostile, true}}, legend);
    EXPECT_EQ(xml_fault(svg), "");
    EXPECT_THAT(svg, Not(HasSubstr("<script>")));
    EXPECT_THAT(svg, HasSubstr("…</text>"));
}

// 1 000 visible facets of equal size: every one has its title, but only those with room show names.
TEST(Drawing, OfAThousandFacetsIsWhole) {
    std::vector<NamedPlane> planes{{"B", {Vec3(0, 0, -1), 0.1}}};
    for (int i = 0; i < 1000; ++i) {
        const double z = 0.05 + 0.9 * i / 1000.0, r = std::sqrt(1 - z * z),
                     a = i * std::numbers::pi * (3 - std::sqrt(5.0));
        planes.push_back({"f" + std::to_string(i), {Vec3(r * std::cos(a), r * std::sin(a), z), 1}});
    }
    const Solid solid = intersect_half_spaces(planes).solid;
    const std::string svg = draw_facets_svg(solid, ViewSide::crown);
    EXPECT_EQ(count_of(svg, "<title>"),
              static_cast<int>(view_of(solid, ViewSide::crown, 1000).facets.size()));
    for (const FacetLabel& label :
         place_labels(solid, view_of(solid, ViewSide::crown, 1000)).labels) {
        EXPECT_GE(label.size, 11);
        EXPECT_GE(label.at.y, 0);
        EXPECT_LE(label.at.y, 1000);
    }
}

const char* const k_report = R"({"status": "contradictory",
    "facets": [{"name": "T", "inclination": 0, "sigma_inclination": 0.0, "sigma_azimuth": null},
               {"name": "C", "inclination": 90, "azimuth": 0, "sigma_inclination": 0.03,
                "sigma_azimuth": 0.04},
               {"name": "B", "inclination": 0, "sigma_inclination": 9}],
    "readings": [{"id": "r0", "of": ["C"], "normalized": -4.5, "suspect": true},
                 {"id": "r1", "of": ["C", "T"], "normalized": 2.0}],
    "undetermined": [{"facet": "B", "freedom": "inclination"}], "suspects": ["r0"]})";

TEST(FitPaint, ColoursFacetsByTheirWorstReading) {
    const Solid solid = bevelled();
    const FitPaint paint = fit_paint(solid, k_report, FitColour::residual);
    ASSERT_EQ(paint.facets.size(), solid.facets.size());
    const auto of = [&](const char* name) {
        return paint.facets[static_cast<std::size_t>(find_facet(solid, name))];
    };
    EXPECT_EQ(of("C").colour, css_colour(ColourMap::residual, 1));
    EXPECT_EQ(of("T").colour, css_colour(ColourMap::residual, 0.5));
    EXPECT_THAT(of("C").about, HasSubstr("of its 2 readings r0 is"));
    EXPECT_THAT(of("E").about, HasSubstr("no reading of its own"));
    EXPECT_TRUE(of("C").marked);
    EXPECT_FALSE(of("T").marked);
    EXPECT_THAT(paint.legend.mark, HasSubstr("suspect"));
}

// The direction of a vertical facet's normal has an uncertainty of the root of the squares of both
// its angles: 0.03, 0.04, 0.05.
TEST(FitPaint, ColoursFacetsByHowFarTheirNormalsMayBeOff) {
    const Solid solid = bevelled();
    const FitPaint paint = fit_paint(solid, k_report, FitColour::uncertainty);
    const auto of = [&](const char* name) {
        return paint.facets[static_cast<std::size_t>(find_facet(solid, name))];
    };
    EXPECT_EQ(paint.legend.to, "0.050 or more");
    EXPECT_EQ(of("C").colour, css_colour(ColourMap::uncertainty, 1));
    EXPECT_EQ(of("T").colour, css_colour(ColourMap::uncertainty, 0));
    // Open facets do not set the scale, and are marked.
    EXPECT_TRUE(of("B").marked);
    EXPECT_THAT(of("B").about, HasSubstr("inclination"));
}

// The first crown main stands at index 24 of 96, a quarter turn from index 96 (GemCad's count).
TEST(FitPaint, FindsFacetsByTierAndIndex) {
    const Solid solid = make_cut("round-brilliant");
    const FitPaint paint =
        fit_paint(solid,
                  R"({"readings": [{"id": "r0", "kind": "inclination", "of": ["C@24"],
                                    "normalized": 4}]})",
                  FitColour::residual);
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const bool read = paint.facets[f].about.find("r0") != std::string::npos;
        EXPECT_EQ(read, solid.facets[f].name == "C1") << solid.facets[f].name;
    }
}

TEST(FitPaint, OfNoReportIsPlain) {
    const FitPaint paint = fit_paint(bevelled(), "", FitColour::uncertainty);
    for (const FacetPaint& own : paint.facets) EXPECT_FALSE(own.marked);
    EXPECT_THROW(fit_paint(bevelled(), "[1", FitColour::residual), InputError);
    EXPECT_NO_THROW(fit_paint(bevelled(),
                              R"({"facets": [1, {"name": 3}], "readings": {"of": 2},
                                  "undetermined": [7], "suspects": [{}]})",
                              FitColour::residual));
}

// Distinguishable without hues: lightness (CIE luminance) falls all the way.
TEST(ColourMaps, OfDrawingsGetDarkerAllTheWay) {
    for (const ColourMap map : {ColourMap::residual, ColourMap::uncertainty}) {
        double before = 2;
        for (int i = 0; i <= 50; ++i) {
            const auto c = colour_at(map, i / 50.0);
            const auto linear = [](std::uint8_t v) { return std::pow(v / 255.0, 2.2); };
            const double y = 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]);
            EXPECT_LT(y, before + 0.002) << i;
            before = y;
        }
    }
}

}  // namespace
}  // namespace culet
