// The number of an error or warning has one meaning; framework/core/diagnostics/CODES.md lists it with the files that
// use it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <string>

#include "tests/layering/source_tree.h"

namespace presa::layering {
namespace {

/// Files that use each number.
using Uses = std::map<int, std::set<std::string>>;

constexpr const char* kPage = "framework/core/diagnostics/CODES.md";

std::string withoutComments(const std::string& text) { return std::regex_replace(text, std::regex("//[^\n]*"), ""); }

void addMatches(const std::string& text, const std::regex& pattern, const std::string& path, Uses& uses) {
  for (auto at = std::sregex_iterator(text.begin(), text.end(), pattern); at != std::sregex_iterator(); ++at)
    uses[std::stoi((*at)[1])].insert(path);
}

/// Finds numbers where a finding is created, in an enum of codes, or in a literal text.
void addUses(const SourceFile& file, Uses& uses) {
  static const std::regex kCall(R"(\b(?:error|warning|refuse|wrong|fail|warn|report|code)\(\s*([1-9]\d\d)\s*[,)])");
  static const std::regex kEnum(R"(enum \w*Code\b[^{;]*\{([^}]*)\})"), kValue(R"(= ([1-9]\d\d)\b)");
  static const std::regex kPrinted(R"((?:error\[E|warning\[W)([1-9]\d\d)\])");
  const std::string text = withoutComments(file.text);
  addMatches(text, kCall, file.path, uses);
  addMatches(text, kPrinted, file.path, uses);
  for (auto at = std::sregex_iterator(text.begin(), text.end(), kEnum); at != std::sregex_iterator(); ++at)
    addMatches((*at)[1], kValue, file.path, uses);
}

Uses usesInSources() {
  Uses uses;
  for (const SourceFile& file : sourceTree()) {
    if (file.isCpp() && file.topFolder() != "tests") addUses(file, uses);
  }
  return uses;
}

/// Parses rows "| 401 | meaning | file, file |"; numbers with two rows go into `twice`.
Uses usesOnPage(std::set<int>& twice) {
  static const std::regex kRow(R"(\| ([1-9]\d\d) \| [^|]+ \| ([^|]+) \|)"), kFile(R"([^,\s]+)");
  Uses uses;
  for (const SourceFile& file : sourceTree()) {
    if (file.path != kPage) continue;
    for (auto row = std::sregex_iterator(file.text.begin(), file.text.end(), kRow); row != std::sregex_iterator();
         ++row) {
      const int number = std::stoi((*row)[1]);
      const std::string files = (*row)[2];
      if (uses.contains(number)) twice.insert(number);
      for (auto one = std::sregex_iterator(files.begin(), files.end(), kFile); one != std::sregex_iterator(); ++one)
        uses[number].insert(one->str());
    }
  }
  return uses;
}

std::string textOf(const std::set<std::string>& files) {
  std::string text;
  for (const std::string& file : files) text += (text.empty() ? "" : ", ") + file;
  return text.empty() ? "nowhere" : text;
}

TEST(Codes, EachIsFoundWhereItIsWritten) {
  Uses uses;
  addUses(
      {"a.cpp",
       "error(\n 101, where); refuse(102, \"\"); f.code(103); say(104, x);  // error(105,\n"
       "enum SomeCode : int { kA = 106,\n kB = 107 }; enum Other { kC = 108 }; \"x: error[E109]: \"; grow(110, 2);"},
      uses);
  std::set<int> found;
  for (const auto& [number, files] : uses) found.insert(number);
  EXPECT_THAT(found, testing::ElementsAre(101, 102, 103, 106, 107, 109));
}

// A number used by an unlisted file fails here. If it means the same there, add the file to the row; if not, take a
// free number.
TEST(Codes, AreListedOnceWithEveryFileThatUsesThem) {
  std::set<int> twice;
  const Uses page = usesOnPage(twice), sources = usesInSources();
  EXPECT_THAT(twice, testing::IsEmpty()) << "have two rows in " << kPage;
  EXPECT_GT(sources.size(), 250U);
  std::set<int> numbers;
  for (const Uses* uses : {&page, &sources})
    for (const auto& [number, files] : *uses) numbers.insert(number);
  const auto in = [](const Uses& uses, int number) {
    const auto found = uses.find(number);
    return found == uses.end() ? std::set<std::string>{} : found->second;
  };
  for (const int number : numbers) {
    const auto listed = in(page, number), used = in(sources, number);
    EXPECT_EQ(listed, used) << number << " is used in " << textOf(used) << "; " << kPage << " says " << textOf(listed)
                            << ". A number has one meaning: name the file in its row, or take a free number.";
  }
}

}  // namespace
}  // namespace presa::layering
