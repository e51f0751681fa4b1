#pragma once
#include <string>
#include <vector>

namespace presa {

/// Version of the tables that plug-ins return. Whatever else a plug-in compiles against is in the hash of the installed
/// headers, which the build puts into every plug-in (PresaInterface.cmake): one of another hash is refused before any
/// of its code is called (E510).
inline constexpr int kPluginAbi = 29;

/// Address of the C symbol `symbol` in the plug-in `presa_<name>.so`. The plug-in is looked for in the folders of the
/// environment variable PRESA_PLUGIN_PATH (separated by colons), then beside the framework library; it is loaded at the
/// first call and stays loaded until the process ends, so that addresses remain valid.
/// Thread: any (not the haptic group). Throws InputError: E590 no such plug-in (with the paths tried), E591 it does not
/// load, E592 it has no such symbol, E510 it was built against other headers.
void* pluginSymbol(const std::string& name, const char* symbol);

/// The folders that plug-ins are looked for in, first to last.
std::vector<std::string> pluginFolders();

/// Throws InputError E510 when a plug-in was built for another version of the interface.
void requireAbi(const std::string& plugin, int abi);

/// The table that the plug-in's C function `symbol` returns. Throws the errors of pluginSymbol and requireAbi.
template <class Table>
const Table& pluginTable(const std::string& plugin, const char* symbol) {
  using Entry = const Table* (*)();
  const Table& table = *reinterpret_cast<Entry>(pluginSymbol(plugin, symbol))();
  requireAbi(plugin, table.abi);
  return table;
}

/// Path of a helper program that Presa starts itself; helpers lie beside the framework library.
std::string helperProgram(const std::string& name);

}  // namespace presa
