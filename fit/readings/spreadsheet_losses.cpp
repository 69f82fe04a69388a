#include "fit/readings/spreadsheet_losses.h"

#include <fmt/format.h>

#include <map>
#include <regex>
#include <set>

#include "stone/text/errors.h"

namespace culet {

std::string date_words(const std::string& name) {
    static const std::regex date(
        "([0-9]{1,2}[-. ])?(jan|feb|mar|apr|may|jun|jul|aug|sep|oct|nov|dec)[a-z]*([-. "
        "][0-9]{1,4})?|"
        "[0-9]{4}-[0-9]{2}-[0-9]{2}.*|[0-9]{1,2}[./][0-9]{1,2}[./][0-9]{4}",
        std::regex::icase);
    if (!std::regex_match(name, date)) return {};
    return fmt::format(
        "the mesh has no facet '{}': a spreadsheet makes a date of 1.2 or 1-2. Format the column "
        "`of` as text before the names are entered, or name facets by tier and index (1@76)",
        name);
}

void refuse_lost_zeros(const std::vector<WrittenReading>& written, const Stone& stone) {
    static const std::regex numbered("[0-9]+\\.[0-9]+");
    std::map<std::pair<std::string, std::string>, const WrittenReading*> first;
    std::set<std::pair<std::string, std::string>> named;
    for (const WrittenReading& w : written) {
        if (w.of.size() == 1) named.insert({w.kind, w.of[0]});
    }
    for (const WrittenReading& w : written) {
        if (w.of.size() != 1 || w.skipped || !std::regex_match(w.of[0], numbered)) continue;
        const auto [at, fresh] = first.emplace(std::pair(w.kind, w.of[0]), &w);
        const std::string whole = w.of[0] + "0";
        if (fresh || find_facet(stone.solid, whole) < 0 || named.count({w.kind, whole}) > 0)
            continue;
        throw InputError(
            w.file, w.line,
            fmt::format(
                "{} of '{}' appears in line {} too, and '{}' in none: a spreadsheet drops the "
                "zero. Format the column `of` as text, or name facets by tier and index (1@76)",
                w.kind, w.of[0], at->second->line, whole));
    }
}

}  // namespace culet
