#include "bench/studies/source_studies.h"

namespace culet {

const std::vector<SourceStudy>& source_studies() {
    static const std::vector<SourceStudy> all{{"guy-soler", guy_soler_page},
                                              {"voelker-hamann", voelker_hamann_page},
                                              {"lee", lee_page},
                                              {"diamond-webgl", diamond_webgl_page},
                                              {"deng", deng_page}};
    return all;
}

}  // namespace culet
