#pragma once
// Options that mean the same for every command, and the exit codes.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace culet {

/// Scripts rely on these.
enum ExitCode : int {
    exit_good = 0,
    exit_untrusted = 1,   ///< done, but the answer should not be trusted; outputs are written
    exit_impossible = 2,  ///< wrong usage or input; nothing is written
    exit_internal = 3,    ///< a bug of ours
    exit_interrupted = 130
};

struct CommonOptions {
    int threads = 0;  ///< 0: all processors
    std::uint64_t seed = 1;
    bool quiet = false, verbose = false;
    std::vector<std::string> set;  ///< `key.path=value`
};

/// Adds -q, -v, --threads, --seed and, for commands that read TOML, --set.
void add_common(CLI::App& command, CommonOptions& options, bool reads_toml = false);

/// The command line as text, for pages to say how they were made.
std::string as_given(const CLI::App& command);

/// Reads "1,2,3" as `least` to `most` numbers. `expected` describes the option in errors. Throws
/// InputError.
std::vector<double> numbers_in(const std::string& text, std::size_t least, std::size_t most,
                               const std::string& expected);

/// Each registers one subcommand, whose callback stores the exit code and throws InputError,
/// InternalError or Interrupted. Commands only parse, call and write: no formulas.
void add_command_fit(CLI::App& program, int& exit_code);
void add_command_register(CLI::App& program, int& exit_code);
void add_command_render(CLI::App& program, int& exit_code);
void add_command_compare(CLI::App& program, int& exit_code);
void add_command_refine(CLI::App& program, int& exit_code);
void add_command_camera(CLI::App& program, int& exit_code);
void add_command_outline(CLI::App& program, int& exit_code);
void add_command_spin(CLI::App& program, int& exit_code);
void add_command_photo(CLI::App& program, int& exit_code);
void add_command_light(CLI::App& program, int& exit_code);
void add_command_cut(CLI::App& program, int& exit_code);
void add_command_convert(CLI::App& program, int& exit_code);
void add_command_info(CLI::App& program, int& exit_code);
void add_command_probe(CLI::App& program, int& exit_code);
void add_command_run(CLI::App& program, int& exit_code);
void add_command_setting(CLI::App& program, int& exit_code);
void add_command_grade(CLI::App& program, int& exit_code);
void add_command_optimize(CLI::App& program, int& exit_code);
void add_command_study(CLI::App& program, int& exit_code);
void add_command_batch(CLI::App& program, int& exit_code);
void add_command_view(CLI::App& program, int& exit_code);
void add_command_studio(CLI::App& program, int& exit_code);
void add_command_help(CLI::App& program, int& exit_code);

}  // namespace culet
