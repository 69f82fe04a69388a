// Typical slips in command lines and files: each is answered in one line that says what to do. And
// the list of materials.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/app/program_test.h"

namespace culet {
namespace {

using test::ProgramRun;
using test::run_culet;

class Slips : public test::ProgramTest {
protected:
    // Exit code 2 and one error line that contains all of `words`.
    static void expect_answer(const std::vector<std::string>& arguments,
                              const std::vector<std::string>& words) {
        const std::string said = refusal(arguments);
        for (const std::string& word : words)
            EXPECT_NE(said.find(word), std::string::npos) << word << " in " << said;
    }
    // A cube's stone file, scene and job.
    void write_files() const {
        cut("round-brilliant", "hand.obj");
        write("stone.toml", "[stone]\nmesh = \"hand.obj\"\n");
        write("scene.toml",
              "mesh = \"hand.obj\"\nmaterial = \"glass_bk7\"\n[camera]\nposition = [0, 0, "
              "40]\nfov = 12\nsize = [24, 24]\n[light]\nconstant = 1.0\n");
        write("job.toml", "[fit]\nstone = \"stone.toml\"\n[render]\nscene = \"scene.toml\"\n");
    }
};

TEST_F(Slips, BareProgramSaysWhatToBeginWith) {
    const ProgramRun run = run_culet({});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_TRUE(run.out.empty());
    for (const char* word : {"culet cut", "culet fit", "culet render", "--help"})
        EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
    EXPECT_LE(std::count(run.err.begin(), run.err.end(), '\n'), 12);
}

TEST_F(Slips, MisspeltOptionsAndCommandsAreAnsweredWithTheNearest) {
    // Even if a required option is missing too.
    expect_answer({"render", "scene.toml", "--tollerance", "0.1"},
                  {"culet render", "\"--tollerance\"", "\"--tolerance\""});
    expect_answer({"fit", "stone.toml", "--drawin=a.svg"}, {"\"--drawing\""});
    expect_answer({"info", "--materiels"}, {"\"--materials\""});
    expect_answer({"rendr", "scene.toml"}, {"\"render\""});
    expect_answer({"stone.toml"}, {"culet info stone.toml"});
    // A parameter of a cut, one command deeper.
    expect_answer({"cut", "round-brilliant", "--pavilion-angel", "41", "-o", file("a.obj")},
                  {"--pavilion-angle"});
}

TEST_F(Slips, UnitsBehindNumbersAreTakenOrTold) {
    const auto cut = [this](const std::string& name, const std::vector<std::string>& parameters) {
        std::vector<std::string> all{"cut", "round-brilliant", "-q", "-o", file(name)};
        all.insert(all.end(), parameters.begin(), parameters.end());
        return run_culet(all);
    };
    EXPECT_EQ(cut("plain.obj", {"--diameter", "6.52", "--table", "58"}).exit_code, 0);
    const ProgramRun units = cut("units.obj", {"--diameter", "6.52mm", "--table", "58%"});
    EXPECT_EQ(units.exit_code, 0) << units.err;
    EXPECT_EQ(text(file("units.obj")), text(file("plain.obj")));
    // A decimal comma and other units of length work too.
    EXPECT_EQ(cut("comma.obj", {"--diameter", "6,52", "--table", "58"}).exit_code, 0);
    EXPECT_EQ(text(file("comma.obj")), text(file("plain.obj")));
    EXPECT_EQ(cut("cm.obj", {"--diameter", "0.652cm"}).exit_code, 0);
    expect_answer({"convert", "a.asc", "b.obj", "--meet-tolerance", "5%"}, {"write 0.05"});
    EXPECT_FALSE(std::filesystem::exists(file("a.obj")));
    write_files();
    expect_answer({"probe", file("scene.toml"), "--pixel", "1,1", "--set", "camera.fov=12deg"},
                  {"write 12 without \"deg\""});
}

TEST_F(Slips, AFileOfTheWrongKindIsToldWithTheCommandThatTakesIt) {
    write_files();
    const std::string out = file("out");
    expect_answer({"fit", file("scene.toml"), "-o", file("a.obj")},
                  {"scene.toml: is a scene", "culet fit takes a stone file", "culet render"});
    expect_answer({"fit", file("hand.obj"), "-o", file("a.obj")},
                  {"is a mesh", "[stone] mesh = \"...\""});
    expect_answer({"fit", file("job.toml"), "-o", file("a.obj")}, {"is a job", "culet run"});
    expect_answer({"probe", file("stone.toml"), "--pixel", "1,1"},
                  {"is a stone file", "culet probe takes a scene"});
    expect_answer({"run", file("scene.toml"), "-o", out}, {"is a scene", "culet run takes a job"});
    expect_answer({"study", file("hand.obj"), "-o", out}, {"is a mesh", "scene", "stone file"});
    expect_answer({"convert", file("scene.toml"), file("a.obj")}, {"is a scene"});
    EXPECT_FALSE(std::filesystem::exists(out));
}

std::string without_texts(const std::string& png) {
    std::string bare = png.substr(0, 8);
    for (std::size_t at = 8; at + 12 <= png.size();) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i)
            length = length << 8 | static_cast<unsigned char>(png[at + i]);
        const std::string kind = png.substr(at + 4, 4);
        if (kind != "tEXt" && kind != "iTXt") bare += png.substr(at, length + 12);
        at += length + 12;
    }
    return bare;
}

TEST_F(Slips, SwappedPhotographAndRenderAreTold) {
    write_files();
    ASSERT_EQ(run_culet({"render", file("scene.toml"), "-q", "-o", file("render.png")}).exit_code,
              0);
    write("photo.png", without_texts(text(file("render.png"))));
    expect_answer({"compare", file("render.png"), file("photo.png"), "-o", file("out")},
                  {"the photograph comes first", "--simulated"});
    expect_answer({"compare", file("scene.toml"), file("photo.png"), "-o", file("out")},
                  {"photographs come first"});
    expect_answer({"compare", file("photo.png"), file("stone.toml"), "-o", file("out")},
                  {"is a stone file"});
    // No warning where the order is right or the pictures are said to be simulated.
    for (const std::vector<std::string>& order :
         {std::vector<std::string>{file("photo.png"), file("render.png")},
          {file("render.png"), file("photo.png"), "--simulated"}}) {
        std::vector<std::string> all{"compare", "-o", file("out")};
        all.insert(all.end(), order.begin(), order.end());
        EXPECT_EQ(run_culet(all).err.find("comes first"), std::string::npos);
    }
}

TEST_F(Slips, TextWithoutQuotesIsTold) {
    write("stone.toml", "[stone]\nname = Dravite\n");
    expect_answer({"fit", file("stone.toml"), "-o", file("a.obj")},
                  {"stone.toml:2:", "name = \"Dravite\""});
}

TEST_F(Slips, ForeignTextIsShortenedAndMadeSafe) {
    write("stone.toml", "[stone]\nmesh = \"a.obj\"\nmaterial = \"" + std::string(3000000, 'x') +
                            "\\u001b[31m\"\n");
    const ProgramRun run = run_culet({"fit", file("stone.toml"), "-o", file("a.obj")});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_LT(run.err.size(), 3000u);
    EXPECT_EQ(run.err.find('\x1b'), std::string::npos);
}

TEST_F(Slips, MissingColourIsSaidWhenAPictureIsDrawn) {
    write_files();
    const std::vector<std::string> draw{"render", file("scene.toml"),   "-o", file("a.png"),
                                        "--set",  "material=aquamarine"};
    const ProgramRun loud = run_culet(draw);
    EXPECT_EQ(loud.exit_code, 0) << loud.err;
    EXPECT_NE(loud.err.find("aquamarine"), std::string::npos) << loud.err;
    const ProgramRun info = run_culet({"info", file("scene.toml"), "--set", "material=aquamarine"});
    EXPECT_NE(info.out.find("drawn without colour"), std::string::npos) << info.out;
    const ProgramRun diamond = run_culet({"info", file("scene.toml"), "--set", "material=diamond"});
    EXPECT_EQ(diamond.out.find("drawn without colour"), std::string::npos);
    write("dravite.toml", "[stone]\nmesh = \"hand.obj\"\nmaterial = \"tourmaline_dravite\"\n");
    const ProgramRun stone = run_culet({"info", file("dravite.toml")});
    EXPECT_NE(stone.out.find("note: tourmaline_dravite"), std::string::npos) << stone.out;
    const ProgramRun ruby =
        run_culet({"info", file("dravite.toml"), "--set", "stone.material=ruby_gem"});
    EXPECT_NE(ruby.out.find("body colour deep red"), std::string::npos) << ruby.out;
    expect_answer({"info", file("scene.toml"), "--set", "material=sapphire"},
                  {"\"sapphire_blue\"", "--materials"});
}

TEST_F(Slips, MaterialsAreListedByWordAsTextJsonAndPage) {
    const ProgramRun all = run_culet({"info", "--materials"});
    EXPECT_EQ(all.exit_code, 0) << all.err;
    EXPECT_EQ(all.out.find('\x1b'), std::string::npos) << "no colours where no terminal is";
    for (const char* name : {"diamond", "ruby_gem", "garnet_rhodolite", "aquamarine"})
        EXPECT_NE(all.out.find(name), std::string::npos);
    const ProgramRun some = run_culet(
        {"info", "--materials", "garnet", "--json", file("list.json"), "-o", file("list.html")});
    EXPECT_EQ(some.exit_code, 0) << some.err;
    EXPECT_EQ(some.out.find("diamond"), std::string::npos);
    const auto list = json("list.json");
    EXPECT_EQ(list.at("schema"), 1);
    for (const auto& material : list.at("materials")) {
        const std::string id = material.at("id");
        EXPECT_EQ(id.rfind("garnet_", 0), 0u) << id;
        EXPECT_EQ(material.at("birefringence"), 0);
        if (id == "garnet_rhodolite") {
            EXPECT_NE(material.at("colour").at("name").get<std::string>().find("purplish red"),
                      std::string::npos);
            EXPECT_EQ(material.at("colour").at("lab").size(), 3u);
        }
        if (id == "garnet_pyrope") {
            EXPECT_TRUE(material.at("colour").is_null());
            EXPECT_EQ(material.at("usual_colour"), "deep red");
        }
    }
    EXPECT_NE(text(file("list.html")).find("garnet_rhodolite"), std::string::npos);
    EXPECT_NE(some.out.find("no spectrum"), std::string::npos);
    const auto ruby =
        nlohmann::json::parse(run_culet({"info", "--materials", "ruby_gem", "--json", "-"}).out);
    // Corundum at 589 nm: Malitson and Dodge, 1.768 and 1.760.
    EXPECT_NEAR(ruby.at("materials")[0].at("birefringence"), 0.008, 5e-4);
    expect_answer({"info", "--materials", "qqqqqqqq"}, {"qqqqqqqq"});
    expect_answer({"info", "-o", file("a.html")}, {"--materials"});
    expect_answer({"info", "--materials", "-o", file("a.txt")}, {".html"});
}

}  // namespace
}  // namespace culet
