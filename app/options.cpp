#include "app/options.h"

namespace culet {

void add_common(CLI::App& command, CommonOptions& options, bool reads_toml) {
    command.add_flag("-q,--quiet", options.quiet, "no messages but errors");
    command.add_flag("-v,--verbose", options.verbose, "say more");
    command.add_option("--threads", options.threads, "worker threads (0: all processors)")
        ->check(CLI::Range(0, 4096))
        ->type_name("N");
    command.add_option("--seed", options.seed, "seed of everything random")->type_name("N");
    if (reads_toml) {
        command.add_option("--set", options.set, "override a key of the file, e.g. render.depth=8")
            ->type_name("KEY=VALUE")
            ->allow_extra_args(false);
    }
}

}  // namespace culet
