#pragma once
// Finds and measures hearts and arrows in the maps of the two scopes.
//
// Arrows (face up): patches near the rim that show the eye's hole (heads), each with a shaft
// towards the middle. Hearts (from the pavilion): patches between the arrows that show the
// reflector. A patch is a connected region where that band is brightest; those below 0.4 of the
// largest of their kind do not count.

#include <vector>

#include "render/grade/scope_map.h"

namespace culet {

struct Arrow {
    double azimuth = 0;  ///< of its head, radians, counter-clockwise in the map
    double head = 0;     ///< areas relative to the silhouette's
    double shaft = 0;    ///< area that shows the hole between head and middle
    double axis = 0;     ///< part of the shaft's centre line that shows the hole
};

struct Arrows {
    int count = 0;        ///< complete arrows: at least half of the shaft's centre line is dark
    double evenness = 0;  ///< smallest over largest area of head and shaft; 1: all equal, 0: none
    double area = 0;      ///< mean area of an arrow, relative to the silhouette's
    std::vector<Arrow> list;  ///< one per head, by azimuth
};
Arrows find_arrows(const ScopeMap& map);

struct Heart {
    double azimuth = 0;  ///< of its centre
    double area = 0;     ///< relative to the silhouette's
    double width = 0;    ///< angle that it subtends, radians
    /// How much farther out the shorter of its two lobes reaches than the middle between them,
    /// relative to the stone's radius. 0 or less: no cleft.
    double cleft = 0;
};

struct Hearts {
    int count = 0;              ///< with a cleft
    double evenness = 0;        ///< smallest over largest area; 1: all equal, 0: none
    double cleft = 0;           ///< mean
    double cleft_evenness = 0;  ///< smallest over largest cleft
    double area = 0;            ///< mean, relative to the silhouette's
    std::vector<Heart> list;    ///< all patches, by azimuth
};
Hearts find_hearts(const ScopeMap& map);

}  // namespace culet
