#include "fit/findings/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "fit/findings/bench_words.h"
#include "fit/findings/name_list.h"
#include "fit/findings/verdict.h"
#include "stone/units.h"

namespace culet {

namespace {

constexpr std::size_t k_named = 4;  // of a longer list the first ones are named

bool in_degrees(ReadingKind kind) {
    return is_angle(kind) || kind == ReadingKind::parallel || kind == ReadingKind::rotation ||
           kind == ReadingKind::mirror;
}

// How far the normal may be off.
double direction_sigma(const FittedFacet& facet) {
    const double turn =
        std::isfinite(facet.sigma_azimuth) ? std::sin(facet.inclination) * facet.sigma_azimuth : 0;
    return std::hypot(facet.sigma_inclination, turn);
}

bool is_open(const FitResult& result, const std::string& facet) {
    return std::any_of(result.findings.undetermined.begin(), result.findings.undetermined.end(),
                       [&](const Undetermined& u) { return u.facet == facet; });
}

std::string least_sure(const FitResult& result) {
    std::vector<std::pair<double, std::string>> sigmas;
    for (const FittedFacet& facet : result.facets) {
        const double sigma = degrees(direction_sigma(facet));
        if (sigma > 0 && std::isfinite(sigma) && !is_open(result, facet.name)) {
            sigmas.emplace_back(sigma, facet.name);
        }
    }
    if (sigmas.size() < 2) return {};
    std::stable_sort(sigmas.begin(), sigmas.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<std::string> worst;
    for (std::size_t i = 0; i < 3 && i < sigmas.size(); ++i) {
        worst.push_back(fmt::format("{} ({:.2g} degrees)", sigmas[i].second, sigmas[i].first));
    }
    return fmt::format(
        "Least sure are {}; half of the facets are known to {:.2g} degrees or better.",
        name_list(worst, k_named), sigmas[sigmas.size() / 2].first);
}

// A sentence begins with a capital and ends with a stop.
std::string sentence_of(std::string text) {
    if (text.empty()) return text;
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    if (text.back() != '.') text += '.';
    return text;
}

const Proposal* proposal_for(const FitResult& result, const std::string& id) {
    const auto found =
        std::find_if(result.findings.proposals.begin(), result.findings.proposals.end(),
                     [&](const Proposal& p) { return p.id == id; });
    return found == result.findings.proposals.end() ? nullptr : &*found;
}

std::string words_of(const FittedReading& r, const Proposal* proposal) {
    const double unit = in_degrees(r.kind) ? degrees(1) : 1;
    std::string of;
    for (const std::string& name : r.of) of += (of.empty() ? " of " : "/") + name;
    std::string text = fmt::format("{} ({}{}", r.id, name_of(r.kind), of);
    if (!is_relation(r.kind)) {
        text += fmt::format(": read {:.6g}", unit * r.value);
        if (proposal != nullptr) {
            text += fmt::format(", the others say {:.6g} +- {:.2g}", unit * proposal->estimate,
                                unit * proposal->sigma);
            if (!proposal->slip.empty()) {
                text += fmt::format(" ({}: {:.6g}?)", proposal->slip, unit * proposal->corrected);
            }
        } else if (r.redundancy > 0.01) {
            // What the reading would be predicted to be had it not been taken.
            text += fmt::format(", the others say {:.6g}",
                                unit * (r.value + r.residual / r.redundancy));
        }
    }
    return text + fmt::format(", off by {:.1f} sigma)", std::abs(r.normalized));
}

bool was_doubted(const FitResult& result, const std::string& id) {
    return !result.findings.doubts.empty() &&
           std::any_of(result.readings.begin(), result.readings.end(), [&](const FittedReading& r) {
               return r.id == id && r.suspect && !r.left_out.empty();
           });
}

std::string doubtful(const FitResult& result) {
    std::vector<std::string> words;
    for (const std::string& id : result.findings.suspects) {
        if (was_doubted(result, id)) continue;  // said before
        const auto found = std::find_if(result.readings.begin(), result.readings.end(),
                                        [&](const FittedReading& r) { return r.id == id; });
        words.push_back(
            found == result.readings.end() ? id : words_of(*found, proposal_for(result, id)));
    }
    return words.empty() ? "" : fmt::format("Look again at {}.", name_list(words, k_named));
}

std::string unchecked(const FitResult& result) {
    // Beside a prior few are: each is held against its tier instead.
    if (result.statistics.prior.source != Prior::Source::none) return {};
    std::vector<std::string> ids;
    for (const FittedReading& r : result.readings) {
        if (!r.exact && !is_relation(r.kind) && r.left_out.empty() && r.redundancy < 0.01) {
            ids.push_back(r.id);
        }
    }
    if (ids.empty()) return {};
    return fmt::format("Nothing checks {} of {} readings ({}): their errors would not show.",
                       ids.size(), result.readings.size(), name_list(ids, k_named));
}

// What a sentence each was found for, as many as one reads.
void add_some(const std::vector<std::string>& found, std::vector<std::string>& sentences) {
    for (std::size_t i = 0; i < found.size() && i < k_named; ++i) {
        sentences.push_back(sentence_of(found[i]));
    }
    if (found.size() > k_named) {
        sentences.push_back(fmt::format("And {} more of these.", found.size() - k_named));
    }
}

// Only where no single reading explains the contradiction.
std::string disagreeing(const FitResult& result) {
    if (result.findings.disagreeing.empty() || !result.findings.suspects.empty()) return {};
    return fmt::format(
        "Readings that cannot hold together, though without any one of them the others can: {}.",
        name_list(result.findings.disagreeing, k_named));
}

// The table need not lie square to the stone: angles from it then differ around the stone.
std::string own_axis(const FitResult& result) {
    const OwnAxis& axis = result.findings.own_axis;
    const double sigma = std::hypot(axis.sigma, axis.scatter_sigma);
    if (!axis.known || !(axis.tilt > 4 * sigma)) return {};
    return fmt::format(
        "The table leans {:.2g} +- {:.1g} degrees against the stone's own axis, towards azimuth "
        "{:.0f}: angles from the table differ around the stone by twice as much.",
        degrees(axis.tilt), degrees(sigma), degrees(axis.azimuth));
}

std::string calipers(const FitResult& result) {
    const auto value = [&](const char* name) {
        const auto found =
            std::find_if(result.findings.proportions.begin(), result.findings.proportions.end(),
                         [&](const FittedProportion& p) { return p.name == name; });
        return found == result.findings.proportions.end() ? 0.0 : found->value;
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

std::string next_reading(const FitResult& result) {
    if (result.findings.help.empty()) return {};
    const NextReading& best = result.findings.help.front();
    // A tenth of the variance is five per cent of the uncertainty: less is not worth the work.
    if (!best.closes && best.reduces < 0.1) return {};
    return fmt::format("What would help most: {} ({}).", bench_words(best),
                       best.closes ? "it would settle something that is open"
                                   : fmt::format("it would make all facets together {:.0f} % surer",
                                                 100 * (1 - std::sqrt(1 - best.reduces))));
}

// Which facets rest on readings, and what is supposed of the others.
std::string supposed(const FitResult& result) {
    const PriorReport& prior = result.statistics.prior;
    if (prior.source == Prior::Source::none) return {};
    int read = 0;
    for (const FittedFacet& f : result.facets) read += f.read_inclination > 0.5;
    return fmt::format(
        "The inclinations of {} of {} facets rest on the readings; the rest is supposed to be near "
        "{}: tiers within {:.2g} degrees, the facets of a tier alike within {:.2g}.",
        read, result.facets.size(),
        prior.source == Prior::Source::catalogue ? "the design that the mesh was made by"
                                                 : "the mesh as it was drawn",
        degrees(prior.tier_angle), degrees(prior.facet_angle));
}

// Beside a prior the readings decide whether planes meet: the mesh shows that they do not.
std::string missed_meets(const FitResult& result) {
    const MeetReport& meets = result.statistics.meets;
    if (result.statistics.prior.source == Prior::Source::none || !meets.estimated) return {};
    return fmt::format(
        "By the readings the planes may miss their common corners by {:.2g} {}: the mesh has short "
        "edges there ([fit] meets = \"exact\" closes them).",
        meets.sigma, name_of(result.unit));
}

std::vector<std::string> bad_meets(const FitResult& result) {
    std::vector<std::string> advice;
    for (const MeetFinding& meet : result.findings.meets) {
        if (meet.contradicted && !meet.advice.empty()) advice.push_back(meet.advice);
    }
    return advice;
}

// Open edges are common and follow from the sigmas; what the readings deny is news.
std::vector<std::string> denied_shape(const FitResult& result) {
    std::vector<std::string> found;
    for (const ShapeFinding& finding : result.findings.shapes) {
        if (finding.kind == ShapeFinding::Kind::edge_vanishes ||
            finding.kind == ShapeFinding::Kind::facet_vanishes) {
            found.push_back(finding.what);
        }
    }
    return found;
}

}  // namespace

std::vector<std::string> fit_summary(const FitResult& result) {
    std::vector<std::string> sentences;
    // As they are: they begin with a file's name.
    for (const std::string& doubt : result.findings.doubts) sentences.push_back(doubt + ".");
    const std::size_t verdict_at = sentences.size();
    sentences.push_back(fit_verdict(result));
    const auto add = [&](std::string sentence) {
        if (!sentence.empty()) sentences.push_back(std::move(sentence));
    };
    const bool stands = result.status != FitStatus::not_converged;
    for (const std::string& note : result.log.notes) {
        // The verdict may have said so already.
        if (sentences[verdict_at].find(note) == std::string::npos) add(sentence_of(note));
    }
    for (const std::string& change : result.log.changes) add(sentence_of("changed: " + change));
    if (stands) add(calipers(result));
    if (stands) {
        for (const NamedTierFinding& tier : result.findings.named_tiers) {
            for (const std::string& what : tier.what) add(sentence_of(what));
        }
        add(supposed(result));
        add(missed_meets(result));
        add(least_sure(result));
    }
    add(doubtful(result));
    add(disagreeing(result));
    add_some(bad_meets(result), sentences);
    add_some(denied_shape(result), sentences);
    add_some(result.findings.undetermined_words, sentences);
    if (stands) add(unchecked(result));
    if (stands) add(own_axis(result));
    if (result.findings.symmetry)
        add(sentence_of("symmetry: " + result.findings.symmetry->message));
    if (stands) add(next_reading(result));
    return sentences;
}

}  // namespace culet
