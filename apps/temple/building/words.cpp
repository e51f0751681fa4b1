#include "apps/temple/building/words.h"

#include <algorithm>
#include <array>

#include "apps/temple/building/building_schemas.h"
#include "apps/temple/building/proportions.h"
#include "apps/temple/building/shipped.h"
#include "framework/scene/scene_parts.h"
#include "framework/scene/xml/escaped.h"
#include "framework/scene/xml/value_rule.h"

namespace presa::temple {
namespace {

enum WordsCode { kVersion = 966 };

constexpr std::array kKinds{BlockKind::kDrum,     BlockKind::kCapital,       BlockKind::kArchitrave,
                            BlockKind::kTriglyph, BlockKind::kMetope,        BlockKind::kCornice,
                            BlockKind::kTympanum, BlockKind::kRakingCornice, BlockKind::kTile};

AssemblyWords readChecked(xml::Document& document, Diagnostics& diagnostics) {
  static const xml::Schema schema(schemas::words);
  if (!document.validate(schema, diagnostics)) return {};
  const xml::Element root = document.root();
  checkVersion(root, "words", kVersion, diagnostics);
  checkWords(root, diagnostics);
  AssemblyWords words = readWords(root);
  for (const BlockKind kind : kKinds) {
    if (std::ranges::find(words.elements, elementName(kind), &AssemblyWords::Element::name) != words.elements.end())
      continue;
    diagnostics.error(968, root.where(), std::string("a ") + elementName(kind) + " has no <element> with its texts",
                      std::string("<element name=\"") + elementName(kind) + "\" called=\"…\" says=\"…\" waits=\"…\"/>");
  }
  for (const std::string& task : shippedNames()) {
    if (std::ranges::any_of(root.children("task"), [&](const auto& one) { return one.attribute("name") == task; }))
      continue;
    diagnostics.error(968, root.where(), "nothing says what stands when the task " + quote(task) + " is done",
                      "<task name=\"" + task + "\" stands=\"…\" offers=\"…\"/>");
  }
  for (const char* action : {"drag", "pinch", "lift", "turn"}) {
    if (std::ranges::find(words.actions, action, &AssemblyWords::Action::name) != words.actions.end()) continue;
    diagnostics.error(968, root.where(), std::string("nothing says how to ") + action,
                      std::string("<action name=\"") + action + "\" keys=\"…\" does=\"…\"/>");
  }
  return words;
}

/// Empty for another language.
const char* shippedText(const std::string& language) {
  return language == "en" ? shipped::words_en : language == "it" ? shipped::words_it : "";
}

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + xml::escaped(value) + "\"";
}

}  // namespace

const char* elementName(BlockKind kind) {
  switch (kind) {
    case BlockKind::kDrum:
      return "drum";
    case BlockKind::kCapital:
      return "capital";
    case BlockKind::kArchitrave:
      return "architrave";
    case BlockKind::kTriglyph:
      return "triglyph";
    case BlockKind::kMetope:
      return "metope";
    case BlockKind::kCornice:
      return "cornice";
    case BlockKind::kTympanum:
      return "tympanum";
    case BlockKind::kRakingCornice:
      return "raking_cornice";
    case BlockKind::kTile:
      break;
  }
  return "tile";
}

std::vector<std::string> shippedLanguages() { return {"en", "it"}; }

TaskWords taskWords(const std::string& language, const std::string& task) {
  Diagnostics diagnostics;
  const auto document = xml::Document::parse(shippedText(language), "words", diagnostics);
  if (!document) return {};
  for (const xml::Element& one : document->root().children("task"))
    if (one.attribute("name") == task) return {one.attribute("stands"), one.attribute("offers")};
  return {};
}

void tellOfTenons(AssemblyWords& words, const std::string& language) {
  Diagnostics diagnostics;
  const auto document = xml::Document::parse(shippedText(language), "words", diagnostics);
  if (!document) return;
  for (const xml::Element& tenon : document->root().children("tenon")) {
    const auto element = std::ranges::find(words.elements, tenon.attribute("of"), &AssemblyWords::Element::name);
    if (element == words.elements.end()) continue;
    element->says = tenon.attribute("says");
    element->stories.insert(element->stories.begin(), {tenon.attribute("story"), tenon.attribute("source")});
  }
}

AssemblyWords shippedWords(const std::string& language, Diagnostics& diagnostics) {
  const char* text = shippedText(language);
  if (*text == '\0') {
    diagnostics.error(969, {"--language", 0, 0}, "there are no words in language " + quote(language), "en or it");
    return {};
  }
  const auto document = xml::Document::parse(text, "config/temple/words_" + language + ".xml", diagnostics);
  return document ? readChecked(*document, diagnostics) : AssemblyWords{};
}

AssemblyWords readWordsFile(const std::string& file, Diagnostics& diagnostics) {
  const auto document = xml::Document::load(file, diagnostics);
  return document ? readChecked(*document, diagnostics) : AssemblyWords{};
}

std::string wordsText(const AssemblyWords& words) {
  std::string text = "    <words" + attribute("language", words.language);
  for (const AssemblyPhrase& phrase : assemblyPhrases())
    text += "\n          " + attribute(phrase.attribute, words.*phrase.text);
  text += ">\n";
  for (const AssemblyWords::Element& element : words.elements) {
    text += "      <element" + attribute("name", element.name) + attribute("called", element.called) +
            attribute("says", element.says) + attribute("waits", element.waits) + ">\n";
    for (const AssemblyWords::Element::Story& story : element.stories)
      text += "        <story" + attribute("says", story.says) + attribute("source", story.source) + "/>\n";
    text += "      </element>\n";
  }
  for (const AssemblyWords::Action& action : words.actions)
    text += "      <action" + attribute("name", action.name) + attribute("keys", action.keys) +
            attribute("does", action.does) + "/>\n";
  return text + "    </words>\n";
}

}  // namespace presa::temple
