#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace presa::xml {

/// Line and column count from 1; a column is one character (of UTF-8), a tab is one too.
struct Position {
  int line = 0;
  int column = 0;
};

struct ScannedAttribute {
  std::string name;
  Position at;
};

struct ScannedTag {
  std::string name;
  Position at;  ///< of '<'
  std::vector<ScannedAttribute> attributes;
  Position text;  ///< of the first character in the element that is neither markup nor white space; line 0: none
};

struct MismatchedEnd {
  std::string name;  ///< what stands in </name>
  Position at;
  std::size_t open_tag;  ///< index of the tag that is open there
};

/// Where everything stands in a source text: libxml2's tree knows lines only. Element i of `tags` is the i-th element
/// of the document in document order. The scan stops at the first thing it does not understand (libxml2 says what).
struct SourceScan {
  std::vector<ScannedTag> tags;
  std::vector<std::size_t> open;  ///< tags still open at the end, innermost last
  std::optional<MismatchedEnd> mismatch;
  std::optional<ScannedAttribute> broken_attribute;  ///< without value or quotes, or running on to the next '<'
  std::optional<Position> doctype;                   ///< of "<!DOCTYPE"; the scan stops there
  std::optional<ScannedAttribute>
      crowded;  ///< an element's first attribute too many, or the first element; stops there
};
SourceScan scanSource(std::string_view text);

/// What no file of ours comes near: libxml2 compares each attribute of an element with each.
inline constexpr std::size_t kMaxAttributes = 256;
/// 100 000 bodies with all defaults written out have a million.
inline constexpr std::size_t kMaxElements = 2'000'000;

}  // namespace presa::xml
