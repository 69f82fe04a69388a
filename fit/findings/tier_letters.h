#pragma once
// What a facet is called but for its number. Private to the room.

#include <string>

namespace culet {

/// `C` of C12; nothing where the name is a number.
inline std::string tier_letters(const std::string& name) {
    return name.substr(0, name.find_last_not_of("0123456789") + 1);
}

}  // namespace culet
