#include "bench/studies/guy_soler_sections.h"
#include "bench/studies/source_studies.h"

namespace culet {

SourcePage guy_soler_page(Parameters& parameters) {
    SourcePage page("guy-soler", "Guy & Soler 2004, reproduced",
                    "S. Guy and C. Soler, Graphics Gems Revisited: Fast and Physically-Based "
                    "Rendering of Gemstones, ACM Transactions on Graphics 23(3), 2004");
    write_wave_angles(page);
    write_face_powers(page, parameters);
    write_linearised_refraction(page, parameters);
    write_dispersion_trees(page, parameters);
    write_facet_trees(page, parameters);
    write_stones(page, parameters);
    write_absorption(page, parameters);
    return page;
}

}  // namespace culet
