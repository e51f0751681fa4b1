#include "apps/common/options/program.h"
#include "apps/presa/device/commands/device_commands.h"

int main(int argc, char** argv) {
  return presa::runProgram(argc, argv, {.words = {"device"}, .declare = presa::addDevice, .footer = {}});
}
