#include "apps/common/options/program.h"
#include "apps/studies/stability/stability_command.h"

int main(int argc, char** argv) {
  return presa::runProgram(argc, argv, {.words = {"stability"}, .declare = presa::addStability, .footer = {}});
}
