#include "fit/readings/readings_by_row.h"

#include <fmt/format.h>

#include <algorithm>

#include "stone/text/errors.h"

namespace culet {

namespace {

// How the message of an InputError for this row begins.
std::string file_and_line(const WrittenReading& written) {
    return fmt::format("{}:{}: ", written.file.string(), written.line);
}

}  // namespace

std::vector<Reading> bind_by_row(std::vector<WrittenReading>& written, const Stone& stone,
                                 std::vector<RowProblem>& problems) {
    while (skipped_readings(written) < written.size()) {
        try {
            return bind_readings(written, stone);
        } catch (const InputError& error) {
            const std::string message = error.what();
            const auto row = std::find_if(written.begin(), written.end(), [&](const auto& w) {
                return !w.skipped && w.line > 0 && message.starts_with(file_and_line(w));
            });
            if (row == written.end()) {
                problems.push_back({0, message});
                return {};
            }
            problems.push_back({row->line, message.substr(file_and_line(*row).size())});
            row->skipped = true;
            row->value.reset();
        }
    }
    return {};
}

}  // namespace culet
