#include "fit/readings/silhouette_tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "fit/silhouettes/contour_files.h"
#include "fit/silhouettes/silhouette.h"
#include "stone/text/errors.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

SilhouetteSet set_of(const TomlTable& table, LengthUnit unit, double sigma) {
    SilhouetteSet set;
    const std::string frame = table.text("frame").value_or("mesh");
    if (frame != "mesh" && frame != "free") {
        table.fail("frame", fmt::format("frame is \"{}\"; expected mesh or free", shown(frame)));
    }
    set.is_free = frame == "free";
    const auto file = table.path("file");
    if (!file) {
        const auto direction = table.vector("direction");
        const auto points = table.vectors("points");
        if (!direction || !points) {
            table.fail("",
                       "a [[silhouette]] needs file = \"contours.json\", or direction = [x, y, z] "
                       "and points = [[x, y, z], ...]");
        }
        try {
            set.contours.push_back(contour_of_polygon(*direction, *points, sigma, 1));
        } catch (const InputError& error) {
            table.fail("points", error.what());
        }
        return set;
    }
    if (table.has("points") || table.has("direction")) {
        table.fail("file", "give file, or direction and points, not both");
    }
    const std::string format =
        table.text("format").value_or(file->extension() == ".dat" ? "shadow_contours" : "contours");
    if (format == "shadow_contours") {
        ShadowContours read = read_shadow_contours(*file, unit, sigma);
        set.contours = std::move(read.contours);
        set.parts_left_out = read.sides_left_out;
    } else if (format == "contours") {
        set.contours = read_contours(*file, unit, sigma);
    } else {
        table.fail("format", fmt::format("format is \"{}\"; expected contours or shadow_contours",
                                         shown(format)));
    }
    return set;
}

}  // namespace

std::vector<WrittenReading> read_silhouettes(const TomlTable& root) {
    std::vector<WrittenReading> all;
    const auto stone = root.table("stone");
    const LengthUnit unit =
        length_unit(stone ? stone->text("unit").value_or("mm") : "mm").value_or(LengthUnit::mm);
    for (const TomlTable& table : root.tables("silhouette")) {
        table.refuse_unknown(
            {"file", "format", "direction", "points", "sigma", "frame", "id", "note", "hold_out"});
        WrittenReading reading;
        reading.kind = name_of(ReadingKind::silhouette);
        reading.id = table.text("id").value_or("");
        reading.note = table.text("note").value_or("");
        reading.file = table.file();
        reading.line = table.line();
        reading.sigma = table.number("sigma");
        if (reading.sigma && !(*reading.sigma > 0)) {
            table.fail("sigma",
                       "sigma must be positive (one standard uncertainty across the "
                       "outline); leave it out to have it estimated");
        }
        SilhouetteSet set = set_of(table, unit, reading.sigma.value_or(0));
        if (const auto every = table.integer("hold_out")) {
            if (*every < 2 || std::size_t(*every) > set.contours.size()) {
                table.fail("hold_out",
                           "hold_out = N keeps every Nth outline out of the fit, to hold it "
                           "against the result: 2 or more, and no more than there are outlines");
            }
            std::vector<Contour> kept;
            for (std::size_t i = 0; i < set.contours.size(); ++i) {
                auto& to = std::int64_t(i + 1) % *every == 0 ? set.held_out : kept;
                to.push_back(std::move(set.contours[i]));
            }
            set.contours = std::move(kept);
        }
        reading.outlines = std::make_shared<const SilhouetteSet>(std::move(set));
        all.push_back(std::move(reading));
    }
    return all;
}

}  // namespace culet
