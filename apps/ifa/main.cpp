// SPDX-License-Identifier: Apache-2.0
// The command line: reads the arguments, hands them to one cmd_*.cpp per subcommand.
#include <CLI/CLI.hpp>

int main(int argc, char** argv) {
  CLI::App app{"Inverse Foley: synchronised rigid-body motion from a contact sound"};
  app.set_version_flag("--version", IFA_VERSION);
  app.require_subcommand(1);
  CLI11_PARSE(app, argc, argv);
  return 0;
}
