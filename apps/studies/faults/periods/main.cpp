#include "apps/common/options/program.h"
#include "apps/studies/faults/fault_commands.h"

int main(int argc, char** argv) {
  const auto declare = [](presa::Command app, int& status) { presa::addPeriods(app.command("device", ""), status); };
  return presa::runProgram(argc, argv, {.words = {"device", "periods"}, .declare = declare, .footer = {}});
}
