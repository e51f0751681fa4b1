#include "framework/scene/xml/schema_reader.h"

#include <cstdlib>
#include <limits>

namespace presa::xml {
namespace {

constexpr std::size_t kUnbounded = std::numeric_limits<std::size_t>::max();
constexpr const char* kExtensions = "urn:presa:schema";

std::string localName(const xmlNode* node) { return fromXml(node->name); }

[[noreturn]] void refuse(const xmlNode* node) {
  throw std::logic_error("schema: <xs:" + localName(node) + "> in line " + std::to_string(xmlGetLineNo(node)) +
                         " is not understood here");
}

std::string collapse(const std::string& text) {
  std::string result;
  for (const std::string& word : splitWords(text)) result += (result.empty() ? "" : " ") + word;
  return result;
}

std::string documentationOf(const xmlNode* node) {
  for (const xmlNode* child : childElements(node)) {
    if (localName(child) != "annotation") continue;
    const std::unique_ptr<xmlChar, void (*)(void*)> text(xmlNodeGetContent(child), xmlFree);
    return collapse(fromXml(text.get()));
  }
  return {};
}

std::size_t readCount(const std::string& text) {
  return text == "unbounded" || text == "*" ? kUnbounded : std::strtoul(text.c_str(), nullptr, 10);
}

std::size_t occurrence(const xmlNode* node, const char* attribute) {
  return readCount(attributeOf(node, attribute).value_or("1"));
}

/// Value of an attribute in Presa's own namespace, or none.
std::optional<std::string> extensionOf(const xmlNode* node, const char* attribute) {
  const std::unique_ptr<xmlChar, void (*)(void*)> value(
      xmlGetNsProp(node, reinterpret_cast<const xmlChar*>(attribute), reinterpret_cast<const xmlChar*>(kExtensions)),
      xmlFree);
  if (!value) return std::nullopt;
  return fromXml(value.get());
}

/// Minimum and maximum from p:occurs; any number when it is absent.
std::pair<std::size_t, std::size_t> statedOccurrence(const xmlNode* node) {
  const std::string text = extensionOf(node, "occurs").value_or("0..*");
  const auto dots = text.find("..");
  if (dots == std::string::npos) return {readCount(text), readCount(text)};
  return {readCount(text.substr(0, dots)), readCount(text.substr(dots + 2))};
}

double facetNumber(const xmlNode* node) {
  double value = 0;
  if (readNumber(attributeOf(node, "value").value_or(""), value) != NumberKind::kFinite) refuse(node);
  return value;
}

}  // namespace

const ElementRule* SchemaReader::read(const std::string& xsd) {
  const std::unique_ptr<xmlDoc, FreeDoc> doc(
      xmlReadMemory(xsd.data(), static_cast<int>(xsd.size()), "schema", nullptr, XML_PARSE_NONET | XML_PARSE_NOBLANKS));
  const std::vector<xmlNode*> top = childElements(xmlDocGetRootElement(doc.get()));
  const xmlNode* root = nullptr;
  for (const xmlNode* node : top) {
    globals_[{localName(node), attributeOf(node, "name").value_or("")}] = node;
    if (localName(node) == "element") root = node;
  }
  if (!root) throw std::logic_error("schema: no root element");
  return readElement(root);
}

const xmlNode* SchemaReader::global(const std::string& kind, const std::string& name) const {
  const auto found = globals_.find({kind, name});
  if (found == globals_.end()) throw std::logic_error("schema: no " + kind + " named " + name);
  return found->second;
}

const ElementRule* SchemaReader::readElement(const xmlNode* node) {
  schema_.elements_.push_back(std::make_unique<ElementRule>());
  ElementRule& rule = *schema_.elements_.back();
  rule.name = attributeOf(node, "name").value_or("");
  rule.implied = extensionOf(node, "implied") != "false";
  const auto type = attributeOf(node, "type");
  if (type) readComplexType(global("complexType", *type), rule);
  for (const xmlNode* child : childElements(node)) {
    if (localName(child) == "complexType") readComplexType(child, rule);
  }
  return &rule;
}

void SchemaReader::readComplexType(const xmlNode* node, ElementRule& rule) {
  for (const xmlNode* child : childElements(node)) {
    const std::string kind = localName(child);
    if (kind == "attribute") {
      readAttribute(child, rule);
    } else if (kind == "attributeGroup") {
      readComplexType(global(kind, attributeOf(child, "ref").value_or("")), rule);
    } else if (kind != "annotation") {
      readGroup(child, rule);
    }
  }
}

void SchemaReader::readAttribute(const xmlNode* node, ElementRule& rule) {
  AttributeRule attribute;
  attribute.name = attributeOf(node, "name").value_or("");
  attribute.required = attributeOf(node, "use") == "required";
  attribute.default_value = attributeOf(node, "default");
  attribute.documentation = documentationOf(node);
  attribute.value = readType(attributeOf(node, "type").value_or("xs:string"));
  rule.attributes.push_back(std::move(attribute));
}

void SchemaReader::readGroup(const xmlNode* node, ElementRule& rule) {
  const std::string kind = localName(node);
  if (kind == "group") {
    for (const xmlNode* child : childElements(global(kind, attributeOf(node, "ref").value_or("")))) {
      readGroup(child, rule);
      // XSD has the number of a choice on the reference to its group
      if (attributeOf(node, "maxOccurs")) rule.content.back().max = occurrence(node, "maxOccurs");
    }
  } else if (kind == "choice" && occurrence(node, "maxOccurs") == kUnbounded) {
    readRepeatedChoice(node, rule);
  } else if (kind == "choice") {
    ContentRule content{{}, occurrence(node, "minOccurs"), occurrence(node, "maxOccurs")};
    for (const xmlNode* child : childElements(node)) content.options.push_back(readElement(child));
    rule.content.push_back(std::move(content));
  } else if (kind == "sequence" || kind == "all") {
    for (const xmlNode* child : childElements(node)) {
      rule.content.push_back({{readElement(child)}, occurrence(child, "minOccurs"), occurrence(child, "maxOccurs")});
    }
  } else {
    refuse(node);
  }
}

void SchemaReader::readRepeatedChoice(const xmlNode* node, ElementRule& rule) {
  for (const xmlNode* child : childElements(node)) {
    if (localName(child) == "any") continue;  // what stands there is checked by whoever reads it
    const auto [min, max] = statedOccurrence(child);
    rule.content.push_back({{readElement(child)}, min, max});
  }
}

ValueRule SchemaReader::readType(const std::string& name) {
  ValueRule rule;
  if (name == "xs:string" || name == "xs:token") return rule;
  if (name == "xs:double") {
    rule.kind = ValueRule::Kind::kNumber;
  } else if (name == "xs:boolean") {
    rule.kind = ValueRule::Kind::kBoolean;
  } else if (name == "xs:NCName") {
    rule.kind = ValueRule::Kind::kName;
  } else {
    rule = readSimpleType(global("simpleType", name));
  }
  return rule;
}

ValueRule SchemaReader::readSimpleType(const xmlNode* node) {
  for (const xmlNode* child : childElements(node)) {
    const std::string kind = localName(child);
    if (kind == "annotation") continue;
    ValueRule rule;
    if (kind == "restriction") {
      rule = readRestriction(child);
    } else if (kind == "list") {
      rule = readType(attributeOf(child, "itemType").value_or(""));
      rule.count = 0;  // until a restriction gives its length
    } else if (kind == "union") {
      rule = readUnion(child);
    } else {
      refuse(child);
    }
    if (rule.documentation.empty()) rule.documentation = documentationOf(node);
    return rule;
  }
  refuse(node);
}

ValueRule SchemaReader::readUnion(const xmlNode* node) {
  ValueRule rule;
  for (const std::string& member : splitWords(attributeOf(node, "memberTypes").value_or(""))) {
    rule.alternatives.push_back(readType(member));
  }
  for (const xmlNode* child : childElements(node)) rule.alternatives.push_back(readSimpleType(child));
  return rule;
}

ValueRule SchemaReader::readRestriction(const xmlNode* node) {
  const auto base = attributeOf(node, "base");
  ValueRule rule;
  if (base) rule = readType(*base);
  for (const xmlNode* child : childElements(node)) {
    if (localName(child) == "simpleType") {
      rule = readSimpleType(child);
    } else {
      readFacet(child, rule);
    }
  }
  return rule;
}

void SchemaReader::readFacet(const xmlNode* node, ValueRule& rule) {
  const std::string facet = localName(node);
  const std::string value = attributeOf(node, "value").value_or("");
  if (facet == "minInclusive" || facet == "minExclusive") {
    rule.min = ValueRule::Bound{facetNumber(node), facet == "minInclusive"};
  } else if (facet == "maxInclusive" || facet == "maxExclusive") {
    rule.max = ValueRule::Bound{facetNumber(node), facet == "maxInclusive"};
  } else if (facet == "length") {
    rule.count = readCount(value);
  } else if (facet == "minLength") {
    rule.min_length = readCount(value);
  } else if (facet == "enumeration") {
    rule.kind = ValueRule::Kind::kWord;
    rule.words.push_back(value);
  } else if (facet == "pattern") {
    rule.kind = ValueRule::Kind::kPattern;
    rule.pattern = value;
  } else {
    refuse(node);
  }
}

}  // namespace presa::xml
