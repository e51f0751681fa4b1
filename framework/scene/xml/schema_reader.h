#pragma once
#include <map>
#include <stdexcept>

#include "framework/scene/xml/document_data.h"
#include "framework/scene/xml/schema.h"

namespace presa::xml {

/// Builds the ElementRules of a Schema from the text of an XSD.
class SchemaReader {
 public:
  explicit SchemaReader(Schema& schema) : schema_(schema) {}
  const ElementRule* read(const std::string& xsd);

 private:
  const ElementRule* readElement(const xmlNode* node);
  void readComplexType(const xmlNode* node, ElementRule& rule);
  void readAttribute(const xmlNode* node, ElementRule& rule);
  void readGroup(const xmlNode* node, ElementRule& rule);
  void readRepeatedChoice(const xmlNode* node, ElementRule& rule);
  ValueRule readType(const std::string& name);
  ValueRule readSimpleType(const xmlNode* node);
  ValueRule readRestriction(const xmlNode* node);
  void readFacet(const xmlNode* node, ValueRule& rule);
  ValueRule readUnion(const xmlNode* node);
  const xmlNode* global(const std::string& kind, const std::string& name) const;

  Schema& schema_;
  std::map<std::pair<std::string, std::string>, const xmlNode*> globals_;  ///< by kind of definition and its name
};

}  // namespace presa::xml
