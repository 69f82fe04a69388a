#include "tests/fit/cutter_slips.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <stdexcept>

namespace culet::bench {

std::size_t one_of(Random& random, std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
}

namespace {

std::string other_digit(char digit, Random& random) {
    const char other = char('0' + one_of(random, 10));
    return other == digit ? other_digit(digit, random) : std::string(1, other);
}

// Returns the value after the slip; empty where the slip cannot happen to this value or hardly
// changes it.
std::string slipped(const CutterRow& row, Slipped slip, const std::vector<CutterRow>& rows,
                    Random& random) {
    std::string text = row.value;
    const bool is_angle = row.kind == "inclination";
    const double value = std::stod(text);
    switch (slip) {
        case Slipped::digits_swapped:
            if (text.size() < 2 || text[1] == '.') return {};
            std::swap(text[0], text[1]);
            break;
        case Slipped::decimal_point:
            return fmt::format("{:g}",
                               one_of(random, 2) == 0 && !is_angle ? value * 10 : value / 10);
        case Slipped::first_digit:
            text.replace(0, 1, other_digit(text[0], random));
            break;
        case Slipped::digit_lost:
            if (text.size() < 3) return {};
            text.erase(0, 1);
            break;
        case Slipped::digit_doubled:
            if (is_angle) return {};  // over 90 is not a valid reading
            text.insert(0, 1, text[0]);
            break;
        case Slipped::other_side:
            if (!is_angle) return {};
            return fmt::format("{:.1f}", 90 - value);
        case Slipped::inches:
            if (is_angle || row.kind == "weight") return {};
            return fmt::format("{:.3f}", value / 25.4);
        case Slipped::grams:
            return row.kind == "weight" ? fmt::format("{:.3f}", value / 5) : std::string();
        case Slipped::other_tier:
        case Slipped::copied_row: {
            if (!is_angle && slip == Slipped::other_tier) return {};
            const CutterRow& other = rows[one_of(random, rows.size())];
            if (other.kind != (slip == Slipped::other_tier ? row.kind : other.kind)) return {};
            return other.value;
        }
        case Slipped::turned_digit:
            for (std::size_t i = 0; i < std::min<std::size_t>(2, text.size()); ++i) {
                static const std::string from = "69173850", to = "96713805";
                const std::size_t at = from.find(text[i]);
                if (at != std::string::npos && from[at] != to[at]) {
                    text[i] = to[at];
                    break;
                }
            }
            break;
        case Slipped::none:
        case Slipped::rows_exchanged:
        case Slipped::whole_tier:
            return {};
    }
    return text;
}

// A slip that one could notice: an angle off by two degrees or more, a length by a tenth.
bool is_gross(const CutterRow& row, const std::string& value) {
    if (value.empty()) return false;
    const double was = std::stod(row.value), is = std::stod(value);
    if (!(is > 0) || (row.kind == "inclination" && is > 90)) return false;
    return row.kind == "inclination" ? std::abs(is - was) > 2 : std::abs(std::log(is / was)) > 0.1;
}

// Rows of patterns are not single readings.
bool is_single(const CutterRow& row) {
    return row.of.empty() || row.of[0].find('*') == std::string::npos;
}

// C for C5, C1 for C1N (a side of a step).
std::string tier_of(const std::string& facet) {
    if (std::isdigit(static_cast<unsigned char>(facet.back())) == 0)
        return facet.substr(0, facet.size() - 1);
    return facet.substr(0, facet.find_last_not_of("0123456789") + 1);
}

std::vector<std::size_t> mix_up_tiers(std::vector<CutterRow>& rows, Random& random) {
    std::map<std::string, std::vector<std::size_t>> tiers;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].kind == "inclination" && is_single(rows[i]))
            tiers[tier_of(rows[i].of[0])].push_back(i);
    for (int attempt = 0; attempt < 1000; ++attempt) {
        const auto to = std::next(tiers.begin(), long(one_of(random, tiers.size()))),
                   from = std::next(tiers.begin(), long(one_of(random, tiers.size())));
        std::vector<std::string> values;
        for (std::size_t k = 0; k < to->second.size(); ++k)
            values.push_back(rows[from->second[k % from->second.size()]].value);
        const bool gross = std::equal(
            values.begin(), values.end(), to->second.begin(),
            [&](const std::string& value, std::size_t i) { return is_gross(rows[i], value); });
        if (!gross) continue;
        for (std::size_t k = 0; k < values.size(); ++k) rows[to->second[k]].value = values[k];
        return to->second;
    }
    throw std::runtime_error("no tiers for this slip");
}

}  // namespace

std::vector<std::size_t> make_slip(std::vector<CutterRow>& rows, Slipped slip, Random& random) {
    if (slip == Slipped::none) return {};
    if (slip == Slipped::whole_tier) return mix_up_tiers(rows, random);
    for (int attempt = 0; attempt < 1000; ++attempt) {
        const std::size_t at = one_of(random, rows.size());
        if (!is_single(rows[at])) continue;
        if (slip == Slipped::rows_exchanged) {
            const std::size_t other = one_of(random, rows.size());
            if (rows[at].kind != "inclination" || rows[other].kind != "inclination" ||
                !is_single(rows[other]) || !is_gross(rows[at], rows[other].value)) {
                continue;
            }
            std::swap(rows[at].value, rows[other].value);
            return {at, other};
        }
        const std::string value = slipped(rows[at], slip, rows, random);
        if (!is_gross(rows[at], value)) continue;
        rows[at].value = value;
        return {at};
    }
    throw std::runtime_error("no row for this slip");
}

const char* name_of(Slipped slip) {
    static constexpr const char* names[]{
        "none",       "digits swapped",  "decimal point",  "another first digit",
        "digit lost", "digit doubled",   "other side",     "inches",
        "grams",      "of another tier", "rows exchanged", "turned digit",
        "copied row", "whole tier"};
    return names[int(slip)];
}

}  // namespace culet::bench
