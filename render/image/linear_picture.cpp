#include "render/image/linear_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <variant>

#include "render/colour/colour.h"
#include "render/image/colour_profile.h"

namespace culet {

namespace {

// White: the largest whole number, or 1 for floats.
template <class Value>
constexpr double k_white_of = std::is_integral_v<Value>
                                  ? static_cast<double>(std::numeric_limits<Value>::max())
                                  : 1;

// Linear light of a value, without primaries.
template <class Value>
class Linear {
public:
    explicit Linear(double exponent) : exponent_(exponent) {
        if constexpr (std::is_integral_v<Value>) {
            table_.resize(std::size_t{std::numeric_limits<Value>::max()} + 1);
            for (std::size_t v = 0; v < table_.size(); ++v) {
                const double part = static_cast<double>(v) / k_white_of<Value>;
                table_[v] = static_cast<float>(exponent > 0 ? std::pow(part, exponent)
                                                            : srgb_decoded(part));
            }
        }
    }
    float operator()(Value value) const {
        if constexpr (std::is_integral_v<Value>)
            return table_[value];
        else
            return exponent_ > 0 ? std::copysign(std::pow(std::abs(value), float(exponent_)), value)
                                 : value;
    }

private:
    double exponent_;
    std::vector<float> table_;
};

template <class Value>
std::vector<float> coverage_of(const std::vector<Value>& samples) {
    std::vector<float> coverage(samples.size() / 4);
    for (std::size_t p = 0; p < coverage.size(); ++p)
        coverage[p] =
            static_cast<float>(static_cast<double>(samples[4 * p + 3]) / k_white_of<Value>);
    return coverage;
}

// Undoes premultiplication by alpha, within the precision of whole numbers.
template <class Value>
void divide_by_alpha(std::vector<Value>& samples) {
    if constexpr (std::is_integral_v<Value>) {
        constexpr std::uint64_t k_white = std::numeric_limits<Value>::max();
        for (std::size_t i = 0; i + 3 < samples.size(); i += 4) {
            const std::uint64_t alpha = samples[i + 3];
            for (std::size_t c = 0; c < 3 && alpha > 0; ++c)
                samples[i + c] = static_cast<Value>(
                    std::min(k_white, (samples[i + c] * k_white + alpha / 2) / alpha));
        }
    }
}

template <class Value>
void take_pixels(const std::vector<Value>& samples, std::size_t channels,
                 const SampleMeaning& meaning, std::vector<float>& rgb) {
    const Linear<Value> linear(meaning.exponent);
    const Value* v = samples.data();
    for (std::size_t i = 0; i < rgb.size(); i += 3, v += channels) {
        for (std::size_t c = 0; c < 3; ++c)
            rgb[i + c] = meaning.factor[c] * linear(v[channels < 3 ? 0 : c]);
    }
}

// Inks without a profile: white times the transmission of two filters, in the sRGB encoding.
template <class Value>
void take_inks(const std::vector<Value>& samples, std::vector<float>& rgb) {
    for (std::size_t i = 0; i < rgb.size(); ++i) {
        const Value* const inks = samples.data() + i / 3 * 4;
        const auto left = [](Value ink) {
            return 1 - static_cast<double>(ink) / k_white_of<Value>;
        };
        rgb[i] = static_cast<float>(srgb_decoded(left(inks[i % 3]) * left(inks[3])));
    }
}

// Contribution of each value of each channel to the light. A profile of curves and a matrix is the
// sum over its channels, and tables are far faster than the library. Other profiles are not
// `exact`.
template <class Value>
class ProfileTables {
public:
    ProfileTables(const ColourProfile& profile, std::size_t colours) : colours_(colours) {
        std::vector<float> alone(colours * k_levels * colours);
        for (std::size_t i = 0; i < colours * k_levels; ++i) {
            const std::size_t level = i % k_levels;
            alone[i * colours + i / k_levels] =
                static_cast<float>(static_cast<double>(level) / k_white_of<Value>);
        }
        table_.resize(3 * colours * k_levels);
        profile.linear(alone.data(), colours * k_levels, table_.data());
        const std::array<float, 3> black{table_[0], table_[1], table_[2]};
        for (std::size_t i = 3 * k_levels; i < table_.size(); ++i) table_[i] -= black[i % 3];
        // Check against the library at colours of all channels.
        for (std::size_t probe = 0; probe < 125 && exact_; ++probe) {
            const std::array<std::size_t, 3> fifths{probe % 5, probe / 5 % 5, probe / 25};
            std::array<Value, 3> values{};
            std::array<float, 3> parts{}, ours{}, theirs{};
            for (std::size_t c = 0; c < 3; ++c) {
                values[c] = static_cast<Value>(fifths[c] * (k_levels - 1) / 4);
                parts[c] = static_cast<float>(static_cast<double>(values[c]) / k_white_of<Value>);
            }
            take(values.data(), ours.data());
            profile.linear(parts.data(), 1, theirs.data());
            for (std::size_t c = 0; c < 3; ++c)
                exact_ = exact_ && std::abs(ours[c] - theirs[c]) <= 1e-5f;
        }
    }
    bool exact() const { return exact_; }
    void take(const Value* values, float* rgb) const {
        const float* const first = &table_[3 * std::size_t{values[0]}];
        for (std::size_t k = 0; k < 3; ++k) rgb[k] = first[k];
        for (std::size_t c = 1; c < colours_; ++c) {
            const float* const more = &table_[3 * (c * k_levels + values[c])];
            for (std::size_t k = 0; k < 3; ++k) rgb[k] += more[k];
        }
    }

private:
    static constexpr std::size_t k_levels = std::size_t{std::numeric_limits<Value>::max()} + 1;
    std::size_t colours_;
    std::vector<float> table_;
    bool exact_ = true;
};

template <class Value>
void take_by_profile(const std::vector<Value>& samples, std::size_t channels, std::size_t colours,
                     const ColourProfile& profile, std::vector<float>& rgb) {
    const std::size_t pixels = rgb.size() / 3;
    if constexpr (std::is_integral_v<Value>) {
        if (colours <= 3) {
            const ProfileTables<Value> tables(profile, colours);
            for (std::size_t i = 0; i < pixels && tables.exact(); ++i)
                tables.take(samples.data() + i * channels, rgb.data() + 3 * i);
            if (tables.exact()) return;
        }
    }
    constexpr std::size_t k_at_once = 4096;
    std::vector<float> values(k_at_once * colours);
    for (std::size_t start = 0; start < pixels; start += k_at_once) {
        const std::size_t count = std::min(k_at_once, pixels - start);
        for (std::size_t i = 0; i < count * colours; ++i) {
            const Value v = samples[(start + i / colours) * channels + i % colours];
            values[i] = static_cast<float>(static_cast<double>(v) / k_white_of<Value>);
        }
        profile.linear(values.data(), count, rgb.data() + 3 * start);
    }
}

// Returns the profile to apply; nothing if there is none, it is sRGB's, or it does not fit (which
// is noted).
std::optional<ColourProfile> profile_for(SampleMeaning& meaning, std::size_t colours, bool whole) {
    if (meaning.profile.empty()) return std::nullopt;
    ColourProfile profile(meaning.profile, colours);
    if (!profile.trouble().empty()) {
        meaning.notes.push_back(fmt::format("{}: its colours are taken as {}", profile.trouble(),
                                            whole ? "sRGB" : "linear sRGB"));
        if (meaning.not_photometric.empty()) meaning.not_photometric = profile.trouble();
        return std::nullopt;
    }
    // The profile alone decodes the values.
    meaning.exponent = 0;
    meaning.primaries = k_srgb_primaries;
    if (whole && profile.is_srgb()) {
        meaning.colours = "sRGB";
        return std::nullopt;
    }
    meaning.colours = profile.name();
    return profile;
}

}  // namespace

void note_pixel_aspect(double aspect, std::vector<std::string>& notes) {
    if (!std::isfinite(aspect) || !(aspect > 0) || std::abs(aspect - 1) < 0.005) return;
    notes.push_back(fmt::format(
        "it says that a pixel is {:.4g} times as wide as high; its pixels are taken as square",
        aspect));
}

ReadPicture linear_picture(DecodedPixels pixels, const std::string& format) {
    ReadPicture read;
    SampleMeaning& meaning = pixels.meaning;
    Picture& picture = read.picture;
    picture.width = pixels.width;
    picture.height = pixels.height;
    picture.rgb.resize(3 * picture.pixels());
    const auto channels = static_cast<std::size_t>(pixels.channels);
    read.had_alpha = channels == 4 && !meaning.inks;
    read.was_encoded = !std::holds_alternative<std::vector<float>>(pixels.samples);
    read.white = read.was_encoded ? 1.0f : 0.0f;
    const std::size_t colours = meaning.grey ? 1 : read.had_alpha ? 3 : channels;
    const auto profile = profile_for(meaning, colours, read.was_encoded);
    std::visit(
        [&](auto& samples) {
            if (read.had_alpha) picture.coverage = coverage_of(samples);
            if (read.had_alpha && meaning.multiplied) divide_by_alpha(samples);
            if (profile)
                take_by_profile(samples, channels, colours, *profile, picture.rgb);
            else if (meaning.inks)
                take_inks(samples, picture.rgb);
            else
                take_pixels(samples, channels, meaning, picture.rgb);
        },
        pixels.samples);
    if (meaning.inks && !profile) {
        meaning.colours = "CMYK";
        if (meaning.not_photometric.empty())
            meaning.not_photometric = "its inks (CMYK) have no profile that says their colours";
    }
    turn_to_srgb(meaning.primaries, picture.rgb, meaning.notes);
    note_pixel_aspect(meaning.pixel_aspect, meaning.notes);
    read.encoding = std::holds_alternative<std::vector<std::uint8_t>>(pixels.samples)
                        ? "8-bit " + meaning.colours
                    : std::holds_alternative<std::vector<std::uint16_t>>(pixels.samples)
                        ? "16-bit " + meaning.colours
                        : "linear " + format;
    read.notes = std::move(meaning.notes);
    read.not_photometric = std::move(meaning.not_photometric);
    return read;
}

}  // namespace culet
