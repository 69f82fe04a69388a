#include "app/batch/batch_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>

#include "app/batch/batch_folder.h"
#include "app/batch/batch_plan.h"
#include "app/batch/batch_work.h"
#include "app/program/options.h"
#include "page/batch_page.h"
#include "stone/numbers/quantile.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace fs = std::filesystem;

namespace {

using TableJson = nlohmann::ordered_json;

constexpr const char* k_parts[] = {"fit", "grade"};

TableJson record_of(const fs::path& folder, const BatchJob& job) {
    const fs::path file = job_folder(folder, job.name) / k_job_record;
    std::error_code problem;
    if (fs::exists(file, problem)) {
        TableJson record = TableJson::parse(read_text(file), nullptr, false);
        if (record.is_object()) return record;
    }
    return {{"name", job.name},
            {"stone", job.stone},
            {"status", "missing"},
            {"exit_code", nullptr},
            {"message", "not finished: go on with --resume"}};
}

double number_in(const TableJson& record, const char* part, const char* key) {
    const auto table = record.find(part);
    if (table == record.end() || !table->is_object()) return std::nan("");
    const auto value = table->find(key);
    return value != table->end() && value->is_number() ? value->get<double>() : std::nan("");
}

// Distance of each light return from the median, in units of 1.4826 times the median deviation (a
// normal distribution's sigma).
std::vector<double> deviations(const std::vector<TableJson>& records) {
    constexpr std::size_t k_fewest = 8;  // with fewer, none counts as unusual
    std::vector<double> known;
    for (const TableJson& record : records) {
        const double value = number_in(record, "grade", "iso");
        if (std::isfinite(value)) known.push_back(value);
    }
    std::vector<double> result(records.size(), 0);
    if (known.size() < k_fewest) return result;
    const double middle = quantile(known, 0.5);
    for (double& value : known) value = std::abs(value - middle);
    const double usual = 1.4826 * quantile(known, 0.5);
    for (std::size_t i = 0; i < records.size(); ++i) {
        const double value = number_in(records[i], "grade", "iso");
        if (std::isfinite(value) && usual > 0) result[i] = std::abs(value - middle) / usual;
    }
    return result;
}

int urgency(const TableJson& record) {
    const std::string status = record.value("status", "");
    if (status == "failed") return 3;
    if (status == "missing") return 2;
    const auto code = record.find("exit_code");
    return code != record.end() && *code == exit_good ? 0 : 1;
}

// Collects the names that any job has, in the order of their first job.
std::vector<std::string> names_in(const std::vector<TableJson>& records, const char* part) {
    std::vector<std::string> names;
    for (const TableJson& record : records) {
        const auto table = record.find(part);
        if (table == record.end() || !table->is_object()) continue;
        for (const auto& [name, value] : table->items()) {
            if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        }
    }
    return names;
}

std::string csv_field(const TableJson& value) {
    if (value.is_null()) return {};
    if (!value.is_string()) return value.dump();
    std::string text = value.get<std::string>();
    // Spreadsheets would take these for formulas.
    if (!text.empty() && std::string_view("=+-@").find(text[0]) != std::string_view::npos)
        text.insert(0, 1, '\'');
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::string table_csv(const std::vector<TableJson>& rows) {
    constexpr const char* k_first[] = {"name",      "stone",   "status",
                                       "exit_code", "outlier", "message"};
    std::vector<std::pair<const char*, std::string>> figures;
    for (const char* part : k_parts) {
        for (std::string& name : names_in(rows, part)) figures.emplace_back(part, std::move(name));
    }
    std::string text;
    for (const char* name : k_first) text += fmt::format("{}{}", text.empty() ? "" : ",", name);
    for (const auto& [part, name] : figures) text += fmt::format(",{}.{}", part, name);
    text += "\n";
    for (const TableJson& row : rows) {
        std::string line;
        for (const char* name : k_first)
            line += fmt::format("{}{}", name == k_first[0] ? "" : ",",
                                csv_field(row.value(name, TableJson())));
        for (const auto& [part, name] : figures) {
            const TableJson table = row.value(part, TableJson::object());
            line += "," + csv_field(table.value(name, TableJson()));
        }
        text += line + "\n";
    }
    return text;
}

BatchCounts counted(const std::vector<TableJson>& rows) {
    BatchCounts counts;
    for (const TableJson& row : rows) {
        const int rank = urgency(row);
        ++(rank == 3   ? counts.failed
           : rank == 2 ? counts.missing
           : rank == 1 ? counts.untrusted
                       : counts.good);
    }
    return counts;
}

BatchPageJob page_job(const TableJson& row, const fs::path& folder, bool with_picture) {
    BatchPageJob job;
    job.name = row.value("name", "");
    job.status = row.value("status", "");
    job.message = row.value("message", "");
    job.outlier = row.value("outlier", 0.0);
    job.worst_reading = number_in(row, "fit", "worst_normalized");
    job.chi2 = number_in(row, "fit", "chi2");
    job.dof = number_in(row, "fit", "dof");
    job.light_return = number_in(row, "grade", "iso");
    job.fire = number_in(row, "grade", "fire.separated");
    job.leak = number_in(row, "grade", "balance.leak");
    job.good = urgency(row) == 0;
    std::error_code problem;
    const fs::path home = job_folder(folder, job.name);
    for (const char* file : {"fit.html", "grade.html", "fit.json", "grade.json", "fitted.obj"}) {
        if (fs::exists(home / file, problem)) job.files.emplace_back(file);
    }
    if (with_picture && fs::exists(home / "stone.png", problem))
        job.png = read_text(home / "stone.png");
    return job;
}

std::string page_of(const std::vector<TableJson>& rows, const BatchCounts& counts,
                    const fs::path& folder) {
    // More would make the page slow to open.
    constexpr std::size_t k_most_pictures = 1000;
    std::vector<const TableJson*> order;
    for (const TableJson& row : rows) order.push_back(&row);
    std::stable_sort(order.begin(), order.end(), [](const TableJson* a, const TableJson* b) {
        const int first = urgency(*a), second = urgency(*b);
        return first != second ? first > second
                               : a->value("outlier", 0.0) > b->value("outlier", 0.0);
    });
    BatchPage page;
    page.version = CULET_VERSION;
    page.good = counts.good;
    page.untrusted = counts.untrusted;
    page.failed = counts.failed;
    page.missing = counts.missing;
    for (const TableJson* row : order)
        page.jobs.push_back(page_job(*row, folder, page.jobs.size() < k_most_pictures));
    return batch_page(page);
}

}  // namespace

MergedBatch merge_batch(const fs::path& folder) {
    const fs::path plan = folder / k_plan_file;
    std::error_code problem;
    if (!fs::exists(plan, problem))
        throw InputError(folder, "holds no batch: it has no jobs.json (culet batch JOBS -o DIR)");
    remove_unfinished(folder);
    std::vector<TableJson> rows;
    for (const BatchJob& job : jobs_of_plan(read_text(plan), plan))
        rows.push_back(record_of(folder, job));
    const std::vector<double> far = deviations(rows);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double worst = number_in(rows[i], "fit", "worst_normalized");
        rows[i]["outlier"] = std::max(far[i], std::isfinite(worst) ? worst : 0);
    }
    MergedBatch merged;
    merged.counts = counted(rows);
    for (const TableJson& row : rows) {
        if (urgency(row) == 3 || urgency(row) == 1)
            merged.complaints.push_back(
                fmt::format("{}: {}", row.value("name", ""), row.value("message", "")));
    }
    TableJson table{{"schema", 1},
                    {"version", CULET_VERSION},
                    {"counts",
                     {{"good", merged.counts.good},
                      {"untrusted", merged.counts.untrusted},
                      {"failed", merged.counts.failed},
                      {"missing", merged.counts.missing}}},
                    {"jobs", rows}};
    const BatchFolder home(folder, "table");
    home.write("table.csv", table_csv(rows));
    home.write("table.json", table.dump(1, ' ', false, TableJson::error_handler_t::replace) + "\n");
    home.write("index.html", page_of(rows, merged.counts, folder));
    return merged;
}

}  // namespace culet
