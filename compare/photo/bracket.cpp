#include "compare/photo/bracket.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <set>

#include "compare/photo/exposure_sum.h"
#include "compare/photo/response.h"
#include "compare/photo/shot_alignment.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr std::size_t k_shots_for_response = 5;
constexpr double k_least_shift = 0.1;        // pixels; smaller shifts are not worth the blur
constexpr double k_pixels_to_align = 2e6;    // enough to see 0.1 pixels of a large photo
constexpr double k_pixels_to_measure = 1e5;  // for the response and the ratios of light
constexpr double k_kept_bytes = 512.0 * 1024 * 1024;

void check_exposures(const std::vector<BracketShot>& shots) {
    if (shots.empty()) throw InputError("no photograph was given");
    for (std::size_t i = 0; i < shots.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (std::abs(std::log2(shots[i].exposure / shots[k].exposure)) < 0.02) {
                throw InputError(
                    std::filesystem::path(shots[i].name),
                    fmt::format("has the same exposure as {}: leave one of them out, or say "
                                "the exposures with --exposure",
                                shots[k].name));
            }
        }
    }
}

std::vector<std::size_t> from_bright_to_dark(const std::vector<BracketShot>& shots) {
    std::vector<std::size_t> order(shots.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return shots[a].exposure > shots[b].exposure; });
    return order;
}

// Processes a series in two passes: shifts and response, then the sum. Both go from the brightest
// shot to the darkest, because neighbours share the most.
class Series {
public:
    Series(const std::vector<BracketShot>& shots, const BracketOptions& options,
           const Progress& progress)
        : shots_(shots),
          options_(options),
          progress_(progress),
          order_(from_bright_to_dark(shots)),
          kept_(shots.size()),
          samples_(shots.size()) {
        result_.shifts.resize(shots.size());
    }

    Bracket merged() {
        look();
        if (options_.align) tell_shifts();
        find_curve();
        add_up();
        tell_photometric();
        return std::move(result_);
    }

private:
    void report(double done) const {
        if (progress_ && !progress_(done)) throw Interrupted();
    }

    Photo read(std::size_t shot) {
        if (kept_[shot]) {
            Photo photo = std::move(*kept_[shot]);
            kept_[shot].reset();
            return photo;
        }
        Photo photo = shots_[shot].read();
        check(photo, shots_[shot].name);
        return photo;
    }

    void check(const Photo& photo, const std::filesystem::path& file) {
        if (photo.not_finite > 0) {
            throw InputError(
                file, fmt::format("{} samples are not numbers (NaN or infinite): export it again",
                                  photo.not_finite));
        }
        const std::string size = fmt::format("{} x {} pixels", photo.width, photo.height);
        if (size_.empty()) {
            size_ = size;
            size_of_ = file.string();
        }
        if (size != size_) {
            throw InputError(file, fmt::format("is {}, {} is {}: the shots of a series are of one "
                                               "size",
                                               size, size_of_, size_));
        }
        const bool black =
            std::all_of(photo.rgb.begin(), photo.rgb.end(), [](float v) { return v <= 0; });
        if (black) throw InputError(file, "is black all over: nothing was exposed");
    }

    void look() {
        Photo before;
        double kept = 0;
        for (std::size_t k = 0; k < order_.size(); ++k) {
            report(0.5 * static_cast<double>(k) / static_cast<double>(order_.size()));
            const std::size_t shot = order_[k];
            Photo photo = read(shot);
            samples_[shot] = thinned(photo, factor_to(photo, k_pixels_to_measure));
            for (const std::string& note : photo.notes) {
                if (told_.insert(note).second)
                    result_.notes.push_back(fmt::format("{}: {}", shots_[shot].name, note));
            }
            if (options_.align) align(k, photo, before);
            const double bytes = static_cast<double>(photo.rgb.size()) * sizeof(float);
            if (kept + bytes > k_kept_bytes && shots_.size() > 1) continue;
            kept += bytes;
            kept_[shot] = std::move(photo);
        }
    }

    void align(std::size_t k, const Photo& photo, Photo& before) {
        Photo small = reduced(photo, factor_to(photo, k_pixels_to_align));
        if (k > 0) {
            const std::size_t shot = order_[k], last = order_[k - 1];
            const FrameShift step =
                shift_between(before, shots_[last].exposure, small, shots_[shot].exposure);
            const FrameShift& there = result_.shifts[last];
            result_.shifts[shot] = {there.x + step.x * photo.width / small.width,
                                    there.y + step.y * photo.height / small.height};
        }
        before = std::move(small);
    }

    // Against the first shot, whose frame the picture keeps.
    void tell_shifts() {
        const FrameShift zero = result_.shifts[0];
        double most = 0;
        for (FrameShift& shift : result_.shifts) {
            shift = {shift.x - zero.x, shift.y - zero.y};
            most = std::max(most, std::hypot(shift.x, shift.y));
        }
        if (most > k_least_shift) {
            result_.notes.push_back(fmt::format(
                "the camera or the scene moved by up to {:.1f} pixels between shots; corrected",
                most));
        }
    }

    bool all_are(const std::function<bool(const Photo&)>& so) const {
        return std::all_of(samples_.begin(), samples_.end(), so);
    }
    bool eight_bits() const {
        return all_are([](const Photo& p) { return p.encoding.starts_with("8-bit"); });
    }
    bool eight_bits_srgb() const {
        return all_are([](const Photo& p) { return p.encoding.starts_with("8-bit sRGB"); });
    }

    void find_curve() {
        const bool jpegs = all_are([](const Photo& p) { return p.encoding == "8-bit sRGB JPEG"; });
        result_.response = options_.response.value_or(jpegs && shots_.size() >= k_shots_for_response
                                                          ? Response::calibrated
                                                          : Response::as_read);
        if (result_.response == Response::as_read) {
            const bool profiled =
                !jpegs && all_are([](const Photo& p) { return p.encoding.ends_with("JPEG"); });
            if (profiled) {
                result_.notes.push_back(
                    "the camera's tone curve is taken as that of the files' profile: five or more "
                    "exposures in sRGB would tell it");
            }
            if (jpegs) {
                result_.notes.push_back(
                    "the camera's tone curve is taken as sRGB: five or more exposures would tell "
                    "it");
            }
            return;
        }
        if (!eight_bits_srgb() || shots_.size() < 3) {
            throw InputError(
                "a camera's response is found from at least three (better five) 8-bit "
                "files in sRGB, of different exposure");
        }
        std::vector<double> exposures;
        for (const BracketShot& shot : shots_) exposures.push_back(shot.exposure);
        result_.curve = find_response(samples_, exposures);
        result_.notes.push_back(
            fmt::format("the camera's response was found from the {} shots", shots_.size()));
    }

    void add_up() {
        Photo& merged = result_.photo;
        std::optional<ExposureSum> sum;
        Photo before;
        const bool eight = eight_bits();
        for (std::size_t k = 0; k < order_.size(); ++k) {
            report(0.5 + 0.5 * static_cast<double>(k) / static_cast<double>(order_.size()));
            const std::size_t shot = order_[k];
            Photo photo = read(shot);
            if (result_.curve) apply_response(*result_.curve, photo);
            const FrameShift& shift = result_.shifts[shot];
            if (std::hypot(shift.x, shift.y) > k_least_shift) move_back(photo, shift);
            Photo sample = thinned(photo, factor_to(photo, k_pixels_to_measure));
            if (k > 0) compare_light(order_[k - 1], before, shot, sample);
            before = std::move(sample);
            if (!sum) sum.emplace(photo.rgb.size() / 3);
            sum->add(photo, relative_exposure(shot), ShotNoise(photo.saturation, eight),
                     k + 1 == order_.size());
            merged.width = photo.width;
            merged.height = photo.height;
        }
        const std::size_t over = sum->take(relative_exposure(0), merged);
        if (over > 0) {
            result_.notes.push_back(fmt::format(
                "{:.2f} % of the pixels are over-exposed even in {}",
                300.0 * static_cast<double>(over) / static_cast<double>(merged.rgb.size()),
                shots_[order_.back()].name));
        }
        report(1);
    }

    // Relative to the brightest, so that powers of any stated exposures stay within a float's
    // range.
    double relative_exposure(std::size_t shot) const {
        return shots_[shot].exposure / shots_[order_.front()].exposure;
    }

    void compare_light(std::size_t bright, const Photo& of_bright, std::size_t dark,
                       const Photo& of_dark) {
        const double stated = shots_[bright].exposure / shots_[dark].exposure;
        const double seen = light_ratio(of_bright, of_dark);
        const double ratio = seen > 0 ? seen / stated : 1;
        result_.exposure_ratios.push_back(ratio);
        if (std::abs(std::log2(ratio)) > 0.15) {
            result_.notes.push_back(fmt::format(
                "{} to {}: by the pictures, the ratio of exposures is {:.2f} times the stated one",
                shots_[bright].name, shots_[dark].name, ratio));
        }
    }

    // JPEGs become photometric only by a calibrated response.
    void tell_photometric() {
        Photo& merged = result_.photo;
        merged.shot = samples_[0].shot;
        merged.encoding = shots_.size() == 1 ? samples_[0].encoding
                                             : fmt::format("{} exposures merged", shots_.size());
        merged.photometric = (result_.response == Response::calibrated ||
                              all_are([](const Photo& p) { return p.photometric; })) &&
                             all_are([](const Photo& p) { return p.shot.processed.empty(); });
        if (merged.photometric) return;
        for (const Photo& sample : samples_) {
            if (merged.not_photometric.empty()) merged.not_photometric = sample.not_photometric;
        }
    }

    const std::vector<BracketShot>& shots_;
    const BracketOptions& options_;
    const Progress& progress_;
    std::vector<std::size_t> order_;          // of the shots, from the brightest to the darkest
    std::vector<std::optional<Photo>> kept_;  // for each shot, between the two passes
    std::vector<Photo> samples_;  // for each shot: some of its pixels, and its other data
    std::set<std::string> told_;  // the shots' notes, each once
    std::string size_, size_of_;  // of the first shot read, and its name
    Bracket result_;
};

}  // namespace

Bracket merge_bracket(const std::vector<BracketShot>& shots, const BracketOptions& options,
                      const Progress& progress) {
    check_exposures(shots);
    return Series(shots, options, progress).merged();
}

}  // namespace culet
