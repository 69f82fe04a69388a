#include "stone/design/design_difference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "stone/design/tiers_as_cut.h"

namespace culet {

namespace {

constexpr double k_equal_depth = 2e-5;  // of the width
constexpr const char* k_material = "render.material";

bool same_turns(const TierAsCut& a, const TierAsCut& b, double least_gear) {
    return std::equal(a.turns.begin(), a.turns.end(), b.turns.begin(), b.turns.end(),
                      [&](double s, double t) {
                          return std::abs(std::remainder(s - t, 1.0)) * least_gear <= k_equal_teeth;
                      });
}

class Comparison {
public:
    Comparison(const Solid& a, const Solid& b) : a_(a), b_(b) {
        least_gear_ = std::min(std::abs(a_.design.gear), std::abs(b_.design.gear));
    }

    std::vector<DesignDifference> run() {
        compare_wholes();
        match();
        find_scale();
        compare_order();
        for (std::size_t i = 0; i < a_.tiers.size(); ++i) {
            if (match_[i] < 0) add("tier", a_.tiers[i].title, setting_words(a_.tiers[i]), "none");
        }
        for (std::size_t j = 0; j < b_.tiers.size(); ++j) {
            if (taken_.count(int(j)) == 0)
                add("tier", b_.tiers[j].title, "none", setting_words(b_.tiers[j]));
        }
        for (std::size_t i = 0; i < a_.tiers.size(); ++i) {
            if (match_[i] >= 0) compare_tiers(a_.tiers[i], b_.tiers[std::size_t(match_[i])]);
        }
        return std::move(found_);
    }

private:
    void add(const char* what, const std::string& tier, std::string a, std::string b) {
        if (a == b) return;
        for (std::string* word : {&a, &b}) {
            if (word->empty()) *word = "none";
        }
        found_.push_back({what, tier, std::move(a), std::move(b)});
    }

    static std::string setting_words(const TierAsCut& tier) {
        return fmt::format("{:.2f} degrees {}, index {}", tier.angle_deg,
                           tier.side == 'P'   ? "pavilion"
                           : tier.side == 'C' ? "crown"
                                              : "girdle",
                           tier.teeth);
    }

    static std::string lines_of(const std::vector<std::string>& lines) {
        const std::string text = fmt::format("{}", fmt::join(lines, " / "));
        return text.substr(0, text.find_last_not_of("/ ") + 1);
    }

    void compare_wholes() {
        const auto both = [&](const char* what, auto words) {
            add(what, {}, words(a_.design), words(b_.design));
        };
        both("gear", [](const Design& d) {
            return fmt::format("{:g}{}", d.gear,
                               d.gear_offset == 0
                                   ? std::string()
                                   : fmt::format(", index {:g} at azimuth zero", d.gear_offset));
        });
        both("symmetry", [](const Design& d) {
            return fmt::format("{}-fold{}", d.symmetry, d.mirror ? ", mirrored" : "");
        });
        both("refractive index", [](const Design& d) {
            return d.refractive_index ? fmt::format("{:g}", *d.refractive_index) : std::string();
        });
        add("headings", {}, lines_of(a_.design.headings), lines_of(b_.design.headings));
        add("footnotes", {}, lines_of(a_.design.footnotes), lines_of(b_.design.footnotes));
        both("material", [](const Design& d) {
            const auto material = d.studio.find(k_material);
            return material == d.studio.end() ? std::string() : material->second;
        });
        add("Gem Cut Studio's own", {}, studio_words(a_.design, b_.design),
            studio_words(b_.design, a_.design));
    }

    // What `other` has otherwise. `index` is of the editor, not of the design.
    static std::string studio_words(const Design& own, const Design& other) {
        std::string words;
        for (const auto& [key, value] : own.studio) {
            const auto at = other.studio.find(key);
            const bool same = at != other.studio.end() && at->second == value;
            if (!same && !value.empty() && key != k_material && !key.starts_with("index."))
                words += fmt::format("{}{} {}", words.empty() ? "" : ", ", key, value);
        }
        return words;
    }

    // By name and setting, else by setting, else by name and side.
    void match() {
        match_.assign(a_.tiers.size(), -1);
        for (const auto& [by_name, by_setting] :
             {std::pair(true, true), {false, true}, {true, false}}) {
            for (std::size_t i = 0; i < a_.tiers.size(); ++i) {
                for (std::size_t j = 0; j < b_.tiers.size() && match_[i] < 0; ++j) {
                    const TierAsCut &a = a_.tiers[i], &b = b_.tiers[j];
                    if (taken_.count(int(j)) > 0 || a.side != b.side) continue;
                    if (by_name && a.title != b.title) continue;
                    if (by_setting && (std::abs(a.angle_deg - b.angle_deg) > k_equal_deg ||
                                       !same_turns(a, b, least_gear_)))
                        continue;
                    match_[i] = int(j);
                    taken_.insert(int(j));
                }
            }
        }
    }

    // offset in B = scale * offset in A + shift * up
    double off(std::size_t i) const {
        const TierAsCut &a = a_.tiers[i], &b = b_.tiers[std::size_t(match_[i])];
        return b.distance - scale_ * a.distance - shift_ * b.up;
    }

    bool same_angle(std::size_t i) const {
        return match_[i] >= 0 &&
               std::abs(a_.tiers[i].angle_deg - b_.tiers[std::size_t(match_[i])].angle_deg) <=
                   k_equal_deg;
    }

    int agreeing() const {
        int count = 0;
        for (std::size_t i = 0; i < a_.tiers.size(); ++i)
            count += same_angle(i) && std::abs(off(i)) <= k_equal_depth * b_.width;
        return count;
    }

    void find_scale() {
        scale_ = a_.width > 0 ? b_.width / a_.width : 1;
        shift_ = b_.middle - scale_ * a_.middle;
        constexpr std::size_t k_most_tried = 60;  // the search takes their cube
        int most = agreeing(), all = 0;
        for (std::size_t i = 0; i < a_.tiers.size(); ++i) all += same_angle(i);
        double scale = scale_, shift = shift_;
        for (std::size_t i = 0; most < all && i < std::min(a_.tiers.size(), k_most_tried); ++i) {
            for (std::size_t k = 0; k < i && same_angle(i); ++k) {
                if (!same_angle(k)) continue;
                const TierAsCut &p = a_.tiers[i], &q = a_.tiers[k];
                const TierAsCut &r = b_.tiers[std::size_t(match_[i])],
                                &s = b_.tiers[std::size_t(match_[k])];
                const double det = p.distance * s.up - q.distance * r.up;
                if (std::abs(det) < 1e-6 * a_.width) continue;
                scale_ = (r.distance * s.up - s.distance * r.up) / det;
                shift_ = (p.distance * s.distance - q.distance * r.distance) / det;
                const int now = scale_ > 0 ? agreeing() : 0;
                if (now <= most) continue;
                most = now;
                scale = scale_;
                shift = shift_;
            }
        }
        scale_ = scale;
        shift_ = shift;
    }

    void compare_order() {
        std::vector<std::string> first, second;
        std::vector<int> order;
        for (std::size_t i = 0; i < match_.size(); ++i) {
            if (match_[i] < 0) continue;
            order.push_back(match_[i]);
            first.push_back(a_.tiers[i].title);
        }
        if (std::is_sorted(order.begin(), order.end())) return;
        std::sort(order.begin(), order.end());
        for (const int j : order) second.push_back(b_.tiers[std::size_t(j)].title);
        add("order of cutting", {}, fmt::format("{}", fmt::join(first, " ")),
            fmt::format("{}", fmt::join(second, " ")));
    }

    void compare_tiers(const TierAsCut& a, const TierAsCut& b) {
        const std::string& tier = a.title;
        add("name", tier, a.title, b.title);
        if (std::abs(a.angle_deg - b.angle_deg) > k_equal_deg) {
            add("angle", tier, fmt::format("{:.6g}", a.angle_deg),
                fmt::format("{:.6g}", b.angle_deg));
        }
        if (!same_turns(a, b, least_gear_)) add("index settings", tier, a.teeth, b.teeth);
        const std::size_t i = std::size_t(&a - a_.tiers.data());
        if (const double deeper = -off(i);
            same_angle(i) && std::abs(deeper) > k_equal_depth * b_.width) {
            add("depth", tier, "as before",
                fmt::format("{:.5f} W {}", std::abs(deeper) / b_.width,
                            deeper > 0 ? "deeper" : "less deep"));
        }
        add("instruction", tier, a.own->instruction, b.own->instruction);
        const auto both = [&](const char* what, auto words) {
            add(what, tier, words(*a.own), words(*b.own));
        };
        both("surface", [](const DesignTier& t) {
            return t.frosting > 0 ? fmt::format("frosted {:g}", t.frosting) : "polished";
        });
        both("use", [](const DesignTier& t) {
            return std::string(t.hidden ? "hidden" : "cut") + (t.guide ? ", guide" : "");
        });
    }

    DesignAsCut a_, b_;
    double least_gear_ = 96, scale_ = 1, shift_ = 0;
    std::vector<int> match_;  // tiers of B; -1: none
    std::set<int> taken_;
    std::vector<DesignDifference> found_;
};

}  // namespace

std::vector<DesignDifference> design_differences(const Solid& a, const Solid& b) {
    return Comparison(a, b).run();
}

std::string words_of(const DesignDifference& difference) {
    return fmt::format("{}{}{}: {}, then {}", difference.tier, difference.tier.empty() ? "" : ": ",
                       difference.what, difference.a, difference.b);
}

}  // namespace culet
