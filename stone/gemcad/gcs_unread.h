#pragma once
// What a .gcs says beyond its published form, in which all tiers are flat.

#include <pugixml.hpp>
#include <string>

namespace culet {

struct GcsUnread {
    pugi::xml_node curved;   ///< the first tier that is cut and says that it is not flat; or empty
    std::string curved_by;   ///< its words: `radius="0.4"`
    std::string elements;    ///< unknown ones, in angle brackets, with commas; empty: none
    std::string attributes;  ///< likewise, each with its element
};

/// Names stand once each, in the file's order.
GcsUnread gcs_unread(const pugi::xml_node& root);

}  // namespace culet
