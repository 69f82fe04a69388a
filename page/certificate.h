#pragma once
// The certificate: a fitted stone on one sheet of paper, laid out like a gemmological laboratory's
// report.

#include <string>
#include <string_view>

#include "stone/solid/solid.h"

namespace culet {

/// Empty texts are not shown.
struct Certificate {
    std::string name, material;
    std::string issuer, number, date;
    std::string logo_uri;      ///< from `logo_uri`
    std::string paper = "A4";  ///< or "letter"; the page fits both
    std::string version;       ///< of the program
    std::string picture_png;   ///< bytes
    std::string fit_json;      ///< as written by `culet fit --report`
    Solid stone;               ///< fitted, table up
};

/// Uses no scripts and, like every page, loads nothing. Throws InputError if the fit report is not
/// a JSON object.
std::string certificate_page(const Certificate& certificate);

/// A data URI of a PNG, JPEG or SVG file's bytes; empty if they are none of these.
std::string logo_uri(std::string_view bytes);

}  // namespace culet
