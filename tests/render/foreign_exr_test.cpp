// OpenEXR files as other programs write them. Expectations: the format's documentation (Technical
// Introduction to OpenEXR; Reading and Writing Image Files), published matrices.

#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>

#include <map>
#include <vector>

#include "tests/render/foreign_picture.h"

namespace {

using namespace culet;
using culet::test::Colour;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ForeignExr : public test::ForeignPicture {
protected:
    using Channels = std::map<std::string, float>;

    std::string written() const { return text("a.exr"); }
    // Channels of one value each, or of `by_column` times the column's number.
    std::string file(Imf::Header header, const Channels& channels, float by_column = 0) const {
        const Imath::Box2i window = header.dataWindow();
        const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
        std::vector<std::vector<float>> planes;
        Imf::FrameBuffer frame;
        for (const auto& [name, value] : channels) {
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            std::vector<float>& plane = planes.emplace_back();
            for (int i = 0; i < width * height; ++i)
                plane.push_back(value + by_column * static_cast<float>(i % width));
            const std::ptrdiff_t before = std::ptrdiff_t{window.min.y} * width + window.min.x;
            frame.insert(name,
                         Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(plane.data() - before), 4,
                                    4 * static_cast<std::size_t>(width)));
        }
        {
            Imf::OutputFile output((folder_ / "a.exr").c_str(), header);
            output.setFrameBuffer(frame);
            output.writePixels(height);
        }
        return written();
    }
    static Imf::Header windows(const Imath::Box2i& display, const Imath::Box2i& data) {
        return Imf::Header(display, data);
    }
};

const Imath::V2f k_d65(0.3127f, 0.3290f), k_d60(0.32168f, 0.33767f);

TEST_F(ForeignExr, ChromaticitiesAreFollowed) {
    Imf::Header header(2, 2);
    Imf::addChromaticities(header, {{0.708f, 0.292f}, {0.170f, 0.797f}, {0.131f, 0.046f}, k_d65});
    const ReadPicture red = read(file(header, {{"R", 1}, {"G", 0}, {"B", 0}}));
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(pixel(red, 0, 0)[c], test::k_rec709_of_rec2020[0][c], test::k_four_digits);

    // ACES (SMPTE ST 2065-1): its white, D60, is white.
    Imf::addChromaticities(header, {{0.73470f, 0.26530f}, {0, 1}, {0.0001f, -0.077f}, k_d60});
    expect_near(pixel(read(file(header, {{"R", 1}, {"G", 1}, {"B", 1}})), 0, 0), {1, 1, 1}, 1e-5);

    // The primaries X, Y, Z: tristimulus values.
    Imf::addChromaticities(header, {{1, 0}, {0, 1}, {0, 0}, {1 / 3.0f, 1 / 3.0f}});
    const auto [x, y, z] = test::k_d65_xyz;
    const Imf::Header plain(2, 2);
    for (const auto& bytes : {file(header, {{"R", float(x)}, {"G", float(y)}, {"B", float(z)}}),
                              file(plain, {{"X", float(x)}, {"Y", float(y)}, {"Z", float(z)}})})
        expect_near(pixel(read(bytes), 0, 0), {1, 1, 1}, 5e-4);

    // Primaries that span nothing are named.
    Imf::addChromaticities(header, {{0.3f, 0.3f}, {0.3f, 0.3f}, {0.3f, 0.3f}, k_d65});
    EXPECT_THAT(read(file(header, {{"R", 1}, {"G", 1}, {"B", 1}})).notes,
                ElementsAre(HasSubstr("span no colours")));
}

TEST_F(ForeignExr, TheDataWindowIsPlacedInTheDisplayWindow) {
    const Channels channels{{"R", 1}, {"G", 2}, {"B", 3}, {"A", 1}};
    const auto box = [](int left, int top, int right, int bottom) {
        return Imath::Box2i({left, top}, {right, bottom});
    };
    // The lower right quarter of a picture whose corner is at (100, 50).
    const ReadPicture part =
        read(file(windows(box(100, 50, 107, 53), box(104, 52, 107, 53)), channels, 10));
    ASSERT_EQ(part.picture.width, 8);
    ASSERT_EQ(part.picture.height, 4);
    expect_near(pixel(part, 3, 3), {0, 0, 0}, 0);
    expect_near(pixel(part, 5, 1), {0, 0, 0}, 0);
    expect_near(pixel(part, 4, 2), {1, 2, 3}, 0);
    expect_near(pixel(part, 7, 3), {31, 32, 33}, 0);
    EXPECT_EQ(part.picture.coverage[0], 0);
    EXPECT_THAT(part.notes, ElementsAre(HasSubstr("columns 4 to 7 and rows 2 to 3 of 8 x 4")));
    // A display window larger than the data window.
    const ReadPicture more = read(file(windows(box(0, 0, 1, 1), box(-2, -1, 5, 3)), channels, 10));
    ASSERT_EQ(more.picture.width, 2);
    expect_near(pixel(more, 1, 1), {31, 32, 33}, 0);
    EXPECT_THAT(more.notes, IsEmpty());
    EXPECT_THAT(refusal(file(windows(box(0, 0, 7, 7), box(20, 0, 21, 1)), channels)),
                HasSubstr("outside"));
}

TEST_F(ForeignExr, TheOnlyLayerOfColoursIsRead) {
    const Imf::Header header(2, 2);
    const ReadPicture blender = read(file(header, {{"View Layer.Combined.R", 1},
                                                   {"View Layer.Combined.G", 2},
                                                   {"View Layer.Combined.B", 3},
                                                   {"View Layer.Combined.A", 0.5f},
                                                   {"View Layer.Depth.Z", 9},
                                                   {"View Layer.Normal.X", 8}}));
    expect_near(pixel(blender, 1, 1), {1, 2, 3}, 0);
    EXPECT_EQ(blender.picture.coverage[0], 0.5f);
    EXPECT_THAT(blender.notes, ElementsAre(HasSubstr("View Layer.Combined")));
    expect_near(pixel(read(file(header, {{"r", 1}, {"g", 2}, {"b", 3}})), 0, 0), {1, 2, 3}, 0);
    EXPECT_THAT(
        read(file(header, {{"R", 1}, {"G", 2}, {"B", 3}, {"a.R", 4}, {"a.G", 4}, {"a.B", 4}}))
            .notes,
        IsEmpty());
    EXPECT_THAT(
        refusal(
            file(header, {{"a.R", 1}, {"a.G", 1}, {"a.B", 1}, {"b.R", 1}, {"b.G", 1}, {"b.B", 1}})),
        HasSubstr("2 layers (a, b)"));
    EXPECT_THAT(refusal(file(header, {{"Z", 1}, {"R", 1}})), HasSubstr("it has R, Z"));
}

TEST_F(ForeignExr, LuminanceWithColourDifferencesIsNotGrey) {
    std::vector<Imf::Rgba> pixels(16 * 8, Imf::Rgba(0.5f, 0.25f, 0.125f));
    for (const Imf::LineOrder order : {Imf::INCREASING_Y, Imf::DECREASING_Y}) {
        {
            Imf::RgbaOutputFile output((folder_ / "a.exr").c_str(), 16, 8, Imf::WRITE_YC, 1, {0, 0},
                                       1, order);
            output.setYCRounding(10, 10);
            output.setFrameBuffer(pixels.data(), 1, 16);
            output.writePixels(8);
        }
        // 11 bits, twice.
        expect_near(pixel(read(written()), 7, 3), {0.5, 0.25, 0.125}, 2e-3);
    }
}

TEST_F(ForeignExr, WhatIsNotFollowedIsSaid) {
    EXPECT_THAT(read(file(Imf::Header(2, 2, 2.0f), {{"R", 1}, {"G", 1}, {"B", 1}})).notes,
                ElementsAre(HasSubstr("2 times as wide")));
    std::vector<Imf::Header> parts(2, Imf::Header(2, 2));
    for (std::size_t i = 0; i < 2; ++i) {
        parts[i].setName(i == 0 ? "left" : "right");
        parts[i].setType(Imf::SCANLINEIMAGE);
        parts[i].channels().insert("R", Imf::Channel(Imf::FLOAT));
    }
    { const Imf::MultiPartOutputFile output((folder_ / "a.exr").c_str(), parts.data(), 2); }
    EXPECT_THAT(refusal(written()), HasSubstr("2 parts"));
}

}  // namespace
