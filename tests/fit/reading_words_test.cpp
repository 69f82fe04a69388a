// Readings as people and spreadsheets write them: empty rows, separators, units, words of the
// trade.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "fit/fit.h"
#include "fit/readings/measurement.h"
#include "stone/cuts/cuts.h"
#include "stone/gemcad/gemcad_io.h"
#include "stone/text/errors.h"
#include "tests/fit/test_stones.h"
#include "tests/folder_test.h"
#include "tests/says.h"

namespace culet {
namespace {

using namespace test;
using test::says;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class Words : public test::FolderTest {
protected:
    std::filesystem::path write(const std::string& text) const {
        std::ofstream(folder_ / "r.csv", std::ios::binary) << text;
        return folder_ / "r.csv";
    }
    std::vector<Reading> bind(const std::string& text) {
        notes_.clear();
        return bind_readings(read_readings_csv(write(text)), stone_, &notes_);
    }
    std::vector<Reading> rows(const std::string& text) {
        return bind("kind,of,value,sigma\n" + text);
    }
    std::string complaint(const std::string& text) {
        return complaint_of("kind,of,value,sigma\n" + text);
    }
    std::string complaint_of(const std::string& text) {
        try {
            bind(text);
        } catch (const InputError& error) {
            return error.what();
        }
        return "no complaint";
    }
    const Facet& facet_of(const Reading& reading) const {
        return stone_.solid.facets[std::size_t(reading.facets[0])];
    }
    void rename(const char* from, const char* to) {
        stone_.solid.facets[std::size_t(find_facet(stone_.solid, from))].name = to;
    }

    Stone stone_ = stone_of(brilliant());  // mains at azimuths 0, 45, ...; diameter 6
    std::vector<std::string> notes_;
};

TEST_F(Words, RowsWithoutAValueAreSkippedAndCounted) {
    const auto readings = rows(
        "inclination,C1,,0.1\ninclination,C2,34.5,0.1\ndepth,,,0.01\nrotation,8,,0.2\n,,,\n"
        "weight,,,\n");
    ASSERT_EQ(readings.size(), 2u);
    // Ids count places in the file, so that they stay the same when a row is filled in later.
    EXPECT_EQ(readings[0].id, "r1");
    EXPECT_EQ(readings[1].kind, ReadingKind::rotation);
    EXPECT_THAT(notes_, Contains(HasSubstr("3 rows")));
    rows("depth,,3.5,0.01\nweight,,,0.01\n");
    EXPECT_THAT(notes_, Contains(HasSubstr("1 row ")));
    rows("depth,,3.5,0.01\n");
    EXPECT_THAT(notes_, IsEmpty());
    // Whether a misspelt kind needs a value is unknown.
    EXPECT_THAT(complaint("depht,,,0.01\n"), HasSubstr("r.csv:2"));
    EXPECT_THAT(complaint("depth,,?,0.01\n"), AllOf(HasSubstr("r.csv:2"), HasSubstr("'?'")));
}

// The same two readings in every format.
TEST_F(Words, SpreadsheetsOfAllCountriesAreRead) {
    for (const char* text : {
             "kind,of,value,sigma\ninclination,C1,33.8,0.1\nwidth,45,6.02,0.015\n",
             "kind;of;value;sigma\ninclination;C1;33,8;0,1\nwidth;45;6,02;0,015\n",
             "\xEF\xBB\xBFkind;of;value;sigma;;\r\ninclination;C1;33,8;0,1;;\r\n;;;;;\r\n"
             "width;45;6,02;0,015;;\r\n",
             "kind\tof\tvalue\tsigma\ninclination\tC1\t33,8\t0.1\nwidth\t45\t6.02\t0,015\n",
             "sep=;\n# a comment; with \"quotes, and more\nKind ; Of ; Value ; Sigma\n"
             " inclination ; \"C1\" ; 33,8 ; 0,1 \n\"# another; one\"\nwidth;45;6,02;0,015",
             "# how to, \"fill\nkind,of,value,sigma\ninclination,C1,\"33,8\",0.1\n"
             "\"width\",45,\" 6,02 \",\"0,015\"\n",
             "kind,of,value,sigma\ninclination,C1,\xC2\xA0"
             "33.8\xC2\xA0,0.1\nwidth,45,+6.02,\xC2\xB1"
             "0.015\n",
         }) {
        const auto readings = bind(text);
        ASSERT_EQ(readings.size(), 2u) << text;
        EXPECT_NEAR(readings[0].value, radians(33.8), 1e-15) << text;
        EXPECT_NEAR(readings[0].sigma, radians(0.1), 1e-15) << text;
        EXPECT_NEAR(readings[1].value, 6.02, 1e-15) << text;
        EXPECT_NEAR(readings[1].sigma, 0.015, 1e-15) << text;
    }
    // Between commas, 1,234 could also mean a thousand and more.
    EXPECT_THAT(complaint("volume,,\"1,234\",1\n"), HasSubstr("one decimal mark"));
    EXPECT_THAT(complaint("width,0,\"1.234,5\",1\n"), HasSubstr("one decimal mark"));
    EXPECT_THAT(complaint("inclination,C1,33,8,0.1\n"), HasSubstr("decimal point"));
}

TEST_F(Words, UnitsAreReadWhereTheyAgree) {
    const auto readings = rows(
        "width,0,6.02mm,0.015 mm\nwidth,45,0.602 cm,0.01mm\ninclination,C1,33.8\xC2\xB0,0.1 deg\n"
        "inclination,C2,33\xC2\xB0"
        "48',0.1\ninclination,C3,33.8 degrees,0.1\nweight,,0.95ct,0.005\n"
        "weight,,0.19 g,1mg\nvolume,,54 mm3,1\ninclination,C4,33.8\xB0,0.1\n");
    ASSERT_EQ(readings.size(), 9u);
    EXPECT_NEAR(readings[0].value, 6.02, 1e-15);
    EXPECT_NEAR(readings[1].value, 6.02, 1e-14);
    EXPECT_NEAR(readings[1].sigma, 0.01, 1e-15);
    EXPECT_NEAR(readings[2].value, radians(33.8), 1e-15);
    EXPECT_NEAR(readings[3].value, radians(33.8), 1e-14);  // 48' are 0.8 degrees
    EXPECT_NEAR(readings[5].value, 0.95, 1e-15);
    EXPECT_NEAR(readings[6].value, 0.95, 1e-14);  // 1 ct = 0.2 g
    EXPECT_NEAR(readings[6].sigma, 0.005, 1e-15);
    EXPECT_NEAR(readings[8].value, radians(33.8), 1e-15);  // the degree sign of Windows' code page
    // A written unit keeps its meaning in a stone of another unit.
    stone_.unit = LengthUnit::cm;
    for (Vec3& v : stone_.solid.vertices) v *= 0.1;
    for (Facet& f : stone_.solid.facets) f.plane.offset *= 0.1;
    EXPECT_NEAR(rows("width,0,6.02mm,0.015mm\n")[0].value, 0.602, 1e-15);
}

// Inclinations measured from straight up: 139 degrees is a pavilion facet of 41, and 90.2 is a
// girdle facet that leans down by 0.2, however small its sigma.
TEST_F(Words, InclinationsOverNinetyAreOfThePavilion) {
    for (const char* sigma : {"0.3", "0.01"}) {
        const Reading g = rows(std::string("inclination,G1,90.2,") + sigma + "\n")[0];
        EXPECT_NEAR(g.value, radians(89.8), 1e-14);
        EXPECT_EQ(g.side, -1);
    }
    const Reading p = rows("inclination,P1,139,0.1\n")[0];
    EXPECT_NEAR(p.value, radians(41), 1e-14);
    EXPECT_EQ(p.side, -1);
    EXPECT_EQ(rows("inclination,P1,41,0.1\n")[0].side, 0);
    EXPECT_THAT(complaint("inclination,C1,139,0.1\n"), HasSubstr("outside 0..90"));
    EXPECT_THAT(complaint("inclination,P1,181,0.1\n"), HasSubstr("outside 0..90"));
}

TEST_F(Words, AReadingMaySayItsSide) {
    const auto side = [&](const std::string& row) {
        return bind("kind,of,value,sigma,side\n" + row)[0].side;
    };
    EXPECT_EQ(side("inclination,P1,41,0.1,pavilion\n"), -1);
    EXPECT_EQ(side("inclination,C1,34,0.1,crown\n"), 1);
    EXPECT_EQ(side("inclination,G1,90.03,0.1,crown\n"), 1);
    const auto refused = [&](const std::string& row) {
        return complaint_of("kind,of,value,sigma,side\n" + row);
    };
    EXPECT_THAT(refused("inclination,P1,41,0.1,crown\n"), says("P1", "pavilion"));
    EXPECT_THAT(refused("inclination,P1,41,0.1,below\n"), HasSubstr("crown or pavilion"));
    EXPECT_THAT(refused("azimuth,P1,41,0.1,crown\n"), HasSubstr("is for inclinations"));
}

TEST_F(Words, OtherUnitsAreRefusedWithWhatToWrite) {
    EXPECT_THAT(complaint("inclination,C1,6.52mm,0.1\n"),
                AllOf(HasSubstr("r.csv:2"), HasSubstr("a length"), HasSubstr("34.5 deg")));
    EXPECT_THAT(complaint("width,0,33.8 deg,0.1\n"), AllOf(HasSubstr("an angle"), HasSubstr("mm")));
    EXPECT_THAT(complaint("weight,,6.5mm,0.1\n"), HasSubstr("1.05 ct"));
    EXPECT_THAT(complaint("table,0,58%,0.1\n"), AllOf(HasSubstr("percentage"), HasSubstr("mm")));
    EXPECT_THAT(complaint("width,0,6.5 furlongs,0.1\n"), HasSubstr("furlongs"));
    EXPECT_THAT(complaint("width,0,6.5,3 deg\n"), AllOf(HasSubstr("sigma"), HasSubstr("an angle")));
}

TEST_F(Words, TradeWordsAreKinds) {
    const auto readings = rows(
        "Angle,C1,34,0.1\ntotal depth,,3.6,0.01\nTotal Height,,3.6,0.01\nheight,,3.6,0.01\n"
        "carat,,0.95,0.01\ntable,0,3.4,0.03\ndiameter,90,6,0.01\n");
    const ReadingKind kinds[] = {
        ReadingKind::inclination, ReadingKind::depth,       ReadingKind::depth, ReadingKind::depth,
        ReadingKind::weight,      ReadingKind::table_width, ReadingKind::width};
    ASSERT_EQ(readings.size(), std::size(kinds));
    for (std::size_t i = 0; i < std::size(kinds); ++i) EXPECT_EQ(readings[i].kind, kinds[i]) << i;
    EXPECT_THAT(notes_, IsEmpty());
}

// The mean of n readings of sigma s sqrt(n) has the sigma s.
TEST_F(Words, DiameterIsTheMeanAcrossOppositeMains) {
    const auto readings = rows("diameter,,6.02,0.01\n");
    ASSERT_EQ(readings.size(), 4u);
    double variance_of_mean = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(readings[i].kind, ReadingKind::width);
        EXPECT_EQ(readings[i].value, 6.02);
        EXPECT_NEAR(readings[i].direction.x, std::cos(radians(45.0 * double(i))), 1e-9);
        EXPECT_NEAR(readings[i].direction.y, std::sin(radians(45.0 * double(i))), 1e-9);
        variance_of_mean += readings[i].sigma * readings[i].sigma / 16;
    }
    EXPECT_NEAR(std::sqrt(variance_of_mean), 0.01, 1e-12);
    EXPECT_EQ(readings[1].id, "r0.45");
    EXPECT_THAT(notes_, Contains(HasSubstr("4 widths")));
    stone_ = stone_of(make_cut("oval"));
    EXPECT_THAT(complaint("diameter,,5,0.01\n"), HasSubstr("not round"));
    EXPECT_THAT(complaint("width,,5,0.01\n"), HasSubstr("`diameter`"));
}

TEST_F(Words, TableIsTheMeanOverOppositeCorners) {
    stone_.up_facet = "T";
    const auto readings = rows("table,,3.42,0.02\n");
    ASSERT_EQ(readings.size(), 4u);
    EXPECT_NEAR(readings[2].azimuth, radians(90), 1e-9);
    EXPECT_NEAR(readings[2].sigma, 0.04, 1e-15);
    // Without a datum for azimuths the table's orientation is open.
    EXPECT_THAT(complaint("azimuth,C1,12,0.1\ntable,,3.42,0.02\n"), HasSubstr("table_width"));
    stone_.azimuth_from_mesh = true;
    EXPECT_EQ(rows("azimuth,C1,0,0.1\ntable,,3.42,0.02\n").size(), 5u);
    stone_ = stone_of(make_cut("step"));
    stone_.up_facet = "T";
    EXPECT_THAT(complaint("table,,3,0.01\n"), HasSubstr("not a regular polygon"));
}

TEST_F(Words, CrownAngleIsTheMeanOfTheMains) {
    const auto readings =
        rows("crown_angle,,34.2,0.1\nPavilion Angle,,41,0.1\ncrown-angle,C1,34,0.1\n");
    ASSERT_EQ(readings.size(), 3u);
    EXPECT_EQ(readings[0].aggregate, Aggregate::mean);
    EXPECT_EQ(readings[0].of, std::vector<std::string>{"mean(C*)"});
    EXPECT_EQ(readings[0].facets.size(), 8u);
    EXPECT_EQ(readings[1].of, std::vector<std::string>{"mean(P*)"});
    EXPECT_EQ(readings[2].facets.size(), 1u);
}

// A reading of a facet's own tooth is its azimuth, because the wheel is the design's.
TEST_F(Words, IndexIsTheToothOfTheWheel) {
    stone_ = stone_of(parse_gemcad_asc("GemCad 5.0\ng 96 0.0\ny 1 n\nI 1.54\n"
                                       "a -90 1.0 2 n G 26 50 74\na 40 0.9 2 n A 26 50 74\n"
                                       "a -41 0.9 2 n P 26 50 74\na 0 0.5 96 n T\n")
                          .solid);
    const auto readings = rows(
        "index,A,2 of 96,0.1\nindex,A.1,26/96,0.4 deg\nindex,P.2,50/96,0.1\n"
        "index,G.3,74 of 96,0.1\n");
    ASSERT_EQ(readings.size(), 4u);
    for (const Reading& r : readings) {
        EXPECT_EQ(r.kind, ReadingKind::azimuth);
        const Vec3& n = facet_of(r).plane.normal;
        EXPECT_NEAR(std::remainder(r.value - std::atan2(n.y, n.x), 2 * std::numbers::pi), 0, 1e-12);
    }
    EXPECT_NEAR(readings[0].sigma, radians(0.1 * 360 / 96), 1e-15);
    EXPECT_NEAR(readings[1].sigma, radians(0.4), 1e-15);
    EXPECT_THAT(complaint("index,A,12,0.1\n"), HasSubstr("12 of 96"));
    EXPECT_THAT(complaint("index,A,97 of 96,0.1\n"), HasSubstr("no such tooth"));
    EXPECT_THAT(complaint("index,A,12 deg,0.1\n"), HasSubstr("`azimuth`"));
}

TEST_F(Words, MisspeltKindsAreAnsweredWithTheNearest) {
    const std::pair<const char*, const char*> slips[] = {
        {"inclanation", "inclination"}, {"incl", "inclination"}, {"diametre", "diameter"},
        {"wieght", "weight"},           {"azimut", "azimuth"},   {"tabel", "table"}};
    for (const auto& [written, meant] : slips) {
        EXPECT_THAT(complaint(std::string(written) + ",C1,1,0.1\n"),
                    HasSubstr(std::string("did you mean ") + meant + "?"));
    }
    EXPECT_THAT(complaint("colour,C1,1,0.1\n"), Not(HasSubstr("did you mean")));
}

TEST_F(Words, CapitalsAreForgivenWhereNothingElseIsMeant) {
    const auto readings = rows("inclination,c1,34,0.1\ninclination,c2,34,0.1\n");
    EXPECT_EQ(facet_of(readings[0]).name, "C1");
    EXPECT_THAT(notes_, Contains(AllOf(HasSubstr("c1 for C1"), HasSubstr("c2 for C2"))));
    EXPECT_EQ(rows("inclination,c*,34,0.1\n").size(), 8u);
    EXPECT_THAT(notes_, Contains(HasSubstr("c* for C1, ...")));
    rename("S1", "a");
    rename("S2", "A");
    EXPECT_EQ(facet_of(rows("inclination,a,20,0.1\n")[0]).name, "a");
    rename("S3", "Ab");
    rename("S4", "aB");
    EXPECT_THAT(complaint("inclination,ab,20,0.1\n"), HasSubstr("no facet 'ab'"));
}

// A tier 1 beside a tier 11: only the asterisk covers both.
TEST_F(Words, TiersOfADesignAreMeantByTheirNames) {
    stone_ = stone_of(parse_gemcad_asc("GemCad 5.0\ng 96 0.0\ny 1 n\nI 1.54\n"
                                       "a -90 1.0 96 n G 24 48 72\na -41 0.9 96 n 1 24 48 72\n"
                                       "a -44 0.99 12 n 11 36 60 84\na 0 0.5 96 n T\n")
                          .solid);
    EXPECT_EQ(rows("inclination,1.*,41,0.1\n").size(), 4u);
    EXPECT_THAT(notes_, IsEmpty());
    EXPECT_EQ(rows("inclination,11.*,44,0.1\n").size(), 4u);
    EXPECT_EQ(rows("inclination,1*,41,0.1\n").size(), 8u);
    EXPECT_THAT(notes_, Contains(AllOf(HasSubstr("line 2 of r.csv"), HasSubstr("1, 11"),
                                       HasSubstr("1.*"))));
    EXPECT_EQ(rows("inclination,11,44,0.1\n").size(), 1u);
    EXPECT_THAT(notes_, Contains(says("line 2", "11", "4")));
    rows("inclination,11,44,0.1\ninclination,11.1,44,0.1\n");
    EXPECT_THAT(notes_, IsEmpty());
    EXPECT_EQ(rows("inclination,each(11/11.1),44,0.1\n").size(), 2u);
    EXPECT_THAT(notes_, IsEmpty());
}

}  // namespace
}  // namespace culet
