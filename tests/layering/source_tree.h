#pragma once
#include <set>
#include <string>
#include <vector>

namespace presa::layering {

/// A file of the repository, by its path from the root ("modules/dynamics_ode/friction.cpp").
struct SourceFile {
  std::string path;
  std::string text;

  std::string topFolder() const;  ///< "modules"
  std::string part() const;       ///< "modules/dynamics_ode": the first two levels
  bool isCpp() const;             ///< .h or .cpp
  bool isText() const;            ///< written by hand: code, CMake, XML, Markdown, shell
  std::size_t lines() const;
  std::vector<std::string> includes() const;  ///< what stands between the brackets or quotes, in order
};

/// Every file below the folders that belong to the product, and those at its root; build folders left out.
const std::vector<SourceFile>& sourceTree();
/// Names at the root, without what git ignores.
std::vector<std::string> rootEntries();
/// Folders of the first and second level ("framework", "framework/core"); of tests and config the first alone.
std::vector<std::string> rooms();

/// Shared libraries that an ELF file asks for by name (DT_NEEDED), as readelf lists them. Throws when it cannot.
std::set<std::string> neededLibraries(const std::string& file);
/// Name spaces below presa:: of the functions that an ELF file defines, as nm lists them.
std::set<std::string> nameSpaces(const std::string& file);

}  // namespace presa::layering
