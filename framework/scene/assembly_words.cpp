#include "framework/scene/assembly_words.h"

#include <algorithm>

#include "framework/scene/scene_parts.h"
#include "framework/scene/xml/value_rule.h"

namespace presa {

const std::vector<AssemblyPhrase>& assemblyPhrases() {
  using Words = AssemblyWords;
  static const std::vector<AssemblyPhrase> phrases{{"progress", &Words::progress, {"count", "all"}},
                                                   {"next", &Words::next, {"element"}},
                                                   {"placed", &Words::placed, {"element"}},
                                                   {"undone", &Words::undone, {"element"}},
                                                   {"dropped", &Words::dropped, {"element"}},
                                                   {"finished", &Words::finished, {}},
                                                   {"took", &Words::took, {"time"}},
                                                   {"invitation", &Words::invitation, {}}};
  return phrases;
}

std::string fillIn(std::string text, const std::string& place, const std::string& value) {
  const std::string mark = "{" + place + "}";
  for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; at += value.size())
    text.replace(at, mark.size(), value);
  return text;
}

std::vector<std::string> placesIn(const std::string& text) {
  std::vector<std::string> places;
  for (std::size_t open = 0; (open = text.find('{', open)) != std::string::npos; ++open) {
    const std::size_t close = text.find('}', open);
    if (close == std::string::npos) break;
    places.push_back(text.substr(open + 1, close - open - 1));
  }
  return places;
}

namespace {

void checkPhrase(const xml::Element& words, const AssemblyPhrase& phrase, Diagnostics& diagnostics) {
  std::string allowed;
  for (const std::string& place : phrase.places) allowed += (allowed.empty() ? "{" : ", {") + place + "}";
  for (const std::string& place : placesIn(words.attribute(phrase.attribute))) {
    if (std::find(phrase.places.begin(), phrase.places.end(), place) != phrase.places.end()) continue;
    diagnostics.error(219, words.where(phrase.attribute),
                      quote(phrase.attribute) + " has no placeholder {" + place + "}",
                      allowed.empty() ? "this phrase takes no placeholders" : "available placeholders: " + allowed);
  }
}

}  // namespace

void checkWords(const xml::Element& words, Diagnostics& diagnostics) {
  for (const AssemblyPhrase& phrase : assemblyPhrases()) checkPhrase(words, phrase, diagnostics);
  for (const char* kind : {"element", "action"}) {
    std::vector<std::string> names;
    for (const xml::Element& element : words.children(kind)) {
      const std::string name = element.attribute("name");
      if (std::find(names.begin(), names.end(), name) != names.end())
        diagnostics.error(203, element.where("name"), std::string("a second ") + kind + " is named " + quote(name));
      names.push_back(name);
    }
  }
}

AssemblyWords readWords(const xml::Element& element) {
  AssemblyWords words;
  words.language = element.attribute("language", words.language);
  for (const AssemblyPhrase& phrase : assemblyPhrases())
    words.*phrase.text = element.attribute(phrase.attribute, words.*phrase.text);
  for (const xml::Element& one : element.children("element")) {
    AssemblyWords::Element& kind = words.elements.emplace_back();
    kind.name = one.attribute("name");
    kind.called = one.attribute("called");
    kind.says = one.attribute("says");
    kind.waits = one.attribute("waits");
    for (const xml::Element& story : one.children("story"))
      kind.stories.push_back({story.attribute("says"), story.attribute("source")});
  }
  for (const xml::Element& one : element.children("action"))
    words.actions.push_back({one.attribute("name"), one.attribute("keys"), one.attribute("does")});
  return words;
}

}  // namespace presa
