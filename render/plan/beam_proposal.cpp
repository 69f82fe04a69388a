#include "render/plan/beam_proposal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "render/plan/planner.h"
#include "render/plan/price.h"

namespace culet {

namespace {

// Of the mean radiance: rounding. What is off by less is taken for that much.
constexpr double k_least_error = 1e-12;

// Measured on brilliants, steps, ovals, princesses and trillions of diamond, spinel, garnet and
// glass under four lights, 64, 200 and 400 pixels across: previews were off by 0.1 to 1 times
// (a stone: median 0.3) the faces met over the root of the stone's pixels, beams of tolerance 0.1
// by a fourth of that, and of others in proportion to the root of it.
constexpr double k_preview_borders = 0.35, k_beam_borders = 0.25, k_coarse = 0.1;
// Of a crystal's parted beams: 0.15 to 0.2 times the root of the tolerance in pictures of 1500
// pixels of a round brilliant in a light with sharp edges, and less in larger ones.
constexpr double k_parted_borders = 0.2, k_parted_pixels = 1500;
constexpr std::array k_tolerances{0.1, 0.03, 0.01, 0.003, 0.001, 0.0003, 0.0001, 0.00003};
// A preview's share of the price of the coarsest beams.
constexpr double k_preview_price = 0.45;
// Errors are guesses: one that is so many times as large is as good.
constexpr double k_as_good = 1.25;
// How far guesses are off, as logarithms: of the causes in their order; and what the causes
// together explain no better, because pixels and causes do not add up so simply.
constexpr std::array k_doubt{0.7, 0.7, 1.1, 0.7, 0.7};
constexpr double k_doubt_of_error = 0.2;
// Of a cause that pixels have shown by itself: they are few, and their rays others than the
// picture's.
constexpr double k_doubt_of_known = 0.3;
// A choice that is as likely near enough as not is taken, or one that is nearly as likely as any.
constexpr double k_even_chance = 0.5, k_as_likely = 0.8;
// Of the likeliest explanation, how likely one must be to count.
constexpr double k_negligible = 0.02;
// Factors that are weighed.
constexpr std::array k_factors{0.18, 0.35, 0.6, 1.0, 1.6, 2.8, 5.0, 12.0};

// `order`: of a choice, beside the known one: above 0 where it is coarser. Where more was found
// than guessed, those that are coarser than any known one are off by more in proportion, too.
template <class Choice, class Order>
void put_right(std::vector<Choice>& choices, double error, bool coarsest_known,
               const Order& order) {
    double factor = 1;
    for (const Choice& choice : choices) {
        if (order(choice) == 0 && choice.error > 0) factor = error / choice.error;
    }
    for (Choice& choice : choices) {
        if (order(choice) > 0)
            choice.error =
                std::max(error, (coarsest_known ? std::max(factor, 1.0) : 1) * choice.error);
        if (order(choice) == 0) choice.error = error;
        if (order(choice) < 0) choice.error = std::min(error, factor * choice.error);
    }
}

}  // namespace

void ProposedBeams::apply_to(RenderSettings& settings) const {
    settings.engine = preview ? "preview" : "beams";
    settings.tolerance = tolerance;
    settings.cut_weight = cut.weight;
    if (wavelengths.count > 0) settings.wavelengths_nm = even_wavelengths(wavelengths.count);
}

bool ProposedBeams::no_finer_than(const ProposedBeams& other) const {
    return cut.weight >= other.cut.weight && wavelengths.count <= other.wavelengths.count &&
           (preview || (!other.preview && tolerance >= other.tolerance));
}

double BeamProposal::borders_of(bool preview, double tolerance) const {
    if (parted && !preview)
        return k_parted_borders * std::sqrt(tolerance * k_parted_pixels / std::max(pixels, 1.0));
    const double coarsest = k_preview_borders * events_per_ray / std::sqrt(std::max(pixels, 1.0));
    return coarsest * (preview ? 1 : k_beam_borders * std::sqrt(tolerance / k_coarse));
}

BeamProposal::Parts BeamProposal::parts_of(const ProposedBeams& beams, double left_out) {
    Parts parts{};
    parts[of_cut] = beams.cut.error;
    parts[of_wavelengths] = beams.wavelengths.error;
    parts[beams.preview ? of_previews : of_beams] = beams.borders;
    parts[of_effects] = left_out;
    for (double& part : parts) part *= part;
    return parts;
}

double BeamProposal::error_of(const ProposedBeams& beams) const {
    const Parts parts = parts_of(beams, effects);
    return std::sqrt(std::inner_product(parts.begin(), parts.end(), squares_.begin(), 0.0));
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
    work.parted = parted;
    return (beams.preview ? k_preview_price : 1) * price_ns(work);
}

std::vector<ProposedBeams> BeamProposal::all() const {
    std::vector<ProposedBeams> found;
    const auto add = [&](ProposedBeams beams) {
        beams.borders = borders_of(beams.preview, beams.tolerance);
        beams.error = error_of(beams);
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

ProposedBeams BeamProposal::cheapest(double room, double most_ns) const {
    std::vector<ProposedBeams> choices = all();
    std::erase_if(choices, [&](const ProposedBeams& beams) {
        return beams.price_ns > most_ns ||
               std::any_of(seen_.begin(), seen_.end(),
                           [&](const Seen& seen) { return beams.no_finer_than(seen.beams); });
    });
    if (choices.empty()) return {};
    if (!beliefs_.empty()) return likeliest(std::move(choices), room);
    const double least =
        std::min_element(choices.begin(), choices.end(), [](const auto& a, const auto& b) {
            return a.error < b.error;
        })->error;
    const double allowed = std::max(room, k_as_good * least);
    ProposedBeams best;
    for (const ProposedBeams& beams : choices) {
        if (beams.error <= allowed && (best.price_ns == 0 || beams.price_ns < best.price_ns))
            best = beams;
    }
    return best;
}

// What cannot be mended by any choice is not to be blamed: of that, only chances tell.
ProposedBeams BeamProposal::likeliest(std::vector<ProposedBeams> choices, double room) const {
    std::sort(choices.begin(), choices.end(),
              [](const auto& a, const auto& b) { return a.price_ns < b.price_ns; });
    std::vector<double> chances;
    for (const ProposedBeams& beams : choices) {
        const Parts parts = parts_of(beams, effects);
        double chance = 0;
        for (const Belief& belief : beliefs_) {
            const double square =
                std::inner_product(parts.begin(), parts.end(), belief.squares.begin(), 0.0);
            if (square <= room * room) chance += belief.weight;
        }
        if (chance >= k_even_chance) return beams;
        chances.push_back(chance);
    }
    const double most = *std::max_element(chances.begin(), chances.end());
    if (!(most > 0)) {
        return *std::min_element(choices.begin(), choices.end(),
                                 [](const auto& a, const auto& b) { return a.error < b.error; });
    }
    const auto first = std::find_if(chances.begin(), chances.end(),
                                    [most](double chance) { return chance >= k_as_likely * most; });
    return choices[static_cast<std::size_t>(first - chances.begin())];
}

void BeamProposal::learn(const ProposedBeams& drawn, double error) {
    seen_.push_back({drawn, effects, std::max(error, k_least_error)});
    put_right_what_was_seen();
    weigh_causes();
}

void BeamProposal::know_cut(double weight, double error) {
    known_cuts_[weight] = error;
    put_right(cuts, error, known_cuts_.rbegin()->first == weight, [weight](const CutChoice& cut) {
        return cut.weight > weight ? 1 : cut.weight < weight ? -1 : 0;
    });
}

void BeamProposal::know_wavelengths(int count, double error) {
    known_wavelengths_[count] = error;
    put_right(sets, error, known_wavelengths_.begin()->first == count,
              [count](const WavelengthChoice& set) { return count - set.count; });
}

void BeamProposal::put_right_what_was_seen() {
    for (Seen& seen : seen_) {
        for (const CutChoice& cut : cuts) {
            if (cut.weight == seen.beams.cut.weight) seen.beams.cut = cut;
        }
        for (const WavelengthChoice& set : sets) {
            if (set.count == seen.beams.wavelengths.count) seen.beams.wavelengths = set;
        }
    }
}

void BeamProposal::learn_from(const BeamProposal& other) {
    // From the coarsest on, as they were found out.
    for (auto known = other.known_cuts_.rbegin(); known != other.known_cuts_.rend(); ++known)
        know_cut(known->first, known->second);
    for (const auto& [count, error] : other.known_wavelengths_) know_wavelengths(count, error);
    const std::vector<ProposedBeams> choices = all();
    for (const Seen& seen : other.seen_) {
        const ProposedBeams& theirs = seen.beams;
        const auto same =
            std::find_if(choices.begin(), choices.end(), [&](const ProposedBeams& beams) {
                return beams.preview == theirs.preview && beams.tolerance == theirs.tolerance &&
                       beams.cut.weight == theirs.cut.weight &&
                       beams.wavelengths.count == theirs.wavelengths.count;
            });
        if (same == choices.end()) continue;
        seen_.push_back({*same, seen.effects, seen.error});
    }
    weigh_causes();
}

void BeamProposal::weigh_causes() {
    std::vector<Parts> parts;
    std::vector<double> logs;
    for (const Seen& seen : seen_) {
        parts.push_back(parts_of(seen.beams, seen.effects));
        logs.push_back(2 * std::log(seen.error));
    }
    // Every combination of factors of those causes that any picture had, by how likely it is and
    // how well it explains what was seen (Bayes).
    std::vector<std::size_t> causes;
    std::size_t combinations = 1;
    for (std::size_t c = 0; c < k_causes; ++c) {
        if (std::none_of(parts.begin(), parts.end(), [c](const Parts& of) { return of[c] > 0; }))
            continue;
        causes.push_back(c);
        combinations *= k_factors.size();
    }
    const auto squares_at = [&](std::size_t number) {
        Parts squares;
        squares.fill(1);
        for (const std::size_t cause : causes) {
            const double factor = k_factors[number % k_factors.size()];
            squares[cause] = factor * factor;
            number /= k_factors.size();
        }
        return squares;
    };
    std::array<std::array<double, k_factors.size()>, k_causes> unlikely_by_itself{};
    for (std::size_t c = 0; c < k_causes; ++c) {
        const bool known = (c == of_cut && !known_cuts_.empty()) ||
                           (c == of_wavelengths && !known_wavelengths_.empty());
        const double doubt = known ? k_doubt_of_known : k_doubt[c];
        for (std::size_t i = 0; i < k_factors.size(); ++i)
            unlikely_by_itself[c][i] = std::pow(std::log(k_factors[i]) / doubt, 2) / 2;
    }
    std::vector<double> unlikely(combinations);
    for (std::size_t number = 0; number < combinations; ++number) {
        const Parts squares = squares_at(number);
        double sum = 0;
        std::size_t left = number;
        for (const std::size_t cause : causes) {
            sum += unlikely_by_itself[cause][left % k_factors.size()];
            left /= k_factors.size();
        }
        for (std::size_t s = 0; s < parts.size(); ++s) {
            const double expected =
                std::inner_product(parts[s].begin(), parts[s].end(), squares.begin(), 0.0);
            // What no cause is expected of tells none from another.
            const double off =
                (logs[s] - std::log(std::max(expected, k_least_error * k_least_error))) /
                (2 * k_doubt_of_error);
            sum += off * off / 2;
        }
        unlikely[number] = sum;
    }
    const double least = *std::min_element(unlikely.begin(), unlikely.end());
    beliefs_.clear();
    double all = 0;
    for (std::size_t number = 0; number < combinations; ++number) {
        const double weight = std::exp(least - unlikely[number]);
        if (weight < k_negligible) continue;
        Belief belief;
        belief.squares = squares_at(number);
        belief.weight = weight;
        beliefs_.push_back(belief);
        all += weight;
    }
    squares_.fill(0);
    for (Belief& belief : beliefs_) {
        belief.weight /= all;
        for (std::size_t c = 0; c < k_causes; ++c) squares_[c] += belief.weight * belief.squares[c];
    }
}

}  // namespace culet
