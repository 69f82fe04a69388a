// Files of ray tables: they read back as written, and damaged ones are refused in one line.
// Expectations: exact round trips; docs/ray-tables.md; CRC-32 finds every burst of up to 32 bits
// (Peterson & Brown 1961); the bound of octahedral_codes.h.

#include <gtest/gtest.h>

#include <boost/crc.hpp>
#include <cstring>
#include <fstream>
#include <functional>
#include <random>
#include <string>

#include "render/raytable/octahedral_codes.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "tests/folder_test.h"
#include "tests/render/ray_stones.h"
#include "tests/render/raytable/table_scenes.h"

namespace culet {
namespace {

class RayTableFile : public test::FolderTest {
protected:
    std::filesystem::path file() const { return folder_ / "t.rays"; }

    std::string bytes() {
        test::table_of(test::brilliant(12)).write(file());
        return read_text(file());
    }
    // The error, one line that names the file; "" when it opens.
    std::string refusal(const std::string& content) {
        std::ofstream(file(), std::ios::binary) << content;
        try {
            (void)RayTable::open(file());
        } catch (const InputError& error) {
            const std::string what = error.what();
            EXPECT_NE(what.find("t.rays"), std::string::npos) << what;
            EXPECT_EQ(what.find('\n'), std::string::npos) << what;
            return what;
        }
        return "";
    }
};

std::string with_checksum(std::string content) {
    boost::crc_32_type crc;
    crc.process_bytes(content.data() + 16, content.size() - 16);
    const std::uint32_t sum = crc.checksum();
    std::memcpy(content.data() + 12, &sum, sizeof sum);
    return content;
}

std::string with_header(std::string content, const std::function<void(RayTableHeader&)>& change) {
    RayTableHeader header;
    std::memcpy(&header, content.data(), sizeof header);
    change(header);
    std::memcpy(content.data(), &header, sizeof header);
    return with_checksum(content);
}

template <class T>
void expect_equal(std::span<const T> a, std::span<const T> b) {
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size_bytes()), 0);
}

TEST_F(RayTableFile, ComesBackAsItWasWritten) {
    Scene scene = test::in_material(test::brilliant(12), "sapphire_blue");
    scene.settings.wavelengths_nm = {450, 550, 650};
    const RayTable table = test::table_of(scene);
    table.write(file());
    EXPECT_EQ(std::filesystem::file_size(file()), table.bytes());
    const RayTable back = RayTable::open(file());
    EXPECT_EQ(std::memcmp(&back.header(), &table.header(), sizeof(RayTableHeader)), 0);
    EXPECT_EQ(back.header().bands, 3u);
    EXPECT_EQ(back.header().lengths, 3u);
    const auto &a = table.parts(), &b = back.parts();
    EXPECT_GT(a.weight.size(), 1000u);
    expect_equal(a.wavelengths_nm, b.wavelengths_nm);
    expect_equal(a.frames, b.frames);
    expect_equal(a.hit_ray, b.hit_ray);
    expect_equal(a.hit_distance, b.hit_distance);
    expect_equal(a.exits_end, b.exits_end);
    expect_equal(a.weight, b.weight);
    expect_equal(a.facet, b.facet);
    for (std::size_t k = 0; k < 2; ++k) {
        expect_equal(a.direction[k], b.direction[k]);
        expect_equal(a.point[k], b.point[k]);
    }
    for (std::size_t k = 0; k < 3; ++k) expect_equal(a.length[k], b.length[k]);
}

TEST_F(RayTableFile, StartsAsTheDocumentationSays) {
    const std::string content = bytes();
    const auto u32 = [&](std::size_t at) {
        std::uint32_t value = 0;
        std::memcpy(&value, content.data() + at, sizeof value);
        return value;
    };
    EXPECT_EQ(content.substr(0, 8), "culetray");
    EXPECT_EQ(u32(8), 1u);               // version
    EXPECT_EQ(u32(16), content.size());  // file_bytes, lower half
    EXPECT_EQ(u32(24), 12u);             // width
    EXPECT_EQ(u32(28), 12u);             // height
    EXPECT_EQ(u32(40), 73u);             // facets
    EXPECT_EQ(u32(52), 6u);              // depth
    EXPECT_EQ(with_checksum(content), content);
}

TEST_F(RayTableFile, TellsAnyFlippedBit) {
    const std::string content = bytes();
    ASSERT_EQ(refusal(content), "");
    std::mt19937_64 random(1);
    // Every byte of the header and the first of the lists, then some in each part of the rest.
    std::vector<std::size_t> places;
    for (std::size_t at = 0; at < 512; ++at) places.push_back(at);
    for (std::size_t at = 512; at < content.size(); at += 97) places.push_back(at);
    places.push_back(content.size() - 1);
    for (const std::size_t at : places) {
        std::string damaged = content;
        damaged[at] = static_cast<char>(damaged[at] ^ (1 << random() % 8));
        EXPECT_NE(refusal(damaged), "") << "byte " << at;
    }
}

TEST_F(RayTableFile, TellsWhatIsCutOffOrTooLong) {
    const std::string content = bytes();
    std::vector<std::size_t> lengths{0, 1, 7, 8, 11, 15, 16, 100, 255, 256, 257};
    for (std::size_t length = 300; length < content.size(); length += 1009)
        lengths.push_back(length);
    lengths.push_back(content.size() - 1);
    for (const std::size_t length : lengths)
        EXPECT_NE(refusal(content.substr(0, length)), "") << length;
    EXPECT_NE(refusal(content + "x"), "");
    EXPECT_NE(refusal(content + content), "");
    EXPECT_NE(refusal(content.substr(0, 300)).find("cut off"), std::string::npos);
}

TEST_F(RayTableFile, TellsWhatIsNoTable) {
    EXPECT_NE(refusal("\x89PNG\r\n\x1a\n and so on").find("not a ray table"), std::string::npos);
    EXPECT_NE(refusal("").find("not a ray table"), std::string::npos);
    EXPECT_NE(refusal(std::string(100000, '\0')).find("not a ray table"), std::string::npos);
    EXPECT_THROW((void)RayTable::open(folder_ / "none.rays"), InputError);
    EXPECT_THROW((void)RayTable::open(folder_.path()), InputError);
    const std::string newer =
        with_header(bytes(), [](RayTableHeader& header) { header.version = 2; });
    EXPECT_NE(refusal(newer).find("version 2"), std::string::npos);
}

// As forged by someone who knows the checksum.
TEST_F(RayTableFile, IsCheckedWholeThoughItsChecksumIsRight) {
    const std::string content = bytes();
    using Change = std::function<void(RayTableHeader&)>;
    const std::vector<Change> changes{[](RayTableHeader& h) { h.width = 0; },
                                      [](RayTableHeader& h) { h.width = 0xffffffffu; },
                                      [](RayTableHeader& h) { h.height = 1; },
                                      [](RayTableHeader& h) { h.samples = 0; },
                                      [](RayTableHeader& h) { h.samples = 0x10000u; },
                                      [](RayTableHeader& h) { h.bands = 0; },
                                      [](RayTableHeader& h) { h.bands = 0xffffffffu; },
                                      [](RayTableHeader& h) { h.facets = 3; },
                                      [](RayTableHeader& h) { h.facets = 0; },
                                      [](RayTableHeader& h) { h.facets = 0xffffffffu; },
                                      [](RayTableHeader& h) { h.lengths = 2; },
                                      [](RayTableHeader& h) { h.lengths = 0xffffffffu; },
                                      [](RayTableHeader& h) { h.wavelengths = 1000; },
                                      [](RayTableHeader& h) { h.branches = 7; },
                                      [](RayTableHeader& h) { h.hits += 1; },
                                      [](RayTableHeader& h) { h.hits = 0; },
                                      [](RayTableHeader& h) { h.hits = ~0ull; },
                                      [](RayTableHeader& h) { h.exits -= 1; },
                                      [](RayTableHeader& h) { h.exits = ~0ull / 2; },
                                      [](RayTableHeader& h) { h.length_step = -1; },
                                      [](RayTableHeader& h) { h.length_step = std::nan(""); },
                                      [](RayTableHeader& h) { h.remainder = INFINITY; },
                                      [](RayTableHeader& h) { h.file_bytes = 256; }};
    for (std::size_t i = 0; i < changes.size(); ++i)
        EXPECT_NE(refusal(with_header(content, changes[i])), "") << "change " << i;
    // In each list an invalid number, with its place as the reader finds it.
    std::ofstream(file(), std::ios::binary) << content;
    const RayTable table = RayTable::open(file());
    const auto& parts = table.parts();
    const char* first = reinterpret_cast<const char*>(parts.frames.data()) - 256;
    const auto put = [&](const auto& list, std::size_t number, auto value) {
        std::string changed = content;
        const auto at = reinterpret_cast<const char*>(&list[number]) - first;
        std::memcpy(changed.data() + at, &value, sizeof value);
        return refusal(with_checksum(changed));
    };
    EXPECT_EQ(put(parts.weight, 5, parts.weight[5]), "");
    EXPECT_NE(put(parts.frames, 1, std::nan("")), "");
    EXPECT_NE(put(parts.hit_ray, 4, parts.hit_ray[3]), "");
    EXPECT_NE(put(parts.hit_ray, parts.hit_ray.size() - 1, 144u), "");
    EXPECT_NE(put(parts.hit_distance, 3, -1.0f), "");
    EXPECT_NE(put(parts.exits_end, 3, 0xffffffffu), "");
    EXPECT_NE(put(parts.exits_end, parts.exits_end.size() - 1, parts.exits_end.back() - 1), "");
    EXPECT_NE(put(parts.weight, 2, std::nanf("")), "");
    EXPECT_NE(put(parts.weight, 2, -0.5f), "");
    EXPECT_NE(put(parts.facet, 7, static_cast<std::uint16_t>(73)), "");
    // Any direction and any point of a facet's frame is valid.
    EXPECT_EQ(put(parts.direction[0], 7, std::int32_t{-2147483647 - 1}), "");
    EXPECT_EQ(put(parts.point[0], 7, std::uint16_t{65535}), "");
}

TEST(OctahedralCodes, KeepDirectionsToABillionth) {
    std::mt19937_64 random(3);
    std::vector<Vec3> directions{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}};
    for (int i = 0; i < 100000; ++i) directions.push_back(random_direction(random));
    for (int i = 0; i < 1000; ++i) {
        Vec3 d = random_direction(random);
        d.z *= 1e-9;
        directions.push_back(glm::normalize(d));
    }
    for (const Vec3& d : directions) {
        const Vec3 back = octahedral_direction(octahedral_code(d));
        EXPECT_NEAR(glm::length(back), 1, 1e-15);
        EXPECT_LT(glm::length(back - d), std::sqrt(18.0) * std::exp2(-32) + 1e-15);
    }
    const std::int32_t lowest = -2147483647 - 1, most = 2147483647;
    for (const std::int32_t a : {lowest, -1, 0, 1, most}) {
        for (const std::int32_t b : {lowest, -1, 0, 1, most})
            EXPECT_NEAR(glm::length(octahedral_direction({a, b})), 1, 1e-15);
    }
}

}  // namespace
}  // namespace culet
