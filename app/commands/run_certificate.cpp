#include "app/commands/run_certificate.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "app/program/other_programs.h"
#include "app/program/scratch_folder.h"
#include "app/program/terminal.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

namespace fs = std::filesystem;

bool print_page(const std::string& browser, const fs::path& page, const fs::path& pdf) {
    constexpr std::chrono::seconds k_most_time(60);
    const ScratchFolder scratch;
    const fs::path printed = scratch.path() / "page.pdf";
    std::vector<std::string> words{browser,
                                   "--headless",
                                   "--disable-gpu",
                                   "--no-pdf-header-footer",
                                   "--user-data-dir=" + (scratch.path() / "profile").string(),
                                   "--print-to-pdf=" + printed.string(),
                                   "file://" + fs::absolute(page).string()};
    // Chromium refuses root its sandbox. The page runs no scripts and loads nothing.
    if (geteuid() == 0) words.insert(words.begin() + 1, "--no-sandbox");
    std::error_code problem;
    if (run_program(words, scratch.path() / "messages.txt", k_most_time) != 0 ||
        !fs::exists(printed, problem))
        return false;
    write_text(pdf, read_text(printed));
    return true;
}

}  // namespace

CertificateJob read_certificate(const TomlTable& table) {
    constexpr std::size_t k_most_logo_bytes = 1 << 20;
    table.refuse_unknown({"number", "date", "issuer", "logo", "paper", "pdf"});
    CertificateJob job;
    Certificate& own = job.certificate;
    own.number = table.kind("number") == TomlTable::Kind::number
                     ? std::to_string(*table.integer("number"))
                     : table.text("number").value_or("");
    own.date = table.text("date").value_or("");
    own.issuer = table.text("issuer").value_or("");
    own.paper = table.text("paper").value_or(own.paper);
    if (own.paper != "A4" && own.paper != "letter")
        table.fail("paper", "paper must be \"A4\" or \"letter\"");
    if (const auto logo = table.path("logo")) {
        own.logo_uri = logo_uri(read_text(*logo, k_most_logo_bytes));
        if (own.logo_uri.empty()) table.fail("logo", "the logo must be a PNG, JPEG or SVG file");
    }
    job.pdf = table.boolean("pdf").value_or(true);
    return job;
}

void write_certificate(CertificateJob job, const fs::path& folder, bool quiet) {
    const fs::path page = folder / "certificate.html", pdf = folder / "certificate.pdf";
    job.certificate.version = CULET_VERSION;
    write_text(page, certificate_page(job.certificate));
    std::error_code ignored;
    fs::remove(pdf, ignored);  // an earlier certificate's
    if (!job.pdf) return;
    const std::array<std::string, 4> browsers{"chromium", "chromium-browser", "google-chrome",
                                              "google-chrome-stable"};
    const auto* const browser = std::find_if(browsers.begin(), browsers.end(), has_program);
    if (browser != browsers.end() && !print_page(*browser, page, pdf))
        say(fmt::format("no certificate.pdf: {} failed; print {} from a browser", *browser,
                        page.string()),
            quiet);
}

}  // namespace culet
