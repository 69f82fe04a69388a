#include "page/batch_page.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <string_view>

#include "page/html.h"
#include "page/parts.h"
#include "page/templates.h"

namespace culet {

namespace {

// A file's name as part of a URL (RFC 3986, section 2.3).
std::string as_address(const std::string& name) {
    constexpr std::string_view k_plain = "-._~";
    std::string address;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain =
            byte < 128 && (std::isalnum(byte) != 0 || k_plain.find(c) != std::string_view::npos);
        address += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
    }
    return address;
}

View row_of(const BatchPageJob& job) {
    std::vector<View> files;
    for (const std::string& file : job.files) {
        files.push_back(
            {{"address", "jobs/" + as_address(job.name) + "/" + as_address(file)}, {"file", file}});
    }
    std::string status = job.status;
    for (char& c : status) c = c == '_' ? ' ' : c;
    return {{"name", job.name},
            {"picture", job.png.empty() ? std::string() : png_uri(job.png)},
            {"good", job.good},
            {"status", status},
            {"message", job.message},
            {"outlier", decimals(job.outlier, 1)},
            {"worst", decimals(job.worst_reading, 1)},
            {"chi2", decimals(job.chi2, 1)},
            {"dof", decimals(job.dof, 0)},
            {"light_return", decimals(job.light_return, 1)},
            {"fire", significant(job.fire, 3)},
            {"leak", significant(job.leak, 3)},
            {"files", files}};
}

}  // namespace

std::string batch_page(const BatchPage& page) {
    std::vector<View> rows;
    for (const BatchPageJob& job : page.jobs) rows.push_back(row_of(job));
    const auto some = [](std::size_t count) {
        return count == 0 ? std::string() : fmt::format("{}", count);
    };
    const std::string title = fmt::format("{} stones", page.jobs.size());
    return html_page(title, filled(templates::batch, {{"title", title},
                                                      {"all_good", page.good == page.jobs.size()},
                                                      {"good", some(page.good)},
                                                      {"untrusted", some(page.untrusted)},
                                                      {"failed", some(page.failed)},
                                                      {"missing", some(page.missing)},
                                                      {"version", page.version},
                                                      {"rows", rows}}));
}

}  // namespace culet
