// Cases of kind "photograph": a comparison that must answer, whatever the pictures.
//
// [photo] and [render]: picture = stone | black | flat | white_pixel | noise; `value`: of flat and
// of the pixel; `gain` on all; `poison` = nan | inf: of some pixels, which come through a file.
// [mask]: pixels, the number in the middle of the stone; 0: no mask. [expect]: verdict, one or
// several.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>

#include "compare/calibration/picture_comparison.h"
#include "compare/report/report.h"
#include "compare/report/scores_json.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "tests/compare/synthetic_pictures.h"
#include "tests/hard/hard_kinds.h"

namespace culet::hard {

namespace {

struct PhotographCase {
    Photo photo, render;
    std::vector<std::string> expected;
    std::optional<Comparison> found;

    const Comparison& result() {
        if (!found) {
            CompareOptions options;
            options.threads = 1;
            found = compare(photo, render, options);
        }
        return *found;
    }
};

Photo make_photo(const TomlTable& t, const std::string& name, bool with_coverage) {
    t.refuse_unknown({"picture", "value", "gain", "poison"});
    const std::string picture = t.text("picture").value_or("stone");
    const auto value = static_cast<float>(t.number("value").value_or(0.5));
    synthetic::StonePicture stone;
    stone.width = 160;
    stone.height = 150;
    stone.centre_x = 79.2;
    stone.centre_y = 74.8;
    stone.diameter = 100;
    stone.with_coverage = with_coverage;
    Photo photo = synthetic::draw(stone);
    if (picture == "black" || picture == "flat") {
        std::fill(photo.rgb.begin(), photo.rgb.end(), picture == "black" ? 0.0f : value);
    } else if (picture == "white_pixel") {
        std::fill(photo.rgb.begin(), photo.rgb.end(), 0.0f);
        for (std::size_t k = 0; k < 3; ++k) photo.rgb[3 * (75 * 160 + 79) + k] = value;
    } else if (picture == "noise") {
        std::mt19937 random(5);
        for (float& v : photo.rgb) v = static_cast<float>(random() % 1000) / 1000.0f;
    } else if (picture != "stone") {
        t.fail("picture", "is none of stone, black, flat, white_pixel, noise");
    }
    const auto gain = static_cast<float>(t.number("gain").value_or(1));
    for (float& v : photo.rgb) v *= gain;
    if (gain != 1) photo.saturation = 0;
    if (const auto poison = t.text("poison")) {
        for (std::size_t i = 0; i < photo.rgb.size(); i += 997) {
            photo.rgb[i] = *poison == "inf" ? std::numeric_limits<float>::infinity()
                                            : std::numeric_limits<float>::quiet_NaN();
        }
        std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", photo.width, photo.height);
        for (int y = photo.height - 1; y >= 0; --y) {
            bytes.append(reinterpret_cast<const char*>(photo.rgb.data() + 3 * y * photo.width),
                         3 * sizeof(float) * static_cast<std::size_t>(photo.width));
        }
        const auto folder = std::filesystem::path(CULET_HARD_RESULTS) / "pictures";
        std::filesystem::create_directories(folder);
        const auto file = folder / (name + ".pfm");
        write_text(file, bytes);
        const std::vector<float> coverage = photo.coverage;
        photo = read_photo(file);
        photo.coverage = coverage;
    }
    return photo;
}

}  // namespace

Subject photograph_subject(const HardCase& hard_case, const HardPoint&,
                           const TomlTable& parameters) {
    const auto c = std::make_shared<PhotographCase>();
    c->photo = make_photo(parameters.table("photo").value(), hard_case.name + ".photo", false);
    c->render = make_photo(parameters.table("render").value(), hard_case.name + ".render", true);
    if (const auto mask = parameters.table("mask")) {
        std::int64_t left = mask->integer("pixels").value_or(0);
        if (left > 140 * 140) mask->fail("pixels", "is more than fits the middle");
        c->photo.mask.assign(c->photo.rgb.size() / 3, 0.0f);
        const std::int64_t side = static_cast<std::int64_t>(std::ceil(std::sqrt(double(left))));
        for (std::int64_t y = 0; y < side; ++y) {
            for (std::int64_t x = 0; x < side && left > 0; ++x, --left) {
                const std::int64_t at =
                    std::min<std::int64_t>(149, 75 - side / 2 + y) * 160 + (79 - side / 2 + x);
                c->photo.mask[static_cast<std::size_t>(at)] = 1.0f;
            }
        }
    }
    if (const auto expect = parameters.table("expect")) {
        c->expected = expect->words("verdict").value_or(std::vector<std::string>{});
    }
    Subject subject;
    auto& is = subject.invariants;
    is["verdict"] = [c] {
        const std::string verdict = name_of(c->result().verdict);
        const bool expected =
            std::find(c->expected.begin(), c->expected.end(), verdict) != c->expected.end();
        return Measured{expected ? 0.0 : 1.0, std::nan(""), verdict + ": " + c->result().reason};
    };
    is["finite"] = [c] {
        const Comparison& r = c->result();
        int bad = r.reason.empty();
        for (const double gain : r.gain) bad += !(std::isfinite(gain) && gain >= 0);
        for (const Score& score : r.scores) {
            bad += score.value && !std::isfinite(*score.value);
            bad += !score.value && score.note.empty();
            for (const double null : score.null) bad += !std::isfinite(null);
            bad += score.p && !(*score.p > 0 && *score.p <= 1);
        }
        return Measured{double(bad), std::nan(""), r.reason};
    };
    is["readable"] = [c] {
        const std::string scores = scores_json(c->result());
        Report report;
        report.comparison = c->result();
        const std::string page = report_page(report);
        const bool sound =
            nlohmann::json::accept(scores) && page.find("</html>") != std::string::npos &&
            page.find(">nan<") == std::string::npos && page.find(">inf<") == std::string::npos;
        return Measured{sound ? 0.0 : 1.0, std::nan(""), ""};
    };
    is["no_match"] = [c] {
        return Measured{c->result().verdict == Verdict::match ? 1.0 : 0.0, std::nan(""),
                        c->result().reason};
    };
    return subject;
}

}  // namespace culet::hard
