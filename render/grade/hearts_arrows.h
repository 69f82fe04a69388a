#pragma once
// Hearts and arrows, found and measured in the maps of the two scopes.
//
// Arrows (face up): patches near the rim that show the eye's hole, the heads, each with a shaft
// towards the middle. Hearts (from the pavilion): patches that show the reflector between the
// arrows. A patch is a connected part of the map where that band is brightest; patches of less than
// 0.4 of the largest of their kind do not count.

#include <vector>

#include "render/grade/scope_map.h"

namespace culet {

struct Arrow {
    double azimuth = 0;  ///< of its head, radians, counter-clockwise in the map
    double head = 0;     ///< areas over the silhouette's
    double shaft = 0;    ///< what shows the hole between the head and the middle
    double axis = 0;     ///< part of the shaft's middle line that does
};

struct Arrows {
    int count = 0;        ///< complete ones: at least half of the shaft's middle line is dark
    double evenness = 0;  ///< smallest over largest area of head and shaft; 1: all alike, 0: none
    double area = 0;      ///< mean of an arrow, over the silhouette's
    std::vector<Arrow> list;  ///< one a head, in order of azimuth
};
Arrows find_arrows(const ScopeMap& map);

struct Heart {
    double azimuth = 0;  ///< of its middle
    double area = 0;     ///< over the silhouette's
    double width = 0;    ///< angle that it spans, radians
    /// How much farther out the lower of its two lobes reaches than the middle between them, over
    /// the stone's radius. Not above 0: it has no cleft.
    double cleft = 0;
};

struct Hearts {
    int count = 0;              ///< with a cleft
    double evenness = 0;        ///< smallest over largest area; 1: all alike, 0: none
    double cleft = 0;           ///< mean
    double cleft_evenness = 0;  ///< smallest over largest cleft
    double area = 0;            ///< mean, over the silhouette's
    std::vector<Heart> list;    ///< all patches, in order of azimuth
};
Hearts find_hearts(const ScopeMap& map);

}  // namespace culet
