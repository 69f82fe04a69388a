#include "fit/findings/words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace culet {

std::string name_list(const std::vector<std::string>& names, std::size_t most) {
    const std::size_t named = std::min(most, names.size());
    std::string text =
        fmt::format("{}", fmt::join(names.begin(), names.begin() + std::ptrdiff_t(named), ", "));
    if (named < names.size()) text += fmt::format(" and {} more", names.size() - named);
    return text;
}

std::string of_words(const std::vector<std::string>& of) {
    return of.empty() ? "" : fmt::format(" of {}", fmt::join(of, "/"));
}

double file_unit(ReadingKind kind) {
    const bool turns = kind == ReadingKind::parallel || kind == ReadingKind::rotation ||
                       kind == ReadingKind::mirror;
    return is_angle(kind) || turns ? degrees(1) : 1;
}

std::string slip_words(const Proposal& proposal) {
    if (proposal.slip.empty()) return {};
    return fmt::format("; {:.6g}? ({})",
                       (proposal.in_radians ? degrees(1) : 1) * proposal.corrected, proposal.slip);
}

std::string length_words(double value, double sigma, LengthUnit unit) {
    const double micrometres = 1000 * mm_per(unit);
    if (std::abs(micrometres * value) < 1000)
        return fmt::format("{:.2g} ± {:.2g} µm", micrometres * value, micrometres * sigma);
    return fmt::format("{:.3g} ± {:.2g} {}", value, sigma, name_of(unit));
}

std::string sentence_of(std::string text) {
    if (text.empty()) return text;
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    if (text.back() != '.') text += '.';
    return text;
}

std::string bench_words(const NextReading& reading) {
    const std::string of = fmt::format("{}", fmt::join(reading.of, " and "));
    switch (reading.kind) {
        case ReadingKind::azimuth:
            return "read the azimuth (the index) of " + of;
        case ReadingKind::width:
            return "measure the width at " + of + " degrees";
        case ReadingKind::table_width:
            return "measure the table's width at " + of + " degrees";
        case ReadingKind::depth:
            return "measure the depth";
        case ReadingKind::weight:
            return "weigh the stone";
        case ReadingKind::volume:
            return "find the volume";
        case ReadingKind::edge:
            return "measure the edge between " + of;
        default:
            return std::string("read the ") + name_of(reading.kind) + " of " + of;
    }
}

std::string place_words(const Reading& reading) {
    if (reading.line <= 0) return "reading " + reading.id;
    return fmt::format("{} line {}", reading.file.filename().string(), reading.line);
}

std::string told_reading(const std::vector<Reading>& readings, const std::string& id) {
    const auto found = std::find_if(readings.begin(), readings.end(),
                                    [&](const Reading& r) { return r.id == id; });
    if (found == readings.end()) return id;
    const std::string what = name_of(found->kind) + of_words(found->of);
    if (found->line <= 0) return fmt::format("{} ({})", id, what);
    return fmt::format("{} ({}, {})", place_words(*found), what, id);
}

}  // namespace culet
