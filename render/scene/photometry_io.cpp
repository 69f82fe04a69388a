#include "render/scene/photometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "stone/text/errors.h"
#include "stone/text/text_decoding.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

constexpr std::int64_t k_most_angles = 3601;  // a circle in tenths of a degree
constexpr double k_most_candela = 1e12;       // a lighthouse has 1e7
constexpr double k_mm_per_foot = 304.8;

// The lines of a file, and numbers in them.
class Reader {
public:
    Reader(std::string_view text, const std::filesystem::path& file) : lines_(text), file_(file) {}

    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(file_, std::max(lines_.line(), 1L), message);
    }
    std::string_view line(const char* what) {
        const auto next = lines_.next();
        if (!next) fail(fmt::format("the file ends before {}: it is cut short", what));
        return *next;
    }
    void skip(int count, const char* what) {
        for (int i = 0; i < count; ++i) line(what);
    }
    // The next number, on this line or a later one (LM-63: blanks or commas between).
    double number(const char* what) {
        while (next_word_ >= words_.size()) {
            line_ = line(what);
            std::replace(line_.begin(), line_.end(), ',', ' ');
            words_ = words_of(line_);
            next_word_ = 0;
        }
        return value(words_[next_word_++], what);
    }
    // A line of one number (EULUMDAT: with a point or a comma).
    double number_line(const char* what) {
        line_ = trimmed(line(what));
        std::replace(line_.begin(), line_.end(), ',', '.');
        return value(line_, what);
    }
    std::size_t count(double value, const char* what, std::int64_t least) const {
        if (!(value >= double(least) && value <= double(k_most_angles)) ||
            value != std::floor(value))
            fail(fmt::format("{} is {:g}; expected a whole number from {} to {}", what, value,
                             least, k_most_angles));
        return std::size_t(value);
    }
    double intensity(double value) const {
        if (!(value >= 0 && value <= k_most_candela))
            fail(fmt::format("a luminous intensity is 0 to {:g} candela, found {:g}",
                             k_most_candela, value));
        return value;
    }
    double positive(double value, const char* what) const {
        if (!(value > 0)) fail(fmt::format("{} must be positive, found {:g}", what, value));
        return value;
    }
    // Angles that ascend; `one` reads one.
    template <class One>
    std::vector<double> angles(std::size_t count, double least, double most, const One& one) {
        std::vector<double> list;
        while (list.size() < count) {
            const double angle = one("its angles");
            if (!(angle >= least && angle <= most) || (!list.empty() && angle <= list.back())) {
                fail(fmt::format("angle {:g}: angles ascend within {:g} to {:g} degrees", angle,
                                 least, most));
            }
            list.push_back(angle);
        }
        return list;
    }

private:
    double value(std::string_view word, const char* what) const {
        const auto number = number_in(word);
        if (!number) fail(fmt::format("{}; expected {}", not_a_number(word), what));
        return *number;
    }

    LineReader lines_;
    const std::filesystem::path& file_;
    std::string line_;
    std::vector<std::string_view> words_;
    std::size_t next_word_ = 0;
};

void read_tilt(Reader& read, const std::string& tilt, Photometry& lamp) {
    if (tilt == "none") return;
    if (tilt != "include") {
        read.fail(
            fmt::format("TILT={}: tables in files of their own are not read; put the table "
                        "here (TILT=INCLUDE), or say TILT=NONE",
                        shown(tilt)));
    }
    read.number("the lamp's geometry");
    const std::size_t count = read.count(read.number("its tilt angles"), "number of tilts", 1);
    const auto one = [&](const char* what) { return read.number(what); };
    lamp.tilt = read.angles(count, 0, 180, one);
    for (std::size_t i = 0; i < count; ++i) {
        const double factor = read.number("its tilt factors");
        if (factor < 0) read.fail(fmt::format("a tilt factor is {:g}, below 0", factor));
        lamp.tilt_factor.push_back(factor);
    }
}

void require_known_span(const Reader& read, const Photometry& lamp) {
    const double first = lamp.horizontal.front(), last = lamp.horizontal.back();
    const bool is_c = lamp.type == Photometry::Type::c;
    const bool known =
        is_c ? (first == 0 && (last == 0 || last == 90 || last == 180 || last == 360)) ||
                   (first == 90 && last == 270)
             : (first == 0 || first == -90) && last == 90;
    if (known) return;
    read.fail(
        fmt::format("horizontal angles {:g} to {:g}; expected {}", first, last,
                    is_c ? "0 alone, 0 to 90, 180 or 360, or 90 to 270" : "-90 to 90, or 0 to 90"));
}

Photometry ies(std::string_view text, const std::filesystem::path& file) {
    Reader read(text, file);
    Photometry lamp;
    std::string line;
    while (!line.starts_with("tilt="))
        line = lower_case(std::string(trimmed(read.line("the line TILT= of LM-63"))));
    read_tilt(read, std::string(trimmed(std::string_view(line).substr(5))), lamp);
    const auto one = [&](const char* what) { return read.number(what); };
    one("the number of lamps");
    one("the lamps' flux");
    double scale = read.positive(one("the multiplier"), "the multiplier");
    const double verticals = one("the number of vertical angles");
    const std::size_t rows = read.count(verticals, "number of vertical angles", 2);
    const double horizontals = one("the number of horizontal angles");
    const std::size_t planes = read.count(horizontals, "number of horizontal angles", 1);
    const double type = one("the photometric type");
    if (type != 1 && type != 2 && type != 3)
        read.fail(fmt::format("photometric type {:g}; expected 1 (C), 2 (B) or 3 (A)", type));
    lamp.type = type == 1   ? Photometry::Type::c
                : type == 2 ? Photometry::Type::b
                            : Photometry::Type::a;
    const double units = one("the type of units");
    if (units != 1 && units != 2)
        read.fail(fmt::format("units {:g}; expected 1 (feet) or 2 (metres)", units));
    const double mm = units == 1 ? k_mm_per_foot : 1000.0;
    const double width = one("its width") * mm, length = one("its length") * mm;
    one("its height");
    // Negative: round.
    const bool is_round = width < 0 || length < 0;
    lamp.opening_mm2 = std::abs(width * length) * (is_round ? std::numbers::pi / 4 : 1.0);
    // The second is the ballast-lamp photometric factor; since 1995 it is 1.
    scale *= read.positive(one("the ballast factor"), "the ballast factor");
    scale *= read.positive(one("the ballast-lamp factor"), "the ballast-lamp factor");
    one("its power");
    const bool is_c = lamp.type == Photometry::Type::c;
    lamp.vertical = read.angles(rows, is_c ? 0 : -90, is_c ? 180 : 90, one);
    lamp.horizontal = read.angles(planes, is_c ? 0 : -90, is_c ? 360 : 90, one);
    require_known_span(read, lamp);
    for (std::size_t i = 0; i < rows * planes; ++i)
        lamp.candela.push_back(read.intensity(one("its intensities") * scale));
    return lamp;
}

// The planes that a EULUMDAT file holds, and `first` of them: their angles from all `c`.
std::vector<double> stored_planes(const Reader& read, int symmetry, const std::vector<double>& c) {
    const std::size_t all = c.size();
    const std::size_t first = symmetry == 3 ? 3 * all / 4 : 0;
    const std::size_t count = symmetry == 0   ? all
                              : symmetry == 1 ? 1
                              : symmetry == 4 ? all / 4 + 1
                                              : all / 2 + 1;
    std::vector<double> angles;
    for (std::size_t i = first; i < first + count; ++i)
        angles.push_back(c[i % all] - (symmetry == 3 && i < all ? 360 : 0));
    const double from = symmetry == 3 ? -90 : 0, to = symmetry == 2 ? 180 : 90;
    if (angles.front() != from || (symmetry >= 2 && angles.back() != to)) {
        read.fail(
            fmt::format("symmetry {} has planes from {:g} to {:g} degrees, found {:g} to {:g}",
                        symmetry, from, to, angles.front(), angles.back()));
    }
    return angles;
}

Photometry ldt(std::string_view text, const std::filesystem::path& file) {
    Reader read(text, file);
    Photometry lamp;
    const auto one = [&](const char* what) { return read.number_line(what); };
    read.skip(1, "its maker");
    one("the type of luminaire");
    const double symmetry = one("its symmetry");
    if (!(symmetry >= 0 && symmetry <= 4) || symmetry != std::floor(symmetry))
        read.fail(fmt::format("symmetry {:g}; expected 0 to 4", symmetry));
    const std::size_t planes = read.count(one("the number of C planes"), "number of C planes", 1);
    one("the distance of C planes");
    const std::size_t rows = read.count(one("the number of angles"), "number of angles", 2);
    one("the distance of angles");
    read.skip(5 + 3, "its names and size");
    const auto size = [&](const char* what) {
        const double mm = one(what);
        if (mm < 0) read.fail(fmt::format("{} is {:g}, below 0", what, mm));
        return mm;
    };
    const double length = size("the luminous length"), width = size("the luminous width");
    // Width 0: a circle of this diameter.
    lamp.opening_mm2 = width > 0 ? length * width : std::numbers::pi / 4 * length * length;
    read.skip(4 + 2, "its heights and fluxes");
    double scale = read.positive(one("the factor of intensities"), "the factor of intensities");
    read.skip(1, "the tilt of the measurement");
    const double sets = one("the number of sets of lamps");
    if (sets != 1)
        read.fail(fmt::format("{:g} sets of lamps: keep one, whose flux is to count", sets));
    read.skip(2, "the lamps");
    scale *= read.positive(one("the lamps' flux"), "the lamps' flux") / 1000;
    read.skip(3 + 10, "the lamps' colour and the direct ratios");
    const std::vector<double> c = read.angles(planes, 0, 359.999, one);
    lamp.vertical = read.angles(rows, 0, 180, one);
    lamp.horizontal = stored_planes(read, int(symmetry), c);
    const std::size_t count = rows * lamp.horizontal.size();
    for (std::size_t i = 0; i < count; ++i)
        lamp.candela.push_back(read.intensity(one("its intensities") * scale));
    if (symmetry == 0) {
        lamp.horizontal.push_back(360);
        for (std::size_t i = 0; i < rows; ++i) lamp.candela.push_back(lamp.candela[i]);
    }
    return lamp;
}

}  // namespace

Photometry photometry_of(std::string_view bytes, const std::filesystem::path& file) {
    const std::string kind = extension_of(file);
    if (kind != "ies" && kind != "ldt")
        throw InputError(file, "a lamp is a file of IES LM-63 (.ies) or EULUMDAT (.ldt)");
    const std::string text = decoded_text(bytes, file);
    Photometry lamp = kind == "ies" ? ies(text, file) : ldt(text, file);
    lamp.greatest = *std::max_element(lamp.candela.begin(), lamp.candela.end());
    if (!(lamp.greatest > 0)) throw InputError(file, "the lamp gives no light: all values are 0");
    return lamp;
}

}  // namespace culet
