#include "framework/scene/xml/document_data.h"
#include "framework/scene/xml/value_rule.h"
#include "framework/scene/xml/xml.h"

namespace presa::xml {
namespace {

xmlNode* asNode(void* node) { return static_cast<xmlNode*>(node); }

xmlAttr* findAttribute(void* node, const std::string& attribute) { return xmlHasProp(asNode(node), toXml(attribute)); }

/// The quoted value of the attribute that distinguishes elements of one kind, or "".
std::string identityOf(const xmlNode* node) {
  for (const char* attribute : {"name", "role", "key"}) {
    const auto value = attributeOf(node, attribute);
    if (value) return quote(*value);
  }
  return {};
}

}  // namespace

std::string qualifiedName(const xmlNs* ns, const xmlChar* local) {
  return ns && ns->prefix ? fromXml(ns->prefix) + ":" + fromXml(local) : fromXml(local);
}

std::string nameOf(const xmlNode* node) { return qualifiedName(node->ns, node->name); }

std::optional<std::string> attributeOf(const xmlNode* node, const std::string& attribute) {
  const std::unique_ptr<xmlChar, void (*)(void*)> value(xmlGetNoNsProp(node, toXml(attribute)), xmlFree);
  if (!value) return std::nullopt;
  return fromXml(value.get());
}

std::string labelOf(const xmlNode* node) {
  const std::string label = "<" + nameOf(node) + ">";
  const std::string own = identityOf(node);
  if (!own.empty()) return label + " " + own;
  for (const xmlNode* above = node->parent; above && above->parent && above->parent->type == XML_ELEMENT_NODE;
       above = above->parent) {
    const std::string identity = identityOf(above);
    if (!identity.empty()) return label + " in " + nameOf(above) + " " + identity;
  }
  return label;
}

std::vector<xmlNode*> childElements(const xmlNode* node) {
  std::vector<xmlNode*> children;
  for (xmlNode* child = node->children; child; child = child->next) {
    if (child->type == XML_ELEMENT_NODE) children.push_back(child);
  }
  return children;
}

std::string Element::name() const { return nameOf(asNode(node_)); }
std::string Element::label() const { return labelOf(asNode(node_)); }
bool Element::hasAttribute(const std::string& attribute) const { return findAttribute(node_, attribute) != nullptr; }

std::string Element::attribute(const std::string& attribute, const std::string& fallback) const {
  return attributeOf(asNode(node_), attribute).value_or(fallback);
}

double Element::number(const std::string& attribute, double fallback) const {
  double value = fallback;
  readNumber(this->attribute(attribute), value);
  return value;
}

std::vector<double> Element::numbers(const std::string& attribute) const {
  std::vector<double> values;
  for (const std::string& word : splitWords(this->attribute(attribute))) {
    double value = 0;
    if (readNumber(word, value) != NumberKind::kFinite) return {};
    values.push_back(value);
  }
  return values;
}

bool Element::boolean(const std::string& attribute, bool fallback) const {
  if (!hasAttribute(attribute)) return fallback;
  const std::string value = this->attribute(attribute);
  return value == "true" || value == "1";
}

std::vector<std::string> Element::attributeNames() const {
  std::vector<std::string> names;
  for (const xmlAttr* attribute = asNode(node_)->properties; attribute; attribute = attribute->next) {
    names.push_back(qualifiedName(attribute->ns, attribute->name));
  }
  return names;
}

std::vector<Element> Element::children(const std::string& name) const {
  std::vector<Element> children;
  for (xmlNode* child : childElements(asNode(node_))) {
    if (name.empty() || nameOf(child) == name) children.push_back({document_, child});
  }
  return children;
}

SourceLocation Element::where() const { return document_->locate(node_); }

SourceLocation Element::where(const std::string& attribute) const {
  const xmlAttr* found = findAttribute(node_, attribute);
  return found ? document_->locate(found) : where();
}

bool Element::flawed(const std::string& attribute) const {
  const xmlAttr* found = findAttribute(node_, attribute);
  return found && document_->flawed.count(found) > 0;
}

void Element::setAttribute(const std::string& attribute, const std::string& value) {
  setAttribute(attribute, value, where(attribute));
}

void Element::setAttribute(const std::string& attribute, const std::string& value, const SourceLocation& origin) {
  const xmlAttr* set = xmlSetProp(asNode(node_), toXml(attribute), toXml(value));
  document_->flawed.erase(set);
  document_->where[set] = origin;
}

void Element::removeAttribute(const std::string& attribute) {
  xmlAttr* found = findAttribute(node_, attribute);
  if (!found) return;
  document_->forget(found);
  xmlRemoveProp(found);
}

Element Element::addChild(const std::string& name, const SourceLocation& origin) {
  xmlNode* child = xmlNewChild(asNode(node_), nullptr, toXml(name), nullptr);
  document_->where[child] = origin;
  return {document_, child};
}

Element Element::copyOf(const Element& of) {
  xmlNode* copy = xmlDocCopyNode(asNode(of.node_), document_->doc.get(), 1);
  if (copy == nullptr) throw std::bad_alloc();
  const auto note = [&](const auto& self, const xmlNode* from, const xmlNode* to) -> void {
    document_->where[to] = of.document_->locate(from);
    const auto text = of.document_->text_where.find(from);
    if (text != of.document_->text_where.end()) document_->text_where[to] = text->second;
    for (const xmlAttr *a = from->properties, *b = to->properties; a && b; a = a->next, b = b->next)
      document_->where[b] = of.document_->locate(a);
    const std::vector<xmlNode*> inner = childElements(from), copied = childElements(to);
    for (std::size_t i = 0; i < inner.size(); ++i) self(self, inner[i], copied[i]);
  };
  note(note, asNode(of.node_), copy);
  return {document_, copy};
}

Element Element::addCopy(const Element& of) {
  const Element copy = copyOf(of);
  xmlAddChild(asNode(node_), asNode(copy.node_));
  return copy;
}

Element Element::insertCopy(const Element& of) {
  const Element copy = copyOf(of);
  xmlAddPrevSibling(asNode(node_), asNode(copy.node_));
  return copy;
}

void Element::remove() {
  const auto forget = [&](const auto& self, xmlNode* node) -> void {
    document_->forget(node);
    document_->text_where.erase(node);
    for (const xmlAttr* attribute = node->properties; attribute; attribute = attribute->next)
      document_->forget(attribute);
    for (xmlNode* child : childElements(node)) self(self, child);
  };
  forget(forget, asNode(node_));
  xmlUnlinkNode(asNode(node_));
  xmlFreeNode(asNode(node_));
  node_ = nullptr;
}

}  // namespace presa::xml
