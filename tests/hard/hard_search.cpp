// hard_search [--cases N | --seconds S] [--seed K] [--keep FOLDER]: searches for hard cases. Each
// is a case file with every number drawn between easy and absurd. A case that fails is kept in
// FOLDER (found/ in the results folder), ready to be copied into the corpus. hard_search --again
// FILE...: runs such files again.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "stone/text/output_file.h"
#include "tests/hard/hard_run.h"

namespace {

using namespace culet::hard;

class Draw {
public:
    explicit Draw(std::uint64_t seed) : random_(seed) {}
    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    /// 10 to a uniform power.
    double power(double low, double high) { return std::pow(10, uniform(low, high)); }
    int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
    bool chance(double p) { return uniform(0, 1) < p; }
    const char* one_of(std::initializer_list<const char*> words) {
        return words.begin()[whole(0, static_cast<int>(words.size()) - 1)];
    }
    std::string direction() {
        return fmt::format("[{}, {}, {}]", uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    }

private:
    std::mt19937_64 random_;
};

// `scale`: of shapes with a diameter of some 2 to 3.5.
std::string stone(Draw& draw, double scale = 1, double turned = 0.7) {
    const std::string shape = draw.one_of(
        {"random", "twins", "nick", "culet", "box", "bipyramid", "sphere", "cut", "culet"});
    std::string text = fmt::format("\n[stone]\nshape = \"{}\"\n", shape);
    if (shape == "random") {
        text += fmt::format("facets = {}\nseed = {}\n", draw.whole(0, 60), draw.whole(1, 1 << 30));
    } else if (shape == "twins") {
        text += fmt::format("angle_deg = {}\n", draw.power(-13, 1));
    } else if (shape == "nick") {
        text += fmt::format("size = {}\n", draw.power(-14, -0.5));
    } else if (shape == "culet") {
        text += fmt::format("facets = {}\ngirdle = {}\nmiss = {}\n", draw.whole(3, 40),
                            draw.power(-15, -0.5), draw.chance(0.5) ? 0 : draw.power(-14, -2));
        if (draw.chance(0.5)) text += fmt::format("culet = {}\n", draw.power(-15, -0.5));
    } else if (shape == "box") {
        text += fmt::format("aspect = {}\n", draw.power(-6, 6));
    } else if (shape == "bipyramid") {
        text += fmt::format("facets = {}\ngirdle = {}\nwith_girdle = {}\n", draw.whole(3, 24),
                            draw.chance(0.3) ? 0 : draw.power(-15, -0.5), draw.chance(0.5));
    } else if (shape == "sphere") {
        text += fmt::format("facets = {}\n", draw.whole(20, 150));
    } else {
        text += fmt::format("cut = \"{}\"\nfacet = \"{}\"\ntilt_deg = {}\n",
                            draw.one_of({"round-brilliant", "step", "princess"}),
                            draw.one_of({"T", "P1", "C1", "G1"}), draw.power(-13, 0));
    }
    text += fmt::format("scale = {}\n", shape == "cut" ? 0.3 * scale : scale);
    if (draw.chance(turned)) text += fmt::format("turn = {}\n", draw.whole(1, 1 << 30));
    return text;
}

std::string material(Draw& draw) {
    const double n = draw.chance(0.3) ? 1 + draw.power(-12, -1) : draw.uniform(1.1, 4);
    const double split = draw.power(-16, -0.7);
    const double second = std::max(1 + 1e-15, n + (draw.chance(0.5) ? split : -split));
    std::string text = "\n[scene.material]\n";
    const int rays = draw.whole(1, 3);
    if (rays == 1) {
        text += fmt::format("optic = \"isotropic\"\nindex = {{ n = {} }}\n", n);
    } else if (rays == 2) {
        text += fmt::format("optic = \"uniaxial\"\nindex = {{ o = {}, e = {} }}\n", n, second);
    } else {
        text +=
            fmt::format("optic = \"biaxial\"\nindex = {{ alpha = {}, beta = {}, gamma = {} }}\n", n,
                        n + split * draw.uniform(0, 1), n + split);
    }
    if (draw.chance(0.3)) {
        const char* names[] = {"n", "o", "alpha"};
        text += fmt::format("absorption = {{ {} = {}{} }}\n", names[rays - 1], draw.power(-12, 8),
                            rays == 1   ? ""
                            : rays == 2 ? ", e = 0.1"
                                        : ", beta = 0.1, gamma = 0");
    }
    return text;
}

std::string lights(Draw& draw) {
    std::string text = fmt::format("\n[scene.light]\nconstant = {}\n", draw.uniform(0.1, 1));
    for (int k = draw.whole(0, 3); k > 0; --k) {
        text +=
            fmt::format("\n[[scene.light.lobe]]\ndirection = {}\nexponent = {}\nradiance = {}\n",
                        draw.direction(), draw.power(-1, 2), draw.uniform(0.1, 3));
    }
    if (draw.chance(0.3)) {
        text +=
            fmt::format("\n[[scene.light.cap]]\ndirection = {}\nhalf_angle = {}\nradiance = {}\n",
                        draw.direction(), draw.power(-1, 1.5), draw.power(-1, 1));
    }
    return text;
}

std::string frame(Draw& draw) {
    // Axes that the reader makes orthonormal.
    const std::string axis = draw.chance(0.3) ? "[0, 0, 1]" : draw.direction();
    return fmt::format("\n[scene]\noptic_axis = {}\n", axis);
}

bool biaxial(const std::string& material_text) {
    return material_text.find("biaxial") != std::string::npos;
}

std::string framed(Draw& draw, const std::string& material_text) {
    if (material_text.find("isotropic") != std::string::npos) return "\n[scene]\n";
    if (biaxial(material_text)) {
        return "\n[scene]\nprincipal_axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n";
    }
    return frame(draw);
}

std::string ray_case(Draw& draw) {
    const std::string of = material(draw);
    const bool coherent = draw.chance(0.3);
    return "kind = \"ray\"\n" + stone(draw, draw.chance(0.5) ? 1 : draw.power(-6, 6)) +
           fmt::format("\n[ray]\naim = \"{}\"\nmiss = {}\nfrom = {}\ndraws = 6\nseed = {}\n",
                       draw.one_of({"vertex", "edge", "facet", "facet_plane", "down", "random",
                                    "edge_line", "leaves_by_vertex", "leaves_by_edge"}),
                       draw.chance(0.3) ? 0 : draw.power(-17, -1), draw.power(0.2, 7),
                       draw.whole(1, 1 << 30)) +
           framed(draw, of) + "\n[scene.camera]\nposition = [0, 0, 40]\n" + of + lights(draw) +
           fmt::format("\n[scene.render]\ndepth = {}\ntolerance = 0\nwavelengths = [589.3]\n{}",
                       draw.whole(2, 8), coherent ? "coherence = \"on\"\nbandwidth = 0\n" : "") +
           "\n[invariants]\nenergy = 1e-12\nfinite = 0\n";
}

std::string picture_case(Draw& draw) {
    const std::string of = material(draw);
    const double z = draw.uniform(-1, 1), a = draw.uniform(0, 6.28), r = std::sqrt(1 - z * z);
    const char* engine = draw.one_of({"beams", "beams", "preview", "reference"});
    const int samples = draw.chance(0.5) ? 1 : 4;
    // The preview is constant over each beam and bounds only its pruning; and its pixel samples are
    // not the reference's.
    const bool bounded = engine == std::string_view("beams") && samples == 1;
    return "kind = \"picture\"\n" + stone(draw) +
           fmt::format("\n[view]\nfrom = {}\nfill = 1.05\n", draw.power(-0.2, 4)) +
           framed(draw, of) +
           fmt::format(
               "\n[scene.camera]\nposition = [{}, {}, {}]\nlook_at = [0, 0, 0]\nup = [0.1, "
               "1, 0.3]\nfov = 40\nsize = [24, 24]\n",
               r * std::cos(a), r * std::sin(a), z) +
           of + lights(draw) +
           fmt::format(
               "\n[scene.render]\nengine = \"{}\"\ndepth = {}\ntolerance = {}\nsamples = "
               "{}\nwavelengths = [589.3]\n",
               engine, draw.whole(2, 6), draw.chance(0.5) ? 0 : 0.01, samples) +
           "\n[invariants]\nfinite = 0\nlost_area = 4e-5\nfaces = 1e-6\n" +
           (bounded ? "within_its_bound = 1\n" : "");
}

std::string solid_case(Draw& draw) {
    return "kind = \"solid\"\n" + stone(draw) +
           fmt::format("shift = {}\n", draw.chance(0.5) ? 0 : draw.power(0, 8)) +
           "\n[invariants]\nexact_topology = 0\ncorners = 2.3e-16\nvolume = { limit = 1e-15, "
           "per_condition = 4 }\nunits = { per_condition = 8 }\nturned = { per_condition = 16 }\n"
           "last_digit = { per_condition = 8 }\nrays_leave = 4e-15\n";
}

std::string crystal_case(Draw& draw) {
    const std::string pattern = draw.chance(0.4)
                                    ? "[1, 0, 0]"
                                    : fmt::format("[{}, {}, {}]", draw.uniform(-0.5, 0.5),
                                                  draw.uniform(-0.5, 0.5), draw.uniform(-0.5, 0.5));
    return fmt::format(
        "kind = \"crystal\"\n\n[crystal]\nn = {}\nspread = {}\npattern = {}\noutside = {}\nlies = "
        "\"{}\"\noff = {}\nwave = \"{}\"\npast = {}\ndraws = 4\nseed = {}\n\n[invariants]\n"
        "amplitudes = {{ limit = 1e-13, per_condition = 8 }}\npowers = {{ limit = 1e-13, "
        "per_condition = 8 }}\nfinite = 0\n",
        draw.uniform(1.2, 3), draw.power(-16, -0.6), pattern, draw.chance(0.8) ? 1.0 : 1.33,
        draw.one_of({"random", "axis_along_normal", "axis_in_facet"}), draw.power(-16, -0.5),
        draw.one_of({"random", "normal", "optic_axis", "outside", "inside"}),
        (draw.chance(0.5) ? 1 : -1) * draw.power(-16, -0.5), draw.whole(1, 1 << 30));
}

std::string fit_case(Draw& draw) {
    // Readings assume an upright stone: those of a turned one would match no stone.
    return "kind = \"fit\"\n" + stone(draw, draw.chance(0.5) ? 1 : draw.power(-9, 9), 0.2) +
           "contract = 1e-9\n" +
           fmt::format("shift = {}\n", draw.chance(0.7) ? 0 : draw.power(0, 6)) +
           fmt::format("\n[mesh]\nshaken = {}\n", draw.chance(0.5) ? 0 : draw.power(-6, -1)) +
           fmt::format("\n[readings]\nset = \"{}\"\nsigma = {}\nnoise = {}\nrepeat = {}\n",
                       draw.one_of({"all", "all", "all", "angles", "lengths", "one", "none"}),
                       draw.chance(0.5) ? 1 : draw.power(-12, 12),
                       draw.chance(0.5) ? 0 : draw.power(-3, 1.5),
                       draw.chance(0.8) ? 1 : draw.whole(2, 20)) +
           "\n[invariants]\nfinite = 0\nsound_or_says_so = 0\n";
}

std::string any_case(Draw& draw) {
    switch (draw.whole(0, 9)) {
        case 0:
        case 1:
        case 2:
            return ray_case(draw);
        case 3:
        case 4:
            return picture_case(draw);
        case 5:
        case 6:
            return solid_case(draw);
        case 7:
        case 8:
            return crystal_case(draw);
        default:
            return fit_case(draw);
    }
}

std::filesystem::path results_of_search() {
    return std::filesystem::path(CULET_HARD_RESULTS) / "search";
}

struct Options {
    int cases = 200;
    double seconds = 0;
    std::uint64_t seed = 1;
    std::filesystem::path keep = std::filesystem::path(CULET_HARD_RESULTS) / "found";
};

class Search : public testing::Test {
public:
    explicit Search(const Options& options) : options_(options) {}
    void TestBody() override {
        const auto begin = std::chrono::steady_clock::now();
        const auto more = [&](int k) {
            const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
            return options_.seconds > 0 ? spent.count() < options_.seconds : k < options_.cases;
        };
        std::filesystem::create_directories(options_.keep);
        int kept = 0, tried = 0;
        for (; more(tried); ++tried) {
            const std::uint64_t seed = options_.seed * 1000003u + static_cast<std::uint64_t>(tried);
            Draw draw(seed);
            const auto file = options_.keep / fmt::format("found_{}.toml", seed);
            culet::write_text(
                file,
                fmt::format("# Found by hard_search, seed {}.\nmay_be_refused = true\n", seed) +
                    any_case(draw));
            const int before = failures();
            run_case(read_case(file), results_of_search());
            if (failures() == before) {
                std::filesystem::remove(file);
                const std::filesystem::path results = CULET_HARD_RESULTS;
                const std::string name =
                    fmt::format("{}.found_{}", options_.keep.filename().string(), seed);
                std::filesystem::remove_all(results / "scenes" / name);
                std::filesystem::remove(results / "search" / (name + ".json"));
            } else {
                ++kept;
                std::printf("found %s\n", file.c_str());
                std::fflush(stdout);
            }
        }
        std::printf("%d of %d cases do not hold\n", kept, tried);
    }

private:
    static int failures() {
        return testing::UnitTest::GetInstance()->current_test_info()->result()->total_part_count();
    }
    Options options_;
};

class Again : public testing::Test {
public:
    explicit Again(std::filesystem::path file) : file_(std::move(file)) {}
    void TestBody() override { run_case(read_case(file_), results_of_search()); }

private:
    std::filesystem::path file_;
};

}  // namespace

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    if (argc > 1 && std::string(argv[1]) == "--again") {
        for (int i = 2; i < argc; ++i) {
            testing::RegisterTest("HardSearch", argv[i], nullptr, nullptr, __FILE__, __LINE__,
                                  [file = argv[i]]() -> testing::Test* { return new Again(file); });
        }
        return RUN_ALL_TESTS();
    }
    Options options;
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string name = argv[i];
        if (name == "--cases") options.cases = std::atoi(argv[i + 1]);
        if (name == "--seconds") options.seconds = std::atof(argv[i + 1]);
        if (name == "--seed") options.seed = std::strtoull(argv[i + 1], nullptr, 10);
        if (name == "--keep") options.keep = argv[i + 1];
    }
    testing::RegisterTest("HardSearch", "finds_nothing", nullptr, nullptr, __FILE__, __LINE__,
                          [=]() -> testing::Test* { return new Search(options); });
    return RUN_ALL_TESTS();
}
