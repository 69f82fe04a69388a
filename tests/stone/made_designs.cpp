#include "tests/stone/made_designs.h"

#include <fmt/format.h>

#include <cmath>

#include "stone/numbers/units.h"

namespace culet::test {

namespace {

std::string tier_line(const Made& made, double angle_deg, double distance, double first,
                      const std::string& name, double pair = 0) {
    std::string line = fmt::format("a {} {}", angle_deg, distance);
    int count = 0;
    for (int i = 0; i < made.folds; ++i) {
        for (const double side : {-pair, pair}) {
            const double index =
                made.offset + (i + first) * std::abs(made.gear) / made.folds + side;
            line += fmt::format(" {}", index);
            ++count;
            if (!made.unnamed && (made.own_names || count == 1))
                line += fmt::format(" n {}{}", name, made.own_names ? std::to_string(count) : "");
            if (pair == 0) break;
        }
    }
    if (*made.instruction != 0) line += fmt::format(" G {} {}", made.instruction, name);
    return line + "\n";
}

}  // namespace

std::string text_of(const Made& made) {
    const auto through_girdle = [](double angle_deg, double radius) {
        const double a = radians(angle_deg);
        return radius * std::sin(a) + 0.02 * std::cos(a);
    };
    const double corner = 0.97 / std::cos(radians(180.0 / made.folds));
    const double turn = made.twist * made.folds / std::abs(made.gear);
    std::string pavilion, crown;
    if (made.preform) pavilion += tier_line(made, -70, 3, 0, "X");
    pavilion += tier_line(made, -41.25, through_girdle(41.25, 1), 0, "P") +
                tier_line(made, -43.123456, through_girdle(43.123456, corner), 0.5, "B");
    if (made.culet) pavilion += "a -0.000000 0.7 0 n K\n";
    crown = tier_line(made, 34, through_girdle(34, 1), turn, made.word, made.cheat) +
            tier_line(made, 39.5, through_girdle(39.5, corner), 0.5 + turn, "S") +
            "a 0.000000 0.3 0" + (made.unnamed ? "" : " n T") + "\n";
    std::string text = fmt::format("GemCad 5.0\ng {} {}\ny {} {}\nI 1.76\n", made.gear, made.offset,
                                   made.folds, made.twist == 0 ? "y" : "n");
    for (int i = 0; i < made.headings; ++i) text += fmt::format("H Heading {} & \"more\"\n", i);
    const std::string girdle = tier_line(made, -90, 1, 0, "G");
    text += made.crown_first ? crown + girdle + pavilion : pavilion + girdle + crown;
    for (int i = 0; i < made.footnotes; ++i) text += fmt::format("F Note {} <caf\xc3\xa9>\n", i);
    return text;
}

}  // namespace culet::test
