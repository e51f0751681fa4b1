#include "framework/scene/xml/schema.h"

#include <algorithm>

#include "framework/scene/xml/schema_compiled.h"
#include "framework/scene/xml/schema_reader.h"

namespace presa::xml {
namespace {

void collectText(void* context, xmlErrorPtr error) {
  *static_cast<std::string*>(context) += error->message ? error->message : "unknown error";
}

}  // namespace

const AttributeRule* ElementRule::attribute(const std::string& attribute_name) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [&](const AttributeRule& rule) { return rule.name == attribute_name; });
  return found == attributes.end() ? nullptr : &*found;
}

const ContentRule* ElementRule::contentOf(const std::string& child_name) const {
  for (const ContentRule& rule : content) {
    for (const ElementRule* option : rule.options) {
      if (option->name == child_name) return &rule;
    }
  }
  return nullptr;
}

const ElementRule* ElementRule::child(const std::string& child_name) const {
  const ContentRule* rule = contentOf(child_name);
  if (!rule) return nullptr;
  return *std::find_if(rule->options.begin(), rule->options.end(),
                       [&](const ElementRule* option) { return option->name == child_name; });
}

std::vector<std::string> ElementRule::attributeNames() const {
  std::vector<std::string> names;
  for (const AttributeRule& rule : attributes) names.push_back(rule.name);
  return names;
}

std::vector<std::string> ElementRule::childNames() const {
  std::vector<std::string> names;
  for (const ContentRule& rule : content) {
    for (const ElementRule* option : rule.options) names.push_back(option->name);
  }
  return names;
}

bool ElementRule::mayBeEmpty() const {
  return std::none_of(attributes.begin(), attributes.end(), [](const AttributeRule& rule) { return rule.required; }) &&
         std::all_of(content.begin(), content.end(), [](const ContentRule& rule) { return rule.min == 0; });
}

Schema::Schema(const std::string& xsd, IfUnknown if_unknown)
    : compiled_(std::make_unique<Compiled>()), if_unknown_(std::move(if_unknown)) {
  prepareLibrary();
  std::string errors;
  const std::unique_ptr<xmlSchemaParserCtxt, decltype(&xmlSchemaFreeParserCtxt)> context(
      xmlSchemaNewMemParserCtxt(xsd.data(), static_cast<int>(xsd.size())), &xmlSchemaFreeParserCtxt);
  if (!context) throw std::bad_alloc();
  xmlSchemaSetParserStructuredErrors(context.get(), &collectText, &errors);
  compiled_->schema.reset(xmlSchemaParse(context.get()));
  if (!compiled_->schema) throw std::logic_error("broken schema: " + errors);
  root_ = SchemaReader(*this).read(xsd);
}

Schema::~Schema() = default;

}  // namespace presa::xml
