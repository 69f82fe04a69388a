#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>

#include "render/image/codecs/codecs.h"
#include "stone/text/errors.h"

// Portable float maps (P. Debevec): `PF` (R, G, B) or `Pf` (grey), columns, rows, and a scale that
// multiplies the values and is negative for little endian; then rows from the bottom.

namespace culet {

namespace {

constexpr std::string_view k_blanks = " \t\r\n";

// Takes the header's next word and one blank after it.
std::string_view next_word(std::string_view& rest) {
    rest.remove_prefix(std::min(rest.find_first_not_of(k_blanks), rest.size()));
    const std::size_t end = std::min(rest.find_first_of(k_blanks), rest.size());
    const std::string_view word = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    return word;
}

template <class Number>
Number number_of(std::string_view word) {
    Number value = 0;
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
    return problem == std::errc() && end == word.data() + word.size() ? value : Number{0};
}

}  // namespace

DecodedPixels decode_pfm(const std::string& bytes, const std::filesystem::path& file) {
    std::string_view rest = bytes;
    const std::string_view kind = next_word(rest);
    const auto columns = number_of<std::uint32_t>(next_word(rest)),
               rows = number_of<std::uint32_t>(next_word(rest));
    const double scale = number_of<double>(next_word(rest));
    check_size(columns, rows, bytes.size(), "PFM", file);
    if ((kind != "PF" && kind != "Pf") || scale == 0 || !std::isfinite(scale)) {
        throw InputError(file,
                         "is an unusual PFM (expected PF or Pf, columns, rows and a scale): "
                         "save it again with another program");
    }
    const std::size_t channels = kind == "PF" ? 3 : 1;
    const std::size_t row = columns * channels, row_bytes = row * sizeof(float);
    // Lines may end in CR LF, of which only one blank has been taken.
    if (rest.starts_with('\n') && rest.size() == rows * row_bytes + 1) rest.remove_prefix(1);
    if (rest.size() / row_bytes < rows) throw InputError(file, "is a PFM that is cut off");
    std::vector<float> samples(row * rows);
    for (std::size_t y = 0; y < rows; ++y)
        std::memcpy(samples.data() + (rows - 1 - y) * row, rest.data() + y * row_bytes, row_bytes);
    const bool swapped = (scale < 0) != (std::endian::native == std::endian::little);
    for (float& sample : samples) {
        auto* const raw = reinterpret_cast<char*>(&sample);
        if (swapped) std::reverse(raw, raw + sizeof sample);
    }
    DecodedPixels result{static_cast<int>(columns),
                         static_cast<int>(rows),
                         static_cast<int>(channels),
                         std::move(samples),
                         {}};
    result.meaning.factor.fill(static_cast<float>(std::abs(scale)));
    if (std::abs(scale) != 1) {
        result.meaning.notes.push_back(fmt::format(
            "its values are multiplied by its scale, {:g}, as its format says", std::abs(scale)));
    }
    return result;
}

std::string encode_pfm(int width, int height, std::span<const float> values) {
    const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
    check(width > 0 && height > 0 && values.size() == columns * rows,
          "a picture to be packed as PFM has all its samples");
    std::string bytes = fmt::format("Pf\n{} {}\n{}\n", width, height,
                                    std::endian::native == std::endian::little ? "-1.0" : "1.0");
    for (std::size_t y = rows; y-- > 0;) {
        bytes.append(reinterpret_cast<const char*>(values.data() + y * columns),
                     columns * sizeof(float));
    }
    return bytes;
}

}  // namespace culet
