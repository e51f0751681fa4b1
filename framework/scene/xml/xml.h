#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"

/// Thin view of an XML document: the only user of libxml2. Errors carry file, line and column (of the start tag or the
/// attribute at fault; columns count characters). A Document belongs to one thread; different ones may be used at once.
namespace presa::xml {

class Element;
class Schema;
struct DocumentData;

class Document {
 public:
  /// Parses `file` (network off, no DOCTYPE, at most kMaxBytes). nullptr and diagnostics on failure.
  static std::unique_ptr<Document> load(const std::string& file, Diagnostics& diagnostics);
  static std::unique_ptr<Document> parse(const std::string& text, const std::string& name, Diagnostics& diagnostics);
  ~Document();
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  /// Checks against an XSD (framework/scene/schemas.h). All findings are reported, unknown names get "did you mean".
  /// False when anything was wrong. Then names that were clearly meant are corrected in the document, so that the
  /// caller's own checks can go on and find what else is wrong; values at fault answer Element::flawed.
  bool validate(const std::string& schema, Diagnostics& diagnostics);
  bool validate(const Schema& schema, Diagnostics& diagnostics);
  /// Writes out every default the schema states, with the optional elements that consist of nothing else.
  void writeDefaults(const Schema& schema);
  Element root() const;
  /// The document as indented text, with all changes made to it.
  std::string text() const;
  const std::string& name() const;

  /// 100 000 bodies with all defaults written out; meshes live in their own files.
  static constexpr std::size_t kMaxBytes = std::size_t{64} << 20U;

 private:
  explicit Document(std::unique_ptr<DocumentData> data);
  std::unique_ptr<DocumentData> data_;
  friend class Element;
};

/// Handle to one element; valid while its Document lives and is not validated again.
class Element {
 public:
  std::string name() const;
  /// For messages: "<body> 'cube'" or "<physics> in body 'cube'".
  std::string label() const;
  bool hasAttribute(const std::string& attribute) const;
  /// Value or `fallback` when absent.
  std::string attribute(const std::string& attribute, const std::string& fallback = {}) const;
  /// Number or `fallback` when absent or not a finite number (validate() has reported the latter).
  double number(const std::string& attribute, double fallback) const;
  /// Space-separated numbers; empty when absent or one of them is not a finite number.
  std::vector<double> numbers(const std::string& attribute) const;
  /// true for "true" and "1", `fallback` when absent.
  bool boolean(const std::string& attribute, bool fallback) const;
  std::vector<std::string> attributeNames() const;
  /// Element children in document order; only those named `name` when it is given.
  std::vector<Element> children(const std::string& name = {}) const;
  /// Location of the element's start tag, or of one of its attributes (the start tag when it is absent).
  SourceLocation where() const;
  SourceLocation where(const std::string& attribute) const;
  /// validate() has found the value of this attribute to be wrong.
  bool flawed(const std::string& attribute) const;

  /// Changes; `origin` is what where() answers for them from then on.
  void setAttribute(const std::string& attribute, const std::string& value);
  void setAttribute(const std::string& attribute, const std::string& value, const SourceLocation& origin);
  void removeAttribute(const std::string& attribute);
  Element addChild(const std::string& name, const SourceLocation& origin);

 private:
  friend class Document;
  Element(DocumentData* document, void* node) : document_(document), node_(node) {}
  DocumentData* document_;
  void* node_;
};

}  // namespace presa::xml
