// The command line of rgc: words to options to commands.
#pragma once

namespace rg::commands {

// Runs the command that `argv` names and gives the exit code.
int run_command_line(int argc, char** argv);

}  // namespace rg::commands
