#include "fit/readings/measurement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "fit/fit.h"
#include "stone/text/errors.h"
#include "tests/fit/test_stones.h"
#include "tests/folder_test.h"

namespace culet {
namespace {

using namespace test;
using ::testing::HasSubstr;

class ReadingFiles : public test::FolderTest {
protected:
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }
    std::vector<Reading> bind_csv(const std::string& rows) const {
        return bind_readings(
            read_readings_csv(
                write("r.csv", "kind,of,value,sigma,exact,released,datum,id,note\n" + rows)),
            stone_);
    }
    std::string complaint(const std::string& rows) const {
        try {
            bind_csv(rows);
        } catch (const InputError& error) {
            return error.what();
        }
        return "no complaint";
    }

    Stone stone_ = stone_of(brilliant());
};

// Up to the instrument's error over 90 degrees, a girdle facet is taken to look down whichever way
// a rough mesh draws it. Beyond that the mesh must show that side.
TEST_F(ReadingFiles, ALittleOverUprightIsNoReadingOfThePavilion) {
    for (Facet& facet : stone_.solid.facets) {
        if (facet.name == "G1") facet.plane.normal = {0.6, 0, 0.8};
    }
    const std::vector<Reading> readings = bind_csv("inclination,G1,90.2,0.1\n");
    ASSERT_EQ(readings.size(), 1u);
    EXPECT_NEAR(degrees(readings[0].value), 89.8, 1e-9);
    EXPECT_THAT(complaint("inclination,G1,130,0.1\n"), HasSubstr("outside 0..90"));
}

TEST_F(ReadingFiles, CsvOfEveryKind) {
    const std::vector<Reading> readings = bind_csv(
        "inclination,C1,34.5,0.1\n"
        "azimuth,C1,-12,0.1,,,S1\n"
        "dihedral,C1/U1,150,0.2\n"
        "distance,T/v3,1.2,0.01\n"
        "distance,C1|U1/P1|P2,2.1,0.01\n"
        "edge,T/S1,1.2,0.01\n"
        "width,45,6,0.01\n"
        "width,1 0 0,6,0.01\n"
        "depth,,3.5,0.01\n"
        "table_width,22.5,3.4,0.01\n"
        "volume,,30,0.1\n"
        "weight,,0.5,0.001\n"
        "meet,P*,,0.01\n"
        "meet,P1/P2/L1/L2,,,,true\n"
        "parallel,G1/G9,,0.1\n"
        "coplanar,U1/U2,,,true\n"
        "rotation,8,,,true\n"
        "rotation,8/C*,,0.2\n"
        "mirror,90,,,true\n"
        "mirror,C1/C2/S8/S1,,0.1,,,,pairs,\"a note, with \"\"quotes\"\"\"\n");
    ASSERT_EQ(readings.size(), 20u);
    EXPECT_EQ(readings[0].id, "r0");
    EXPECT_NEAR(readings[0].value, radians(34.5), 1e-15);
    EXPECT_NEAR(readings[0].sigma, radians(0.1), 1e-15);
    EXPECT_EQ(readings[1].datum.kind, Datum::Kind::facet);
    EXPECT_EQ(readings[4].places[0].kind, Place::Kind::edge);
    EXPECT_NEAR(readings[6].azimuth, radians(45), 1e-15);
    EXPECT_TRUE(readings[7].has_direction);
    EXPECT_EQ(readings[12].facets.size(), 8u);
    EXPECT_TRUE(readings[13].released);
    EXPECT_EQ(readings[16].order, 8);
    EXPECT_EQ(readings[17].facets.size(), 8u);
    EXPECT_EQ(readings[19].id, "pairs");
    EXPECT_EQ(readings[19].note, "a note, with \"quotes\"");
}

TEST_F(ReadingFiles, PatternsAndAggregates) {
    const std::vector<Reading> readings = bind_csv(
        "inclination,C*,34.5,0.1,,,,crown\n"
        "inclination,mean(P*),40.8,0.1\n"
        "inclination,max(S1/S2),22,0.5\n"
        "edge,T/mean(S*),1.3,0.05\n"
        "edge,T/S*,1.3,0.05,,,,table\n"
        "inclination,each(S1/S3/U*),30,0.5,,,,some\n");
    ASSERT_EQ(readings.size(), 8u + 3 + 8 + 18);
    EXPECT_EQ(readings[19].id, "some.S1");
    EXPECT_EQ(readings[20].of, std::vector<std::string>{"S3"});
    EXPECT_EQ(readings[0].id, "crown.C1");
    EXPECT_EQ(readings[7].id, "crown.C8");
    EXPECT_EQ(readings[8].aggregate, Aggregate::mean);
    EXPECT_EQ(readings[8].facets.size(), 8u);
    EXPECT_EQ(readings[9].aggregate, Aggregate::max);
    EXPECT_EQ(readings[10].facets.size(), 16u);
    EXPECT_EQ(readings[11].id, "table.T.S1");
}

TEST_F(ReadingFiles, TomlTables) {
    const auto file =
        write("stone.toml",
              "[stone]\nreadings = \"more.csv\"\n[[reading]]\nkind = \"inclination\"\n"
              "of = [\"C1\"]\nvalue = 34.5\nsigma = 0.1\n[[reading]]\nkind = \"rotation\"\n"
              "of = [8, \"C*\"]\nexact = true\n[[reading]]\nkind = \"width\"\nof = 45\n"
              "value = 6\nsigma = 0.01\n[fit]\nmeets = \"soft\"\nmeet_sigma = 0.02\n");
    write("more.csv", "\xEF\xBB\xBFkind,of,value,sigma\r\n# a comment\r\ndepth,,3.5,0.01\r\n\r\n");
    const auto readings = bind_readings(read_readings(file), stone_);
    ASSERT_EQ(readings.size(), 4u);
    EXPECT_EQ(readings[1].facets.size(), 8u);
    EXPECT_EQ(readings[3].kind, ReadingKind::depth);
    EXPECT_EQ(readings[3].line, 3);
    const FitOptions options = read_fit_options(file);
    EXPECT_EQ(options.meets, MeetTreatment::soft);
    EXPECT_EQ(*options.meet_sigma, 0.02);
    EXPECT_EQ(read_fit_options(file, {"fit.meets=released"}).meets, MeetTreatment::released);
    EXPECT_FALSE(read_fit_options(file, {"fit.meet_sigma=auto"}).meet_sigma);
    EXPECT_EQ(*read_readings(file, {"reading.0.sigma=0.3"})[0].sigma, 0.3);
    EXPECT_THROW(read_readings(file, {"reading.9.sigma=0.3"}), InputError);
    EXPECT_THROW(read_fit_options(file, {"fit.meets=loose"}), InputError);
}

// Each error names the file, the line, what was found and what to do.
TEST_F(ReadingFiles, ComplaintsNameTheLine) {
    EXPECT_THAT(complaint("depth,,3.5,0.01\nincl,C1,34,0.1\n"),
                ::testing::AllOf(HasSubstr("r.csv:3: unknown kind of reading 'incl'"),
                                 HasSubstr("inclination")));
    EXPECT_THAT(
        complaint("inclination,C9,34,0.1\n"),
        ::testing::AllOf(HasSubstr("r.csv:2"), HasSubstr("no facet 'C9'"), HasSubstr("C1")));
    EXPECT_THAT(complaint("inclination,Q*,34,0.1\n"), HasSubstr("no facet matches 'Q*'"));
    EXPECT_THAT(complaint("inclination,C1,34,0\n"), HasSubstr("must be positive"));
    EXPECT_THAT(complaint("inclination,C1,34,-1\n"), HasSubstr("must be positive"));
    EXPECT_THAT(complaint("inclination,C1,34,\n"), HasSubstr("sigma is missing"));
    // An empty row of a form is fine. A form without any value is an error, and so is a missing
    // exact value.
    EXPECT_THAT(complaint("inclination,C1,,0.1\n"), HasSubstr("no row has a value yet"));
    EXPECT_THAT(complaint("inclination,C1,,,true\n"), HasSubstr("value is missing"));
    EXPECT_THAT(complaint("inclination,C1,nan,0.1\n"), HasSubstr("finite number"));
    EXPECT_THAT(complaint("inclination,C1,3o,0.1\n"), HasSubstr("'3o'"));
    EXPECT_THAT(complaint("inclination,C1,1e999,0.1\n"), HasSubstr("finite number"));
    EXPECT_THAT(complaint("inclination,C1,95,0.1\n"), HasSubstr("outside 0..90"));
    EXPECT_THAT(complaint("inclination,C1,-5,0.1\n"), HasSubstr("outside 0..90"));
    EXPECT_THAT(complaint("dihedral,C1/U1,180,0.1\n"), HasSubstr("outside 0..180"));
    EXPECT_THAT(complaint("edge,C1/P1,1,0.1\n"), HasSubstr("share no edge"));
    EXPECT_THAT(complaint("edge,C1,1,0.1\n"), HasSubstr("names 1 in `of`; expected two"));
    EXPECT_THAT(complaint("inclination,C1/C2,34,0.1\n"), HasSubstr("names 2"));
    EXPECT_THAT(complaint("depth,T,3,0.1\n"), HasSubstr("leave `of` empty"));
    EXPECT_THAT(complaint("depth,,-3,0.1\n"), HasSubstr("must be positive"));
    EXPECT_THAT(complaint("azimuth,T,3,0.1\n"), HasSubstr("no azimuth"));
    EXPECT_THAT(complaint("azimuth,mean(C*),3,0.1\n"), HasSubstr("no mean"));
    EXPECT_THAT(complaint("distance,T/P1,1,0.1\n"), HasSubstr("not parallel"));
    EXPECT_THAT(complaint("distance,v1/v999,1,0.1\n"), HasSubstr("no vertex 'v999'"));
    EXPECT_THAT(complaint("distance,v1/v1,1,0.1\n"), HasSubstr("same thing twice"));
    EXPECT_THAT(complaint("width,north,6,0.1\n"), HasSubstr("'north'"));
    EXPECT_THAT(complaint("width,0 0 0,6,0.1\n"), HasSubstr("no direction"));
    EXPECT_THAT(complaint("meet,P1/P2,,0.1\n"), HasSubstr("expected 3 or more"));
    EXPECT_THAT(complaint("meet,P1/P2/P2,,0.1\n"), HasSubstr("twice"));
    EXPECT_THAT(complaint("meet,P1/P2/P3,1,0.1\n"), HasSubstr("has no value"));
    EXPECT_THAT(complaint("rotation,C1,,0.1\n"), HasSubstr("order first"));
    EXPECT_THAT(complaint("rotation,1,,0.1\n"), HasSubstr("order first"));
    EXPECT_THAT(complaint("mirror,C1,,0.1\n"), HasSubstr("pairs"));
    EXPECT_THAT(complaint("inclination,C1,34,0.1,maybe\n"), HasSubstr("true or false"));
    EXPECT_THAT(complaint("inclination,C1,34,0.1,,true\n"), HasSubstr("only a meet"));
    EXPECT_THAT(
        complaint("inclination,C1,34,0.1,,,,a\ninclination,C2,34,0.1,,,,a\n"),
        ::testing::AllOf(HasSubstr("r.csv:3"), HasSubstr("'a' is taken"), HasSubstr("r.csv:2")));
    EXPECT_THAT(complaint("inclination,C1,34,0.1,,,,,,,\n"), HasSubstr("11 fields"));
    EXPECT_THAT(complaint("azimuth,C1,364.9,0.1\n"), HasSubstr("4.9?"));
    EXPECT_THAT(complaint("inclination,\"C1,34,0.1\n"), HasSubstr("never closed"));
    EXPECT_THAT(complaint(std::string("inclination,\0C1,34,0.1\n", 24)), HasSubstr("zero byte"));
}

// 6 mm written in another unit: the factor tells which.
TEST_F(ReadingFiles, LengthsInAnotherUnitAreNamed) {
    EXPECT_THAT(complaint("width,0,0.006,0.00001\n"),
                ::testing::AllOf(HasSubstr("1000 times"), HasSubstr("in m?")));
    EXPECT_THAT(complaint("width,0,0.6,0.001\n"), HasSubstr("in cm?"));
    EXPECT_THAT(complaint("width,0,0.236,0.001\n"), HasSubstr("in in?"));
    EXPECT_THAT(complaint("width,0,600,0.001\n"), HasSubstr("100 times"));
    EXPECT_THAT(complaint("width,0,40,0.001\n"), HasSubstr("check"));
    EXPECT_EQ(complaint("width,0,6.3,0.001\n"), "no complaint");
}

// One kind in mm, the other in inches, so the mesh is not at fault; and a volume in another unit.
TEST_F(ReadingFiles, LengthsOfTwoUnitsAreNamed) {
    std::string edges, widths;
    for (int k = 1; k <= 8; ++k) edges += "edge,T/S" + std::to_string(k) + ",1.4,0.01\n";
    for (int k = 0; k < 4; ++k) widths += "width," + std::to_string(45 * k) + ",0.256,0.001\n";
    EXPECT_THAT(complaint(edges + widths),
                ::testing::AllOf(HasSubstr("r.csv:10"), HasSubstr("too small for the 8 edges"),
                                 HasSubstr("another unit")));
    EXPECT_THAT(complaint("width,0,6.3,0.01\nvolume,,100000,10\n"),
                ::testing::AllOf(HasSubstr("r.csv:3"), HasSubstr("its unit (mm3)")));
    EXPECT_THAT(complaint("width,0,6.3,0.01\nweight,,250,1\n"), HasSubstr("its unit (carat)"));
    EXPECT_EQ(complaint("width,0,6.3,0.01\nweight,,0.2,0.01\n"), "no complaint");
}

TEST_F(ReadingFiles, WeightNeedsDensity) {
    stone_.material.density_g_cm3.reset();
    EXPECT_THAT(complaint("weight,,0.5,0.001\n"), HasSubstr("density"));
}

TEST_F(ReadingFiles, HeadersAndFilesThatCannotBe) {
    EXPECT_THROW(read_readings_csv(folder_ / "none.csv"), InputError);
    EXPECT_THROW(read_readings_csv(write("a.csv", "")), InputError);
    EXPECT_THROW(read_readings_csv(write("b.csv", "kind,of,value\n")), InputError);
    EXPECT_THROW(read_readings_csv(write("c.csv", "kind,of,value,sigma,kind\n")), InputError);
    EXPECT_THROW(read_readings_csv(write("d.csv", "kind,of,value,sigma,colour\n")), InputError);
    EXPECT_THROW(read_readings(write("e.toml", "[[reading]]\nof = \"C1\"\n")), InputError);
    EXPECT_THROW(read_readings(write("f.toml", "[[reading]]\nkind = \"depth\"\nsigmaa = 1\n")),
                 InputError);
    EXPECT_THROW(read_readings(write("g.toml", "reading = 3\n")), InputError);
    EXPECT_THROW(read_readings(write("h.toml", "x = [\n")), InputError);
    EXPECT_TRUE(read_readings(write("i.toml", "[stone]\n")).empty());
}

}  // namespace
}  // namespace culet
