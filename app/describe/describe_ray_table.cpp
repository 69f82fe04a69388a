#include <fmt/format.h>

#include "app/describe/describe.h"
#include "render/raytable/ray_table.h"

namespace culet {

Description describe_ray_table(const DescribeOptions& options) {
    const RayTable table = RayTable::open(options.file);
    const RayTableHeader& header = table.header();
    Description about;
    auto& object = about.object;
    object["format"] = "rays";
    object["width"] = header.width;
    object["height"] = header.height;
    object["samples"] = header.samples;
    object["depth"] = header.depth;
    object["facets"] = header.facets;
    object["wavelengths"] = std::vector<double>(table.parts().wavelengths_nm.begin(),
                                                table.parts().wavelengths_nm.end());
    object["rays"] = header.hits;
    object["leaves"] = header.exits;
    object["remainder"] = header.remainder;
    object["cut"] = header.cut;
    about.lines.push_back(fmt::format("{}: a ray table, for culet render --engine raytable --table",
                                      options.file.string()));
    about.lines.push_back(fmt::format("{} x {} pixels, samples {}, depth {}", header.width,
                                      header.height, header.samples, header.depth));
    about.lines.push_back(header.wavelengths == 0
                              ? std::string("one refractive index for all wavelengths")
                              : fmt::format("{} wavelengths, {} to {} nm", header.wavelengths,
                                            table.parts().wavelengths_nm.front(),
                                            table.parts().wavelengths_nm.back()));
    about.lines.push_back(fmt::format(
        "{} rays meet a stone of {} facets, and leave it at {} places; too deep {:.2g}, cut {:.2g}",
        header.hits, header.facets, header.exits, header.remainder, header.cut));
    return about;
}

}  // namespace culet
