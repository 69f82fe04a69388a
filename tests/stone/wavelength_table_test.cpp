// Tables by wavelength: the unit is the header's, or the one in which the table covers visible
// light.

#include "stone/material/wavelength_table.h"

#include <gmock/gmock.h>

#include "stone/text/errors.h"
#include "tests/folder_test.h"

namespace culet::test {
namespace {

using testing::HasSubstr;

class WavelengthTables : public FolderTest {};

TEST_F(WavelengthTables, WavelengthsComeInTheUnitThatTheirRangeOrHeaderTells) {
    const struct {
        const char *text, *note;  ///< the note; empty: none
        double at_550;
    } cases[] = {
        {"wl,n\n400,1.80\n700,1.70\n", "", 1.75},
        {"wl,n\n0.40,1.80\n0.70,1.70\n", "micrometres", 1.75},  // refractiveindex.info
        {"wl,n\n4000,1.80\n7000,1.70\n", "Angstrom", 1.75},
        {"wl,n\n700,1.70\n400,1.80\n", "", 1.75},  // from red to blue
        {"nm;n\n400;1,80\n700;1,70\n", "", 1.75},
        {"400 1.80\n700\t1.70\n", "", 1.75},
        {"wavelength (um) n\n0.40 1.80\n0.70 1.70\n", "", 1.75},
        {"\u03bb/\u00c5,n\n4000,1.80\n7000,1.70\n", "", 1.75},
        {"nm,alpha (1/cm)\n400,0\n700,10\n", "per mm", 0.5},
    };
    for (const auto& one : cases) {
        SCOPED_TRACE(one.text);
        std::vector<std::string> notes;
        const Spectrum spectrum = read_wavelength_table(write("n.csv", one.text), "index", notes);
        EXPECT_NEAR(spectrum.at(550), one.at_550, 1e-12);
        ASSERT_EQ(notes.size(), *one.note == '\0' ? 0u : 1u);
        for (const std::string& note : notes) EXPECT_THAT(note, HasSubstr(one.note));
    }
}

TEST_F(WavelengthTables, WavelengthsThatMayMeanSomethingElseAreRefused) {
    const struct {
        const char *text, *says;
    } cases[] = {
        {"wl,n\n5,1.80\n20,1.70\n", "380"},                 // far infrared in um, or what?
        {"wl,n\n5000,1.80\n25000,1.70\n", "wave numbers"},  // Angstrom, or 1/cm
        {"wl (nm),n\n0.4,1.80\n0.7,1.70\n", "header"},      // the header and the range disagree
        {"cm-1,a\n14000,1\n25000,2\n", "cm-1"},
        {"wl,n\n400,1.80\n400,1.70\n", "n.csv:3: "},
        {"wl,n,k\n400,1.80,0\n", "n.csv:2: "},
        {"wl,n\n400,1.8\n700,1.7\n\nwl,k\n400,0\n", "n.csv:5: "},
        {"wl,n\n400 nm,1.8\n", "n.csv:2: "},
        {"wl,n\n", "no numbers"},
    };
    for (const auto& one : cases) {
        SCOPED_TRACE(one.text);
        std::vector<std::string> notes;
        const std::string file = write("n.csv", one.text);
        try {
            read_wavelength_table(file, "index", notes);
            ADD_FAILURE();
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr(one.says));
        }
    }
}

}  // namespace
}  // namespace culet::test
