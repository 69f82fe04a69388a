#pragma once
// The contents of a viewer page: stones, scenes and small pictures, as JSON (docs/viewer.md, "The
// document").

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "page/fit_facts.h"
#include "stone/stone.h"
#include "stone/text/toml_file.h"

namespace culet {

struct CutChoice {
    std::string kind;
    std::map<std::string, double> values;
};

struct ViewedStone {
    std::string role = "stone";  ///< stone, fitted, catalogue, design
    Stone stone;
    std::optional<CutChoice> cut;
    std::vector<FacetFacts> fit;  ///< one per facet, or empty
};

struct ViewItem {
    std::string name;
    std::vector<ViewedStone> stones;
    std::string scene;    ///< a scene file without its stone (TOML)
    HeldFiles files;      ///< files that the scene names
    std::string picture;  ///< data:image/png;base64,...
    std::string refused;  ///< why beams cannot draw it; empty: they can
    std::string command;  ///< `culet render ...` up to the file; the page appends --set
};

struct ViewDocument {
    std::string title, version;
    int first = 0;
    std::vector<ViewItem> items;
};

/// The standard cuts, as pages have them: JSON, a list of name, summary, convex and parameters.
std::string cut_list_json();

/// Schema "culet-view-1"; numbers are exact.
std::string document_json(const ViewDocument& document);

/// One item of a document. Throws InputError if it is not a document, or has no such item.
ViewItem read_view_item(std::string_view document, int item);

}  // namespace culet
