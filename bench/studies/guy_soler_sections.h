#pragma once
// The sections of the page on Guy & Soler, Graphics Gems Revisited (2004).

#include "bench/studies/parameters.h"
#include "bench/studies/source_page.h"

namespace culet {

// guy_soler_optics.cpp: numbers for one face, one ray.
void write_wave_angles(SourcePage& page);
void write_face_powers(SourcePage& page, Parameters& parameters);
void write_absorption(SourcePage& page, Parameters& parameters);

// guy_soler_pictures.cpp: whole stones.
void write_linearised_refraction(SourcePage& page, Parameters& parameters);
void write_dispersion_trees(SourcePage& page, Parameters& parameters);
void write_facet_trees(SourcePage& page, Parameters& parameters);
void write_stones(SourcePage& page, Parameters& parameters);

}  // namespace culet
