#include "apps/common/options/program.h"
#include "apps/experiment/commands/experiment_commands.h"

int main(int argc, char** argv) {
  return presa::runProgram(argc, argv, {.words = {"experiment"}, .declare = presa::addExperiment, .footer = {}});
}
