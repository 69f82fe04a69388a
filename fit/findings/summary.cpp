#include "fit/findings/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/findings/words.h"

namespace culet {

namespace {

constexpr std::size_t k_named = 4;  // names shown of a longer list

std::string misfit_words(const FitStatistics& statistics) {
    return fmt::format(
        "{:.2f} times as far off as their sigmas say (chi-square {:.1f}; {:.1f} expected, up to "
        "{:.1f} by chance)",
        std::sqrt(statistics.chi2 / statistics.dof), statistics.chi2, statistics.dof,
        statistics.chi2_limit);
}

bool is_left_out(const FitResult& result, const std::string& id) {
    return std::any_of(result.readings.begin(), result.readings.end(), [&](const auto& r) {
        return r.id == id && r.suspect && !r.left_out.empty();
    });
}

std::string doubts_told(const FitResult& result) {
    const bool one = result.findings.doubts.size() == 1;
    std::string figures;
    for (const Change& change : result.log.changed) {
        // The two fits may have different sigmas, by which chi-square need not fall.
        if (change.what != k_readings_left_out || !(change.before > change.after)) continue;
        figures = fmt::format(" (chi-square {:.1f} with {}, {:.1f} without)", change.before,
                              one ? "it" : "them", change.after);
    }
    const FitStatistics& statistics = result.statistics;
    const bool agrees =
        (statistics.dof <= 0 || statistics.chi2 <= statistics.chi2_limit) &&
        std::all_of(result.findings.suspects.begin(), result.findings.suspects.end(),
                    [&](const std::string& id) { return is_left_out(result, id); });
    return fmt::format(
        "{} left out{}; {}.", one ? "It is" : "They are", figures,
        agrees ? "the other readings agree with this stone" : "even so the others do not agree");
}

std::string verdict(const FitResult& result) {
    const FitStatistics& statistics = result.statistics;
    const std::string why = result.message + ".";
    switch (result.status) {
        case FitStatus::converged:
            if (!(statistics.dof > 0)) {
                return "This stone has these readings: there are only as many as it needs, so that "
                       "none checks another.";
            }
            return "The readings agree with this stone: they are " + misfit_words(statistics) + ".";
        case FitStatus::contradictory:
            if (!result.findings.doubts.empty()) return doubts_told(result);
            return "The readings contradict each other: " +
                   (statistics.dof > 0 && statistics.chi2 > statistics.chi2_limit
                        ? "they are " + misfit_words(statistics) + "."
                        : why);
        case FitStatus::undetermined:
            return "The readings do not suffice: " + why;
        case FitStatus::not_converged:
            break;
    }
    return "Do not rely on this stone: " + why;
}

std::string calipers(const FitResult& result) {
    const auto value = [&](const char* name) {
        for (const FittedProportion& p : result.findings.proportions) {
            if (p.name == name) return p.value;
        }
        return 0.0;
    };
    const double least = value("caliper min"), most = value("caliper max");
    if (!(least > 0)) return {};
    return fmt::format(
        "In plan this stone is {:.4g} {} wide at the least and {:.4g} at the most, {:.4g} on "
        "average{}.",
        least, name_of(result.unit), most, value("caliper mean"),
        value("diameter") > 0 && most > 1.005 * least
            ? " (its girdle is drawn with flats: calipers read the largest from corner to corner)"
            : "");
}

// Which facets rest on readings, and what the prior assumes of the others.
std::string supposed(const FitResult& result) {
    const PriorReport& prior = result.statistics.prior;
    if (prior.source == Prior::Source::none) return {};
    int read = 0;
    for (const FittedFacet& f : result.facets) read += f.read_inclination > 0.5;
    return fmt::format(
        "The inclinations of {} of {} facets rest on the readings; the rest are assumed to lie "
        "near {}: tiers within {:.2g} degrees, the facets of a tier alike within {:.2g}.",
        read, result.facets.size(),
        prior.source == Prior::Source::catalogue ? "the design that the mesh was made by"
                                                 : "the mesh as it was drawn",
        degrees(prior.tier_angle), degrees(prior.facet_angle));
}

// With a prior the readings decide whether planes meet, and the mesh shows it.
std::string missed_meets(const FitResult& result) {
    const MeetReport& meets = result.statistics.meets;
    if (result.statistics.prior.source == Prior::Source::none || !meets.estimated) return {};
    return fmt::format(
        "Within the readings the planes may miss their common corners by {:.2g} {}: the mesh has "
        "short edges there ([fit] meets = \"exact\" closes them).",
        meets.sigma, name_of(result.unit));
}

// How far the normals may be off.
std::string least_sure(const FitResult& result) {
    std::vector<std::pair<double, std::string>> sigmas;
    for (const FittedFacet& facet : result.facets) {
        const double turn = std::isfinite(facet.sigma_azimuth)
                                ? std::sin(facet.inclination) * facet.sigma_azimuth
                                : 0;
        const double sigma = degrees(std::hypot(facet.sigma_inclination, turn));
        const bool is_open =
            std::any_of(result.findings.undetermined.begin(), result.findings.undetermined.end(),
                        [&](const Undetermined& u) { return u.facet == facet.name; });
        if (sigma > 0 && std::isfinite(sigma) && !is_open) sigmas.emplace_back(sigma, facet.name);
    }
    if (sigmas.size() < 2) return {};
    std::stable_sort(sigmas.begin(), sigmas.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<std::string> worst;
    for (std::size_t i = 0; i < 3 && i < sigmas.size(); ++i) {
        worst.push_back(fmt::format("{} ({:.2g} degrees)", sigmas[i].second, sigmas[i].first));
    }
    return fmt::format(
        "The least certain facets are {}; half of the facets are known to ±{:.2g} degrees or "
        "better.",
        name_list(worst), sigmas[sigmas.size() / 2].first);
}

std::string doubtful(const FitResult& result) {
    std::vector<std::string> words;
    for (const std::string& id : result.findings.suspects) {
        const bool is_said = !result.findings.doubts.empty() && is_left_out(result, id);
        if (!is_said) words.push_back(suspect_words(result, id));
    }
    return words.empty() ? "" : fmt::format("Look again at {}.", name_list(words, k_named));
}

// Only if no single reading explains the contradiction.
std::string disagreeing(const FitResult& result) {
    if (result.findings.disagreeing.empty() || !result.findings.suspects.empty()) return {};
    return fmt::format("Conflicting readings; without any one of them the others agree: {}.",
                       name_list(result.findings.disagreeing, k_named));
}

std::string unchecked(const FitResult& result) {
    // With a prior few are: each is compared with its tier instead.
    if (result.statistics.prior.source != Prior::Source::none) return {};
    std::vector<std::string> ids;
    for (const FittedReading& r : result.readings) {
        if (!r.exact && !is_relation(r.kind) && r.left_out.empty() && r.redundancy < 0.01) {
            ids.push_back(r.id);
        }
    }
    if (ids.empty()) return {};
    return fmt::format(
        "Nothing checks {} of {} readings ({}): an error in them would go unnoticed.", ids.size(),
        result.readings.size(), name_list(ids, k_named));
}

// If the table leans, angles from it differ around the stone.
std::string own_axis(const FitResult& result) {
    const OwnAxis& axis = result.findings.own_axis;
    const double sigma = std::hypot(axis.sigma, axis.scatter_sigma);
    if (!axis.known || !(axis.tilt > 4 * sigma)) return {};
    return fmt::format(
        "The table leans {:.2g} ± {:.1g} degrees against the stone's own axis, towards azimuth "
        "{:.0f}: angles from the table differ around the stone by twice as much.",
        degrees(axis.tilt), degrees(sigma), degrees(axis.azimuth));
}

std::string next_reading(const FitResult& result) {
    if (result.findings.help.empty()) return {};
    const NextReading& best = result.findings.help.front();
    // A tenth of the variance is 5 % of the uncertainty; less is not worth the work.
    if (!best.closes && best.reduces < 0.1) return {};
    return fmt::format(
        "What would help most: {} ({}).", bench_words(best),
        best.closes
            ? "it would settle what no reading settles yet"
            : fmt::format("it would reduce the uncertainty of all facets together by {:.0f} %",
                          100 * (1 - std::sqrt(1 - best.reduces))));
}

}  // namespace

std::string suspect_words(const FitResult& result, const std::string& id) {
    for (const FittedReading& r : result.readings) {
        if (r.id != id) continue;
        const double unit = file_unit(r.kind);
        std::string text = fmt::format("{} ({}{}", r.id, name_of(r.kind), of_words(r.of));
        if (!is_relation(r.kind)) text += fmt::format(": read {:.6g}", unit * r.value);
        const auto proposal =
            std::find_if(result.findings.proposals.begin(), result.findings.proposals.end(),
                         [&](const Proposal& p) { return p.id == id && !is_relation(r.kind); });
        if (proposal != result.findings.proposals.end()) {
            text += fmt::format(", the others say {:.6g} ± {:.2g}{}", unit * proposal->estimate,
                                unit * proposal->sigma, slip_words(*proposal));
        }
        return text + fmt::format(", off by {:.1f} sigma)", std::abs(r.normalized));
    }
    return id;
}

std::string next_step(const FitResult& result) {
    for (const FittedReading& r : result.readings) {
        if (result.findings.suspects.empty() || r.id != result.findings.suspects.front()) continue;
        std::string text = fmt::format("Read the {}{} again", name_of(r.kind), of_words(r.of));
        for (const Proposal& proposal : result.findings.proposals) {
            if (proposal.id == r.id) text += slip_words(proposal);
        }
        return text + ".";
    }
    for (const std::string& words : {disagreeing(result), next_reading(result)}) {
        if (!words.empty()) return words;
    }
    return result.usable() ? "" : sentence_of(result.message);
}

std::vector<std::string> fit_summary(const FitResult& result) {
    const FitFindings& findings = result.findings;
    std::vector<std::string> sentences;
    const auto add = [&](const std::string& sentence) {
        if (!sentence.empty()) sentences.push_back(sentence_of(sentence));
    };
    // At most `k_named` of them.
    const auto add_some = [&](const std::vector<std::string>& found) {
        for (std::size_t i = 0; i < found.size() && i < k_named; ++i) add(found[i]);
        if (found.size() > k_named)
            add(fmt::format("And {} more of these", found.size() - k_named));
    };
    // Unchanged, because they begin with a file name.
    for (const std::string& doubt : findings.doubts) sentences.push_back(doubt + ".");
    const std::string first = verdict(result);
    add(first);
    for (const std::string& note : result.log.notes) {
        // The verdict may contain it already.
        if (first.find(note) == std::string::npos) add(note);
    }
    for (const std::string& change : result.log.changes) add("changed: " + change);
    const bool stands = result.status != FitStatus::not_converged;
    if (stands) {
        add(calipers(result));
        for (const NamedTierFinding& tier : findings.named_tiers) {
            for (const std::string& what : tier.what) add(what);
        }
        add(supposed(result));
        add(missed_meets(result));
        add(least_sure(result));
    }
    add(doubtful(result));
    add(disagreeing(result));
    // Open edges are common and follow from the sigmas; denied ones are news.
    std::vector<std::string> meets, shapes;
    for (const MeetFinding& meet : findings.meets) {
        if (meet.contradicted && !meet.advice.empty()) meets.push_back(meet.advice);
    }
    for (const ShapeFinding& shape : findings.shapes) {
        if (shape.is_denied()) shapes.push_back(shape.what);
    }
    add_some(meets);
    add_some(shapes);
    add_some(findings.undetermined_words);
    if (stands) add(unchecked(result));
    if (stands) add(own_axis(result));
    if (findings.symmetry) add("symmetry: " + findings.symmetry->message);
    if (stands) add(next_reading(result));
    return sentences;
}

}  // namespace culet
