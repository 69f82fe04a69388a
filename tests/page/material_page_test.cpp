#include "page/material_page.h"

#include <gtest/gtest.h>

#include "stone/text/errors.h"
#include "tests/page/kept_pages.h"

namespace culet {
namespace {

TEST(MaterialPage, ShowsColoursRaysInOrderAndWhatIsMissing) {
    const std::string page = material_page(
        R"({"width_mm": 6.5, "light_path_mm": 8.7, "materials": [
            {"id": "red", "name": "Red <stone>", "index_589nm": {"o": 1.768, "e": 1.76},
             "birefringence": 0.008, "density": 4.0,
             "colour": {"name": "deep red", "srgb": "#99002a", "lab": [29, 64, 20]}},
            {"id": "blue", "index_589nm": {"n": 1.5}, "colour": null,
             "usual_colour": "light blue"},
            {"id": "clear", "index_589nm": {"n": 1.5}, "colour": null}]})",
        "0.2");
    test::keep_page("materials", page);
    EXPECT_NE(page.find("background:#99002a"), std::string::npos);
    EXPECT_NE(page.find("o 1.768<br>e 1.760"), std::string::npos);
    EXPECT_NE(page.find("light blue"), std::string::npos);
    EXPECT_NE(page.find("<td>colourless</td>"), std::string::npos);
    EXPECT_EQ(page.find("<stone>"), std::string::npos) << "foreign text is escaped";
    EXPECT_THROW(material_page("[]", "0.2"), InputError);
}

}  // namespace
}  // namespace culet
