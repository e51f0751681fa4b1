#include <libxml/xmlschemas.h>

#include <algorithm>
#include <map>
#include <set>

#include "framework/scene/xml/document_data.h"
#include "framework/scene/xml/listed.h"
#include "framework/scene/xml/schema_compiled.h"
#include "framework/scene/xml/xml.h"

namespace presa::xml {
namespace {

enum CheckCode {
  kWrongRoot = 110,
  kUnknownElement = 111,
  kTooMany = 112,
  kMissingElement = 113,
  kUnknownAttribute = 114,
  kMissingAttribute = 115,
  kStrayText = 119,
  kNamespace = 120,
  kOther = 199
};

std::string tag(const std::string& name) { return "<" + name + ">"; }

/// Walks a document alongside the rules of its schema and reports every deviation.
class Checker {
 public:
  Checker(const Schema& schema, DocumentData& data, Diagnostics& diagnostics)
      : schema_(schema), data_(data), diagnostics_(diagnostics) {}

  void run() {
    xmlNode* root = data_.root();
    const std::string expected = schema_.root().name;
    if (root->ns || root->nsDef) {
      const bool is_hint_only = !root->ns && fromXml(root->nsDef->prefix) == "xsi" && !root->nsDef->next;
      if (!is_hint_only) {
        diagnostics_.error(kNamespace, data_.locate(root), "Presa files use no XML namespace", "remove xmlns");
        return;
      }
    }
    if (nameOf(root) != expected) {
      diagnostics_.error(kWrongRoot, data_.locate(root),
                         "the root element is " + tag(nameOf(root)) + ", expected " + tag(expected) +
                             didYouMean(nameOf(root), {expected}));
      return;
    }
    element(root, schema_.root());
  }

  /// Corrects misspelt names in the tree, so that later checks recognise them.
  void correctNames() {
    for (const auto& [node, name] : corrections_) xmlNodeSetName(node, toXml(name));
  }

 private:
  void element(xmlNode* node, const ElementRule& rule) {
    attributes(node, rule);
    children(node, rule);
    const auto text = data_.text_where.find(node);
    if (text != data_.text_where.end()) {
      diagnostics_.error(kStrayText, text->second, "text in " + labelOf(node) + ", where only elements may stand",
                         "values are written as attributes: name=\"value\"");
    }
  }

  void attributes(xmlNode* node, const ElementRule& rule) {
    std::set<std::string> present;
    for (xmlAttr* attribute = node->properties; attribute; attribute = attribute->next) {
      present.insert(qualifiedName(attribute->ns, attribute->name));
    }
    for (xmlAttr* attribute = node->properties; attribute; attribute = attribute->next) {
      const std::string name = qualifiedName(attribute->ns, attribute->name);
      const AttributeRule* known = rule.attribute(name);
      if (!known) {
        known = unknownAttribute(node, attribute, name, rule, present);
        if (known) present.insert(known->name);
      }
      if (known) value(node, attribute, *known);
    }
    for (const AttributeRule& required : rule.attributes) {
      if (!required.required || present.count(required.name) > 0) continue;
      diagnostics_.error(kMissingAttribute, data_.locate(node), labelOf(node) + " has no " + quote(required.name),
                         required.name + ": " + describe(required.value) +
                             (required.documentation.empty() ? "" : "; " + required.documentation));
    }
  }

  /// Returns the rule of the attribute that was meant, if there is one clear candidate.
  const AttributeRule* unknownAttribute(xmlNode* node, xmlAttr* attribute, const std::string& name,
                                        const ElementRule& rule, const std::set<std::string>& present) {
    std::vector<std::string> free_names;
    for (const AttributeRule& allowed : rule.attributes) {
      if (present.count(allowed.name) == 0) free_names.push_back(allowed.name);
    }
    const SourceLocation where = data_.locate(attribute);
    std::vector<std::string> owners = ownersOfAttribute(name);
    std::erase(owners, tag(rule.name));  // an element of this name, but in another place
    if (rule.child(name)) {
      diagnostics_.error(kUnknownAttribute, where, quote(name) + " is no attribute of " + labelOf(node),
                         "it is an element of its own within it: " + tag(name));
      return nullptr;
    }
    if (!owners.empty() && owners.size() <= 2) {
      diagnostics_.error(kUnknownAttribute, where, "attribute " + quote(name) + " does not belong on " + labelOf(node),
                         "it belongs on " + listed(owners));
      return nullptr;
    }
    const std::string nearest = attribute->ns ? "" : nearestName(name, free_names);
    diagnostics_.error(
        kUnknownAttribute, where,
        "unknown attribute " + quote(name) + " on " + labelOf(node) +
            (nearest.empty() ? "" : " (did you mean " + quote(nearest) + "?)"),
        rule.attributes.empty() ? tag(rule.name) + " has no attributes" : "allowed: " + listed(rule.attributeNames()));
    if (nearest.empty()) return nullptr;
    corrections_.emplace_back(reinterpret_cast<xmlNode*>(attribute), nearest);
    return rule.attribute(nearest);
  }

  void value(xmlNode* node, xmlAttr* attribute, const AttributeRule& rule) {
    const std::string text = attributeOf(node, fromXml(attribute->name)).value_or("");
    const auto problem = problemOf(rule.value, text);
    if (!problem) return;
    data_.flawed.insert(attribute);
    diagnostics_.error(problem->code, data_.locate(attribute),
                       quote(rule.name) + " of " + labelOf(node) + " " + problem->message,
                       problem->help.empty() ? helpFor(rule) : problem->help);
  }

  static std::string helpFor(const AttributeRule& rule) {
    return rule.documentation.empty() ? "" : rule.name + ": " + rule.documentation;
  }

  void children(xmlNode* node, const ElementRule& rule) {
    std::map<const ContentRule*, std::vector<xmlNode*>> found;
    bool has_unclear = false;
    for (xmlNode* child : childElements(node)) {
      std::string name = nameOf(child);
      if (!rule.child(name)) name = unknownElement(child, name, rule);
      if (name.empty()) {
        has_unclear = true;
        continue;
      }
      found[rule.contentOf(name)].push_back(child);
      element(child, *rule.child(name));
    }
    for (const ContentRule& content : rule.content) counts(node, content, found[&content], has_unclear);
  }

  void counts(xmlNode* node, const ContentRule& content, const std::vector<xmlNode*>& found, bool has_unclear) {
    std::vector<std::string> names;
    for (const ElementRule* option : content.options) names.push_back(tag(option->name));
    for (std::size_t i = content.max; i < found.size(); ++i) {
      const SourceLocation first = data_.locate(found.front());
      const std::string one = content.max == 1 ? "only one " : "up to " + std::to_string(content.max) + " ";
      const std::string limit = names.size() > 1 ? one + "of " + listed(names) : one + names.front();
      diagnostics_.error(kTooMany, data_.locate(found[i]),
                         labelOf(node) + " may hold " + limit + ", this is another one",
                         "the first is in line " + std::to_string(first.line));
    }
    // an unknown child may be the missing one misspelt: one message is enough
    if (found.size() >= content.min || has_unclear) return;
    const std::string what = names.size() > 1 ? "one of " + listed(names) : names.front();
    diagnostics_.error(kMissingElement, data_.locate(node), labelOf(node) + " needs " + what + ", found none");
  }

  /// Returns the name that was meant, or "" when there is no clear candidate.
  std::string unknownElement(xmlNode* node, const std::string& name, const ElementRule& parent) {
    const SourceLocation where = data_.locate(node);
    const std::string in = labelOf(node->parent);
    if (parent.attribute(name)) {
      diagnostics_.error(kUnknownElement, where, tag(name) + " is no element of " + in,
                         "it is an attribute: " + tag(parent.name + " " + name + "=\"...\""));
      return {};
    }
    const std::vector<std::string> owners = ownersOfElement(name);
    const std::string nearest = owners.empty() ? nearestName(name, parent.childNames()) : "";
    if (!owners.empty()) {
      diagnostics_.error(kUnknownElement, where, tag(name) + " does not belong in " + in,
                         "it belongs in " + listed(owners));
    } else {
      diagnostics_.error(
          kUnknownElement, where,
          "unknown element " + tag(name) + " in " + in +
              (nearest.empty() ? "" : " (did you mean " + quote(nearest) + "?)"),
          (parent.content.empty() ? in + " has no elements in it" : "allowed: " + listed(parent.childNames())) +
              (nearest.empty() ? schema_.ifUnknown(name, where.file) : ""));
    }
    if (!nearest.empty()) corrections_.emplace_back(node, nearest);
    return nearest;
  }

  std::vector<std::string> ownersOfElement(const std::string& name) const {
    std::vector<std::string> owners;
    for (const auto& rule : schema_.elements()) {
      if (rule->child(name)) appendOnce(owners, tag(rule->name));
    }
    return owners;
  }

  std::vector<std::string> ownersOfAttribute(const std::string& name) const {
    std::vector<std::string> owners;
    for (const auto& rule : schema_.elements()) {
      if (rule->attribute(name)) appendOnce(owners, tag(rule->name));
    }
    return owners;
  }

  static void appendOnce(std::vector<std::string>& words, const std::string& word) {
    if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
  }

  const Schema& schema_;
  DocumentData& data_;
  Diagnostics& diagnostics_;
  std::vector<std::pair<xmlNode*, std::string>> corrections_;
};

struct Verdict {
  DocumentData* data;
  Diagnostics findings;
};

void collectFinding(void* context, xmlErrorPtr error) {
  auto* verdict = static_cast<Verdict*>(context);
  std::string message = error->message ? error->message : "";
  while (!message.empty() && message.back() == '\n') message.pop_back();
  verdict->findings.error(kOther, verdict->data->locate(error->node), message);
}

/// Findings of libxml2's validator, which decides what the XSD allows.
Diagnostics validateWithLibrary(xmlSchema* schema, DocumentData& data) {
  Verdict verdict{&data, {}};
  const std::unique_ptr<xmlSchemaValidCtxt, decltype(&xmlSchemaFreeValidCtxt)> context(xmlSchemaNewValidCtxt(schema),
                                                                                       &xmlSchemaFreeValidCtxt);
  if (!context) throw std::bad_alloc();
  xmlSchemaSetValidStructuredErrors(context.get(), &collectFinding, &verdict);
  const int result = xmlSchemaValidateDoc(context.get(), data.doc.get());
  if (result != 0 && !verdict.findings.hasErrors()) {
    verdict.findings.error(kOther, data.locate(data.root()), "the document does not fit its schema");
  }
  return verdict.findings;
}

void writeDefaultsOf(Element element, const ElementRule& rule) {
  for (const AttributeRule& attribute : rule.attributes) {
    if (!attribute.default_value || element.hasAttribute(attribute.name)) continue;
    element.setAttribute(attribute.name, *attribute.default_value, element.where());
  }
  for (const ContentRule& content : rule.content) {
    const ElementRule& only = *content.options.front();
    const bool is_optional_single = content.options.size() == 1 && content.min == 0 && content.max == 1;
    if (!is_optional_single || !only.implied || !only.mayBeEmpty() || only.attributes.empty()) continue;
    if (element.children(only.name).empty()) element.addChild(only.name, element.where());
  }
  for (const Element& child : element.children()) {
    const ElementRule* child_rule = rule.child(child.name());
    if (child_rule) writeDefaultsOf(child, *child_rule);
  }
}

}  // namespace

bool Document::validate(const Schema& schema, Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.errorCount();
  const Diagnostics library = validateWithLibrary(schema.compiled_->schema.get(), *data_);
  Checker checker(schema, *data_, diagnostics);
  checker.run();
  checker.correctNames();
  if (diagnostics.errorCount() == errors_before) {
    for (const Diagnostic& finding : library.all()) diagnostics.error(kOther, finding.where, finding.message);
  }
  return diagnostics.errorCount() == errors_before;
}

void Document::writeDefaults(const Schema& schema) { writeDefaultsOf(root(), schema.root()); }

}  // namespace presa::xml
