#include "stone/gemcad/gemcad_io.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <random>

#include "stone/design/proportions.h"
#include "stone/gemcad/cut_planes.h"
#include "stone/solid/checks.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_decoding.h"
#include "tests/scratch_folder.h"
#include "tests/stone/synthetic_solids.h"

namespace culet {
namespace {

using namespace culet::test;

const char* const k_block =
    "GemCad 5.0\n"
    "g 96 0.0\n"
    "y 4 y\n"
    "I 1.76\n"
    "H A block\n"
    "a -90.000000 1.0 96 n G1 24 48 n G3 72\n"
    "a 0.000000 0.5 96 n T\n"
    "a -0.000000 0.25 96 n B G Polish last\n"
    "F done\n";

TEST(GemCadAsc, BlockHasItsPlanesAndNames) {
    const ReadCut cut = parse_gemcad_asc(k_block);
    ASSERT_EQ(cut.solid.facets.size(), 6u);
    // Index 0 and 96 face +y, 24 faces +x.
    const auto normal = [&](const char* name) {
        return cut.solid.facets[find_facet(cut.solid, name)].plane.normal;
    };
    EXPECT_EQ(normal("G1"), Vec3(0, 1, 0));
    EXPECT_EQ(normal("f0"), Vec3(1, 0, 0));
    EXPECT_EQ(normal("G3"), Vec3(0, -1, 0));
    EXPECT_EQ(normal("f1"), Vec3(-1, 0, 0));
    EXPECT_EQ(normal("T"), Vec3(0, 0, 1));
    EXPECT_EQ(normal("B"), Vec3(0, 0, -1));
    EXPECT_DOUBLE_EQ(volume(cut.solid), 2 * 2 * 0.75);
    EXPECT_EQ(cut.solid.design->gear, 96);
    EXPECT_EQ(cut.solid.design->symmetry, 4);
    EXPECT_TRUE(cut.solid.design->mirror);
    EXPECT_EQ(cut.solid.design->refractive_index, 1.76);
    EXPECT_EQ(cut.solid.design->headings, std::vector<std::string>{"A block"});
    EXPECT_EQ(cut.solid.design->footnotes, std::vector<std::string>{"done"});
    EXPECT_TRUE(find_faults(cut.solid).empty());
}

TEST(GemCadAsc, NegativeGearTurnsTheOtherWayAndOffsetMovesTheZero) {
    std::string text = k_block;
    text.replace(text.find("g 96 0.0"), 8, "g -96 48");
    const ReadCut cut = parse_gemcad_asc(text);
    // t = 2 pi (24 - 48) / -96 is a quarter turn: +x. Index 96 is at t = -pi: -y.
    EXPECT_EQ(cut.solid.facets[find_facet(cut.solid, "f0")].plane.normal, Vec3(1, 0, 0));
    EXPECT_EQ(cut.solid.facets[find_facet(cut.solid, "G1")].plane.normal, Vec3(0, -1, 0));
}

TEST(GemCadAsc, FormsThatRealFilesUse) {
    for (const char* gear : {"g96 0.0", "96 0.0", "g 96"}) {
        std::string text = k_block;
        text.replace(text.find("g 96 0.0"), 8, gear);
        EXPECT_EQ(parse_gemcad_asc(text).solid.facets.size(), 6u) << gear;
    }
    // Continued lines, CRLF, a name that is also a keyword, two G instructions.
    const ReadCut cut = parse_gemcad_asc(
        "GemCad 4.51\r\ng 96 0.0\r\ny 1 n\r\nI 1.54\r\n"
        "a 90 1.0 96 n\r\nG 24 n 2\r\n48 72 G cut\r\nto girdle\r\n"
        "a 0 0.5 96 n T G Table\r\na 0 -0.25 96 n C\r\n");
    ASSERT_EQ(cut.solid.facets.size(), 6u);
    EXPECT_EQ(cut.solid.facets[0].name, "G");
    EXPECT_EQ(cut.solid.facets[1].name, "2");
    // Angle 0 with a negative distance is the culet.
    EXPECT_EQ(cut.solid.facets[5].plane.normal.z, -1);
    EXPECT_EQ(cut.solid.facets[5].plane.offset, 0.25);
}

TEST(GemCadAsc, RepeatedAndUnusedPlanesAreTold) {
    std::string text = k_block;
    text += "a 90.0 1.0 0\na 45 9 3 n far\n";
    const ReadCut cut = parse_gemcad_asc(text);
    EXPECT_EQ(cut.solid.facets.size(), 6u);
    ASSERT_EQ(cut.repeated_planes.size(), 1u);
    EXPECT_EQ(cut.repeated_planes[0], "tier 4 (90 degrees), index 0");
    ASSERT_EQ(cut.unused_planes.size(), 1u);
    EXPECT_EQ(cut.unused_planes[0], "tier 5 (45 degrees), index 3");
}

TEST(GemCadAsc, Windows1252BecomesUtf8AndBack) {
    EXPECT_EQ(utf8_from_windows1252("caf\xe9 \x80 \x93"), "caf\xc3\xa9 \xe2\x82\xac \xe2\x80\x9c");
    EXPECT_EQ(utf8_from_windows1252("caf\xc3\xa9"), "caf\xc3\xa9");
    EXPECT_EQ(windows1252_from_utf8("caf\xc3\xa9 \xe2\x82\xac \xe6\xbc\xa2"), "caf\xe9 \x80 _");
    EXPECT_EQ(windows1252_from_utf8("\xff"), "_");
}

TEST(GemCadAsc, OpenAndEmptyDesignsAreRefused) {
    EXPECT_THROW(parse_gemcad_asc("GemCad 5.0\na 0 0.5 96\n"), InputError);
    EXPECT_THROW(parse_gemcad_asc("GemCad 5.0\n"), InputError);
    std::string text = k_block;
    text.replace(text.find("0.5 96"), 3, "0.0");
    text.replace(text.find("0.25"), 4, "0.00");
    EXPECT_THROW(parse_gemcad_asc(text), InputError);
}

TEST(CutSettings, SettingAndPlaneAreInverse) {
    std::mt19937_64 generator(8);
    std::uniform_real_distribution<double> angle(0.1, 89.9), index(0.01, 95.99);
    for (const double gear : {96.0, -96.0, 80.0, 64.0}) {
        Design sheet;
        sheet.gear = gear;
        sheet.gear_offset = gear < 0 ? 48 : 0;
        for (int i = 0; i < 200; ++i) {
            CutSetting setting{angle(generator), i % 2 == 0, 0.7,
                               std::fmod(index(generator), std::abs(gear))};
            const CutSetting back = setting_of(plane_of(setting, sheet), sheet);
            EXPECT_NEAR(back.angle_deg, setting.angle_deg, 1e-12);
            EXPECT_EQ(back.pavilion, setting.pavilion);
            EXPECT_NEAR(back.index, setting.index, 1e-10);
        }
    }
}

TEST(CutSettings, MirroredSettingsGiveMirroredPlanesExactly) {
    const Design sheet;
    for (int i = 1; i < 96; ++i) {
        const Plane a = plane_of({41.3, false, 1, static_cast<double>(i)}, sheet);
        const Plane b = plane_of({41.3, false, 1, static_cast<double>(96 - i)}, sheet);
        EXPECT_EQ(a.normal.x, -b.normal.x) << i;
        EXPECT_EQ(a.normal.y, b.normal.y) << i;
    }
    EXPECT_EQ(plane_of({90, true, 1, 17}, sheet).normal.z, 0);
    EXPECT_EQ(plane_of({0, false, 1, 17}, sheet).normal, Vec3(0, 0, 1));
}

// Counts and ratios found independently from the same files (metrics.json; half-spaces by Qhull,
// meets contracted at 3e-4 of the width).
TEST(GemCadDesigns, HaveTheCountsAndRatiosOfAnotherProgram) {
    const auto designs = committed_designs();
    const auto metrics =
        nlohmann::json::parse(read_text(CULET_SOURCE_DIR "/tests/stone/designs/metrics.json"));
    EXPECT_EQ(designs.size(), metrics.size());
    for (const auto& design : designs) {
        SCOPED_TRACE(design.filename());
        const auto& known = metrics.at(design.filename().string());
        const ReadCut cut = read_cut(design);
        const Solid& solid = cut.solid;
        EXPECT_EQ(solid.facets.size(), known["facets"].get<std::size_t>());
        EXPECT_EQ(solid.vertices.size(), known["vertices"].get<std::size_t>());
        EXPECT_EQ(edge_count(solid), known["edges"].get<int>());
        EXPECT_EQ(cut.unused_planes.size(), known["unused_planes"].get<std::size_t>());
        EXPECT_EQ(cut.repeated_planes.size(), known["repeated_planes"].get<std::size_t>());
        // Corners differ by how far meets miss, so lengths agree to 3e-4 only.
        const Proportions p = proportions(solid);
        const double near = 3e-4;
        EXPECT_NEAR(p.width / known["W"].get<double>(), 1, near);
        EXPECT_NEAR(p.length / known["L"].get<double>(), 1, near);
        EXPECT_NEAR(p.height / p.width, known["HW"].get<double>(), near);
        EXPECT_NEAR(p.pavilion / p.width, known["PW"].get<double>(), near);
        EXPECT_NEAR(p.crown / p.width, known["CW"].get<double>(), near);
        EXPECT_EQ(p.table_length.has_value(), known.contains("TW"));
        if (known.contains("TW") && p.table_length) {
            EXPECT_NEAR(*p.table_length / p.width, known["TW"].get<double>(), near);
            EXPECT_NEAR(*p.table_width / p.width, known["UW"].get<double>(), near);
        }
        EXPECT_NEAR(volume(solid) / known["volume"].get<double>(), 1, near);
        EXPECT_EQ(cut.solid.design->gear, known["gear"].get<double>());
        EXPECT_TRUE(
            find_faults(solid, {.planarity = k_largest_miss, .must_be_convex = true}).empty());
    }
}

// The same design in both file formats: the planes of a .gem are unit normals over distances.
TEST(GemCadDesigns, GemAndAscAgree) {
    for (const auto& design : committed_designs()) {
        SCOPED_TRACE(design.filename());
        const ReadCut asc = read_cut(design);
        const ReadCut gem =
            parse_gemcad_gem(gem_bytes(asc.solid, static_cast<int>(asc.solid.design->gear),
                                       asc.solid.design->refractive_index.value()));
        EXPECT_EQ(asc.solid.facets.size(), gem.solid.facets.size());
        EXPECT_EQ(asc.solid.vertices.size(), gem.solid.vertices.size());
        EXPECT_EQ(edge_count(asc.solid), edge_count(gem.solid));
        EXPECT_EQ(asc.solid.design->gear, gem.solid.design->gear);
        EXPECT_EQ(asc.solid.design->refractive_index, gem.solid.design->refractive_index);
        EXPECT_LT(plane_difference(asc.solid, gem.solid), 1e-12);
    }
}

TEST(GemCadWriting, SharesTiersAndWritesPlainNumbers) {
    const ScratchFolder folder;
    for (const auto& design : committed_designs()) {
        SCOPED_TRACE(design.filename());
        const ReadCut cut = read_cut(design);
        write_cut(cut.solid, *cut.solid.design, folder / "a.asc");
        const ReadCut again = read_cut(folder / "a.asc");
        EXPECT_LT(plane_difference(cut.solid, again.solid), 1e-12);
        EXPECT_EQ(again.solid.design->headings, cut.solid.design->headings);
        EXPECT_EQ(again.solid.design->gear, cut.solid.design->gear);
        const auto tiers = [](const std::string& text) {
            int count = 0;
            for (std::size_t at = text.find("\na "); at != std::string::npos;
                 at = text.find("\na ", at + 1)) {
                ++count;
            }
            return count;
        };
        EXPECT_EQ(tiers(read_text(folder / "a.asc")), tiers(read_text(design)));
    }
}

TEST(GemCadWriting, RefusesWhatTheFormatCannotHold) {
    const ScratchFolder folder;
    Solid open = cube();
    open.facets.pop_back();
    EXPECT_THROW(write_cut(open, {}, folder / "a.asc"), InputError);
    EXPECT_THROW(write_cut(turned_inside_out(cube()), {}, folder / "a.asc"), InputError);
    Design sheet;
    sheet.gear = 0;
    EXPECT_THROW(write_cut(cube(), sheet, folder / "a.asc"), InputError);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.asc"));
}

}  // namespace
}  // namespace culet
