#include "apps/common/options/program.h"
#include "apps/studies/printed/printed_command.h"

int main(int argc, char** argv) {
  return presa::runProgram(argc, argv, {.words = {"printed"}, .declare = presa::addPrinted, .footer = {}});
}
