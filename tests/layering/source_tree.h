#pragma once
#include <set>
#include <string>
#include <vector>

namespace presa::layering {

/// A file of the repository; its path is relative to the root ("modules/dynamics_ode/rotation.cpp").
struct SourceFile {
  std::string path;
  std::string text;

  std::string topFolder() const;  ///< such as "modules"
  std::string part() const;       ///< the first two levels, such as "modules/dynamics_ode"
  bool isCpp() const;             ///< .h or .cpp
  bool isText() const;            ///< written by hand: code, CMake, XML, Markdown, shell
  std::size_t lines() const;
  std::vector<std::string> includes() const;  ///< names between the brackets or quotes, in order
};

/// Every file of the product's folders and of the root, without build folders.
const std::vector<SourceFile>& sourceTree();
/// Names in the root, without those that git ignores.
std::vector<std::string> rootEntries();
/// Folders of the first and second level ("framework", "framework/core"); for tests and config only the first.
std::vector<std::string> rooms();

/// Shared libraries that an ELF file needs (DT_NEEDED), as listed by readelf. Throws when readelf fails.
std::set<std::string> neededLibraries(const std::string& file);
/// Name spaces below presa:: of the functions that an ELF file defines, as listed by nm.
std::set<std::string> nameSpaces(const std::string& file);

}  // namespace presa::layering
