#pragma once
// The report of `culet spin`: the stone turning beside its photographs, then what was found.

#include <array>
#include <string>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

struct SpinPage {
    std::string version, title;
    std::string verdict;  ///< why it is not to be trusted, and what to do; empty: it can be
    Solid solid;
    std::vector<bool> seen;     ///< by facet
    int width = 0, height = 0;  ///< of the photographs, pixels
    struct Frame {
        std::string name, uri;  ///< the photograph as a data URI
        bool held_out = false;
        double median_px = 0;  ///< of the edge's places from the stone's outline
        /// X of `solid` falls on the pixel (u / w, v / w), (u, v, w) = projection (X, 1).
        std::array<std::array<double, 4>, 3> projection{};
    };
    std::vector<Frame> frames;
    struct Row {
        std::string name, value, sigma, halves;
        bool read = false;
    };
    std::vector<Row> proportions;
    std::vector<std::string> facts;  ///< sentences
    std::string beside_uri;          ///< frames left out, their renders beside them; empty: none
};

std::string spin_page(const SpinPage& page);

}  // namespace culet
