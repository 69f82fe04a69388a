#include "fit/report/assessment.h"

#include "fit/report/json_number.h"
#include "stone/units.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

}  // namespace

void report_assessment(const FitResult& result, Json& report) {
    Json proportions = Json::array();
    for (const FittedProportion& p : result.findings.proportions) {
        proportions.push_back({{"name", p.name},
                               {"value", json_number(p.value)},
                               {"sigma", json_number(p.sigma)},
                               {"unit", p.unit}});
    }
    report["proportions"] = proportions;
    report["disagreeing"] = result.findings.disagreeing;
    Json proposals = Json::array();
    for (const Proposal& p : result.findings.proposals) {
        const double unit = p.in_radians ? degrees(1) : 1;
        Json one = {{"id", p.id},
                    {"estimate", json_number(unit * p.estimate)},
                    {"sigma", json_number(unit * p.sigma)}};
        if (!p.slip.empty()) {
            one["slip"] = p.slip;
            one["corrected"] = json_number(unit * p.corrected);
        }
        one["alternatives"] = p.alternatives;
        proposals.push_back(std::move(one));
    }
    report["proposals"] = proposals;
    report["undetermined_words"] = result.findings.undetermined_words;
    Json help = Json::array();
    for (const NextReading& h : result.findings.help) {
        const double unit = is_angle(h.kind) ? degrees(1) : 1;
        help.push_back({{"kind", name_of(h.kind)},
                        {"of", h.of},
                        {"sigma", json_number(unit * h.sigma)},
                        {"reduces", json_number(h.reduces)},
                        {"closes", h.closes}});
    }
    report["help"] = help;
    report["options"]["loss"] = name_of(result.log.options.loss);
    if (result.log.options.loss == Loss::none) return;
    for (std::size_t r = 0; r < result.readings.size(); ++r) {
        report["readings"][r]["weight"] = json_number(result.readings[r].weight);
    }
}

}  // namespace culet
