// The form to fill in at the bench: its rows are readings whose expected values are those of the
// mesh.

#include "fit/readings/readings_template.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "fit/fit.h"
#include "stone/cuts/cuts.h"
#include "stone/design/index_names.h"
#include "stone/gemcad/gemcad_io.h"
#include "stone/stone_io.h"
#include "stone/text/errors.h"
#include "tests/folder_test.h"
#include "tests/says.h"

namespace culet {
namespace {

using ::testing::HasSubstr;

Stone stone_of_cut(const Solid& solid) {
    Stone stone;
    stone.solid = solid;
    stone.material = catalogue_material("diamond");
    stone.facets_are_whole = true;
    stone.azimuth_from_mesh = true;
    return stone;
}

// The form with the expected value from each note filled in; the middle of a range.
std::string filled_in(const std::string& form) {
    const std::regex row(
        "^([a-z_]+,(?:\"[^\"]*\"|[^,]*),)(,.*expected ([0-9.]+)(?: to ([0-9.]+))?.*)$");
    std::istringstream lines(form);
    std::string line, text;
    std::smatch found;
    while (std::getline(lines, line)) {
        if (std::regex_match(line, found, row)) {
            const double from = std::stod(found[3]);
            const double to = found[4].matched ? std::stod(found[4]) : from;
            std::ostringstream value;
            value << 0.5 * (from + to);
            line = found[1].str() + value.str() + found[2].str();
        }
        text += line + "\n";
    }
    return text;
}

class Form : public test::FolderTest {
protected:
    std::vector<WrittenReading> read(const std::string& text) const {
        std::ofstream(folder_ / "form.csv", std::ios::binary) << text;
        return read_readings_csv(folder_ / "form.csv");
    }
    static bool reads(const std::vector<WrittenReading>& written, const std::string& name) {
        return std::any_of(written.begin(), written.end(), [&](const WrittenReading& w) {
            return w.of == std::vector<std::string>{name};
        });
    }
};

TEST_F(Form, OfABrilliantHasARowForEveryMain) {
    const ReadingsForm form = readings_form(stone_of_cut(make_cut("round-brilliant")), true);
    const auto written = read(form.csv);
    EXPECT_EQ(written.size(), form.rows.size());
    EXPECT_EQ(skipped_readings(written), written.size());
    EXPECT_EQ(form.up_facet, "T");
    std::map<std::string, int> rows;
    for (const WrittenReading& w : written) ++rows[w.kind];
    // 8 + 8 mains; then stars, upper halves, girdle and lower halves as patterns.
    EXPECT_EQ(rows["inclination"], 16 + 4);
    EXPECT_EQ(rows["width"], 4);
    EXPECT_EQ(rows["table_width"], 2);
    EXPECT_EQ(rows["depth"], 1);
    EXPECT_EQ(rows["weight"], 1);
    for (const char* pattern : {"S*", "U*", "G*", "L*"}) EXPECT_TRUE(reads(written, pattern));
    EXPECT_THAT(form.csv, HasSubstr("inclination,C1,,0.1,expected 34.50"));
    EXPECT_THAT(form.csv, HasSubstr("expected 6.5 mm (jaws at C1 and C5)"));
    EXPECT_TRUE(form.csv.starts_with("# "));
}

// Filled in as expected, every form binds, is short enough for an evening, and reads each facet but
// the table.
TEST_F(Form, OfEveryCutReadsEveryFacet) {
    for (const CutKind& kind : cut_kinds()) {
        if (!kind.convex) continue;
        Stone stone = stone_of_cut(make_cut(kind.name));
        const ReadingsForm form = readings_form(stone, true);
        stone.up_facet = form.up_facet;
        const auto readings = bind_readings(read(filled_in(form.csv)), stone);
        EXPECT_GE(form.rows.size(), 20u) << kind.name;
        EXPECT_LE(form.rows.size(), 46u) << kind.name << form.csv;
        std::vector<bool> is_read(stone.solid.facets.size(), false);
        for (const Reading& r : readings) {
            if (r.kind != ReadingKind::inclination) continue;
            for (const int f : r.facets) is_read[std::size_t(f)] = true;
        }
        EXPECT_EQ(std::count(is_read.begin(), is_read.end(), false), 1) << kind.name;
    }
}

// Notes have two digits of a degree and four of a length: off by at most 0.005 where sigmas are
// 0.1.
TEST_F(Form, FilledInAsExpectedIsExplainedByTheMesh) {
    Stone stone = stone_of_cut(make_cut("round-brilliant"));
    stone.up_facet = "T";
    const auto readings = bind_readings(read(filled_in(readings_form(stone, true).csv)), stone);
    const FitResult result = fit_stone(stone, readings);
    EXPECT_TRUE(result.findings.suspects.empty());
    for (const FittedReading& r : result.readings) {
        EXPECT_LT(std::abs(r.residual), 0.1 * r.sigma) << r.id;
    }
}

// `{A}` stands for the tier's name.
const std::string k_lines =
    "a -90 1.0 3{G} 9 15 21 27 33 39 45 51 57 63 69 75 81 87 93\n"
    "a -43 0.69662544 3{1} 9 15 21 27 33 39 45 51 57 63 69 75 81 87 93\n"
    "a -41 0.68400618 12{2} 24 36 48 60 72 84 96\n"
    "a 32 0.54688022 3{A} 9 15 21 27 33 39 45 51 57 63 69 75 81 87 93\n"
    "a 28 0.49632800 12{B} 24 36 48 60 72 84 96\n"
    "a 13 0.37513062 6{C} 18 30 42 54 66 78 90\n"
    "a 0 0.26634654 96{T}\n";

Solid design(bool named) {
    const std::string text =
        std::regex_replace(k_lines, std::regex("\\{(.)\\}"), named ? " n $1" : "");
    return parse_gemcad_asc("GemCad 5.0\ng 96 0.0\ny 8 y\nI 1.54\n" + text).solid;
}

// GemCad's tiers: the mains one by one, the others by the design's names or, without names, as
// lists by tier and index.
TEST_F(Form, OfADesignMeansItsTiers) {
    const Solid solid = design(true);
    const auto written = read(readings_form(stone_of_cut(solid), true).csv);
    for (const char* name : {"A*", "1*", "C*", "G*"}) EXPECT_TRUE(reads(written, name)) << name;
    const std::vector<std::string> names = index_names(solid, 96);
    for (const char* name : {"B", "B.7", "2", "2.7"}) {
        EXPECT_TRUE(reads(written, names[std::size_t(find_facet(solid, name))])) << name;
    }
    Stone unnamed = stone_of_cut(design(false));
    const ReadingsForm form = readings_form(unnamed, true);
    unnamed.up_facet = form.up_facet;
    EXPECT_THAT(form.csv, testing::ContainsRegex("each\\([PC][0-9]@"));
    // All 72 facets but the table, and 8 rows of lengths and weight.
    EXPECT_EQ(bind_readings(read(filled_in(form.csv)), unnamed).size(), 72u + 8);
}

// 12, 24, .. of 96 are the eighths of a turn that the design's lines give tier B.
TEST_F(Form, FacetsOfADesignAreCalledByTierAndIndex) {
    const Stone stone = stone_of_cut(design(true));
    const std::vector<std::string> names = index_names(stone.solid, 96);
    for (std::size_t f = 0; f < names.size(); ++f) {
        if (names[f].find('@') == std::string::npos) continue;
        EXPECT_THAT(facets_at_index(stone.solid, names[f]), testing::ElementsAre(int(f)))
            << names[f];
    }
    WrittenReading w;
    w.kind = "inclination";
    w.of = {names[std::size_t(find_facet(stone.solid, "B.3"))]};
    EXPECT_THAT(w.of[0], testing::MatchesRegex("B@[0-9]+"));
    w.value = 30;
    w.sigma = 0.1;
    const std::vector<Reading> bound = bind_readings({w}, stone);
    EXPECT_EQ(stone.solid.facets[std::size_t(bound.at(0).facets[0])].name, "B.3");
    EXPECT_EQ(bound[0].of, w.of);
    // Another wheel, and the name of a facet that a standard cut has: C1 faces along x, a quarter
    // of a turn from where indices begin.
    EXPECT_THAT(
        facets_at_index(stone.solid,
                        index_names(stone.solid, 64)[std::size_t(find_facet(stone.solid, "B.3"))]),
        testing::ElementsAre(find_facet(stone.solid, "B.3")));
    const Solid brilliant = make_cut("round-brilliant");
    for (const char* name : {"C1@24", "C@24", "C1@16of64"}) {
        EXPECT_THAT(facets_at_index(brilliant, name),
                    testing::ElementsAre(find_facet(brilliant, "C1")))
            << name;
    }
    EXPECT_TRUE(facets_at_index(brilliant, "C1@36").empty());
}

// What a spreadsheet makes of 1.10 and 1-2.
TEST_F(Form, LostZerosAndDatesAreToldWithTheirLine) {
    Stone stone = stone_of_cut(make_cut("round-brilliant"));
    for (int i = 1; i <= 16; ++i) {
        const int f = find_facet(stone.solid, "U" + std::to_string(i));
        stone.solid.facets[std::size_t(f)].name = "1." + std::to_string(i);
    }
    const auto refusal = [&](const std::string& rows) -> std::string {
        try {
            bind_readings(read("kind,of,value,sigma\n" + rows), stone);
        } catch (const InputError& error) {
            return error.what();
        }
        return {};
    };
    const std::string lost =
        refusal("inclination,1.1,40,0.1\ninclination,1.2,40,0.1\ninclination,1.1,41,0.1\n");
    EXPECT_THAT(lost, test::says("form.csv:4", "line 2", "1.10"));
    // 1.1 was read twice and 1.10 is there too: not a slip.
    EXPECT_EQ(refusal("inclination,1.1,40,0.1\ninclination,1.1,40,0.1\ninclination,1.10,40,0.1\n"),
              "");
    EXPECT_THAT(refusal("inclination,1-Feb,40,0.1\n"), test::says("form.csv:2", "date", "text"));
}

TEST_F(Form, NamesThatReadingsCannotHoldAreLeftOut) {
    Solid solid = make_cut("round-brilliant");
    solid.facets[std::size_t(find_facet(solid, "C1"))].name = "main/1";
    solid.facets[std::size_t(find_facet(solid, "C2"))].name = "main; \"2\"";
    const auto written = read(readings_form(stone_of_cut(solid), true).csv);
    EXPECT_FALSE(reads(written, "main/1"));
    EXPECT_TRUE(reads(written, "main; \"2\""));
    EXPECT_TRUE(reads(written, "C3"));
}

TEST_F(Form, StoneFileIsReadyForTheFit) {
    std::filesystem::create_directory(folder_ / "bench");
    Stone stone = stone_of_cut(make_cut("oval"));
    stone.name = "An \"oval\"";
    write_solid(stone.solid, folder_ / "oval.obj");
    const ReadingsForm form = readings_form(stone, true);
    std::ofstream(folder_ / "bench" / "form.csv") << filled_in(form.csv);
    const auto file = folder_ / "bench" / "stone.toml";
    std::ofstream(file) << stone_file_text(stone, file, folder_ / "oval.obj",
                                           folder_ / "bench" / "form.csv", "diamond",
                                           form.up_facet);
    const StoneFile back = read_stone(file);
    EXPECT_EQ(back.stone.name, "An \"oval\"");
    EXPECT_EQ(back.stone.up_facet, "T");
    EXPECT_TRUE(back.stone.azimuth_from_mesh);
    EXPECT_TRUE(back.stone.facets_are_whole);  // because culet wrote the mesh
    EXPECT_EQ(read_readings(file).size(), form.rows.size());
    EXPECT_EQ(skipped_readings(read_readings(file)), 0u);
}

}  // namespace
}  // namespace culet
