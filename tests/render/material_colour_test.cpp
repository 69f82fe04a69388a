// Body colours of the catalogue's stones against closed forms and published colours.

#include "render/colour/material_colour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/render/published_gem_colours.h"

namespace culet {
namespace {

double hue_deg(const Lab& c) {
    return std::atan2(c.b, c.a) * 180 / std::numbers::pi;
}

TEST(MaterialColour, OfAGreyStoneIsBeersLaw) {
    Material grey = catalogue_material("quartz");
    for (Spectrum& spectrum : grey.absorption_per_mm) spectrum = Spectrum(0.1);
    const StoneColour colour = body_colour(grey, 5);
    const double transmitted = std::exp(-0.1 * light_path_mm(5));
    for (const double value : colour.rgb) EXPECT_NEAR(value, transmitted, 1e-12);
    // CIE 1976 lightness.
    EXPECT_NEAR(colour.lab.L, 116 * std::cbrt(transmitted) - 16, 1e-2);
    EXPECT_NEAR(std::hypot(colour.lab.a, colour.lab.b), 0, 0.05);
}

TEST(MaterialColour, AddsUpWhatTheRaysLetThrough) {
    // Opaque along one of two rays: half of the light remains, however thick the stone.
    Material half = catalogue_material("quartz");
    half.absorption_per_mm[0] = Spectrum(1e3);
    half.absorption_per_mm[1] = Spectrum(0.0);
    EXPECT_NEAR(luminance(body_colour(half).rgb), 0.5, 1e-12);
}

TEST(MaterialColour, LargerStonesAreDeeperAndColourlessOnesStaySo) {
    for (const char* name : {"ruby_gem", "emerald", "citrine"}) {
        const Material material = catalogue_material(name);
        EXPECT_GT(body_colour(material, 4).lab.L, body_colour(material, 6.5).lab.L) << name;
        EXPECT_GT(body_colour(material, 6.5).lab.L, body_colour(material, 12).lab.L) << name;
    }
    const StoneColour diamond = body_colour(catalogue_material("diamond"));
    EXPECT_EQ(diamond.name, "colourless");
    EXPECT_EQ(display_hex(diamond.rgb), "#ffffff");
}

TEST(MaterialColour, NamesAreThoseOfTheirBlocks) {
    // The middle of a block has the block's name: NBS Special Publication 440.
    const std::pair<int, const char*> middles[] = {
        {0xbe0032, "vivid red"},  {0x78184a, "deep purplish red"}, {0x272458, "deep purplish blue"},
        {0x00543d, "deep green"}, {0xf3c300, "vivid yellow"},      {0xf2f3f4, "white"},
        {0x222222, "black"}};
    for (const auto& [srgb, name] : middles) {
        EXPECT_EQ(colour_name(test::lab_of_srgb(srgb)), name);
    }
}

TEST(MaterialColour, IsThatOfThePublishedNames) {
    // Hue within 20 degrees and lightness within 20 of the nearest entry of a dictionary of colour.
    // Exceptions are in docs/materials.md, not here.
    for (const test::NamedGem& gem : test::named_gems()) {
        if (gem.material == "citrine" || gem.material.starts_with("tourmaline_")) continue;
        const StoneColour colour = body_colour(catalogue_material(gem.material));
        double best = 1e9;
        for (const test::PublishedColour& published : gem.colours) {
            const Lab lab = test::lab_of_srgb(published.srgb);
            double hue = std::abs(hue_deg(colour.lab) - hue_deg(lab));
            hue = std::min(hue, 360 - hue);
            best = std::min(best, std::max(hue / 20, std::abs(colour.lab.L - lab.L) / 20));
        }
        EXPECT_LE(best, 1) << gem.material << ": " << colour.name;
    }
}

TEST(MaterialColour, RubyIsRedAndRhodolitePurplishRed) {
    const StoneColour ruby = body_colour(catalogue_material("ruby_gem")),
                      rhodolite = body_colour(catalogue_material("garnet_rhodolite"));
    EXPECT_TRUE(ruby.name.ends_with(" red")) << ruby.name;
    EXPECT_EQ(ruby.name.find("purplish"), std::string::npos) << ruby.name;
    EXPECT_NE(rhodolite.name.find("purplish red"), std::string::npos) << rhodolite.name;
}

}  // namespace
}  // namespace culet
