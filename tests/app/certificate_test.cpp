// The certificate that `culet run` makes of a fitted stone.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "page/json_fields.h"
#include "page/quantity.h"
#include "tests/app/program_test.h"

namespace culet {
namespace {

namespace fs = std::filesystem;
using test::ProgramRun;
using test::run_culet;
using ::testing::HasSubstr;

class RunCertificate : public test::ProgramTest {
protected:
    ProgramRun run(const std::string& certificate) const {
        write("job.toml", "[fit]\nstone = \"" + std::string(CULET_SOURCE_DIR) +
                              "/samples/dravite-step/stone.toml\"\n" + certificate);
        return run_culet({"run", file("job.toml"), "-o", file("out")});
    }
    /// A program of this name, before all others.
    void put_first(const std::string& name, const std::string& script) const {
        fs::create_directory(folder_ / "bin");
        fs::permissions(write("bin/" + name, "#!/bin/sh\n" + script + "\n"), fs::perms::owner_all);
        setenv("PATH", (file("bin") + ":" + path_).c_str(), 1);
    }
    ~RunCertificate() override { setenv("PATH", path_.c_str(), 1); }

    const std::string path_ = std::getenv("PATH");
};

TEST_F(RunCertificate, HasTheFiguresOfTheFitAndTheSameBytesEachTime) {
    ASSERT_EQ(run("[certificate]\npdf = false\ndate = 2026-01-31\n"
                  "number = 17\n")
                  .exit_code,
              0);
    const std::string page = text("out/certificate.html");
    for (const auto& p : json("out/fit.json").at("proportions")) {
        const std::string name = text_at(p, "name");
        // The weight is the balance's; calipers on the way round are for round stones.
        if (name == "weight" || name.starts_with("caliper")) continue;
        EXPECT_THAT(page, HasSubstr(">" +
                                    quantity(number_at(p, "value"), number_at(p, "sigma"),
                                             text_at(p, "unit")) +
                                    "<"))
            << name;
    }
    EXPECT_THAT(page, HasSubstr("2026-01-31"));
    EXPECT_THAT(page, HasSubstr("No. 17"));
    EXPECT_THAT(text("out/report.html"), HasSubstr("href=\"certificate.html\""));
    ASSERT_EQ(run("[certificate]\npdf = false\ndate = \"2026-01-31\"\n"
                  "number = \"17\"\n")
                  .exit_code,
              0);
    EXPECT_EQ(text("out/certificate.html"), page);
}

TEST_F(RunCertificate, IsPrintedOnOnePageWhereChromiumIs) {
    if (std::system("chromium --version >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "no Chromium is installed";
    ASSERT_EQ(run("").exit_code, 0);
    const std::string pdf = text("out/certificate.pdf");
    const std::regex page("/Type */Page\\b");
    EXPECT_EQ(std::distance(std::sregex_iterator(pdf.begin(), pdf.end(), page), {}), 1);
}

TEST_F(RunCertificate, ABrowserThatFailsIsANoteAndLeavesNoOlderPdf) {
    put_first("chromium", "exit 1");
    fs::create_directory(folder_ / "out");
    write("out/certificate.pdf", "of another stone");
    const ProgramRun made = run("");
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.err, HasSubstr("no certificate.pdf: chromium failed"));
    EXPECT_TRUE(fs::exists(file("out/certificate.html")));
    EXPECT_FALSE(fs::exists(file("out/certificate.pdf")));
}

TEST_F(RunCertificate, RefusesWhatItCannotUse) {
    write("logo.txt", "no picture");
    write("large.svg", "<svg>" + std::string(2 << 20, ' ') + "</svg>");
    for (const char* key : {"paper = \"A5\"", "logo = \"logo.txt\"", "logo = \"missing.png\"",
                            "logo = \"large.svg\"", "number = 1.5", "nummer = 1"}) {
        refusal_of(run("[certificate]\n" + std::string(key) + "\n"));
        EXPECT_FALSE(fs::exists(file("out"))) << key;
    }
    write("job.toml", "[render]\nscene = \"scene.toml\"\n[certificate]\n");
    EXPECT_THAT(refusal({"run", file("job.toml"), "-o", file("out")}), HasSubstr("needs [fit]"));
}

}  // namespace
}  // namespace culet
