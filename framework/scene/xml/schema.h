#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/scene/xml/value_rule.h"

namespace presa::xml {

/// An attribute that an element may have.
struct AttributeRule {
  std::string name;                          ///< as in the XSD
  bool required = false;                     ///< it has no default, and must be written
  std::optional<std::string> default_value;  ///< none: absent stays absent
  std::string documentation;                 ///< meaning and unit
  ValueRule value;                           ///< what it may hold
};

struct ElementRule;

/// Between `min` and `max` children of an element; several options are alternatives.
struct ContentRule {
  std::vector<const ElementRule*> options;  ///< not owned; Schema::elements() holds them
  std::size_t min = 0;                      ///< children at least
  std::size_t max = 1;                      ///< children at most; a large number: unbounded
};

/// An element that a document may hold.
struct ElementRule {
  std::string name;                       ///< as in the XSD
  std::vector<AttributeRule> attributes;  ///< in the order of the XSD
  std::vector<ContentRule> content;       ///< its children, in the order of the XSD
  bool implied = true;  ///< where it may stand once and all its values have defaults, it is there without being written

  const AttributeRule* attribute(const std::string& attribute_name) const;  ///< null: none of that name
  const ElementRule* child(const std::string& child_name) const;            ///< null: no such child
  const ContentRule* contentOf(const std::string& child_name) const;        ///< rule of that child; null: none
  std::vector<std::string> attributeNames() const;                          ///< in the order of `attributes`
  std::vector<std::string> childNames() const;                              ///< in the order of `content`
  /// True when no attribute and no child is required.
  bool mayBeEmpty() const;
};

/// An XSD in two forms: compiled by libxml2, which decides validity, and as rules for messages, defaults and overrides.
/// Immutable; may be shared by threads.
///
/// The rules support the part of XSD 1.0 that Presa's schemas use; any other construct throws std::logic_error. One
/// extension, which XSD 1.0 lacks: within a repeated choice (elements in any order) the attribute `p:occurs`
/// ("1", "0..1", "1..*") in the namespace urn:presa:schema limits how often an element may occur. An element with
/// p:implied="false" is there only if it is written.
class Schema {
 public:
  /// Added to the help for an unknown element, of this name in this file, that resembles no known one.
  using IfUnknown = std::function<std::string(const std::string& element, const std::string& file)>;
  explicit Schema(const std::string& xsd, IfUnknown if_unknown = {});  ///< throws std::logic_error
  ~Schema();
  Schema(const Schema&) = delete;
  Schema& operator=(const Schema&) = delete;

  const ElementRule& root() const { return *root_; }                                       ///< rule of the root element
  const std::vector<std::unique_ptr<ElementRule>>& elements() const { return elements_; }  ///< all, root included
  /// Text of IfUnknown; empty without one.
  std::string ifUnknown(const std::string& element, const std::string& file) const {
    return if_unknown_ ? if_unknown_(element, file) : std::string{};
  }

 private:
  friend class Document;
  friend class SchemaReader;
  struct Compiled;
  std::unique_ptr<Compiled> compiled_;
  std::vector<std::unique_ptr<ElementRule>> elements_;
  const ElementRule* root_ = nullptr;
  IfUnknown if_unknown_;
};

}  // namespace presa::xml
