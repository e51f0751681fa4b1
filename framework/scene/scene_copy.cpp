#include "framework/scene/scene_copy.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <tuple>

#include "framework/input/input.h"
#include "framework/scene/manifest.h"
#include "framework/scene/scene_parts.h"
#include "framework/scene/schemas.h"
#include "framework/scene/xml/escaped.h"
#include "framework/scene/xml/source_scan.h"

namespace presa {
namespace {

using xml::Element;

/// Changes of one start tag.
struct TagEdit {
  std::map<std::string, std::string> set;
  std::vector<std::string> removed;
  std::string children;  ///< markup of added elements
};
using Edits = std::map<std::size_t, TagEdit>;  ///< by the tag's number in document order

std::string asValue(const std::string& text) { return "\"" + xml::escaped(text) + "\""; }

std::string markupOf(const Element& element) {
  std::string out = "<" + element.name();
  for (const std::string& name : element.attributeNames()) out += " " + name + "=" + asValue(element.attribute(name));
  const std::vector<Element> children = element.children();
  if (children.empty()) return out + "/>";
  out += ">";
  for (const Element& child : children) out += markupOf(child);
  return out + "</" + element.name() + ">";
}

/// Compares the document as written with the changed one, tag by tag.
class Comparison {
 public:
  /// `resolved`: as `changed`, with absolute paths. Such paths become relative to `folder`; empty: stay as they are.
  Edits between(const Element& before, const Element& changed, const Element& resolved, const std::string& folder) {
    relocate(changed, resolved, folder);
    compare(before, changed);
    return std::move(edits_);
  }

 private:
  static void relocate(Element changed, const Element& resolved, const std::string& folder) {
    if (folder.empty()) return;
    for (const std::string& name : changed.attributeNames()) {
      const std::string path = resolved.attribute(name);
      if (path != changed.attribute(name))
        changed.setAttribute(name, std::filesystem::path(path).lexically_relative(folder).string());
    }
    const std::vector<Element> a = changed.children(), b = resolved.children();
    for (std::size_t i = 0; i < a.size(); ++i) relocate(a[i], b[i], folder);
  }

  void compare(const Element& before, const Element& changed) {
    const std::size_t tag = count_++;
    for (const std::string& name : changed.attributeNames()) {
      if (!before.hasAttribute(name) || before.attribute(name) != changed.attribute(name))
        edits_[tag].set[name] = changed.attribute(name);
    }
    for (const std::string& name : before.attributeNames()) {
      if (!changed.hasAttribute(name)) edits_[tag].removed.push_back(name);
    }
    const std::vector<Element> a = before.children(), b = changed.children();
    for (std::size_t i = 0; i < a.size(); ++i) compare(a[i], b[i]);
    for (std::size_t i = a.size(); i < b.size(); ++i) edits_[tag].children += markupOf(b[i]);  // added at the end
  }

  std::size_t count_ = 0;
  Edits edits_;
};

/// Byte of a position in characters; a byte order mark has none.
std::size_t offsetOf(const std::string& text, const xml::Position& at) {
  std::size_t i = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  for (int line = 1; line < at.line; ++line) i = text.find('\n', i) + 1;
  for (int column = 1; column < at.column; ++column) {
    ++i;
    while (i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U) ++i;
  }
  return i;
}

void apply(const TagEdit& edit, const xml::ScannedTag& tag, std::string& text) {
  std::size_t end = offsetOf(text, tag.at) + 1 + tag.name.size();  // behind the last attribute
  std::map<std::string, std::string> missing = edit.set;
  std::vector<std::tuple<std::size_t, std::size_t, std::string>> changes;  // begin, end, new text
  for (const xml::ScannedAttribute& attribute : tag.attributes) {
    const std::size_t name = offsetOf(text, attribute.at);
    const std::size_t open = text.find_first_of("\"'", name + attribute.name.size());
    const std::size_t from = end;
    end = text.find(text[open], open + 1) + 1;
    if (const auto found = missing.find(attribute.name); found != missing.end()) {
      changes.emplace_back(open, end, asValue(found->second));
      missing.erase(found);
    } else if (std::find(edit.removed.begin(), edit.removed.end(), attribute.name) != edit.removed.end()) {
      changes.emplace_back(from, end, "");
    }
  }
  const std::size_t close = text.find('>', end);
  if (!edit.children.empty()) {
    std::string indent;
    const bool is_empty = text[close - 1] == '/';
    const std::size_t next = text.find_first_not_of(" \t\r\n", close + 1);
    if (!is_empty && text[close + 1] == '\n')  // on a line of its own, indented as the element that follows
      indent = text.substr(close + 1, next - close - 1);
    const std::string rest = is_empty ? ">" + edit.children + "</" + tag.name + ">" : ">" + indent + edit.children;
    changes.emplace_back(is_empty ? close - 1 : close, close + 1, rest);
  }
  std::string added;
  for (const auto& [name, value] : missing) added += " " + name + "=" + asValue(value);
  changes.emplace_back(end, end, added);
  std::stable_sort(changes.begin(), changes.end(),
                   [](const auto& a, const auto& b) { return std::get<0>(a) > std::get<0>(b); });
  for (const auto& [begin, stop, replacement] : changes) text.replace(begin, stop - begin, replacement);
}

std::string folderOf(const std::string& file) {
  return std::filesystem::absolute(file).lexically_normal().parent_path().string();
}

}  // namespace

std::string sceneCopy(const std::string& file, const std::vector<Override>& overrides, const std::string& to,
                      Diagnostics& diagnostics) {
  const xml::Schema schema(sceneSchemaWith(manifests()));
  const auto before = xml::Document::load(file, diagnostics);
  if (!before) return {};
  std::string text = input::readOrRefuse(file, xml::Document::kMaxBytes, 0);
  const auto changed = xml::Document::parse(text, file, diagnostics);
  const auto resolved = xml::Document::parse(text, file, diagnostics);
  const std::size_t errors_before = diagnostics.errorCount();
  Diagnostics same;
  applyOverrides(changed->root(), schema.root(), overrides, diagnostics);
  applyOverrides(resolved->root(), schema.root(), overrides, same);
  if (diagnostics.errorCount() > errors_before) return {};
  resolveFiles(resolved->root(), folderOf(file));
  const std::string folder = folderOf(to) == folderOf(file) ? std::string() : folderOf(to);
  const Edits edits = Comparison().between(before->root(), changed->root(), resolved->root(), folder);
  const xml::SourceScan scan = xml::scanSource(text);
  for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit) apply(edit->second, scan.tags[edit->first], text);
  return text;
}

}  // namespace presa
