#pragma once
#include <CLI/CLI.hpp>

namespace presa {

/// Exit statuses of the program.
enum ExitStatus : int {
  kExitOk = 0,
  kExitFault = 1,          ///< the run ended with a fault, or a verification failed
  kExitBadInput = 2,       ///< nothing was run and nothing written
  kExitInterrupted = 130,  ///< Ctrl-C
};

/// Each adds one subcommand, which leaves its exit status in `status`.
void addRun(CLI::App& app, int& status);
void addCheck(CLI::App& app, int& status);
void addExplain(CLI::App& app, int& status);
void addReplay(CLI::App& app, int& status);
void addStability(CLI::App& app, int& status);
void addCost(CLI::App& app, int& status);
void addExperiment(CLI::App& app, int& status);
void addView(CLI::App& app, int& status);
void addBus(CLI::App& app, int& status);
void addBusList(CLI::App& bus, int& status);
void addBusSet(CLI::App& bus, int& status);
void addBusKeys(CLI::App& app, int& status);
void addDevice(CLI::App& app, int& status);
void addTemple(CLI::App& app, int& status);

}  // namespace presa
