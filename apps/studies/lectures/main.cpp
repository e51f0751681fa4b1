#include "apps/common/options/program.h"
#include "apps/studies/lectures/lectures_command.h"

int main(int argc, char** argv) {
  return presa::runProgram(argc, argv, {.words = {"lectures"}, .declare = presa::addLectures, .footer = {}});
}
