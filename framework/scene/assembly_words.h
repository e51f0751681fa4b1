#pragma once
#include <string>
#include <vector>

namespace presa {

inline constexpr std::size_t kNoElement = static_cast<std::size_t>(-1);  ///< an index of an element that means none

/// The texts shown to a user about an assembly, in one language. The placeholders {count}, {all}, {element} and {time}
/// are replaced; assemblyPhrases() lists the placeholders that each phrase may use.
struct AssemblyWords {
  /// A kind of body, such as "capital".
  struct Element {
    std::string name;    ///< identifier that goals refer to
    std::string called;  ///< name shown to the user, capitalised
    std::string says;    ///< one sentence about it
    std::string waits;   ///< reason why it cannot be placed yet: "The capital needs its drum first."
    /// A further sentence about a kind of body.
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
  std::string language = "en";                                        ///< two letters such as "en"
  std::string progress = "{count} of {all}";                          ///< how many goals are filled
  std::string next = "Next: {element}";                               ///< kind of the next body
  std::string placed = "Placed: {element}";                           ///< a body fills its goal
  std::string undone = "Taken out: {element}";                        ///< an undo took a body out
  std::string dropped = "{element}: fallen, and still within reach";  ///< a body fell
  std::string finished = "All stands.";                               ///< every goal is filled
  std::string took = "In {time}.";                                    ///< after `finished`: assembly time
  std::string invitation = "Touch to begin";                          ///< shown until somebody touches
  std::vector<Element> elements;                                      ///< kinds that goals refer to
  std::vector<Action> actions;  ///< in the order of the help table; empty: not for visitors with a mouse
};

/// A phrase: its attribute in the XML, its text, and the placeholders it may use.
struct AssemblyPhrase {
  const char* attribute;             ///< "progress"
  std::string AssemblyWords::*text;  ///< &AssemblyWords::progress
  std::vector<std::string> places;   ///< "count", "all"
};
/// All phrases, in the order of AssemblyWords.
const std::vector<AssemblyPhrase>& assemblyPhrases();

/// `text` with every {place} replaced by `value`.
std::string fillIn(std::string text, const std::string& place, const std::string& value);
/// Placeholders of a phrase: "{count} of {all}" has count and all.
std::vector<std::string> placesIn(const std::string& text);

}  // namespace presa
