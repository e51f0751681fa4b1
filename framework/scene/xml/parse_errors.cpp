#include <map>
#include <set>

#include "framework/scene/xml/document_data.h"

namespace presa::xml {
namespace {

enum ParseCode { kNotUtf8 = 103, kNotWellFormed = 104, kTooDeep = 107 };

struct Words {
  const char* message;
  const char* help;
};

/// Messages for the most common libxml2 errors, worded for the author of the file.
const std::map<int, Words>& wordsByCode() {
  static const std::map<int, Words> words{
      {XML_ERR_DOCUMENT_EMPTY, {"this is no XML: it does not start with '<'", ""}},
      {XML_ERR_DOCUMENT_END,
       {"something follows after the end of the root element",
        "a file holds one root element; is one closed too early?"}},
      {XML_ERR_SPACE_REQUIRED,
       {"a start tag is broken here", "separate attributes by spaces and end the tag with '>' or '/>'"}},
      {XML_ERR_NAME_REQUIRED,
       {"a name of an element or attribute is expected here",
        "is the tag before it closed with '>' or '/>'? A real '<' is written &lt;, a real '&' is written &amp;"}},
      {XML_ERR_GT_REQUIRED, {"a start tag is not closed with '>' or '/>'", ""}},
      {XML_ERR_TAG_NOT_FINISHED, {"an element is not closed before the end of the file", ""}},
      {XML_ERR_UNDECLARED_ENTITY,
       {"unknown entity", "only &lt; &gt; &amp; &quot; &apos; and &#number; exist; a real '&' is written &amp;"}},
      {XML_ERR_HYPHEN_IN_COMMENT, {"'--' is not allowed within a comment", "a comment ends with '-->'"}},
      {XML_ERR_COMMENT_NOT_FINISHED, {"a comment is not closed", "end it with '-->'"}},
      {XML_ERR_RESERVED_XML_NAME,
       {"'<?xml' is allowed only at the very start of the file", "remove everything before it"}},
      {XML_NS_ERR_UNDEFINED_NAMESPACE,
       {"a name with ':' uses a namespace that is not declared", "names in Presa files have no ':'"}},
  };
  return words;
}

/// Uses the scan, which knows better than libxml2 where a mistake begins: at the unclosed tag or attribute.
bool reportFromScan(const std::string& name, const SourceScan& scan, int code, Diagnostics& diagnostics) {
  const auto at = [&](const Position& position) { return SourceLocation{name, position.line, position.column}; };
  if (code == XML_ERR_TAG_NAME_MISMATCH && scan.mismatch) {
    const ScannedTag& open = scan.tags[scan.mismatch->open_tag];
    const std::string help =
        "<" + open.name + "> was opened in line " + std::to_string(open.at.line) + " and has to be closed first";
    diagnostics.error(kNotWellFormed, at(scan.mismatch->at),
                      "</" + scan.mismatch->name + "> does not close <" + open.name + ">", help);
    return true;
  }
  if (code == XML_ERR_TAG_NOT_FINISHED && !scan.open.empty()) {
    const ScannedTag& open = scan.tags[scan.open.back()];
    diagnostics.error(kNotWellFormed, at(open.at), "<" + open.name + "> is not closed before the end of the file",
                      "add </" + open.name + ">");
    return true;
  }
  if (!scan.broken_attribute) return false;
  const std::string attribute = quote(scan.broken_attribute->name);
  const SourceLocation where = at(scan.broken_attribute->at);
  switch (code) {
    case XML_ERR_LT_IN_ATTRIBUTE:
    case XML_ERR_ATTRIBUTE_NOT_FINISHED:
      diagnostics.error(kNotWellFormed, where, "the value of " + attribute + " is not closed with a quote",
                        "a real '<' in a value is written &lt;");
      return true;
    case XML_ERR_ATTRIBUTE_NOT_STARTED:
      diagnostics.error(kNotWellFormed, where, "the value of " + attribute + " is not in quotes",
                        "write name=\"value\"");
      return true;
    case XML_ERR_ATTRIBUTE_WITHOUT_VALUE:
      diagnostics.error(kNotWellFormed, where, "attribute " + attribute + " has no value", "write name=\"value\"");
      return true;
    default:
      return false;
  }
}

/// A repeated attribute does not stop the parser, so all of them are reported.
bool reportRepeatedAttributes(const std::string& name, const SourceScan& scan, Diagnostics& diagnostics) {
  bool found = false;
  for (const ScannedTag& tag : scan.tags) {
    std::set<std::string> seen;
    for (const ScannedAttribute& attribute : tag.attributes) {
      if (seen.insert(attribute.name).second) continue;
      diagnostics.error(kNotWellFormed, {name, attribute.at.line, attribute.at.column},
                        "<" + tag.name + "> has " + quote(attribute.name) + " twice");
      found = true;
    }
  }
  return found;
}

}  // namespace

void reportParseErrors(const std::string& name, const SourceScan& scan, const std::vector<xmlError>& errors,
                       Diagnostics& diagnostics) {
  // only the first error counts: later ones are mostly its consequences
  const xmlError first = errors.empty() ? xmlError{} : errors.front();
  const SourceLocation where{name, first.line, first.int2};
  if (first.code == XML_ERR_ATTRIBUTE_REDEFINED && reportRepeatedAttributes(name, scan, diagnostics)) return;
  if (reportFromScan(name, scan, first.code, diagnostics)) return;
  switch (first.code) {
    case XML_ERR_INVALID_CHAR:
    case XML_ERR_INVALID_ENCODING:
    case XML_ERR_UNKNOWN_ENCODING:
    case XML_ERR_UNSUPPORTED_ENCODING:
    case XML_I18N_CONV_FAILED:
      diagnostics.error(kNotUtf8, where, "a character here does not belong in a text file of the stated encoding",
                        "save the file as UTF-8");
      return;
    case XML_ERR_INTERNAL_ERROR:
      diagnostics.error(kTooDeep, where, "elements are nested more than 256 deep");
      return;
    default:
      break;
  }
  const auto words = wordsByCode().find(first.code);
  if (words != wordsByCode().end()) {
    diagnostics.error(kNotWellFormed, where, words->second.message, words->second.help);
  } else {
    diagnostics.error(kNotWellFormed, where,
                      "this is not well-formed XML (parser error " + std::to_string(first.code) + ")");
  }
}

}  // namespace presa::xml
