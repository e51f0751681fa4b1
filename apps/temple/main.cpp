#include "apps/common/options/program.h"
#include "apps/temple/temple_command.h"

int main(int argc, char** argv) {
  return presa::runProgram(argc, argv, {.words = {"temple"}, .declare = presa::addTemple, .footer = {}});
}
