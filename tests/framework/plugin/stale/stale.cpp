#include "framework/plugin/plugin_loader.h"

namespace {
struct Table {
  int abi = presa::kPluginAbi;
};
}  // namespace

extern "C" {
#ifdef STALE_INTERFACE
extern const char presa_plugin_interface[];
const char presa_plugin_interface[] = STALE_INTERFACE;
#endif

// A table as every plug-in returns one; the version of the tables is the same in all three.
const Table* presaStaleTable() {
  static const Table table;
  return &table;
}
}
