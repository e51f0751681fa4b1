#pragma once
#include <string>
#include <vector>

#include "apps/temple/building/block.h"
#include "framework/core/diagnostics/diagnostics.h"
#include "framework/scene/assembly_words.h"

namespace presa::temple {

/// Name of a kind of block in words files and scenes, such as "raking_cornice".
const char* elementName(BlockKind kind);

/// Languages of the shipped words: "en", "it".
std::vector<std::string> shippedLanguages();
/// Reads the shipped words (config/temple/words_LANGUAGE.xml) and checks that every kind of block has an entry. Errors
/// go to `diagnostics` (E966 format version, E969 unknown language, E968 a kind of block, or something to do, without
/// words, E203, E219). Never throws for bad input.
AssemblyWords shippedWords(const std::string& language, Diagnostics& diagnostics);
/// The same from a file.
AssemblyWords readWordsFile(const std::string& file, Diagnostics& diagnostics);

/// What visitors are told about a task as a whole.
struct TaskWords {
  std::string stands;  ///< what was rebuilt
  std::string offers;  ///< offers it as the next task; {time} is when it begins by itself
};
/// Those of a shipped building ("first", "column", "facade"), or empty texts for another name. `language` is a shipped
/// one.
TaskWords taskWords(const std::string& language, const std::string& task);

/// Lets the words tell of tenons, as the shipped ones of `language` do.
void tellOfTenons(AssemblyWords& words, const std::string& language);

/// The <words> element of a scene.
std::string wordsText(const AssemblyWords& words);

}  // namespace presa::temple
