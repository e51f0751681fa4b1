#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/plugin/plugin_loader.h"

namespace presa {
namespace {

struct Table {
  int abi = 0;
};

/// What the loader says about a plug-in of stale/; empty: it takes it.
std::string refusalOf(const std::string& plugin) {
  setenv("PRESA_PLUGIN_PATH", PRESA_BINARY_DIR "/tests/stale_plugins", 1);
  try {
    pluginTable<Table>(plugin, "presaStaleTable");
    return {};
  } catch (const InputError& error) {
    return error.diagnostics().text();
  }
}

// A plug-in that was built against other headers is refused with both builds named, and with what to do: its table's own
// version cannot tell, as a field that moved crashes.
TEST(PluginInterface, RefusesAPlugInOfOtherHeaders) {
  EXPECT_EQ(refusalOf("today"), "");
  const std::string stale = refusalOf("stale");
  EXPECT_NE(stale.find("presa_stale.so: error[E510]: built for Presa 0.0.9 (interface 0123456789ab), this program is "
                       "Presa "),
            std::string::npos)
      << stale;
  EXPECT_NE(stale.find("build it again: cmake --build"), std::string::npos) << stale;
  const std::string nameless = refusalOf("nameless");
  EXPECT_NE(nameless.find("built for a Presa that did not yet name its plug-in interface"), std::string::npos)
      << nameless;
}

/// The file that PresaInterface.cmake writes for one header of this text.
std::string interfaceOfHeader(const std::string& header) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("presa_interface_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "a.h") << header;
  std::ofstream(folder / "list.txt") << "a.h\n";
  const std::string command = "cmake -DSOURCE=" + folder.string() + " -DHEADERS=" + (folder / "list.txt").string() +
                              " -DVERSION=1.2.3 -DFILE=" + (folder / "out.cpp").string() +
                              " -P " PRESA_SOURCE_DIR "/config/cmake/PresaInterface.cmake";
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::ostringstream text;
  text << std::ifstream(folder / "out.cpp").rdbuf();
  std::filesystem::remove_all(folder);
  return text.str();
}

// The hash changes with every declaration, and with nothing that a plug-in does not see.
TEST(PluginInterface, HashesDeclarationsAndNotComments) {
  const std::string plain = interfaceOfHeader("struct A {\n  int a;  ///< old\n  double b[2];\n};\n");
  EXPECT_NE(plain.find("\"Presa 1.2.3 (interface "), std::string::npos) << plain;
  EXPECT_EQ(interfaceOfHeader("struct A {\n  int a;  ///< new; words\n\n  double b[2];\n};\n"), plain);
  EXPECT_NE(interfaceOfHeader("struct A {\n  int a;\n  double b[3];\n};\n"), plain);
  EXPECT_NE(interfaceOfHeader("struct A {\n  int a, c;\n  double b[2];\n};\n"), plain);
}

}  // namespace
}  // namespace presa
