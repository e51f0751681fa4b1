#pragma once
#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace presa {

/// What is wrong with a word that should be a number, with the cure; empty: nothing. `above`: greater than `min`, not
/// equal to it.
struct NumberRule {
  bool whole = false, above = false;
  double min = -1e300, max = 1e300;
};
std::string numberTrouble(const std::string& text, const NumberRule& rule);

/// What is wrong with a word that should be one of these; empty: nothing.
std::string choiceTrouble(const std::string& text, const std::vector<std::string>& words);

/// Before parsing: the words must begin with a command of `app` (and of its groups); the word `help` in the place of a
/// command becomes `--help`. `programs`: commands of other programs, their words joined by
/// dashes. Throws InputError E123 with one sentence.
void requireCommand(const CLI::App& app, std::vector<std::string>& words, const std::vector<std::string>& programs);

/// The parser's complaint as one sentence of Presa's. Throws InputError E123.
[[noreturn]] void refuseUsage(const CLI::App& app, const CLI::ParseError& error);

}  // namespace presa
