#pragma once
#include <string>
#include <vector>

namespace presa {

inline constexpr std::size_t kNoElement = static_cast<std::size_t>(-1);

/// The texts shown to a user about an assembly, in one language. The placeholders {count}, {all}, {element} and {time}
/// are replaced; assemblyPhrases() lists the placeholders that each phrase may use.
struct AssemblyWords {
  /// A kind of body, such as "capital".
  struct Element {
    std::string name;    ///< identifier that goals refer to
    std::string called;  ///< name shown to the user, capitalised
    std::string says;    ///< one sentence about it
    std::string waits;   ///< reason why it cannot be placed yet: "The capital needs its drum first."
    struct Story {
      std::string says;    ///< a further sentence
      std::string source;  ///< where it is written; not shown
    };
    std::vector<Story> stories;  ///< told in turn after `says`, one for each body taken
  };
  /// Something that a visitor does with mouse or keys, such as "drag".
  struct Action {
    std::string name;  ///< drag, pinch, lift, turn: shown by a hand at the start; others only in the help
    std::string keys;  ///< what to do: "Turn the wheel forwards"
    std::string does;  ///< what happens: "the fingers close"
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
  std::vector<Action> actions;  ///< in the order of the help table; empty: not for visitors with a mouse
};

/// A phrase: its attribute in the XML, its text, and the placeholders it may use.
struct AssemblyPhrase {
  const char* attribute;
  std::string AssemblyWords::*text;
  std::vector<std::string> places;
};
const std::vector<AssemblyPhrase>& assemblyPhrases();

/// `text` with every {place} replaced by `value`.
std::string fillIn(std::string text, const std::string& place, const std::string& value);
/// Placeholders of a phrase: "{count} of {all}" has count and all.
std::vector<std::string> placesIn(const std::string& text);

}  // namespace presa
