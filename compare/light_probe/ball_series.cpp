#include "compare/light_probe/ball_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stone/text/errors.h"

namespace culet {

namespace {

bool alike(double a, double b) {
    return std::abs(std::log2(a / b)) < 0.02;
}

}  // namespace

std::vector<std::vector<std::size_t>> views_of(const std::vector<SortedShot>& shots) {
    std::vector<std::vector<std::size_t>> views;
    const bool none = std::none_of(shots.begin(), shots.end(),
                                   [](const SortedShot& s) { return s.exposure.has_value(); });
    const bool all = std::all_of(shots.begin(), shots.end(),
                                 [](const SortedShot& s) { return s.exposure.has_value(); });
    if (!none && !all) {
        for (const SortedShot& shot : shots) {
            if (!shot.exposure) {
                throw InputError(shot.file,
                                 "says no exposure time, and others do: give one for each with "
                                 "--exposure, or name the views with --view");
            }
        }
    }
    if (none) {
        if (shots.size() > 2) {
            throw InputError(fmt::format(
                "{} photographs without exposure times in their EXIF data: say which belong to "
                "one view with --view FILE FILE... --view FILE FILE... and give --exposure",
                shots.size()));
        }
        for (std::size_t i = 0; i < shots.size(); ++i) views.push_back({i});
        return views;
    }
    for (std::size_t i = 0; i < shots.size(); ++i) {
        const bool again =
            !views.empty() &&
            std::any_of(views.back().begin(), views.back().end(), [&](std::size_t k) {
                return alike(*shots[k].exposure, *shots[i].exposure);
            });
        if (views.empty() || again) views.emplace_back();
        views.back().push_back(i);
    }
    return views;
}

namespace {

/// The shots of all views, and which belong to each.
struct GroupedShots {
    std::vector<SortedShot> shots;
    std::vector<std::vector<std::size_t>> views;
};

GroupedShots grouped(const BallSeries& series) {
    std::vector<std::filesystem::path> files = series.files;
    GroupedShots result;
    for (const auto& view : series.views) {
        result.views.emplace_back();
        for (const auto& file : view) {
            result.views.back().push_back(files.size());
            files.push_back(file);
        }
    }
    if (!series.views.empty() && !series.files.empty())
        throw InputError("name the photographs either plainly or after --view, not both");
    if (files.empty()) throw InputError("name the photographs of the ball");
    if (!series.exposures.empty() && series.exposures.size() != files.size()) {
        throw InputError(
            fmt::format("--exposure has {} values for {} photographs: one for each, in "
                        "the order of the files",
                        series.exposures.size(), files.size()));
    }
    for (std::size_t i = 0; i < files.size(); ++i) {
        result.shots.push_back({files[i], series.exposures.empty()
                                              ? exposure_of(read_shot_data(files[i]))
                                              : std::optional<double>(series.exposures[i])});
    }
    if (result.views.empty()) result.views = views_of(result.shots);
    return result;
}

std::vector<BracketShot> bracket_of(const GroupedShots& all, std::size_t view) {
    const std::vector<std::size_t>& group = all.views[view];
    std::vector<BracketShot> bracket;
    for (const std::size_t i : group) {
        const SortedShot& shot = all.shots[i];
        if (!shot.exposure && group.size() > 1) {
            throw InputError(shot.file,
                             "says no exposure time: give one for each photograph with "
                             "--exposure 1/10,1/40,...");
        }
        bracket.push_back({shot.file.string(), shot.exposure.value_or(1.0),
                           [file = shot.file] { return read_photo(file); }});
    }
    return bracket;
}

ProbeView view_of(Photo photo, const std::string& name, const std::optional<Lens>& given) {
    ProbeView view;
    view.name = name;
    view.photo = std::move(photo);
    view.focal_px = focal_px_of(view.photo.shot, std::hypot(view.photo.width, view.photo.height));
    if (given) {
        const Lens lens = lens_for(*given, view.photo.width, view.photo.height, view.name);
        undistort(view.photo, lens);
        view.focal_px = (lens.focal_x + lens.focal_y) / 2;
        view.principal = PixelPlace{lens.principal_x, lens.principal_y};
    }
    return view;
}

}  // namespace

ReadSeries read_ball_series(const BallSeries& series, const Progress& progress) {
    const GroupedShots all = grouped(series);
    const std::size_t views = all.views.size();
    ReadSeries result;
    double first_exposure = 0;
    for (std::size_t g = 0; g < views; ++g) {
        const Progress view_progress = [&](double part) {
            return !progress ||
                   progress((static_cast<double>(g) + part) / static_cast<double>(views));
        };
        const std::vector<BracketShot> bracket = bracket_of(all, g);
        const double exposure = bracket[0].exposure;
        if (g == 0) first_exposure = exposure;
        const std::string& name = bracket[0].name;
        Bracket merged = merge_bracket(bracket, {}, view_progress);
        // Convert to units of the very first shot.
        if (all.shots[all.views[g][0]].exposure && first_exposure > 0) {
            const auto scale = static_cast<float>(first_exposure / exposure);
            for (float& v : merged.photo.rgb) v *= scale;
            for (float& v : merged.photo.variance) v *= scale * scale;
            merged.photo.saturation = 0;
        }
        for (const std::string& note : merged.notes)
            result.notes.push_back(fmt::format("{}: {}", name, note));
        if (!merged.photo.photometric) {
            result.notes.push_back(fmt::format("{}: {}: the light depends on that curve", name,
                                               merged.photo.not_photometric));
        }
        result.views.push_back(view_of(std::move(merged.photo), name, series.lens));
    }
    return result;
}

}  // namespace culet
