#include "fit/readings/slips.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <vector>

namespace culet {

namespace {

std::optional<double> number_of(const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace

Measured measured_by(ReadingKind kind) {
    if (is_angle(kind)) return Measured::angle;
    return kind == ReadingKind::weight ? Measured::weight : Measured::length;
}

std::optional<Slip> find_slip(double written, double wanted, double tolerance, Measured measured) {
    if (!std::isfinite(written) || !std::isfinite(wanted) || !(tolerance > 0)) return std::nullopt;
    if (std::abs(written - wanted) <= tolerance) return std::nullopt;
    // Kinds of slips, the likelier first; of one kind the nearest counts.
    std::vector<std::vector<Slip>> kinds;
    kinds.push_back({{"decimal point moved", written * 10},
                     {"decimal point moved", written / 10},
                     {"decimal point moved", written * 100},
                     {"decimal point moved", written / 100}});
    if (measured == Measured::angle) {
        kinds.push_back({{"counted from the other side", 90 - written},
                         {"counted from the other side", 180 - written},
                         {"half a turn off", written + 180},
                         {"half a turn off", written - 180},
                         {"wrong sign", -written}});
    } else if (measured == Measured::weight) {
        // 1 ct = 0.2 g
        kinds.push_back({{"grams for carats", written * 5}, {"mg for carats", written / 200}});
    } else {
        kinds.push_back({{"inches for mm", written * 25.4}, {"mm for inches", written / 25.4}});
    }
    const std::string digits = fmt::format("{:.10g}", written);
    std::vector<Slip> swapped, wrong, lost;
    if (digits.find('e') == std::string::npos) {
        const auto put = [](std::vector<Slip>& to, const char* what, const std::string& text) {
            if (const auto value = number_of(text)) to.push_back({what, *value});
        };
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < digits.size(); ++i) {
            if (digits[i] >= '0' && digits[i] <= '9') places.push_back(i);
        }
        for (std::size_t k = 0; k + 1 < places.size(); ++k) {
            std::string text = digits;
            std::swap(text[places[k]], text[places[k + 1]]);
            put(swapped, "two digits swapped", text);
        }
        for (const std::size_t at : places) {
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
    }
    kinds.push_back(std::move(swapped));
    kinds.push_back(std::move(wrong));
    kinds.push_back(std::move(lost));
    for (const std::vector<Slip>& kind : kinds) {
        const Slip* best = nullptr;
        for (const Slip& slip : kind) {
            const double off = std::abs(slip.corrected - wanted);
            if (off <= tolerance && (best == nullptr || off < std::abs(best->corrected - wanted))) {
                best = &slip;
            }
        }
        if (best != nullptr) return *best;
    }
    return std::nullopt;
}

}  // namespace culet
