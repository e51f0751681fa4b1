#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"

/// Thin interface to an XML document over libxml2. Errors carry file, line and column of the start tag or attribute at
/// fault; columns count characters. A Document belongs to one thread; different Documents may be used concurrently.
namespace presa::xml {

class Element;
class Schema;
struct DocumentData;

/// An XML document in memory; see the top of this file for threads.
class Document {
 public:
  /// Parses `file` (network off, no DOCTYPE, at most kMaxBytes). On failure: nullptr and diagnostics.
  static std::unique_ptr<Document> load(const std::string& file, Diagnostics& diagnostics);
  /// As load.
  static std::unique_ptr<Document> parse(const std::string& text, const std::string& name, Diagnostics& diagnostics);
  ~Document();
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  /// Validates against an XSD (framework/scene/schemas.h). Reports all findings; unknown names get "did you mean".
  /// Returns false when there were errors. Misspelt names are then corrected in the document, so that the caller's own
  /// checks find further errors; attributes with invalid values answer Element::flawed.
  bool validate(const std::string& schema, Diagnostics& diagnostics);
  /// As above, with a schema that is compiled already.
  bool validate(const Schema& schema, Diagnostics& diagnostics);
  /// Writes out every default of the schema, including optional elements that consist of defaults only.
  void writeDefaults(const Schema& schema);
  Element root() const;  ///< element at the top
  /// The document as indented text, including changes.
  std::string text() const;
  const std::string& name() const;  ///< file name, or that given to parse

  /// Enough for 100 000 bodies with all defaults written out; meshes are in separate files.
  static constexpr std::size_t kMaxBytes = std::size_t{64} << 20U;

 private:
  explicit Document(std::unique_ptr<DocumentData> data);
  std::unique_ptr<DocumentData> data_;
  friend class Element;
};

/// Handle to one element; valid while its Document exists and is not validated again.
class Element {
 public:
  std::string name() const;  ///< as in the start tag
  /// For messages: "<body> 'cube'" or "<physics> in body 'cube'".
  std::string label() const;
  bool hasAttribute(const std::string& attribute) const;  ///< written, or by writeDefaults
  /// The value, or `fallback` when absent.
  std::string attribute(const std::string& attribute, const std::string& fallback = {}) const;
  /// The number, or `fallback` when absent or not a finite number (which validate() has reported).
  double number(const std::string& attribute, double fallback) const;
  /// Space-separated numbers; empty when absent or one of them is not a finite number.
  std::vector<double> numbers(const std::string& attribute) const;
  /// true for "true" and "1", `fallback` when absent.
  bool boolean(const std::string& attribute, bool fallback) const;
  std::vector<std::string> attributeNames() const;  ///< in document order
  /// Element children in document order; only those named `name` when it is given.
  std::vector<Element> children(const std::string& name = {}) const;
  /// Location of the start tag, or of the attribute (the start tag when the attribute is absent).
  SourceLocation where() const;
  SourceLocation where(const std::string& attribute) const;  ///< of the attribute
  /// Whether validate() found the value of this attribute to be invalid.
  bool flawed(const std::string& attribute) const;

  /// Changes to the document; where() answers `origin` for the changed attribute or element.
  void setAttribute(const std::string& attribute, const std::string& value);
  /// Instead of the start tag's place.
  void setAttribute(const std::string& attribute, const std::string& value, const SourceLocation& origin);
  void removeAttribute(const std::string& attribute);                       ///< no effect when it is absent
  Element addChild(const std::string& name, const SourceLocation& origin);  ///< the new last child
  /// Copies of an element of any document with all that is in it, which keep their locations: the last child, or in
  /// front of this element.
  Element addCopy(const Element& of);
  /// In front of this element.
  Element insertCopy(const Element& of);
  /// Takes the element out of its document; no handle to it is valid any more.
  void remove();

 private:
  friend class Document;
  Element copyOf(const Element& of);
  Element(DocumentData* document, void* node) : document_(document), node_(node) {}
  DocumentData* document_;
  void* node_;
};

}  // namespace presa::xml
