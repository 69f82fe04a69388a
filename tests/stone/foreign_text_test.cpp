// Text from other programs and systems: byte order marks, encodings, line ends, symbols.

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <functional>

#include "stone/gemcad/gemcad_io.h"
#include "stone/mesh/mesh_io.h"
#include "stone/text/csv.h"
#include "stone/text/errors.h"
#include "stone/text/text_decoding.h"
#include "stone/text/text_scan.h"
#include "stone/text/toml_file.h"
#include "stone/text/written_number.h"
#include "tests/folder_test.h"
#include "tests/says.h"

namespace culet::test {
namespace {

using testing::HasSubstr;

/// UTF-16 (RFC 2781) of ASCII text.
std::string utf16(const std::string& text, bool little, bool mark) {
    std::string bytes = !mark ? "" : little ? "\xff\xfe" : "\xfe\xff";
    for (const char c : text) {
        if (!little) bytes += '\0';
        bytes += c;
        if (little) bytes += '\0';
    }
    return bytes;
}

std::string with_ends(const std::string& text, const std::string& end) {
    std::string changed;
    for (const char c : text) changed += c == '\n' ? end : std::string(1, c);
    return changed;
}

std::vector<std::pair<const char*, std::string>> kept_otherwise(const std::string& text) {
    return {{"mark", "\xef\xbb\xbf" + text},
            {"UTF-16 LE", utf16(text, true, true)},
            {"UTF-16 BE", utf16(text, false, true)},
            {"UTF-16 without a mark", utf16(text, true, false)},
            {"CR", with_ends(text, "\r")},
            {"CRLF and Ctrl-Z", with_ends(text, "\r\n") + "\x1a"},
            {"Ctrl-Z in a block of zeros", text + "\x1a" + std::string(100, '\0')}};
}

std::string refusal_of(const std::function<void()>& work) {
    try {
        work();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

TEST(ForeignText, BytesBecomeUtf8) {
    const struct {
        std::string bytes, text;
    } cases[] = {
        {"a\nb\n", "a\nb\n"},
        {"a\rb\r\nc\n\re", "a\nb\nc\n\ne"},  // a lone CR is an end, CRLF is one
        {"a\x1a", "a"},
        {"a\x1a"
         "b",
         "a\x1a"
         "b"},  // not the end of the file: text follows
        // A surrogate pair (RFC 2781, 2.1: U+1F48E is D83D DC8E), and a half of one.
        {"\xff\xfe\x3d\xd8\x8e\xdc", "\xf0\x9f\x92\x8e"},
        {std::string("\xfe\xff\xd8\x3d\0a", 6),
         "\xef\xbf\xbd"
         "a"},
        // Windows-1252 in one line, UTF-8 in another (CP1252.TXT: E9 is U+00E9).
        {"caf\xe9\ncaf\xc3\xa9", "caf\xc3\xa9\ncaf\xc3\xa9"},
        {"", ""},
    };
    for (const auto& one : cases) EXPECT_EQ(decoded_text(one.bytes, "file"), one.text);
}

TEST(ForeignText, OtherFilesAreNamedWithARemedy) {
    const struct {
        std::string bytes;
        const char *what, *remedy;
    } cases[] = {
        {"PK\x03\x04rest", "Excel", "CSV"},
        {"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", "Excel", "CSV"},
        {"%PDF-1.7\n", "PDF", "text"},
        {"\x1f\x8b\x08", "gzip", "unpack"},
        {std::string("\0\0\0\x18"
                     "ftypheic",
                     12),
         "HEIC", "export"},
        {"\xef\xbb\xbf<!DOCTYPE html>", "HTML", "download"},
        {std::string("\xff\xfe\0\0a\0\0\0", 8), "UTF-32", "UTF-8"},
    };
    for (const auto& one : cases) {
        EXPECT_THAT(refusal_of([&] { decoded_text(one.bytes, "file"); }),
                    says(one.what, one.remedy));
    }
    EXPECT_THAT(refusal_of([] { decoded_text(std::string("a\nb\nc\0d\n", 8), "file"); }),
                HasSubstr("file:3: "));
}

// A tetrahedron with legs of 1 (volume 1/6), a cube with edges of 2 (volume 8).
const std::string k_corners = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string k_obj =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const std::string k_off = "OFF\n4 4 0\n" + k_corners + "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
const std::string k_ply =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
    "z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n" +
    k_corners + "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
const std::string k_asc = "GemCad 5.0\ng 96 0.0\ny 4 n\na 90 1 96 24 48 72\na 0 1 96\na -0 1 96\n";

std::string stl_text_of_it() {
    return mesh_text(parse_mesh(k_obj, MeshFormat::obj).solid, MeshFormat::stl);
}

double volume_in(const std::string& bytes, MeshFormat format) {
    return volume(parse_mesh(bytes, format).solid);
}

TEST(ForeignText, EveryMeshAndDesignIsReadHoweverItsTextIsKept) {
    for (const auto& [format, text] :
         {std::pair(MeshFormat::obj, k_obj), std::pair(MeshFormat::off, k_off),
          std::pair(MeshFormat::ply, k_ply), std::pair(MeshFormat::stl, stl_text_of_it())}) {
        for (const auto& [how, bytes] : kept_otherwise(text)) {
            SCOPED_TRACE(std::string(how) + " " + std::to_string(static_cast<int>(format)));
            EXPECT_NEAR(volume_in(bytes, format), 1.0 / 6, 1e-15);
        }
    }
    for (const auto& [how, bytes] : kept_otherwise(k_asc)) {
        SCOPED_TRACE(how);
        EXPECT_NEAR(volume(parse_gemcad_asc(bytes).solid), 8, 1e-12);
    }
}

TEST(ForeignText, LinesOfErrorsStayRight) {
    const std::string wrong = "v 0 0 0\nv 1 0 0\nv 0 x 0\n";
    for (const auto& [how, bytes] : kept_otherwise(wrong)) {
        SCOPED_TRACE(how);
        EXPECT_THAT(refusal_of([&, text = bytes] { parse_mesh(text, MeshFormat::obj, "a.obj"); }),
                    says("a.obj:3: ", "'x'"));
    }
}

class ForeignTables : public FolderTest {};

TEST_F(ForeignTables, TablesAndStoneFilesAreReadHoweverTheirTextIsKept) {
    for (const auto& [how, bytes] : kept_otherwise("kind,value\ndepth,3.5\n")) {
        SCOPED_TRACE(how);
        const CsvTable table = read_csv(write("a.csv", bytes));
        ASSERT_EQ(table.rows.size(), 2u);
        EXPECT_EQ(table.rows[0].fields, (std::vector<std::string>{"kind", "value"}));
        EXPECT_EQ(table.rows[1].fields, (std::vector<std::string>{"depth", "3.5"}));
        EXPECT_EQ(table.rows[1].line, 2);
    }
    for (const auto& [how, bytes] : kept_otherwise("a = 1\nb = 2.5\n")) {
        SCOPED_TRACE(how);
        EXPECT_EQ(read_toml(write("a.toml", bytes)).number("b"), 2.5);
    }
}

TEST(ForeignText, NumbersWithATypesettersMinusAndBlanks) {
    for (const char* const minus : {"-", "\u2212", "\u2013", "\u2012", "\u2010"}) {
        EXPECT_EQ(number_in(std::string(minus) + "2.5"), -2.5) << minus;
        EXPECT_EQ(written_number(std::string(minus) + "2,5 \u00b0", false).value, -2.5) << minus;
    }
    EXPECT_EQ(number_in("\u2212"), std::nullopt);
    EXPECT_EQ(number_in("2\u22125"), std::nullopt);
    EXPECT_EQ(number_in("34\uff0e0"), std::nullopt);  // a full-width full stop
    EXPECT_EQ(words_of("\ufeffv\u00a01\u202f2\t3 ").size(), 4u);
    EXPECT_EQ(trimmed("\u00a0 a b\u2009\u3000"), "a b");
    EXPECT_THAT(not_a_number("2,5"), says("decimal comma", "2.5"));
    EXPECT_THAT(not_a_number("1.5,2.5,3.5"), says("blanks"));
    EXPECT_THAT(written_number("34.0 \u00b1 0.05", false).problem, says("\u00b1 0.05", "sigma"));
}

TEST(ForeignText, WhatPeopleSeeIsWholeCharactersAndNoCommands) {
    EXPECT_EQ(shown("Gro\u00dfe Tafel \u5b9d\u77f3"), "Gro\u00dfe Tafel \u5b9d\u77f3");
    EXPECT_EQ(shown("a\u202eb\xff"
                    "c\u009b"),
              "a?b?c?");
    std::string letters;
    for (int i = 0; i < 50; ++i) letters += "\u00e9";
    EXPECT_EQ(shown(letters), letters.substr(0, 80) + "...");  // two bytes per letter
    EXPECT_EQ(for_terminal("\u5b9d\u202e\xff"), "\u5b9d\\u202e\\xff");
    EXPECT_EQ(for_terminal("\u00e9 \U0001f48e", true), "\\u00e9 \\u1f48e");
    // 200 letters in quotes: 120 are kept, three of them points.
    std::string quote = for_terminal("\"" + letters + letters + letters + letters + "\"");
    EXPECT_EQ(quote.size(), 2 + 3 + 2 * 117u);
}

template <class Value>
void append_value(std::string& bytes, Value value) {
    const auto* const raw = reinterpret_cast<const char*>(&value);
    std::string part(raw, sizeof value);
    if (std::endian::native != std::endian::little) part = {part.rbegin(), part.rend()};
    bytes += part;
}

// The first byte of the data is a line feed: the float 0x3f80000a is 1.0000012.
TEST(ForeignText, HeadersOfBinaryPlyMayEndInAnyLineEnd) {
    const float x = std::bit_cast<float>(0x3f80000a);
    std::string data;
    for (const float f : {x, 0.f, 0.f, 0.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f})
        append_value(data, f);
    for (const auto& face :
         {std::array{0, 1, 2}, std::array{0, 3, 1}, std::array{1, 3, 2}, std::array{0, 2, 3}}) {
        data += '\3';
        for (const int corner : face) append_value(data, std::int32_t{corner});
    }
    std::string header = k_ply.substr(0, k_ply.find(k_corners));
    header.replace(header.find("ascii"), 5, "binary_little_endian");
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        for (const std::string mark : {"", "\xef\xbb\xbf"}) {
            SCOPED_TRACE(static_cast<int>(end.size()));
            EXPECT_NEAR(std::abs(volume_in(mark + with_ends(header, end) + data, MeshFormat::ply)),
                        static_cast<double>(x) / 6, 1e-12);
        }
    }
}

TEST(ForeignText, BinaryStlMayHaveAMarkAndTheWordSolidInItsHeader) {
    const Solid solid = parse_mesh(k_obj, MeshFormat::obj).solid;
    std::string bytes = "solid by some program";
    bytes.resize(80, ' ');
    append_value(bytes, std::uint32_t{4});
    for (const Facet& facet : solid.facets) {
        for (int i = 0; i < 3; ++i) append_value(bytes, 0.f);
        for (const int corner : facet.corners) {
            for (int axis = 0; axis < 3; ++axis)
                append_value(bytes, static_cast<float>(
                                        solid.vertices[static_cast<std::size_t>(corner)][axis]));
        }
        append_value(bytes, std::uint16_t{0});
    }
    EXPECT_NEAR(volume_in(bytes, MeshFormat::stl), 1.0 / 6, 1e-15);
    EXPECT_NEAR(volume_in("\xef\xbb\xbf" + bytes, MeshFormat::stl), 1.0 / 6, 1e-15);
}

}  // namespace
}  // namespace culet::test
