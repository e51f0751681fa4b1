#pragma once
#include <string>

namespace presa {

/// Address of the C symbol `symbol` in the plug-in `presa_<name>.so`. The plug-in is looked for in the folders of the
/// environment variable PRESA_PLUGIN_PATH (separated by colons), then beside the framework library; it is loaded at the
/// first call and stays loaded until the process ends, so that addresses remain valid.
/// Thread: any (not the haptic group). Throws InputError: E590 no such plug-in (with the paths tried), E591 it does not
/// load, E592 it has no such symbol.
void* pluginSymbol(const std::string& name, const char* symbol);

/// Path of a program that Presa starts itself; it lies beside the framework library.
std::string helperProgram(const std::string& name);

}  // namespace presa
