#pragma once
// What a .gcs says beyond its published form, in which all tiers are flat.

#include <pugixml.hpp>
#include <string>

namespace culet {

struct GcsUnread {
    pugi::xml_node curved;   ///< the first tier that is cut and says that it is not flat; or empty
    std::string curved_by;   ///< its words: `radius="0.4"`
    std::string elements;    ///< "<a>, <b>": unknown ones; empty: none
    std::string attributes;  ///< "a of <tier>, b of <facet>"; likewise
};

/// Names stand once each, in the file's order.
GcsUnread gcs_unread(const pugi::xml_node& root);

}  // namespace culet
