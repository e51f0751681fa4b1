#include "apps/common/options/program.h"
#include "apps/presa/model/model_command.h"

int main(int argc, char** argv) {
  return presa::runProgram(argc, argv, {.words = {"model"}, .declare = presa::addModel, .footer = {}});
}
