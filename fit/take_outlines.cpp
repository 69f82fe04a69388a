#include "fit/take_outlines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "fit/readings/seen_lines.h"
#include "fit/silhouettes/silhouette_fit.h"
#include "fit/uncertainty/statistics.h"
#include "stone/text/errors.h"
#include "stone/upright.h"

namespace culet {

namespace {

bool is_corner_name(const std::string& name) {
    return name.size() > 1 && name[0] == 'v' &&
           std::all_of(name.begin() + 1, name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

void refuse_corners(const Stone& mesh, const std::vector<WrittenReading>& written) {
    for (const WrittenReading& w : written) {
        if (w.kind != name_of(ReadingKind::distance)) continue;
        for (const std::string& name : w.of) {
            if (!is_corner_name(name) || find_facet(mesh.solid, name) >= 0) continue;
            throw InputError(
                w.file, w.line,
                fmt::format("{} is a corner of the mesh, which outlines move and part: "
                            "beside [[silhouette]] a distance is of facets and edges",
                            name));
        }
    }
}

std::string sigma_note(const Reading& reading, const OutlineObservations& observed,
                       const Stone& stone) {
    const auto set = std::size_t(reading.outline_set);
    return fmt::format(
        "{}: no sigma was given; {:.2g} {} was estimated from how the outlines "
        "scatter about the stone",
        reading.id, observed.sigmas[set], name_of(stone.unit));
}

std::string words_of(const std::string& id, const SilhouetteFinding& finding,
                     std::string_view unit) {
    const SilhouetteMisfit& misfit = finding.misfit;
    std::string words = fmt::format(
        "{}: {} points of {} outline{} lie {:.2g} {} (root mean square) from the stone's", id,
        misfit.points, misfit.contours, misfit.contours == 1 ? "" : "s", misfit.rms, unit);
    if (finding.held_out) {
        words += fmt::format(", those of the {} held out {:.2g} {}", finding.held_out->contours,
                             finding.held_out->rms, unit);
    }
    if (misfit.outliers > 0) {
        words += fmt::format("; {} {} left out as dust or the holder", misfit.outliers,
                             misfit.outliers == 1 ? "is" : "are");
    }
    return words;
}

void judge_outlines(const OutlineObservations& observed, FitResult& result) {
    if (!(observed.dof > 0)) return;
    const double limit = chi2_quantile(result.log.options.significance, observed.dof);
    if (observed.chi2 <= limit) return;
    const std::string what = fmt::format(
        "the outlines lie {:.1f} times as far from any stone with these facets as their sigma says "
        "(leave sigma out to have it estimated)",
        std::sqrt(observed.chi2 / observed.dof));
    if (result.status == FitStatus::converged || result.status == FitStatus::undetermined) {
        result.status = FitStatus::contradictory;
        result.message = what + "; " + result.message;
    } else {
        result.message += "; " + what;
    }
}

}  // namespace

std::vector<WrittenReading> turned_with_mesh(const Vec3& file_up,
                                             std::vector<WrittenReading> written) {
    if (file_up == Vec3{0, 0, 1}) return written;
    const glm::dmat3 turn = turn_upright(file_up);
    for (WrittenReading& reading : written) {
        if (reading.seen_line) {
            auto line = std::make_shared<SeenLine>(*reading.seen_line);
            line->projection = line->projection * glm::dmat4(glm::transpose(turn));
            reading.seen_line = std::move(line);
        }
        if (!reading.outlines || reading.outlines->is_free) continue;
        auto set = std::make_shared<SilhouetteSet>(*reading.outlines);
        for (std::vector<Contour>* contours : {&set->contours, &set->held_out}) {
            for (Contour& contour : *contours) {
                contour.direction = turn * contour.direction;
                for (Vec3& point : contour.points) point = turn * point;
            }
        }
        reading.outlines = std::move(set);
    }
    return written;
}

TakenOutlines take_outlines(const Stone& mesh, const std::vector<WrittenReading>& written) {
    TakenOutlines taken;
    std::vector<std::shared_ptr<const SilhouetteSet>> sets;
    for (const WrittenReading& w : written) {
        if (!w.outlines) continue;
        Reading reading;
        reading.id = w.id.empty() ? fmt::format("silhouette{}", sets.size()) : w.id;
        reading.kind = ReadingKind::silhouette;
        reading.note = w.note;
        reading.file = w.file;
        reading.line = w.line;
        reading.outlines = w.outlines;
        reading.outline_set = int(sets.size());
        sets.push_back(w.outlines);
        taken.readings.push_back(std::move(reading));
    }
    if (sets.empty()) return taken;
    refuse_corners(mesh, written);
    SilhouetteFit fit = [&] {
        try {
            return fit_silhouettes(mesh, sets);
        } catch (const InputError& error) {
            throw InputError(taken.readings[0].file, taken.readings[0].line, error.what());
        }
    }();
    taken.notes = std::move(fit.notes);
    for (Reading& reading : taken.readings) {
        reading.outline_observations = fit.observations;
        const auto set = std::size_t(reading.outline_set);
        reading.sigma = fit.observations->sigmas[set];
        if (fit.observations->estimated[set]) {
            taken.notes.push_back(sigma_note(reading, *fit.observations, mesh));
        }
        if (reading.outlines->parts_left_out > 0) {
            taken.notes.push_back(
                fmt::format("{}: {} sides of outlines that the file calls not "
                            "measured are left out",
                            reading.id, reading.outlines->parts_left_out));
        }
    }
    taken.stone = std::move(fit.stone);
    return taken;
}

void add_outlines(TakenOutlines taken, std::vector<Reading>& readings,
                  std::vector<std::string>& notes) {
    for (Reading& reading : taken.readings) {
        for (const Reading& other : readings) {
            if (other.id != reading.id) continue;
            throw InputError(reading.file, reading.line,
                             fmt::format("the id '{}' is taken by another reading", reading.id));
        }
        readings.push_back(std::move(reading));
    }
    for (std::string& note : taken.notes) notes.push_back(std::move(note));
}

bool has_outlines(const std::vector<Reading>& readings) {
    return std::any_of(readings.begin(), readings.end(),
                       [](const Reading& r) { return r.outline_observations != nullptr; });
}

bool has_photographs(const std::vector<Reading>& readings) {
    return std::any_of(readings.begin(), readings.end(),
                       [](const Reading& r) { return r.photograph != nullptr; });
}

FitOptions with_free_corners(const Stone& stone, FitOptions options) {
    options.meets = MeetTreatment::released;
    options.free_corners = true;
    if (!options.start) options.start = stone.solid;
    return options;
}

void prepare_for_outlines(const Stone& stone, FitOptions& options) {
    if (options.meets_named && options.meets != MeetTreatment::released) {
        throw InputError(
            "outlines fix each plane, so meets cannot be forced: with [[silhouette]], make [fit] "
            "meets \"released\" or leave it out");
    }
    options = with_free_corners(stone, options);
}

void describe_outlines(const std::vector<Reading>& readings, FitResult& result) {
    const OutlineObservations* observed = nullptr;
    for (const Reading& reading : readings) {
        if (!reading.outline_observations) continue;
        observed = reading.outline_observations.get();
        const auto set = std::size_t(reading.outline_set);
        const auto fitted =
            std::find_if(result.readings.begin(), result.readings.end(),
                         [&](const FittedReading& r) { return r.id == reading.id; });
        if (fitted == result.readings.end()) continue;
        const SilhouetteSet& outlines = *reading.outlines;
        SilhouetteFinding finding;
        finding.misfit = silhouette_misfit(result.solid, outlines.contours, outlines.contours,
                                           observed->motions[set]);
        finding.sigma = observed->sigmas[set];
        finding.estimated = observed->estimated[set];
        if (!outlines.held_out.empty()) {
            finding.held_out = silhouette_misfit(result.solid, outlines.contours, outlines.held_out,
                                                 observed->motions[set]);
        }
        result.log.notes.push_back(words_of(reading.id, finding, name_of(result.unit)));
        fitted->silhouette = finding;
    }
    if (observed != nullptr) judge_outlines(*observed, result);
}

}  // namespace culet
