#pragma once
// Costs and savings of a ray table (Lee 2004, figs. 8.9 to 8.15).

#include "render/image/picture.h"
#include "render/scene/scene.h"

namespace culet {

struct TableCost {
    long long hits = 0, exits = 0;  ///< rays that meet the stone; exit events of their paths
    double bytes = 0;
    double make_seconds = 0;       ///< processor time, one thread
    double relight_seconds = 0;    ///< of a picture in new light
    double reference_seconds = 0;  ///< of the same picture without a table
    /// Largest difference between the two, relative to the brightest pixel.
    double difference = 0;
    Picture picture;
};

/// Uses one ray per pixel.
TableCost table_cost(const Scene& scene);

}  // namespace culet
