#include "fit/readings/slips.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace culet {

namespace {

// Frequencies: of wrongly copied numbers, 79 in 100 have one wrong digit and 10 two swapped
// neighbours (Verhoeff 1969, Error Detecting Decimal Codes). He counted numbers of fixed length;
// the other kinds together count like those that he could not class.
constexpr double k_wrong = 0.79, k_swapped = 0.10, k_other = 0.025;

std::optional<double> number_of(const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

// Slips of one kind share its frequency.
void add(std::vector<Slip> kind, double frequency, bool telling, std::vector<Slip>& all) {
    for (Slip& slip : kind) {
        slip.weight = frequency / double(kind.size());
        slip.telling = telling;
        all.push_back(std::move(slip));
    }
}

void add_of_units(double written, Measured measured, std::vector<Slip>& all) {
    add({{"decimal point moved", written * 10},
         {"decimal point moved", written / 10},
         {"decimal point moved", written * 100},
         {"decimal point moved", written / 100}},
        k_other, true, all);
    if (measured == Measured::angle) {
        add({{"counted from the other side", 90 - written},
             {"counted from the other side", 180 - written},
             {"half a turn off", written + 180},
             {"half a turn off", written - 180},
             {"wrong sign", -written}},
            k_other, true, all);
    } else if (measured == Measured::weight) {
        // 1 ct = 0.2 g
        add({{"grams for carats", written * 5}, {"mg for carats", written / 200}}, k_other, true,
            all);
    } else {
        add({{"inches for mm", written * 25.4}, {"mm for inches", written / 25.4}}, k_other, true,
            all);
    }
}

void add_of_digits(double written, Measured measured, std::vector<Slip>& all) {
    std::string digits = fmt::format("{:.10g}", written);
    if (digits.find('e') != std::string::npos) return;
    std::vector<Slip> swapped, wrong, lost;
    const auto put = [](std::vector<Slip>& to, const char* what, const std::string& text) {
        if (const auto value = number_of(text)) to.push_back({what, *value});
    };
    const auto places_in = [](const std::string& text) {
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < text.size(); ++i) {
            if (text[i] >= '0' && text[i] <= '9') places.push_back(i);
        }
        return places;
    };
    for (const std::size_t at : places_in(digits)) {
        for (char d = '0'; d <= '9'; ++d) {
            std::string text = digits;
            text[at] = d;
            put(wrong, "one digit wrong", text);
            text = digits;
            text.insert(at, 1, d);
            put(lost, "one digit lost", text);
        }
        std::string text = digits;
        text.erase(at, 1);
        put(lost, "one digit too many", text);
    }
    // 30.3 with two digits swapped is 03.3, which arrives as 3.3.
    if (measured == Measured::angle && written >= 0 && written < 10) digits.insert(0, 1, '0');
    const std::vector<std::size_t> places = places_in(digits);
    for (std::size_t k = 0; k + 1 < places.size(); ++k) {
        std::string text = digits;
        std::swap(text[places[k]], text[places[k + 1]]);
        put(swapped, "two digits swapped", text);
    }
    add(std::move(swapped), k_swapped, true, all);
    add(std::move(wrong), k_wrong, false, all);
    add(std::move(lost), k_other, false, all);
}

}  // namespace

Measured measured_by(ReadingKind kind) {
    if (is_angle(kind)) return Measured::angle;
    return kind == ReadingKind::weight ? Measured::weight : Measured::length;
}

std::vector<Slip> find_slips(double written, const Meant& meant, Measured measured) {
    if (!std::isfinite(written) || !std::isfinite(meant.value) || !(meant.sigma > 0)) return {};
    if (std::abs(written - meant.value) <= meant.within) return {};
    std::vector<Slip> all;
    add_of_units(written, measured, all);
    add_of_digits(written, measured, all);
    std::vector<Slip> found;
    for (Slip& slip : all) {
        const double off = slip.corrected - meant.value;
        if (!(std::abs(off) <= meant.within)) continue;
        slip.weight *= std::exp(-0.5 * off * off / (meant.sigma * meant.sigma));
        found.push_back(std::move(slip));
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Slip& a, const Slip& b) { return a.weight > b.weight; });
    return found;
}

std::optional<Slip> find_slip(double written, const Meant& meant, Measured measured) {
    std::vector<Slip> found = find_slips(written, meant, measured);
    if (found.empty()) return std::nullopt;
    return std::move(found.front());
}

}  // namespace culet
