#pragma once
#include <string>
#include <vector>

namespace presa {

inline constexpr std::size_t kNoElement = static_cast<std::size_t>(-1);

/// What people are told about an assembly, in one language. In a phrase {count}, {all}, {element} and {time} are filled in; which of
/// them a phrase may hold is in assemblyPhrases().
struct AssemblyWords {
  /// A kind of body: "capital".
  struct Element {
    std::string name;    ///< by which goals refer to it
    std::string called;  ///< as people call it, as at the beginning of a sentence
    std::string says;    ///< one sentence about it
    std::string waits;   ///< why it cannot be put yet: "The capital needs its drum first."
  };
  std::string language = "en";
  std::string progress = "{count} of {all}";
  std::string next = "Next: {element}";
  std::string placed = "Placed: {element}";
  std::string undone = "Taken out: {element}";
  std::string dropped = "{element}: fallen, and still within reach";
  std::string finished = "All stands.";
  std::string took = "In {time}.";
  std::string invitation = "Touch to begin";
  std::vector<Element> elements;
};

/// A phrase, the attribute that holds it, and what is filled in there.
struct AssemblyPhrase {
  const char* attribute;
  std::string AssemblyWords::*text;
  std::vector<std::string> places;
};
const std::vector<AssemblyPhrase>& assemblyPhrases();

/// `text` with {place} replaced by what stands for it.
std::string fillIn(std::string text, const std::string& place, const std::string& value);
/// Places in a phrase: "{count} of {all}" has count and all.
std::vector<std::string> placesIn(const std::string& text);

}  // namespace presa
