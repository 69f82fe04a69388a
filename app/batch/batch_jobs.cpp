#include "app/batch/batch_jobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <system_error>

#include "app/batch/batch_plan.h"
#include "stone/file_kind.h"
#include "stone/solid_input.h"
#include "stone/text/csv.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_decoding.h"
#include "stone/text/text_scan.h"
#include "stone/text/toml_file.h"

namespace culet {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t k_longest_name = 100, k_most_jobs = 1000000;

// Letters, digits, and characters that are harmless in shells, pages and file systems.
std::string plain_name(const std::string& written) {
    constexpr std::string_view k_harmless = "._-+=,@";
    const std::string text = utf8_from_windows1252(written);
    std::string name;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t start = at;
        const std::int32_t code = next_code_point(text, at);
        const bool kept = code >= 0x80 ? is_printable(code)
                                       : std::isalnum(code) != 0 ||
                                             k_harmless.find(text[start]) != std::string_view::npos;
        name += kept ? text.substr(start, at - start) : "_";
    }
    if (name.starts_with('.') || name.starts_with('-')) name[0] = '_';
    return name;
}

// Long names become their beginning and a hash of the whole.
std::string fitting(const std::string& name, BatchList& list) {
    if (name.size() <= k_longest_name) return name;
    const std::string hash = "_" + hash_of(name).substr(0, 8);
    std::size_t end = 0;
    for (std::size_t at = 0; at + hash.size() <= k_longest_name; next_code_point(name, at))
        end = at;
    list.notes.push_back(fmt::format("the name \"{}\" is longer than {} bytes: its folder is {}{}",
                                     name, k_longest_name, name.substr(0, end), hash));
    return name.substr(0, end) + hash;
}

// Why the file is not a job; empty: it is one. Unreadable files are jobs, which will fail.
std::string no_job(const fs::path& file) {
    if (is_solid_file(file)) return {};
    if (extension_of(file) != "toml") return "of another kind";
    try {
        const FileKind kind = kind_of(file);
        if (kind == FileKind::stone || kind == FileKind::unknown) return {};
        return words_for(kind);
    } catch (const InputError&) {
        return {};
    }
}

std::vector<fs::path> files_in(const fs::path& folder) {
    std::error_code problem;
    std::vector<fs::path> files;
    for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end;
         entry.increment(problem)) {
        const std::string name = entry->path().filename().string();
        if (!name.starts_with('.') && !entry->is_directory(problem)) files.push_back(entry->path());
    }
    if (problem) throw InputError(folder, fmt::format("cannot be read: {}", problem.message()));
    std::sort(files.begin(), files.end());
    return files;
}

BatchList read_folder(const fs::path& folder) {
    BatchList list;
    list.folder = folder;
    std::vector<fs::path> stones;
    std::set<fs::path> named;
    for (const fs::path& file : files_in(folder)) {
        const std::string why = no_job(file);
        if (why == "of another kind") continue;
        if (!why.empty()) {
            list.skipped.push_back(fmt::format("{}: {}", file.filename().string(), why));
            continue;
        }
        stones.push_back(file);
        for (const fs::path& other : files_of_stone(file, {}))
            if (other != file) named.insert(other.lexically_normal());
    }
    std::erase_if(stones, [&](const fs::path& file) {
        const bool mesh_of_a_stone = named.count(file.lexically_normal()) > 0;
        if (mesh_of_a_stone)
            list.skipped.push_back(
                fmt::format("{}: a stone file names it", file.filename().string()));
        return mesh_of_a_stone;
    });
    std::map<std::string, int> stems;
    for (const fs::path& file : stones) ++stems[plain_name(file.stem().string())];
    std::set<std::string> names;
    for (const fs::path& file : stones) {
        BatchJob job;
        job.stone = file.filename().string();
        job.name = plain_name(file.stem().string());
        // Keeps ring.toml and ring.asc apart.
        if (stems[job.name] > 1) job.name = plain_name(job.stone);
        job.name = fitting(job.name, list);
        if (!names.insert(job.name).second)
            throw InputError(file, fmt::format("another file of the folder is the job \"{}\" too: "
                                               "rename one of them",
                                               job.name));
        list.jobs.push_back(std::move(job));
    }
    if (list.jobs.empty())
        throw InputError(folder,
                         "has no stone in it: a batch takes stone files (.toml), cut "
                         "designs (.asc .gem .gcs) and meshes (.obj .off .ply .stl)");
    return list;
}

struct JobColumns {
    int stone = -1, name = -1, material = -1, index = -1;
    std::vector<std::pair<int, std::string>> settings;
};

JobColumns columns_of_jobs(const CsvRow& header, const fs::path& file) {
    JobColumns columns;
    std::set<std::string> seen;
    for (std::size_t i = 0; i < header.fields.size(); ++i) {
        std::string name = header.fields[i];
        if (name.empty()) continue;
        if (name.find('.') == std::string::npos) name = lower_case(name);
        if (!seen.insert(name).second)
            throw InputError(file, header.line, fmt::format("column \"{}\" appears twice", name));
        const int at = static_cast<int>(i);
        if (name == "stone") {
            columns.stone = at;
        } else if (name == "name") {
            columns.name = at;
        } else if (name == "material") {
            columns.material = at;
        } else if (name == "index") {
            columns.index = at;
        } else if (name.find('.') != std::string::npos && name.find('=') == std::string::npos) {
            columns.settings.emplace_back(at, name);
        } else {
            throw InputError(file, header.line,
                             fmt::format("unknown column \"{}\": a table of jobs has stone, and "
                                         "may have name, material, index, and keys of stone files "
                                         "as for --set (fit.meets)",
                                         name));
        }
    }
    if (columns.stone < 0)
        throw InputError(file, header.line,
                         "a table of jobs needs a column stone, with a file in each row");
    return columns;
}

BatchJob job_of_row(const CsvRow& row, const JobColumns& columns, const fs::path& file,
                    BatchList& list) {
    const auto field = [&](int at) {
        return at >= 0 && static_cast<std::size_t>(at) < row.fields.size()
                   ? row.fields[static_cast<std::size_t>(at)]
                   : std::string();
    };
    BatchJob job;
    job.stone = field(columns.stone);
    if (job.stone.empty()) throw InputError(file, row.line, "no stone in this row");
    job.material = field(columns.material);
    if (const std::string index = field(columns.index); !index.empty())
        job.index = numbers_in(index, 1, 1, "index is a refractive index")[0];
    for (const auto& [at, key] : columns.settings) {
        if (!field(at).empty()) job.set.push_back(key + "=" + field(at));
    }
    const std::string name = field(columns.name);
    job.name = name.empty() ? plain_name(fs::path(job.stone).stem().string()) : name;
    if (job.name.empty() || job.name != plain_name(job.name))
        throw InputError(file, row.line,
                         fmt::format("\"{}\" cannot be the name of a folder: letters, digits and "
                                     "._-+=,@, no point or hyphen first",
                                     job.name));
    job.name = fitting(job.name, list);
    return job;
}

BatchList read_job_table(const fs::path& file) {
    const CsvTable table = read_csv(file);
    if (table.rows.empty())
        throw InputError(file, "is empty: a table of jobs has a header with the column stone");
    if (table.rows.size() - 1 > k_most_jobs)
        throw InputError(file, fmt::format("has more than {} jobs: split it", k_most_jobs));
    const JobColumns columns = columns_of_jobs(table.rows.front(), file);
    BatchList list;
    list.folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    std::map<std::string, long> lines;
    for (std::size_t r = 1; r < table.rows.size(); ++r) {
        BatchJob job = job_of_row(table.rows[r], columns, file, list);
        const auto [first, is_new] = lines.emplace(job.name, table.rows[r].line);
        if (!is_new)
            throw InputError(file, table.rows[r].line,
                             fmt::format("the job \"{}\" appears in line {} already: give each a "
                                         "name of its own in a column name",
                                         job.name, first->second));
        list.jobs.push_back(std::move(job));
    }
    if (list.jobs.empty()) throw InputError(file, "has a header but no jobs");
    return list;
}

}  // namespace

BatchList read_batch(const fs::path& jobs) {
    std::error_code problem;
    if (!fs::exists(jobs, problem)) throw InputError(jobs, "no such folder or table");
    if (fs::is_directory(jobs, problem)) return read_folder(jobs);
    if (extension_of(jobs) == "csv") return read_job_table(jobs);
    if (const std::string other = foreign_kind_of(jobs); !other.empty())
        throw InputError(jobs, other);
    throw InputError(jobs, "is neither a folder of stones nor a table of jobs (.csv)");
}

}  // namespace culet
