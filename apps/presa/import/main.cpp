#include "apps/common/options/program.h"
#include "apps/presa/import/import_command.h"

int main(int argc, char** argv) {
  return presa::runProgram(argc, argv, {.words = {"import"}, .declare = presa::addImport, .footer = {}});
}
