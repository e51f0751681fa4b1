#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/diagnostics/diagnostics.h"

/// Thin, read-only view of an XML document: the only user of libxml2. Errors carry file, line and column.
namespace presa::xml {

class Element;

class Document {
 public:
  /// Parses `file` (network off, entities not expanded). nullptr and diagnostics on failure.
  static std::unique_ptr<Document> load(const std::string& file, Diagnostics& diagnostics);
  static std::unique_ptr<Document> parse(const std::string& text, const std::string& name, Diagnostics& diagnostics);
  ~Document();

  /// Checks against the XSD text `schema` (see framework/scene/schema); unknown names get "did you mean".
  /// False when anything was wrong.
  bool validate(const std::string& schema, Diagnostics& diagnostics);
  Element root() const;
  /// The document as text, with all changes made through Element::setAttribute.
  std::string text() const;
  const std::string& name() const;

 private:
  struct Impl;
  explicit Document(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
  friend class Element;
};

/// Handle to one element; valid while its Document lives.
class Element {
 public:
  std::string name() const;
  bool hasAttribute(const std::string& attribute) const;
  /// Value or `fallback` when absent.
  std::string attribute(const std::string& attribute, const std::string& fallback = {}) const;
  /// Number or `fallback` when absent or not a number (validate() has reported the latter).
  double number(const std::string& attribute, double fallback) const;
  /// Space-separated numbers; empty when absent.
  std::vector<double> numbers(const std::string& attribute) const;
  void setAttribute(const std::string& attribute, const std::string& value);
  std::vector<std::string> attributeNames() const;
  /// Element children in document order; only those named `name` when it is given.
  std::vector<Element> children(const std::string& name = {}) const;
  /// Location of the element's start tag, or of one of its attributes.
  SourceLocation where() const;
  SourceLocation where(const std::string& attribute) const;

 private:
  friend class Document;
  Element(const Document* document, void* node) : document_(document), node_(node) {}
  const Document* document_;
  void* node_;
};

}  // namespace presa::xml
