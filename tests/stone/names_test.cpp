// Unknown names, values that are not TOML, and foreign text for a terminal.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include "stone/material/material.h"
#include "stone/text/errors.h"
#include "stone/text/name_suggestions.h"
#include "stone/text/toml_advice.h"
#include "stone/text/toml_file.h"
#include "tests/scratch_folder.h"

namespace culet {
namespace {

std::string error_of(const std::string& name) {
    try {
        catalogue_material(name);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

bool has(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

TEST(NamesLike, BeginWithTheWordElseHoldItElseAreSpeltAlike) {
    const std::vector<std::string> known{"sapphire_blue", "ruby_gem", "ruby_pale", "topaz_blue"};
    const auto names = [&known](const char* word) { return names_like(word, known); };
    EXPECT_EQ(names("ruby"), (std::vector<std::string>{"ruby_gem", "ruby_pale"}));
    EXPECT_EQ(names("Blue"), (std::vector<std::string>{"sapphire_blue", "topaz_blue"}));
    EXPECT_EQ(names("blue sapphire"), std::vector<std::string>{"sapphire_blue"});
    // One letter away from a part of the name.
    EXPECT_EQ(names("saphire"), std::vector<std::string>{"sapphire_blue"});
    EXPECT_TRUE(names("opal").empty());
    EXPECT_TRUE(names("").empty());
    EXPECT_TRUE(names(std::string(1000000, 'x').c_str()).empty());
}

TEST(NamesLike, AreListedInWords) {
    EXPECT_EQ(listed({}), "");
    EXPECT_EQ(listed({"a"}), "\"a\"");
    EXPECT_EQ(listed({"a", "b"}), "\"a\" or \"b\"");
    EXPECT_EQ(listed({"a", "b", "c", "d", "e", "f"}, 3), "\"a\", \"b\", \"c\" or 3 more");
}

TEST(Catalogue, AnswersTradeNamesWithWhatItHas) {
    EXPECT_NE(error_of("sapphire").find("mean \"sapphire_blue\", \"corundum\""), std::string::npos)
        << error_of("sapphire");
    EXPECT_NE(error_of("topaz").find("mean \"topaz_fluor\", \"topaz_imperial\" or \"topaz_blue\"?"),
              std::string::npos)
        << error_of("topaz");
    EXPECT_NE(error_of("beryl").find("mean \"aquamarine\" or \"emerald\"?"), std::string::npos)
        << error_of("beryl");
    for (const char* kind :
         {"pyrope", "almandine", "spessartine", "grossular", "andradite", "rhodolite"})
        EXPECT_NE(error_of("garnet").find(kind), std::string::npos) << kind;
    EXPECT_NE(error_of("dimond").find("\"diamond\""), std::string::npos);
    // Tsavorite and demantoid are garnets, found by their usual colours.
    EXPECT_EQ(catalogue_names_like("tsavorite"), std::vector<std::string>{"garnet_grossular"});
    EXPECT_EQ(catalogue_names_like("Demantoid"), std::vector<std::string>{"garnet_andradite"});
    EXPECT_TRUE(has(catalogue_names_like("garnet"), "garnet_rhodolite"));
    EXPECT_TRUE(catalogue_names_like("qqqqqqqq").empty());
    EXPECT_LT(for_terminal(error_of(std::string(1 << 20, 'x'))).size(), 400u);
}

TEST(Catalogue, KnowsAStoneByItsTitle) {
    const Material ruby = catalogue_material("Ruby");
    EXPECT_EQ(ruby.id, "ruby_gem");
    // Red: the green between chromium's two bands is absorbed, red passes.
    EXPECT_GT(ruby.absorption_per_mm[0].at(550), 10 * ruby.absorption_per_mm[0].at(650));
    EXPECT_EQ(catalogue_material("blue sapphire").id, "sapphire_blue");
    EXPECT_EQ(catalogue_material("Diamond").id, "diamond");
    std::set<std::string> titles;
    for (const std::string& name : catalogue_names())
        EXPECT_TRUE(titles.insert(catalogue_material(name).name).second) << name;
}

TEST(Catalogue, SaysWhenTheColourOfAStoneIsMissing) {
    EXPECT_NE(notes_on(catalogue_material("aquamarine")).at(0).find("light greenish blue"),
              std::string::npos);
    for (const char* name : {"diamond", "quartz", "glass_bk7", "corundum", "garnet_rhodolite",
                             "peridot", "tourmaline_green"}) {
        EXPECT_TRUE(notes_on(catalogue_material(name)).empty()) << name;
    }
    // Every material of the catalogue has a spectrum, is colourless, or says what is missing.
    for (const std::string& name : catalogue_names()) {
        const Material material = catalogue_material(name);
        EXPECT_EQ(material.has_absorption(), !material.absorption_source.empty()) << name;
    }
}

TEST(Catalogue, AbsorbsByTheTableTimesTheDepthOfTheName) {
    // Dubinsky et al. 2020: 14.6 /cm at 410 nm for 750 ppma Cr and E across c; the ruby of the
    // catalogue has 2000 ppma. The pale one is as in its table: 2.609 /cm for 134 ppma.
    EXPECT_NEAR(catalogue_material("ruby_gem").absorption_per_mm[0].at(410), 1.46 * 2000 / 750,
                1e-4);
    EXPECT_NEAR(catalogue_material("ruby_pale").absorption_per_mm[0].at(410), 0.2609, 1e-12);
    EXPECT_FALSE(catalogue_material("ruby_gem").absorption_depth.empty());
    EXPECT_TRUE(catalogue_material("ruby_pale").absorption_depth.empty());
}

// A gem with absorption for rays that its mineral lacks would be drawn colourless.
TEST(Catalogue, HasOnlyEntriesThatCanBeRead) {
    ASSERT_GT(catalogue_names().size(), 40u);
    for (const std::string& name : catalogue_names())
        EXPECT_NO_THROW(catalogue_material(name)) << name;
}

TEST(Catalogue, BandsOfGarnetsMakeTheirTables) {
    // Gaussians over the wavenumber, with half the maximum at half the width; strengths in 1/cm.
    struct Band {
        double nm, width, peak;
    };
    // A share of almandine, and the broad band's strength.
    struct Garnet {
        const char* name;
        double almandine, broad;
    };
    for (const Garnet& garnet :
         {Garnet{"garnet_rhodolite", 0.42, 1.7}, {"garnet_almandine", 0.7, 3.5}}) {
        const double iron = garnet.almandine;
        const Band bands[] = {{505, 700, 15 * iron},  {527, 800, 20 * iron},
                              {576, 650, 25 * iron},  {441, 7000, garnet.broad},
                              {462, 700, 2.5 * iron}, {428, 800, 2.5 * iron},
                              {617, 900, 2.5 * iron}, {690, 900, 2.5 * iron}};
        const Material material = catalogue_material(garnet.name);
        for (int nm = 380; nm <= 780; nm += 40) {
            double sum = 0;
            for (const Band& band : bands) {
                const double x = (1e7 / nm - 1e7 / band.nm) / band.width;
                sum += band.peak * std::exp2(-4 * x * x);
            }
            // The table has four digits: half of the last is at most 5e-4 of the value.
            EXPECT_NEAR(material.absorption_per_mm[0].at(nm), 0.1 * sum, 5e-5 * sum) << nm;
        }
    }
}

TEST(TomlAdvice, SaysWhatToWrite) {
    EXPECT_EQ(toml_advice("name = Dravite, off-standard # mine"),
              "put quotes about a text: name = \"Dravite, off-standard\"");
    EXPECT_EQ(toml_advice("stone = ../a.toml"), "put quotes about a text: stone = \"../a.toml\"");
    EXPECT_EQ(toml_advice("value = 6.52mm"), "write 6.52 without \"mm\"");
    EXPECT_EQ(toml_advice("value = 6,52"), "write 6.52 with a point");
    EXPECT_EQ(toml_advice("tolerance = 5%"), "write 0.05 for a fraction, 5 for per cent");
    EXPECT_EQ(toml_advice("unit: mm"), "write unit = mm, with =");
    EXPECT_EQ(toml_advice("name = \"Dravite"), "a quote is not closed");
    EXPECT_EQ(toml_advice("value ="), "a value is missing behind value =");
    // Nothing to report where the value is right, or inside lists.
    for (const char* line : {"value = 6.52", "value = true", "at = [1, 2, x]", "", "# x", "[a"}) {
        EXPECT_EQ(toml_advice(line), "") << line;
    }
    EXPECT_EQ(number_advice("5"), "");
    EXPECT_EQ(number_advice("mm"), "");
    EXPECT_EQ(without_unit("6.52 mm", "mm"), "6.52");
    EXPECT_EQ(without_unit("58%", "%"), "58");
    EXPECT_EQ(without_unit("33.8\u00b0", "deg"), "33.8");
    // Whoever reads the number handles a foreign unit.
    EXPECT_EQ(without_unit("6.52cm", "mm"), "6.52cm");
    EXPECT_EQ(without_unit("wide", "mm"), "wide");
}

TEST(TomlAdvice, StandsInTheErrorWithTheLine) {
    const test::ScratchFolder folder;
    const auto error = [&folder](const std::string& text) -> std::string {
        std::ofstream(folder / "a.toml") << text;
        try {
            const TomlTable root = read_toml(folder / "a.toml");
            root.number("value");
        } catch (const InputError& caught) {
            return caught.what();
        }
        return "no error";
    };
    const std::string unquoted = error("value = 1\nname = Dravite\n");
    EXPECT_NE(unquoted.find("a.toml:2:"), std::string::npos) << unquoted;
    EXPECT_NE(unquoted.find("name = \"Dravite\""), std::string::npos) << unquoted;
    EXPECT_NE(error("value = \"6.52mm\"\n").find("write 6.52 without \"mm\""), std::string::npos);
}

TEST(ForTerminal, LetsNoControlCharacterThroughAndShortensWhatIsQuoted) {
    EXPECT_EQ(for_terminal("a\x1b[31m\nb\x7f"), "a [31m b ");
    EXPECT_EQ(for_terminal("a\u009b31m"), "a  31m");
    EXPECT_EQ(for_terminal("\u00e4\u00f6 \"\u00fc\""), "\u00e4\u00f6 \"\u00fc\"");
    const std::string quoted = for_terminal("no \"" + std::string(5000, 'x') + "\" here");
    EXPECT_EQ(quoted.size(), std::string("no \"\" here").size() + 120);
    EXPECT_NE(quoted.find("x...x"), std::string::npos);
    EXPECT_TRUE(quoted.ends_with("\" here"));
    EXPECT_LE(for_terminal(std::string(1 << 20, 'y')).size(), 2000u);
    // No character is split: every byte of a shortened text of two-byte letters has its partner.
    std::string letters;
    for (int i = 0; i < 3001; ++i) letters += "\u00e4";
    const std::string cut = for_terminal("x" + letters);
    EXPECT_EQ(std::count(cut.begin(), cut.end(), '\xc3'),
              std::count(cut.begin(), cut.end(), '\xa4'));
}

}  // namespace
}  // namespace culet
