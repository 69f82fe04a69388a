#include "stone/text/toml_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "stone/text/errors.h"
#include "stone/text/toml_file.h"
#include "tests/scratch_folder.h"

namespace culet {
namespace {

std::string repeated(const std::string& part, int times) {
    std::string text;
    for (int i = 0; i < times; ++i) text += part;
    return text;
}

// By hand: counts parts between dots in keys and table names only.
TEST(TomlKeys, CountsThePartsOfKeysAlone) {
    EXPECT_EQ(line_of_deep_key("a = 1\nb.c.d = 2\n", 3), 0);
    EXPECT_EQ(line_of_deep_key("a = 1\nb.c.d.e = 2\n", 3), 2);
    EXPECT_EQ(line_of_deep_key("[a.b]\n[[c.d.e.f]]\n", 3), 2);
    EXPECT_EQ(line_of_deep_key("x = { a.b.c.d = 1 }\n", 3), 1);
    EXPECT_EQ(line_of_deep_key("x = [1.5, 2.5, 3.5, 4.5, 5.5]\n", 3), 0);
    EXPECT_EQ(line_of_deep_key("# a.b.c.d.e\nx = 1\n", 3), 0);
    EXPECT_EQ(line_of_deep_key("x = \"a.b.c.d.e\"\ny = 'a.b.c.d.e'\n", 3), 0);
    EXPECT_EQ(line_of_deep_key("x = \"\"\"\na.b.c.d \\\"\"\" e.f.g.h\n\"\"\"\na.b.c.d = 1\n", 3),
              4);
    EXPECT_EQ(line_of_deep_key("x = '''\na.b.c.d '' e\n'''\na.b.c.d = 1\n", 3), 4);
    EXPECT_EQ(line_of_deep_key("x = \"not closed\na.b.c.d = 1\n", 3), 2);
    EXPECT_EQ(line_of_deep_key("a.\"b.b.b.b\".c = 1\n", 3), 0);
    EXPECT_EQ(line_of_deep_key("", 3), 0);
}

// Each of these used to end the program with a stack overflow.
TEST(TomlKeys, OfAHundredThousandPartsAreRefusedInALine) {
    const std::string deep = repeated("a.", 100000);
    for (const std::string& text : {deep + "a = 1\n", "[" + deep + "a]\n", "[[" + deep + "a]]\n",
                                    "x = { " + deep + "a = 1 }\n"}) {
        const test::ScratchFolder folder;
        const auto file = folder.path() / "deep.toml";
        std::ofstream(file) << text;
        try {
            read_toml(file);
            ADD_FAILURE() << "not refused";
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), ::testing::HasSubstr("deep.toml:1: a key has more than"));
        }
    }
}

TEST(TomlKeys, OfOverridesAreBoundedToo) {
    const test::ScratchFolder folder;
    const auto file = folder.path() / "plain.toml";
    std::ofstream(file) << "x = 1\n";
    EXPECT_THROW(read_toml(file, {repeated("a.", 100000) + "a=1"}), InputError);
    EXPECT_NO_THROW(read_toml(file, {"a.b.c=1"}));
}

}  // namespace
}  // namespace culet
