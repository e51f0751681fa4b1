#include <libxml/xmlschemastypes.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <mutex>

#include "framework/input/input.h"
#include "framework/scene/xml/document_data.h"
#include "framework/scene/xml/schema.h"
#include "framework/scene/xml/xml.h"

namespace presa::xml {
namespace {

enum DocumentCode { kUnreadable = 101, kEmpty = 102, kNotText = 103, kDoctype = 105, kTooLarge = 106, kCrowded = 695 };

struct FreeParser {
  void operator()(xmlParserCtxt* context) const { xmlFreeParserCtxt(context); }
};

/// libxml2's errors point into memory that the next error overwrites. Only the numbers are kept.
struct ErrorList {
  std::vector<xmlError> errors;
  static constexpr std::size_t kKept = 64;
};

void collectError(void* context, xmlErrorPtr error) {
  auto* list = static_cast<ErrorList*>(static_cast<xmlParserCtxt*>(context)->_private);
  if (error->level < XML_ERR_ERROR || list->errors.size() >= ErrorList::kKept) return;
  xmlError kept = *error;
  kept.message = kept.file = kept.str1 = kept.str2 = kept.str3 = nullptr;
  kept.ctxt = kept.node = nullptr;
  list->errors.push_back(kept);
}

/// True when the text is in an encoding that can be parsed; otherwise reports the reason.
bool isText(const std::string& text, const std::string& name, Diagnostics& diagnostics) {
  const SourceLocation where{name, 1, 1};
  if (text.size() > Document::kMaxBytes) {
    diagnostics.error(kTooLarge, where,
                      "the file has " + std::to_string(text.size()) + " bytes, at most " +
                          std::to_string(Document::kMaxBytes) + " are read",
                      "meshes belong in files of their own");
    return false;
  }
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    diagnostics.error(kEmpty, where, "the file is empty");
    return false;
  }
  const bool is_utf16 = text.rfind("\xFF\xFE", 0) == 0 || text.rfind("\xFE\xFF", 0) == 0;
  if (is_utf16) {
    diagnostics.error(kNotText, where, "the file is written in UTF-16", "save it as UTF-8");
    return false;
  }
  const auto zero = text.find('\0');
  if (zero != std::string::npos) {
    const std::string before = text.substr(0, zero);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t column = zero - (before.rfind('\n') + 1) + 1;  // npos + 1 is 0
    const SourceLocation there{where.file, static_cast<int>(line), static_cast<int>(column)};
    diagnostics.error(kNotText, there, "this is no text file: byte " + std::to_string(zero + 1) + " is zero",
                      "the file may be damaged, or a mesh or recording instead of XML");
    return false;
  }
  return true;
}

void notePositions(DocumentData& data, const SourceScan& scan) {
  std::size_t index = 0;
  const auto location = [&](const Position& at) { return SourceLocation{data.name, at.line, at.column}; };
  const auto visit = [&](const auto& self, xmlNode* node) -> void {
    if (index >= scan.tags.size()) return;
    const ScannedTag& tag = scan.tags[index++];
    data.where[node] = location(tag.at);
    if (tag.text.line > 0) data.text_where[node] = location(tag.text);
    for (const xmlAttr* attribute = node->properties; attribute; attribute = attribute->next) {
      const std::string name = qualifiedName(attribute->ns, attribute->name);
      for (const ScannedAttribute& scanned : tag.attributes) {
        if (scanned.name == name) data.where[attribute] = location(scanned.at);
      }
    }
    for (xmlNode* child : childElements(node)) self(self, child);
  };
  visit(visit, data.root());
}

/// Removes the hint for editors (xsi:noNamespaceSchemaLocation). Validation uses the embedded schema, and libxml2 would
/// open any file that the hint names.
void dropSchemaHint(xmlNode* root) {
  for (const char* hint : {"noNamespaceSchemaLocation", "schemaLocation"}) {
    xmlAttr* attribute = xmlHasNsProp(root, reinterpret_cast<const xmlChar*>(hint),
                                      reinterpret_cast<const xmlChar*>("http://www.w3.org/2001/XMLSchema-instance"));
    if (attribute) xmlRemoveProp(attribute);
  }
}

}  // namespace

void prepareLibrary() {
  static std::once_flag once;
  std::call_once(once, [] {
    xmlInitParser();
    xmlSchemaInitTypes();
  });
}

Document::Document(std::unique_ptr<DocumentData> data) : data_(std::move(data)) {}
Document::~Document() = default;

std::unique_ptr<Document> Document::load(const std::string& file, Diagnostics& diagnostics) {
  const SourceLocation where{file, 0, 0};
  input::Refusal refusal;
  const auto text = input::read(file, kMaxBytes, refusal);
  if (text) return parse(*text, file, diagnostics);
  std::error_code ignored;
  if (refusal.trouble == input::Trouble::kTooLarge) {
    diagnostics.error(kTooLarge, where, "the file " + refusal.what, "meshes belong in files of their own");
  } else {
    if (refusal.error == ENOENT)
      refusal.help = "relative paths start at the working directory " + std::filesystem::current_path(ignored).string();
    refusal.report(kUnreadable, where, "the file ", diagnostics);
  }
  return nullptr;
}

std::unique_ptr<Document> Document::parse(const std::string& text, const std::string& name, Diagnostics& diagnostics) {
  prepareLibrary();
  if (!isText(text, name, diagnostics)) return nullptr;
  const SourceScan scan = scanSource(text);
  if (scan.doctype) {
    // refuse before libxml2 sees the text: no entity can expand, no external subset can be loaded
    diagnostics.error(kDoctype, {name, scan.doctype->line, scan.doctype->column},
                      "<!DOCTYPE> and entities are not allowed in Presa files", "remove the DOCTYPE declaration");
    return nullptr;
  }
  if (scan.crowded) {
    const auto& [attribute, at] = *scan.crowded;
    diagnostics.error(kCrowded, {name, at.line, at.column},
                      attribute.empty() ? "the file has more than " + std::to_string(kMaxElements) + " elements"
                                        : "this element has more than " + std::to_string(kMaxAttributes) +
                                              " attributes: " + quote(attribute) + " is one too many",
                      "valid files stay far below this limit");
    return nullptr;
  }
  auto data = std::make_unique<DocumentData>();
  data->name = name;
  ErrorList list;
  const std::unique_ptr<xmlParserCtxt, FreeParser> context(xmlNewParserCtxt());
  if (!context) throw std::bad_alloc();
  context->sax->serror = &collectError;
  context->_private = &list;
  constexpr int kOptions = XML_PARSE_NONET | XML_PARSE_BIG_LINES | XML_PARSE_NOBLANKS;
  data->doc.reset(
      xmlCtxtReadMemory(context.get(), text.data(), static_cast<int>(text.size()), name.c_str(), nullptr, kOptions));
  if (!list.errors.empty() || !data->doc || !data->root()) {
    reportParseErrors(name, scan, list.errors, diagnostics);
    return nullptr;
  }
  notePositions(*data, scan);
  dropSchemaHint(data->root());
  return std::unique_ptr<Document>(new Document(std::move(data)));
}

bool Document::validate(const std::string& schema, Diagnostics& diagnostics) {
  return validate(Schema(schema), diagnostics);
}

Element Document::root() const { return {data_.get(), data_->root()}; }

const std::string& Document::name() const { return data_->name; }

std::string Document::text() const {
  xmlChar* buffer = nullptr;
  int size = 0;
  xmlDocDumpFormatMemoryEnc(data_->doc.get(), &buffer, &size, "UTF-8", 1);
  const std::unique_ptr<xmlChar, void (*)(void*)> owner(buffer, xmlFree);
  return {reinterpret_cast<const char*>(buffer), static_cast<std::size_t>(size)};
}

}  // namespace presa::xml
