#pragma once
// Names in a sentence. Private to the room.

#include <fmt/format.h>

#include <string>
#include <vector>

namespace culet {

/// `C1, C2 and 5 more`: of a longer list, the first `most` are named.
inline std::string name_list(const std::vector<std::string>& names, std::size_t most = 8) {
    if (names.size() <= most) return fmt::format("{}", fmt::join(names, ", "));
    return fmt::format("{} and {} more",
                       fmt::join(names.begin(), names.begin() + std::ptrdiff_t(most), ", "),
                       names.size() - most);
}

}  // namespace culet
