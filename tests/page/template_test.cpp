// What a template may contain, and that it escapes: rules of the mustache manual, mustache(5), and
// of page/template.h.

#include "page/template.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <stdexcept>

namespace culet {
namespace {

TEST(Template, EscapesWhatDoesNotSayThatItIsHtml) {
    const Template form{"form", "<p>{{text}}{{{text_html}}}</p>"};
    EXPECT_EQ(filled(form, {{"text", "<b>\x01"}, {"text_html", "<i>"}}),
              "<p>&lt;b&gt;\xef\xbf\xbd<i></p>");
}

TEST(Template, RepeatsListsAndLeavesOutWhatIsEmpty) {
    const Template form{"form", "{{#rows}}{{name}};{{/rows}}{{#note}}({{note}}){{/note}}"};
    const std::vector<View> rows{{{"name", "a"}}, {{"name", "b"}}};
    EXPECT_EQ(filled(form, {{"rows", rows}, {"note", ""}}), "a;b;");
    EXPECT_EQ(filled(form, {{"rows", std::vector<View>{}}, {"note", "n"}}), "(n)");
}

TEST(Template, RefusesNamesThatAreNotThere) {
    for (const char* text : {"{{gone}}", "{{{gone}}}", "{{#gone}}x{{/gone}}", "{{^gone}}x{{/gone}}",
                             "{{>gone}}", "{{#open}}"}) {
        EXPECT_THROW(filled({"form", text}, {{"open", true}}), std::logic_error) << text;
    }
}

// Rule of page/template.h: unescaped values have names that say so.
TEST(Template, FilesWriteNothingUnescapedButWhatIsNamedSo) {
    const std::regex raw(R"(\{\{(\{|&)\s*([a-z_.]*))"), named(R"(.*_(html|svg|css|js|json))");
    for (const char* folder :
         {"page/templates", "compare/report/templates", "tests/hard/templates"}) {
        int files = 0;
        for (const auto& entry : std::filesystem::directory_iterator(
                 std::filesystem::path(CULET_SOURCE_DIR) / folder)) {
            ++files;
            std::ifstream in(entry.path());
            const std::string text{std::istreambuf_iterator<char>(in), {}};
            for (std::sregex_iterator at(text.begin(), text.end(), raw), end; at != end; ++at) {
                EXPECT_TRUE(std::regex_match((*at)[2].str(), named))
                    << entry.path() << ": " << *at->begin();
            }
        }
        EXPECT_GT(files, 0) << folder;
    }
}

}  // namespace
}  // namespace culet
