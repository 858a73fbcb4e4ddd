// rgc: compiles a render graph. Exit codes: 0 done, 1 the input is wrong, 2 the call is wrong, 3 our fault.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>

#include "compiler/commands/command.h"
#include "compiler/commands/command_line.h"

namespace {

// RG_CHECK has said what went wrong; the exit code says whose fault it is.
void on_abort(int) { std::_Exit(rg::commands::exit_our_fault); }

void install_handlers() {
  std::signal(SIGABRT, on_abort);
  std::signal(SIGXFSZ, SIG_IGN);  // a reached file size limit becomes an error of write()
}

}  // namespace

int main(int argc, char** argv) {
  install_handlers();
  try {
    return rg::commands::run_command_line(argc, argv);
  } catch (const std::filesystem::filesystem_error& error) {
    std::fprintf(stderr, "rgc: cannot use `%s`: %s\n", error.path1().c_str(), error.code().message().c_str());
    return rg::commands::exit_input_wrong;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "rgc: internal error: %s\n", error.what());
    return rg::commands::exit_our_fault;
  }
}
