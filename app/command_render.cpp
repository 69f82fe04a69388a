#include "app/options.h"

namespace culet {

void add_command_render(CLI::App& program, int& exit_code) {
    (void)program;
    (void)exit_code;
}

}  // namespace culet
