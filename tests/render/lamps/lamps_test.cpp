// Lamps by their photometry. Expectations: the definitions of LM-63 and EULUMDAT, closed forms
// stated with each test, and the plain sphere light.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "render/export/mitsuba.h"
#include "render/reference/light_field.h"
#include "render/scene/photometry.h"
#include "render/scene/scene_io.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "tests/folder_test.h"
#include "tests/render/beams/beam_scenes.h"
#include "tests/render/random_direction.h"

namespace {

using namespace culet;

constexpr double k_pi = std::numbers::pi;
const std::string k_lamps = CULET_SOURCE_DIR "/tests/render/lamps/";

using Candela = std::function<double(double c, double gamma)>;  // of degrees

std::vector<double> steps(double from, double to, double step) {
    std::vector<double> list;
    for (double x = from; x <= to; x += step) list.push_back(x);
    return list;
}

std::string ies(const std::vector<double>& vertical, const std::vector<double>& horizontal,
                const Candela& candela, const std::string& type = "1",
                const std::string& head = "IESNA:LM-63-2002\nTILT=NONE\n",
                const std::string& factors = "1 1 50") {
    std::string text = head + fmt::format("1 -1 2 {} {} {} 2 0 0 0\n{}\n", vertical.size(),
                                          horizontal.size(), type, factors);
    for (const double v : vertical) text += fmt::format("{} ", v);
    for (const double h : horizontal) text += fmt::format("\n{}", h);
    for (const double h : horizontal) {
        for (const double v : vertical) text += fmt::format("\n{:.17g}", candela(h, v) / 2);
    }
    return text + "\n";
}

std::string ldt(int symmetry, const Candela& candela) {
    const std::vector<double> c = steps(0, 345, 15), gamma = steps(0, 180, 10);
    std::string text = fmt::format(
        "made here\n1\n{}\n24\n15\n19\n10\n1\n2\n3\n4\n5\n0\n0\n0\n0\n0\n0\n0\n0\n0\n50\n80\n1,25\n"
        "0\n1\n1\nLED\n2000\n4000\n90\n20\n",
        symmetry);
    for (int i = 0; i < 10; ++i) text += "0.5\n";
    for (const double angle : c) text += fmt::format("{}\n", angle);
    for (const double angle : gamma) text += fmt::format("{}\n", angle);
    const int first = symmetry == 3 ? 18 : 0;
    const int count = symmetry == 0 ? 24 : symmetry == 1 ? 1 : symmetry == 4 ? 7 : 13;
    for (int i = first; i < first + count; ++i) {
        for (const double angle : gamma)
            text += fmt::format("{:.17g}\n", candela(c[std::size_t(i % 24)], angle) / 2 / 1.25);
    }
    return text;
}

Vec3 of_angles(double c, double gamma) {
    c *= k_pi / 180, gamma *= k_pi / 180;
    return {std::sin(gamma) * std::cos(c), std::sin(gamma) * std::sin(c), std::cos(gamma)};
}

double sine(double degrees) {
    return std::sin(degrees * k_pi / 180);
}
double cosine(double degrees) {
    return std::cos(degrees * k_pi / 180);
}

// A disc after Lambert with I0 on its axis sends out pi I0 lumens. Linear interpolation in steps of
// 5 degrees loses (5 degrees)^2 / 12 = 6e-4 of them.
TEST(Photometry, ALambertLampSendsOutPiTimesItsIntensity) {
    const Photometry lamp = photometry_of(read_text(k_lamps + "lambert.ies"), "lambert.ies");
    double lumens = 0;
    const double step = 0.01;
    for (double g = step / 2; g < 180; g += step)
        lumens += 2 * k_pi * sine(g) * (step * k_pi / 180) * lamp.at(of_angles(77, g));
    EXPECT_NEAR(lumens / (300 * k_pi), 1, 1e-3);
    EXPECT_NEAR(lamp.opening_mm2, k_pi * 30 * 30, 1e-9);
    EXPECT_EQ(lamp.at(of_angles(10, 91)), 0);
    const Photometry same = photometry_of(read_text(k_lamps + "lambert.ldt"), "lambert.ldt");
    EXPECT_NEAR(same.opening_mm2, lamp.opening_mm2, 1e-9);
    for (double g = 0; g < 180; g += 0.7)
        EXPECT_NEAR(same.at(of_angles(g, g)), lamp.at(of_angles(0, g)), 1e-3) << g;
}

// The same lamp in both formats, with every symmetry: EULUMDAT's 0 to 4, and LM-63's last
// horizontal angle. At a measured angle the value is that of the file, between two their mean.
TEST(Photometry, BothFormatsGiveTheSameCandelaEverywhere) {
    struct Case {
        int symmetry;
        double first, last;
        Candela candela;
    };
    const Case cases[] = {
        {0, 0, 360, [](double c, double g) { return 200 + 90 * sine(c + 20) * sine(g); }},
        {1, 0, 0, [](double, double g) { return 200 + 90 * cosine(g); }},
        {2, 0, 180, [](double c, double g) { return 200 + 90 * cosine(c) * sine(g); }},
        {3, 90, 270, [](double c, double g) { return 200 + 90 * sine(c) * sine(g); }},
        {4, 0, 90, [](double c, double g) { return 200 + 90 * cosine(2 * c) * sine(g); }}};
    std::mt19937_64 random(6605);
    for (const Case& one : cases) {
        SCOPED_TRACE(fmt::format("symmetry {}, seed 6605", one.symmetry));
        const Photometry a = photometry_of(
            ies(steps(0, 180, 10), steps(one.first, one.last, 15), one.candela), "a.ies");
        const Photometry b = photometry_of(ldt(one.symmetry, one.candela), "b.LDT");
        for (double c = 0; c < 360; c += 15) {
            EXPECT_NEAR(a.at(of_angles(c, 40)), one.candela(c, 40), 1e-9) << c;
            EXPECT_NEAR(a.at(of_angles(c + 7.5, 45)),
                        (one.candela(c, 40) + one.candela(c, 50) + one.candela(c + 15, 40) +
                         one.candela(c + 15, 50)) /
                            4,
                        1e-9)
                << c;
        }
        for (int i = 0; i < 500; ++i) {
            const Vec3 way = random_direction(random);
            EXPECT_NEAR(a.at(way), b.at(way), 1e-9);
        }
    }
}

// LM-63-2002, 3: planes of type A share the vertical axis, those of type B a horizontal one;
// horizontal angles of both turn clockwise seen from above. x, y and z as photometry.h says.
TEST(Photometry, TypesAAndBHaveTheirOwnAxes) {
    const Candela candela = [](double h, double v) { return 1000 + 5 * h + v; };
    const auto lamp = [&](const char* type, double first) {
        return photometry_of(ies(steps(-90, 90, 10), steps(first, 90, 10), candela, type), "l.ies");
    };
    const double h = 20, v = 40;
    const Photometry a = lamp("3", -90), b = lamp("2", -90), half = lamp("2", 0);
    EXPECT_NEAR(a.at({sine(v), -cosine(v) * sine(h), cosine(v) * cosine(h)}), 1140, 1e-9);
    EXPECT_NEAR(b.at({cosine(h) * sine(v), -sine(h), cosine(h) * cosine(v)}), 1140, 1e-9);
    EXPECT_NEAR(b.at({cosine(h) * sine(v), sine(h), cosine(h) * cosine(v)}), 940, 1e-9);
    EXPECT_NEAR(half.at({cosine(h) * sine(v), sine(h), cosine(h) * cosine(v)}), 1140, 1e-9);
    EXPECT_EQ(a.at({0, 0, -1}), 0) << "behind the lamp nothing was measured";
}

TEST(Photometry, HeadersFactorsAndTiltsCount) {
    const Candela ten = [](double, double) { return 10.0; };
    const auto seen = [&](const std::string& head, const std::string& factors) {
        return photometry_of(ies({0, 90}, {0}, ten, "1", head, factors), "l.ies").greatest;
    };
    for (const char* head : {"", "IESNA91\n", "IESNA:LM-63-1995\n[TEST] a\n[MORE] b\n",
                             "IES:LM-63-2019\n[TEST] tilt\n"})
        EXPECT_EQ(seen(std::string(head) + "TILT=NONE\n", "1 1 50"), 10);
    EXPECT_EQ(seen("TILT=NONE\r\n", "0.5, 0.8, 50"), 4) << "ballast and ballast-lamp factor";
    const Photometry tilted = photometry_of(
        ies({0, 90}, {0}, ten, "1", "TILT=INCLUDE\n1\n3\n0 45 90\n1.0 0.9\n0.5\n"), "l.ies");
    EXPECT_EQ(tilted.greatest, 10);
    EXPECT_EQ(tilted.factor_at_tilt(0), 1);
    EXPECT_NEAR(tilted.factor_at_tilt(60), 0.9 - 0.4 / 3, 1e-12);
    EXPECT_EQ(tilted.factor_at_tilt(120), 0.5);
}

std::string refused(const std::string& text, const char* file) {
    try {
        photometry_of(text, file);
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
    return "";
}

TEST(Photometry, DamagedFilesAreRefusedByLine) {
    const std::string start = "TILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 50\n0 90\n0\n";
    EXPECT_EQ(refused(start + "5 5\n", "l.ies"), "");
    const std::pair<std::string, std::string> of_ies[] = {
        {start + "5\n", "l.ies:6: the file ends"},
        {start + "5 -5\n", "l.ies:6: a luminous intensity"},
        {start + "5 nan\n", "l.ies:6: 'nan' is not"},
        {start + "5 1e999\n", "l.ies:6: '1e999' is not"},
        {start + "0 0\n", "no light"},
        {"TILT=NONE\n1 -1 1 999999999 1 1 2 0 0 0\n", "l.ies:2: number of vertical angles"},
        {"TILT=NONE\n1 -1 1 -2 1 1 2 0 0 0\n", "l.ies:2: number of vertical angles"},
        {"TILT=NONE\n1 -1 0 2 1 1 2 0 0 0\n", "l.ies:2: the multiplier"},
        {"TILT=NONE\n1 -1 1 2 1 4 2 0 0 0\n", "l.ies:2: photometric type 4"},
        {"TILT=NONE\n1 -1 1 2 1 1 7 0 0 0\n", "l.ies:2: units 7"},
        {"TILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 50\n0 0\n", "l.ies:4: angle 0"},
        {"TILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 50\n0 270\n", "l.ies:4: angle 270"},
        {"TILT=NONE\n1 -1 1 2 2 1 2 0 0 0\n1 1 50\n0 90\n0 100\n", "horizontal angles 0 to 100"},
        {"TILT=lamp.tlt\n", "l.ies:1: TILT=lamp.tlt"},
        {"TILT=INCLUDE\n1 99999 0\n", "l.ies:2: number of tilts"},
        {"IESNA91\n[TEST]\n", "l.ies:2: the file ends before the line TILT="}};
    for (const auto& [text, words] : of_ies)
        EXPECT_NE(refused(text, "l.ies").find(words), std::string::npos) << words << "\n"
                                                                         << refused(text, "l.ies");
    const Candela ten = [](double, double) { return 10.0; };
    const std::string good = ldt(2, ten);
    EXPECT_EQ(refused(good, "l.ldt"), "");
    const auto with = [&](int line, const std::string& value) {
        std::size_t at = 0;
        for (int i = 1; i < line; ++i) at = good.find('\n', at) + 1;
        return good.substr(0, at) + value + good.substr(good.find('\n', at));
    };
    for (const auto& [line, value] : {std::pair{3, "5"},
                                      {3, "x"},
                                      {4, "-1"},
                                      {4, "1e9"},
                                      {4, "2.5"},
                                      {6, "1"},
                                      {6, "nan"},
                                      {16, "-3"},
                                      {24, "0"},
                                      {26, "2"},
                                      {29, "-5"},
                                      {44, "-1"},
                                      {90, "-1"},
                                      {90, ""}}) {
        EXPECT_NE(refused(with(line, value), "l.ldt").find(fmt::format("l.ldt:{}: ", line)),
                  std::string::npos)
            << line << " " << value << ": " << refused(with(line, value), "l.ldt");
    }
    // No part of a file is a crash, and none is a whole lamp.
    for (const std::string& whole : {start + "5 5", ldt(1, ten)}) {
        for (std::size_t i = 0; i + 3 < whole.size(); ++i) {
            const char* file = whole == start + "5 5" ? "l.ies" : "l.ldt";
            EXPECT_NE(refused(whole.substr(0, i), file), "") << i;
        }
    }
    EXPECT_NE(refused(good, "l.txt"), "");
}

class LampScenes : public test::FolderTest {
protected:
    Scene read(const std::string& lamp) const {
        write("mesh.obj",
              "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
        write("scene.toml", "mesh = \"mesh.obj\"\nmaterial = \"diamond\"\n[[light.lamp]]\n" + lamp);
        return read_scene(folder_ / "scene.toml");
    }
    std::string refusal(const std::string& lamp) const {
        try {
            read(lamp);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
    // A picture of a brilliant in the light of a lamp 8 away that shines so over the polar angle.
    RenderResult lit(const std::string& engine, const Candela& candela) const {
        write("l.ies", ies(steps(0, 180, 2), {0}, candela));
        Scene scene = plain_scene(round_brilliant());
        look(scene, {0.21, 0.34, 1}, 10);
        scene.camera.width = scene.camera.height = 40;
        scene.lights = read(
                           "file = \"l.ies\"\nposition = [1, 2, 8]\nradius = 2.5\n"
                           "direction = [-0.3, 0.1, -1]\n")
                           .lights;
        return with_engine(scene, engine, 1);
    }
};

double radiance(const Lights& lights, const Vec3& from, const Vec3& direction) {
    double value = 0;
    LightField(lights, WavelengthSet({550})).add_radiance(from, direction, 1, 0, 1, &value);
    return value;
}

// A ball of radius r with radiance I / (pi r^2) has the intensity I. So an isotropic lamp of 100 cd
// is a sphere light, in every engine, bit by bit.
TEST_F(LampScenes, AnIsotropicLampIsASphereLight) {
    write("l.ies", ies({0, 180}, {0}, [](double, double) { return 100.0; }));
    const Scene scene = read(
        "file = \"l.ies\"\nposition = [1, 2, 8]\nradius = 2.5\nscale = 0.5\ndirection = [1, 0, 0]");
    Scene drawn = plain_scene(round_brilliant());
    look(drawn, {0.21, 0.34, 1}, 10);
    for (const char* engine :
         {"reference", "beams", "preview", "raytable", "flat", "gouraud", "phong", "whitted"}) {
        drawn.lights = scene.lights;
        const RenderResult lamp = with_engine(drawn, engine, 1);
        drawn.lights.sources = {SphereLight{{1, 2, 8}, 2.5, {50 / (k_pi * 2.5 * 2.5)}}};
        EXPECT_EQ(lamp.picture.rgb, with_engine(drawn, engine, 1).picture.rgb) << engine;
    }
}

// Light adds up: a lamp and what it lacks of an isotropic one make an isotropic one, in every
// engine. In single precision, after some ten additions: 1e-5 of the brightest.
TEST_F(LampScenes, ALampAndItsComplementAreAnIsotropicLamp) {
    for (const char* engine :
         {"reference", "beams", "preview", "raytable", "flat", "gouraud", "phong", "whitted"}) {
        const auto a = lit(engine, [](double, double g) { return 60 + 60 * cosine(9 * g); });
        const auto b = lit(engine, [](double, double g) { return 60 - 60 * cosine(9 * g); });
        const auto both = lit(engine, [](double, double) { return 120.0; });
        double most = 0, off = 0, apart = 0;
        for (std::size_t i = 0; i < both.picture.rgb.size(); ++i) {
            const double one = double(a.picture.rgb[i]), other = double(b.picture.rgb[i]),
                         sum = double(both.picture.rgb[i]);
            most = std::max(most, sum);
            off = std::max(off, std::abs(one + other - sum));
            apart = std::max(apart, std::abs(one - other));
        }
        EXPECT_GT(apart, 0.05 * most) << engine;
        EXPECT_LE(off, 1e-5 * most) << engine;
    }
}

// Irradiance at the distance d on the axis of a lamp of I0 candela is I0 / d^2: exactly for an
// isotropic ball, and to (r / d)^2 for others. The scale makes colours, and the tilt a factor.
TEST_F(LampScenes, IrradianceFallsWithTheSquareOfTheDistance) {
    std::filesystem::copy_file(k_lamps + "lambert.ies", folder_ / "l.ies");
    const Lights lights = read("file = \"l.ies\"\nposition = [0, 0, 500]\n").lights;
    const auto& lamp = nth_light<LampLight>(lights, 0);
    EXPECT_NEAR(lamp.radius, 30, 1e-9) << "of the file's opening";
    for (const double distance : {500.0, 1000.0, 4000.0}) {
        const Vec3 from{0, 0, 500 - distance};
        const double most = std::asin(30 / distance);
        double irradiance = 0;
        const int rings = 2000;
        for (int i = 0; i < rings; ++i) {
            const double angle = most * (i + 0.5) / rings;
            irradiance += 2 * k_pi * std::sin(angle) * std::cos(angle) * most / rings *
                          radiance(lights, from, {std::sin(angle), 0, std::cos(angle)});
        }
        EXPECT_NEAR(irradiance * distance * distance / 300, 1, 900 / (distance * distance) + 1e-3);
    }
    write("t.ies", ies(
                       {0, 180}, {0}, [](double, double) { return 10.0; }, "1",
                       "TILT=INCLUDE\n1 2 0 90 1 0.5\n"));
    const Lights tilted = read(
                              "file = \"t.ies\"\nposition = [0, 0, 20]\ntilt = 45\n"
                              "scale = [1, 2, 4]\n")
                              .lights;
    const auto& colour = std::get<Rgb>(nth_light<LampLight>(tilted, 0).radiance.value);
    for (const int i : {0, 1, 2})
        EXPECT_NEAR(colour[std::size_t(i)], (1 << i) * 7.5 / k_pi, 1e-9) << "radius 20 / 20";
}

TEST_F(LampScenes, SayWhatIsWrongOrLeftOut) {
    std::filesystem::copy_file(k_lamps + "lambert.ies", folder_ / "l.ies");
    const std::string file = "file = \"l.ies\"\n";
    for (const auto& [lamp, words] :
         {std::pair<std::string, std::string>{"position = [0, 0, 9]\n", "file is missing"},
          {"file = \"none.ies\"\nposition = [0, 0, 9]\n", "none.ies"},
          {file + "position = [0, 0, 9]\n", "reaches the middle"},
          {file + "position = [0, 0, 90]\nscale = -1\n", "scale must not be negative"},
          {file + "position = [0, 0, 90]\nzero = [0, 0, 1]\n", "zero must not be parallel"},
          {file + "position = [0, 0, 90]\ntilt = 20\n", "tilt needs"},
          {file + "position = [0, 0, 90]\nradiance = 2\n", "radiance"}})
        EXPECT_NE(refusal(lamp).find(words), std::string::npos) << refusal(lamp);
    const Scene scene = read(file + "position = [0, 0, 90]\n");
    const std::vector<std::string> notes = mitsuba_scene(scene, "s").notes;
    EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
        return note.find("photometry") != std::string::npos;
    }));
}

}  // namespace
