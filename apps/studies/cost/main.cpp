#include "apps/common/options/program.h"
#include "apps/studies/cost/cost_command.h"

int main(int argc, char** argv) {
  return presa::runProgram(argc, argv, {.words = {"cost"}, .declare = presa::addCost, .footer = {}});
}
