#pragma once
#include <libxml/parser.h>
#include <libxml/tree.h>

#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/scene/xml/source_scan.h"

namespace presa::xml {

struct FreeDoc {
  void operator()(xmlDoc* doc) const { xmlFreeDoc(doc); }
};

/// A libxml2 tree and data about its nodes (keys: xmlNode* or xmlAttr*; looked up, never iterated).
struct DocumentData {
  std::string name;
  std::unique_ptr<xmlDoc, FreeDoc> doc;
  std::unordered_map<const void*, SourceLocation> where;
  std::unordered_map<const void*, SourceLocation> text_where;  ///< place of stray text, by its element
  std::unordered_set<const void*> flawed;                      ///< attributes with an invalid value

  xmlNode* root() const { return xmlDocGetRootElement(doc.get()); }
  SourceLocation locate(const void* node) const {
    const auto found = where.find(node);
    return found == where.end() ? SourceLocation{name, 0, 0} : found->second;
  }
  void forget(const void* node) {
    where.erase(node);
    flawed.erase(node);
  }
};

/// Must be called before the first use of libxml2 in any thread.
void prepareLibrary();

inline const xmlChar* toXml(const std::string& text) { return reinterpret_cast<const xmlChar*>(text.c_str()); }
inline std::string fromXml(const xmlChar* text) { return text ? reinterpret_cast<const char*>(text) : ""; }
/// Name with its prefix as written ("xsi:type").
std::string qualifiedName(const xmlNs* ns, const xmlChar* local);
std::string nameOf(const xmlNode* node);
std::optional<std::string> attributeOf(const xmlNode* node, const std::string& attribute);
/// "<body> 'cube'", "<physics> in body 'cube'", "<world>".
std::string labelOf(const xmlNode* node);
std::vector<xmlNode*> childElements(const xmlNode* node);

/// Reports why the text could not be parsed: one finding, or one for each repeated attribute.
void reportParseErrors(const std::string& name, const SourceScan& scan, const std::vector<xmlError>& errors,
                       Diagnostics& diagnostics);

}  // namespace presa::xml
