#include "apps/common/options/program.h"
#include "apps/temple/trials/trials_command.h"

int main(int argc, char** argv) {
  return presa::runProgram(argc, argv, {.words = {"temple", "trials"}, .declare = presa::addTrials, .footer = {}});
}
