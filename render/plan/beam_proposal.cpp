#include "render/plan/beam_proposal.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/plan/planner.h"
#include "render/plan/price.h"

namespace culet {

namespace {

// Measured on brilliants, steps, ovals, princesses and trillions of diamond, spinel, garnet and
// glass under four lights, 64, 200 and 400 pixels across: previews were off by 0.1 to 1 times
// (a stone: median 0.3) the faces met over the root of the stone's pixels, beams of tolerance 0.1
// by a fourth of that, and of others in proportion to the root of it.
constexpr double k_preview_borders = 0.35, k_beam_borders = 0.25, k_coarse = 0.1;
constexpr std::array k_tolerances{0.1, 0.03, 0.01, 0.003, 0.001, 0.0003, 0.0001, 0.00003};
// A preview's share of the price of the coarsest beams.
constexpr double k_preview_price = 0.45;
// Pictures say how wrong a guess was, but a single one is no law.
constexpr double k_least_guess = 0.2, k_most_guess = 8;

}  // namespace

void ProposedBeams::apply_to(RenderSettings& settings) const {
    settings.engine = preview ? "preview" : "beams";
    settings.tolerance = tolerance;
    settings.cut_weight = cut.weight;
    if (wavelengths.count > 0) settings.wavelengths_nm = even_wavelengths(wavelengths.count);
}

double BeamProposal::borders_of(bool preview, double tolerance) const {
    const double coarsest = k_preview_borders * events_per_ray / std::sqrt(std::max(pixels, 1.0));
    return guess_ * coarsest * (preview ? 1 : k_beam_borders * std::sqrt(tolerance / k_coarse));
}

double BeamProposal::price_of(const ProposedBeams& beams) const {
    const int count = beams.wavelengths.count;
    BeamWork work;
    work.pixels = pixels;
    work.views = views;
    work.bands = count == 0 ? bands : dispersed ? count : 1;
    work.nodes = count > 0 && !dispersed ? count : 1;
    work.events_per_ray = events_per_ray;
    work.tolerance = beams.preview ? k_coarse : beams.tolerance;
    work.cut = beams.cut.weight;
    work.polarised = polarised;
    return (beams.preview ? k_preview_price : 1) * price_ns(work);
}

std::vector<ProposedBeams> BeamProposal::all() const {
    std::vector<ProposedBeams> found;
    const auto add = [&](ProposedBeams beams) {
        beams.borders = borders_of(beams.preview, beams.tolerance);
        beams.error = std::hypot(guess_ * std::hypot(beams.cut.error, beams.wavelengths.error),
                                 std::hypot(beams.borders, effects));
        beams.price_ns = price_of(beams);
        found.push_back(beams);
    };
    for (const CutChoice& cut : cuts) {
        for (const WavelengthChoice& set : sets) {
            ProposedBeams beams;
            beams.cut = cut;
            beams.wavelengths = set;
            beams.tolerance = k_coarse;
            if (previews) {
                beams.preview = true;
                add(beams);
                beams.preview = false;
            }
            for (const double tolerance : k_tolerances) {
                if (!borders_are_open) break;
                beams.tolerance = tolerance;
                add(beams);
            }
        }
    }
    return found;
}

ProposedBeams BeamProposal::cheapest(double room, double over_ns, double most_ns) const {
    ProposedBeams best, nearest;
    for (const ProposedBeams& beams : all()) {
        if (!(beams.price_ns > over_ns && beams.price_ns <= most_ns)) continue;
        if (nearest.price_ns == 0 || beams.error < nearest.error) nearest = beams;
        if (beams.error <= room && (best.price_ns == 0 || beams.price_ns < best.price_ns))
            best = beams;
    }
    return best.price_ns > 0 ? best : nearest;
}

ProposedBeams BeamProposal::finer_in_all(const ProposedBeams& drawn) const {
    const std::vector<ProposedBeams> choices = all();
    double finest_cut = drawn.cut.weight, finest_borders = drawn.borders;
    int most_wavelengths = drawn.wavelengths.count;
    for (const ProposedBeams& beams : choices) {
        finest_cut = std::min(finest_cut, beams.cut.weight);
        finest_borders = std::min(finest_borders, beams.borders);
        most_wavelengths = std::max(most_wavelengths, beams.wavelengths.count);
    }
    const double borders = borders_of(drawn.preview, drawn.tolerance);
    ProposedBeams best;
    for (const ProposedBeams& beams : choices) {
        const bool finer =
            (beams.cut.weight < drawn.cut.weight || beams.cut.weight == finest_cut) &&
            (beams.borders < borders || beams.borders == finest_borders) &&
            (beams.wavelengths.count > drawn.wavelengths.count ||
             beams.wavelengths.count == most_wavelengths);
        if (finer && beams.price_ns > drawn.price_ns &&
            (best.price_ns == 0 || beams.price_ns < best.price_ns))
            best = beams;
    }
    return best;
}

ProposedBeams BeamProposal::as_fine_as(const ProposedBeams& drawn) const {
    for (const ProposedBeams& beams : all()) {
        if (beams.preview == drawn.preview && beams.tolerance == drawn.tolerance &&
            beams.cut.weight == drawn.cut.weight &&
            beams.wavelengths.count == drawn.wavelengths.count)
            return beams;
    }
    return {};
}

void BeamProposal::learn(const ProposedBeams& drawn, double error) {
    const double guessed =
        std::hypot(guess_ * std::hypot(drawn.cut.error, drawn.wavelengths.error), drawn.borders);
    if (!(guessed > 0)) return;
    const double left = std::sqrt(std::max(0.0, error * error - effects * effects));
    guess_ *= std::clamp(left / guessed, k_least_guess, k_most_guess);
}

}  // namespace culet
