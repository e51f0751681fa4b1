#include <cstdio>
#include <exception>

#include "apps/common/options/commands.h"
#include "apps/common/standard_streams.h"
#include "apps/common/version.h"
#include "framework/core/diagnostics/diagnostics.h"
#include "framework/core/diagnostics/printable.h"
#include "framework/input/folders.h"

namespace {

/// --allow-folder, of every command that has no commands of its own.
void offerFolders(CLI::App& app) {
  const auto commands = app.get_subcommands([](CLI::App*) { return true; });
  for (CLI::App* command : commands) offerFolders(*command);
  if (!commands.empty()) return;
  app.add_option_function<std::vector<std::string>>(
         "--allow-folder",
         [](const std::vector<std::string>& folders) {
           for (const std::string& folder : folders) presa::input::allowFolder(folder);
         },
         "files may name files in this folder, too (repeatable; also PRESA_ALLOW_FOLDERS)")
      ->type_name("FOLDER")
      ->check(CLI::ExistingDirectory)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

}  // namespace

int main(int argc, char** argv) {
  presa::openStandardStreams();
  presa::input::allowFoldersOf(argc, argv);
  CLI::App app{"Presa: virtual environments that people pick up with their fingers"};
  app.name("presa");
  app.set_version_flag("--version", std::string("presa ") + presa::kVersion);
  app.require_subcommand(1);
  app.footer(
      "First steps:\n"
      "  presa run config/scenes/cube.xml                      two fingers lift a cube, live\n"
      "  presa run config/scenes/cube.xml --lockstep --report cube.html\n"
      "  presa explain config/scenes/cube.xml                  which parts run, and why\n"
      "  presa cost config/scenes/cube.xml --quick             what accuracy costs in time\n"
      "  presa COMMAND --help                                  all options of a command");
  int status = presa::kExitOk;
  presa::addRun(app, status);
  presa::addCheck(app, status);
  presa::addExplain(app, status);
  presa::addReplay(app, status);
  presa::addStability(app, status);
  presa::addCost(app, status);
  presa::addExperiment(app, status);
  presa::addDevice(app, status);
  presa::addView(app, status);
  presa::addBus(app, status);
  presa::addTemple(app, status);
  offerFolders(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // help and version are not errors; everything else is bad input
    return app.exit(error) == 0 ? presa::kExitOk : presa::kExitBadInput;
  } catch (const presa::InputError& error) {
    std::fputs(error.diagnostics().text().c_str(), stderr);
    return presa::kExitBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "presa: error: %s\n", presa::printableLines(error.what()).c_str());
    return presa::kExitFault;
  }
  return presa::outputLost() && status == presa::kExitOk ? presa::kExitFault : status;
}
