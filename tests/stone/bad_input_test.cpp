// Bad input of every kind for every reader: the result is an InputError or a solid, nothing else.

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <random>

#include "stone/gemcad/gemcad_io.h"
#include "stone/mesh/mesh_io.h"
#include "stone/solid/checks.h"
#include "stone/stone.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "tests/scratch_folder.h"
#include "tests/stone/synthetic_solids.h"

namespace culet {
namespace {

using namespace culet::test;

struct Format {
    const char* extension;
    std::function<Solid(const std::string&)> parse;
    std::string good;
};

std::vector<Format> formats() {
    std::vector<Format> all;
    const Solid solid = random_solid(20, 1);
    for (const auto& [extension, format] :
         {std::pair("obj", MeshFormat::obj), std::pair("off", MeshFormat::off),
          std::pair("ply", MeshFormat::ply), std::pair("stl", MeshFormat::stl)}) {
        all.push_back({extension,
                       [format = format](const std::string& bytes) {
                           return parse_mesh(bytes, format).solid;
                       },
                       mesh_text(solid, format)});
    }
    all.push_back({"asc", [](const std::string& bytes) { return parse_gemcad_asc(bytes).solid; },
                   read_text(committed_designs().front())});
    all.push_back({"gem", [](const std::string& bytes) { return parse_gemcad_gem(bytes).solid; },
                   gem_bytes(cube(), 96, 1.54)});
    const ScratchFolder folder;
    write_cut(cube(), {}, folder / "cube.gcs");
    all.push_back({"gcs", [](const std::string& bytes) { return parse_gcs(bytes).solid; },
                   read_text(folder / "cube.gcs")});
    return all;
}

void expect_survives(const Format& format, const std::string& bytes) {
    try {
        const Solid solid = format.parse(bytes);
        find_faults(solid);
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_FALSE(message.empty());
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
}

TEST(BadInput, TheGoodFilesAreGood) {
    for (const Format& format : formats()) {
        SCOPED_TRACE(format.extension);
        EXPECT_TRUE(
            find_faults(format.parse(format.good), {.planarity = 1e-6, .must_be_convex = true})
                .empty());
    }
}

TEST(BadInput, CutShortAnywhere) {
    for (const Format& format : formats()) {
        SCOPED_TRACE(format.extension);
        const std::size_t step = std::max<std::size_t>(1, format.good.size() / 150);
        for (std::size_t size = 0; size < format.good.size(); size += step) {
            expect_survives(format, format.good.substr(0, size));
        }
    }
}

TEST(BadInput, OneByteWrongAnywhere) {
    std::mt19937_64 generator(12);
    for (const Format& format : formats()) {
        SCOPED_TRACE(format.extension);
        for (int i = 0; i < 300; ++i) {
            std::string bytes = format.good;
            bytes[generator() % bytes.size()] = static_cast<char>(generator() % 256);
            expect_survives(format, bytes);
        }
    }
}

TEST(BadInput, Garbage) {
    std::mt19937_64 generator(13);
    const std::vector<std::string> starts{"",   "ply\n", "OFF\n", "solid ", "GemCad 5.0\n",
                                          "v ", "f ",    "a ",    "g 96\n"};
    for (const Format& format : formats()) {
        SCOPED_TRACE(format.extension);
        for (const std::string& start : starts) {
            for (const std::size_t size : {0u, 1u, 10u, 84u, 200u, 3000u}) {
                std::string bytes = start;
                for (std::size_t i = 0; i < size; ++i) {
                    bytes.push_back(static_cast<char>(generator() % 256));
                }
                expect_survives(format, bytes);
                expect_survives(format, start + std::string(size, '\0'));
                expect_survives(format, start + std::string(size, '1'));
                expect_survives(format, start + std::string(size, ' '));
                expect_survives(format, start + std::string(size, '\n'));
            }
        }
    }
}

TEST(BadInput, NumbersThatAreNone) {
    for (const char* word : {"nan", "inf", "-inf", "1e999", "0x1p3", "1,5", "", "-", "1e"}) {
        SCOPED_TRACE(word);
        const std::string w = word;
        EXPECT_THROW(parse_mesh("v 0 0 " + w + "\nf 1 1 1\n", MeshFormat::obj), InputError);
        EXPECT_THROW(parse_mesh("OFF\n1 1 0\n0 0 " + w + "\n3 0 0 0\n", MeshFormat::off),
                     InputError);
        // In PLY the next number would stand in for a missing one.
        if (!w.empty()) {
            EXPECT_THROW(parse_mesh("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                                    "property float y\nproperty float z\nelement face 1\n"
                                    "property list uchar int vertex_indices\nend_header\n0 0 " +
                                        w + "\n3 0 0 0\n",
                                    MeshFormat::ply),
                         InputError);
        }
        EXPECT_THROW(parse_mesh("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 " + w +
                                    "\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n",
                                MeshFormat::stl),
                     InputError);
        EXPECT_THROW(parse_gemcad_asc("GemCad 5.0\ng 96 0\na 45 " + w + " 96\n"), InputError);
    }
}

TEST(BadInput, CountsThatTheFileCannotHold) {
    for (const char* count : {"4000000000", "2147483647", "99999999999999999999", "-1", "1e9"}) {
        SCOPED_TRACE(count);
        const std::string c = count;
        EXPECT_THROW(parse_mesh("OFF\n" + c + " 1 0\n0 0 0\n", MeshFormat::off), InputError);
        EXPECT_THROW(parse_mesh("OFF\n1 " + c + " 0\n0 0 0\n", MeshFormat::off), InputError);
        EXPECT_THROW(parse_mesh("OFF\n1 1 0\n0 0 0\n" + c + " 0 0 0\n", MeshFormat::off),
                     InputError);
        for (const char* form : {"ascii", "binary_little_endian"}) {
            EXPECT_THROW(
                parse_mesh("ply\nformat " + std::string(form) + " 1.0\nelement vertex " + c +
                               "\nproperty float x\nproperty float y\nproperty float z\n"
                               "element face 1\nproperty list uchar int vertex_indices\n"
                               "end_header\n0 0 0\n",
                           MeshFormat::ply),
                InputError);
        }
    }
    // An empty element, four thousand million times.
    EXPECT_THROW(
        parse_mesh("ply\nformat ascii 1.0\nelement none 4000000000\nend_header\n", MeshFormat::ply),
        InputError);
    // A binary STL that claims the largest possible number of triangles.
    EXPECT_THROW(parse_mesh(std::string(80, 'x') + "\xff\xff\xff\xff", MeshFormat::stl),
                 InputError);
}

TEST(BadInput, AllCornersInOnePlace) {
    EXPECT_THROW(parse_mesh("v 1 1 1\nf 1 1\n", MeshFormat::obj), InputError);
    const ReadSolid read = parse_mesh("v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n", MeshFormat::obj);
    EXPECT_EQ(find_faults(read.solid).front().kind, FaultKind::empty);
    const ReadSolid line = parse_mesh("v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n", MeshFormat::obj);
    EXPECT_FALSE(find_faults(line.solid).empty());
}

TEST(BadInput, ExtremeCoordinates) {
    for (const char* size : {"1e-320", "1e-200", "1e150", "1e308"}) {
        SCOPED_TRACE(size);
        const std::string s = size, zero = "0";
        std::string text = "v 0 0 0\nv " + s + " 0 0\nv 0 " + s + " 0\nv 0 0 " + s + "\n";
        const ReadSolid read =
            parse_mesh(text + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n", MeshFormat::obj);
        find_faults(read.solid);
    }
}

// Files that once crashed a reader, kept by the fuzzers (tests/fuzz). The name is free; the
// extension selects the reader.
TEST(BadInput, FilesThatFuzzersFound) {
    std::size_t count = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(CULET_SOURCE_DIR "/tests/fuzz/found")) {
        for (const Format& format : formats()) {
            if (entry.path().extension() != std::string(".").append(format.extension)) continue;
            SCOPED_TRACE(entry.path().filename());
            expect_survives(format, read_text(entry.path()));
            ++count;
        }
    }
    EXPECT_GT(count, 0u);
}

class BadFile : public testing::TestWithParam<const char*> {
protected:
    ScratchFolder folder_;
    std::filesystem::path file() const { return folder_ / (std::string("x.") + GetParam()); }
};

TEST_P(BadFile, IsMissing) {
    EXPECT_THROW(read_solid(file()), InputError);
}

TEST_P(BadFile, IsEmpty) {
    write_bytes(file(), "");
    EXPECT_THROW(read_solid(file()), InputError);
}

TEST_P(BadFile, IsAFolder) {
    std::filesystem::create_directory(file());
    EXPECT_THROW(read_solid(file()), InputError);
    EXPECT_THROW(write_solid(cube(), file()), InputError);
}

TEST_P(BadFile, IsAPipe) {
    ASSERT_EQ(::mkfifo(file().c_str(), 0600), 0);
    EXPECT_THROW(read_solid(file()), InputError);
}

TEST_P(BadFile, IsTwoGigabytesOfNothing) {
    write_bytes(file(), "x");
    std::filesystem::resize_file(file(), std::uintmax_t{2} << 30);
    EXPECT_THROW(read_solid(file()), InputError);
}

TEST_P(BadFile, MayNotBeRead) {
    write_bytes(file(), "x");
    std::filesystem::permissions(file(), std::filesystem::perms::none);
    if (::access(file().c_str(), R_OK) == 0) GTEST_SKIP() << "this user may read everything";
    EXPECT_THROW(read_solid(file()), InputError);
}

// Areas and volumes of such a stone overflow or vanish; it used to be reported as not convex, with
// volume nan.
TEST(BadSize, AStoneOfNoUnitIsRefused) {
    const ScratchFolder folder;
    const auto file = folder / "cube.obj";
    for (const double factor : {1e-300, 1e-51, 1e51, 1e150, 1e300}) {
        Solid solid = cube();
        for (Vec3& v : solid.vertices) v *= factor;
        for (Facet& f : solid.facets) f.plane.offset *= factor;
        write_solid(solid, file);
        EXPECT_THROW(read_solid(file), InputError) << factor;
    }
    for (const double factor : {1e-40, 1e40}) {
        Solid solid = cube();
        for (Vec3& v : solid.vertices) v *= factor;
        for (Facet& f : solid.facets) f.plane.offset *= factor;
        write_solid(solid, file);
        EXPECT_TRUE(find_faults(read_solid(file).solid).empty()) << factor;
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, BadFile,
                         testing::Values("obj", "off", "ply", "stl", "asc", "gem", "gcs"),
                         [](const auto& format) { return std::string(format.param); });

}  // namespace
}  // namespace culet
