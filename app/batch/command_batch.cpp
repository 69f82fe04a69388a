// culet batch JOBS -o DIR: fits and grades many stones, on one machine or many.

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <system_error>

#include "app/batch/batch_folder.h"
#include "app/batch/batch_jobs.h"
#include "app/batch/batch_table.h"
#include "app/batch/batch_workers.h"
#include "app/grade/graded.h"
#include "app/program/options.h"
#include "app/program/terminal.h"
#include "stone/material/material_io.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

namespace fs = std::filesystem;

struct BatchCommand {
    CommonOptions common;
    std::string jobs, out, shard, merge;
    BatchSettings settings;
    bool resume = false;
};

// Reports before the first job what would make all of them fail.
void check_settings(const BatchSettings& settings) {
    grade_options(settings.head_deg, settings.tilts);
    if (settings.index && !(*settings.index > 1 && *settings.index < 10))
        throw InputError(
            fmt::format("--index is a refractive index above 1, found {:g}", *settings.index));
    if (settings.material.empty()) return;
    if (fs::path(settings.material).extension() == ".toml") {
        read_material(settings.material);
    } else {
        catalogue_material(settings.material);
    }
}

// Results among the inputs would be inputs of the next run; inputs among the results would be lost.
void refuse_jobs_inside(const fs::path& jobs, const fs::path& out) {
    std::error_code problem;
    const fs::path results = fs::weakly_canonical(out, problem);
    for (fs::path at = fs::weakly_canonical(jobs, problem); !at.empty(); at = at.parent_path()) {
        if (at == results && (at != fs::weakly_canonical(jobs.parent_path(), problem) ||
                              fs::is_directory(jobs, problem)))
            throw InputError(out, fmt::format("-o holds the jobs themselves ({}): give the results "
                                              "a folder of their own",
                                              jobs.string()));
        if (at == at.parent_path()) break;
    }
}

int tell(const MergedBatch& merged, const fs::path& folder, bool quiet) {
    constexpr std::size_t k_most_listed = 10;
    const BatchCounts& counts = merged.counts;
    std::string text = fmt::format("{} jobs: {} good", counts.all(), counts.good);
    if (counts.untrusted > 0) text += fmt::format(", {} not to be trusted", counts.untrusted);
    if (counts.failed > 0) text += fmt::format(", {} failed", counts.failed);
    if (counts.missing > 0) text += fmt::format(", {} not finished", counts.missing);
    say(text, quiet);
    const std::size_t told = std::min(merged.complaints.size(), k_most_listed);
    for (std::size_t i = 0; i < told; ++i) say("  " + merged.complaints[i], quiet);
    if (merged.complaints.size() > told)
        say(fmt::format("  and {} more, all in the table", merged.complaints.size() - told), quiet);
    print_lines((folder / "index.html").string());
    const std::string next = counts.missing > 0
                                 ? "culet batch JOBS -o {} --resume (what is missing)"
                                 : "open {}/index.html in a browser";
    say("next: " + fmt::format(fmt::runtime(next), folder.string()), quiet);
    return counts.good == counts.all() ? exit_good : exit_untrusted;
}

int run_batch(BatchCommand& command) {
    if (!command.merge.empty()) {
        const bool other = !command.jobs.empty() || !command.out.empty() ||
                           !command.shard.empty() || command.resume;
        if (other)
            throw InputError("give --merge DIR alone: it tabulates the results already there");
        return tell(merge_batch(command.merge), command.merge, command.common.quiet);
    }
    if (command.jobs.empty() || command.out.empty())
        throw InputError(
            "culet batch takes a folder of stones or a table of jobs and -o DIR, or "
            "--merge DIR alone");
    BatchSettings& settings = command.settings;
    settings.seed = command.common.seed;
    settings.set = command.common.set;
    check_settings(settings);
    ShareOptions options;
    options.share = share_in(command.shard);
    options.workers = command.common.threads;
    options.resume = command.resume;
    options.quiet = command.common.quiet;
    options.verbose = command.common.verbose;
    const BatchList list = read_batch(command.jobs);
    refuse_jobs_inside(command.jobs, command.out);
    for (const std::string& note : list.notes) say("note: " + note, command.common.quiet);
    for (const std::string& skipped : list.skipped)
        say("left out: " + skipped, !command.common.verbose);
    const ShareResult result = work_on_share(list, settings, command.out, options);
    say(fmt::format("{} jobs done in {:.1f} s, {:.1f} s of processor time{}", result.worked,
                    result.seconds, result.cpu_seconds,
                    result.kept > 0 ? fmt::format(", {} were there already", result.kept) : ""),
        options.quiet);
    if (options.share.of == 1) return tell(merge_batch(command.out), command.out, options.quiet);
    say(fmt::format("next: when all shares are done, culet batch --merge {}", command.out),
        options.quiet);
    return result.bad == 0 ? exit_good : exit_untrusted;
}

}  // namespace

void add_command_batch(CLI::App& program, int& exit_code) {
    auto command = std::make_shared<BatchCommand>();
    CLI::App* batch = program.add_subcommand(
        "batch", "many stones fitted and graded, on all processors, or shared out over machines");
    BatchSettings& settings = command->settings;
    batch
        ->add_option("jobs", command->jobs,
                     "folder of stone files, cut designs and meshes, or a table with a row a job")
        ->type_name("JOBS");
    batch->add_option("-o,--output", command->out, "folder for the results")->type_name("DIR");
    batch
        ->add_option("--shard", command->shard,
                     "one share of the jobs: K from 0 to N - 1; all shares write to one folder")
        ->type_name("K/N");
    batch->add_flag(
        "--resume", command->resume,
        "continue a batch: finished jobs whose files and settings have not changed are kept");
    batch
        ->add_option("--merge", command->merge,
                     "table.csv, table.json and index.html of all results in the folder")
        ->type_name("DIR");
    batch
        ->add_option("--material", settings.material,
                     "for all stones, not their own: a name or a file")
        ->type_name("NAME");
    batch->add_option("--index", settings.index, "refractive index, instead of the material's")
        ->type_name("N");
    batch->add_option("--head", settings.head_deg, "half angle of the viewer's head, degrees (10)")
        ->type_name("DEG");
    batch
        ->add_option("--tilts", settings.tilts,
                     "tilts of the grades, degrees: FROM:TO:STEP or a list (-30:30:10)")
        ->type_name("TILTS");
    batch
        ->add_option("--draws", settings.draws, "random stones for a grade's sigmas (0: no sigmas)")
        ->check(CLI::Range(0, 100000))
        ->type_name("N");
    batch->add_flag("--pages", settings.pages, "a page of every fit and every grade as well");
    add_common(*batch, command->common, true);
    batch->footer(
        "Examples:\n"
        "  culet batch stones -o out\n"
        "  culet batch jobs.csv -o out --shard 3/50 --resume\n"
        "  culet batch --merge out");
    batch->callback([command, &exit_code] { exit_code = run_batch(*command); });
}

}  // namespace culet
