#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace presa::xml {

/// Line and column, both from 1. A column is one UTF-8 character; a tab counts as one.
struct Position {
  int line = 0;    ///< from 1; 0: none
  int column = 0;  ///< from 1; 0: none
};

/// An attribute in a start tag.
struct ScannedAttribute {
  std::string name;  ///< as written
  Position at;       ///< first character of the name
};

/// A start tag, or an empty element.
struct ScannedTag {
  std::string name;                          ///< as written
  Position at;                               ///< position of '<'
  std::vector<ScannedAttribute> attributes;  ///< in the order of the text
  Position text;  ///< first character in the element that is neither markup nor white space; line 0: none
};

/// An end tag that does not fit the innermost open tag.
struct MismatchedEnd {
  std::string name;      ///< in the end tag `</name>`
  Position at;           ///< position of '<'
  std::size_t open_tag;  ///< index of the tag that should have been closed
};

/// Positions of all tags and attributes in a source text, because libxml2's tree knows lines only. Element i of `tags`
/// is the i-th element in document order. The scan stops at the first construct it does not understand; libxml2 reports
/// it.
struct SourceScan {
  std::vector<ScannedTag> tags;                      ///< in document order
  std::vector<std::size_t> open;                     ///< tags still open at the end, innermost last
  std::optional<MismatchedEnd> mismatch;             ///< the scan stops at it
  std::optional<ScannedAttribute> broken_attribute;  ///< no value, no quotes, or a value that runs on to the next '<'
  std::optional<Position> doctype;                   ///< position of "<!DOCTYPE", where the scan stops
  std::optional<ScannedAttribute>
      crowded;  ///< first attribute beyond kMaxAttributes, or (name empty) element beyond kMaxElements; the scan stops
};
/// Scans `text` once, up to the first construct that it does not understand.
SourceScan scanSource(std::string_view text);

/// Limit per element, far above any valid file: libxml2 compares every attribute of an element with every other.
inline constexpr std::size_t kMaxAttributes = 256;
/// Limit per document: 100 000 bodies with all defaults written out have a million elements.
inline constexpr std::size_t kMaxElements = 2'000'000;

}  // namespace presa::xml
