// All readings of a file, bound to one solid.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "fit/readings/binder.h"
#include "fit/readings/copied_rows.h"
#include "fit/readings/level_facets.h"
#include "fit/readings/reading_sizes.h"
#include "fit/readings/spreadsheet_losses.h"
#include "stone/text/errors.h"

namespace culet {

std::vector<Reading> bind_readings(const std::vector<WrittenReading>& written, const Stone& stone,
                                   std::vector<std::string>* notes) {
    const std::size_t skipped = skipped_readings(written);
    if (skipped > 0 && skipped == written.size()) {
        throw InputError(written[0].file,
                         "no row has a value yet: write what was read into the column `value`; "
                         "rows that stay empty are skipped");
    }
    refuse_lost_zeros(written, stone);
    Binder binder(stone, written);
    std::set<std::string> given;
    for (const WrittenReading& w : written) given.insert(w.id);
    std::map<std::string, const WrittenReading*> owner;
    std::vector<Reading> readings;
    const std::vector<bool> copies = copied_rows(written);
    for (std::size_t i = 0; i < written.size(); ++i) {
        if (copies[i]) continue;
        if (written[i].outlines) continue;  // they name no facets; fit_input uses them
        std::string id = written[i].id;
        if (id.empty()) {
            id = "r" + std::to_string(i);
            while (given.count(id) > 0) id += "_";
        }
        for (Reading& reading : binder.bind(written[i], id)) {
            const auto [at, fresh] = owner.emplace(reading.id, &written[i]);
            if (!fresh) {
                throw InputError(
                    written[i].file, written[i].line,
                    fmt::format("the id '{}' is taken by the reading at {}:{}", reading.id,
                                at->second->file.filename().string(), at->second->line));
            }
            readings.push_back(std::move(reading));
        }
    }
    refuse_level_azimuths(readings, stone);
    refuse_other_units(readings, stone);
    if (notes != nullptr) {
        for (std::string& note : binder.notes()) notes->push_back(std::move(note));
        const auto copied = std::count(copies.begin(), copies.end(), true);
        if (copied > 0) {
            const auto first = std::find(copies.begin(), copies.end(), true) - copies.begin();
            notes->push_back(fmt::format(
                "{} row{} another to the last digit (the first is line {}), too many for "
                "independent readings: taken as copies, they count once",
                copied, copied == 1 ? " repeats" : "s repeat", written[std::size_t(first)].line));
        }
        if (skipped > 0) {
            const auto first =
                std::find_if(written.begin(), written.end(),
                             [](const WrittenReading& reading) { return reading.skipped; });
            notes->push_back(fmt::format(
                "{} row{} without a value skipped{}", skipped, skipped == 1 ? "" : "s",
                first->line > 0 ? fmt::format(", the first in line {} of {}", first->line,
                                              first->file.filename().string())
                                : ""));
        }
    }
    return readings;
}

}  // namespace culet
