#pragma once
// The studies of culet's sources. Each makes a page.

#include <vector>

#include "bench/studies/parameters.h"
#include "bench/studies/source_page.h"
#include "stone/progress/progress.h"

namespace culet {

struct SourceStudy {
    const char* name;  ///< of its page, and of its table in parameters.toml
    SourcePage (*make)(Parameters& parameters);
};

const std::vector<SourceStudy>& source_studies();

SourcePage guy_soler_page(Parameters& parameters);
SourcePage voelker_hamann_page(Parameters& parameters);
SourcePage lee_page(Parameters& parameters);
SourcePage diamond_webgl_page(Parameters& parameters);
SourcePage deng_page(Parameters& parameters);

}  // namespace culet
