#include "apps/common/options/usage.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "framework/core/diagnostics/printable.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa {
namespace {

enum UsageCode { kBadArgument = 123 };

std::string quoted(const std::string& word) { return "'" + printable(word) + "'"; }

std::string shortNumber(double value) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.10g", value);
  return text.data();
}

/// "a, b or c"
std::string listed(const std::vector<std::string>& words, const char* last) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? std::string(" ") + last + " " : ", ") + words[i];
  return text;
}

/// "a whole number of at least 0"
std::string wanted(const NumberRule& rule) {
  const std::string number = rule.whole ? "a whole number" : "a number";
  const bool low = rule.min > -1e300, high = rule.max < 1e300;
  if (low && high) return number + " from " + shortNumber(rule.min) + " to " + shortNumber(rule.max);
  if (low) return number + (rule.above ? " above " : " of at least ") + shortNumber(rule.min);
  return high ? number + " of at most " + shortNumber(rule.max) : number;
}

/// "presa run"
std::string commandOf(const CLI::App& app) {
  return (app.get_parent() == nullptr ? "" : commandOf(*app.get_parent()) + " ") + app.get_name();
}

/// The commands that may follow; none where options follow.
std::vector<std::string> commandsOf(const CLI::App& app, const std::vector<std::string>& programs) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  if (names.empty()) return names;
  const std::string group = app.get_parent() == nullptr ? "" : app.get_name() + "-";
  for (const std::string& program : programs) {
    const std::string name = program.substr(std::min(program.size(), group.size()));
    if (program.starts_with(group) && name.find('-') == std::string::npos &&
        std::ranges::find(names, name) == names.end())
      names.push_back(name);
  }
  return names;
}

const CLI::App& parsedCommand(const CLI::App& app) {
  const auto parsed = app.get_subcommands();
  return parsed.empty() ? app : parsedCommand(*parsed.front());
}

std::vector<std::string> optionsOf(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::string placesOf(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) text += (text.empty() ? "" : " ") + option->get_name();
  }
  return text.empty() ? "no file and no name" : text;
}

bool takesFiles(const CLI::App& app) {
  return std::ranges::any_of(app.get_options(), [](const CLI::Option* option) { return option->get_positional(); });
}

bool needsCommand(const CLI::App& app) { return app.get_require_subcommand_min() > 0; }

bool isFile(const std::string& word) {
  std::error_code ignored;
  return word.ends_with(".xml") || word.ends_with(".h5") || std::filesystem::is_regular_file(word, ignored);
}

[[noreturn]] void refuseWord(const CLI::App& at, const std::string& word, const std::vector<std::string>& names) {
  const std::string here = commandOf(at);
  const std::string more = here + " --help tells what each command does";
  if (at.get_parent() == nullptr && (word == "version" || word == "-v" || word == "-V"))
    refuse(kBadArgument, here, "there is no command " + quoted(word), "presa --version prints the version");
  if (isFile(word)) {
    const std::string verb = word.ends_with(".h5") ? "presa replay " : "presa run ";
    refuse(kBadArgument, here, "a command must come before the file " + quoted(word), verb + printable(word));
  }
  if (word.starts_with("-")) {
    refuse(kBadArgument, here, "a command must come before the option " + quoted(word) + ": " + listed(names, "or"),
           more);
  }
  refuse(kBadArgument, here, "there is no command " + quoted(word) + didYouMean(word, names),
         "commands: " + listed(names, "and") + "; " + more);
}

/// The part of the parser's message before a separator: an option's name.
std::string before(const std::string& message, const std::string& separator) {
  return message.substr(0, message.find(separator));
}

std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

std::string extraWord(const CLI::App& command) {
  const std::vector<std::string> extra = command.remaining();
  const std::string word = extra.empty() ? "" : extra.front();
  if (!word.starts_with("-"))
    return quoted(word) + " is one argument too many: " + commandOf(command) + " takes " + placesOf(command);
  const std::string option = before(word, "=");
  return "there is no option " + quoted(option) + didYouMean(option, optionsOf(command));
}

/// "SCENE is missing: scene file, e.g. …"
std::string missing(const CLI::App& command, const std::string& name) {
  const CLI::Option* option = command.get_option_no_throw(name);
  return name + " is missing" + (option == nullptr ? "" : ": " + firstLine(option->get_description()));
}

std::string sentenceOf(const CLI::App& command, const CLI::ParseError& error) {
  const std::string message = error.what();
  const auto kind = static_cast<CLI::ExitCodes>(error.get_exit_code());
  if (kind == CLI::ExitCodes::ExtrasError) return extraWord(command);
  if (kind == CLI::ExitCodes::ArgumentMismatch) return before(message, ":") + " needs a value";
  if (kind == CLI::ExitCodes::RequiredError && message.ends_with(" is required"))
    return missing(command, before(message, " is required"));
  if (kind == CLI::ExitCodes::ExcludesError) {
    const std::string one = before(message, " excludes ");
    return one + " and " + message.substr(std::min(message.size(), one.size() + 10)) + " exclude each other";
  }
  const std::size_t colon = message.find(": expects ");
  return colon == std::string::npos ? printable(message) : message.substr(0, colon) + message.substr(colon + 1);
}

}  // namespace

std::string numberTrouble(const std::string& text, const NumberRule& rule) {
  double value = 0;
  const char *begin = text.data(), *end = begin + text.size();
  const auto [rest, status] = std::from_chars(begin + (text.starts_with("+") ? 1 : 0), end, value);
  const bool number = status == std::errc{} && rest == end && std::isfinite(value);
  if (number && !(rule.whole && value != std::floor(value)) && value <= rule.max &&
      (rule.above ? value > rule.min : value >= rule.min))
    return {};
  std::string trouble = "expects " + wanted(rule) + ", found " + quoted(text);
  if (status == std::errc{} && rest != end && std::isalpha(static_cast<unsigned char>(*rest)) != 0)
    trouble += "; write it without a unit: " + std::string(begin, rest);
  return trouble;
}

std::string choiceTrouble(const std::string& text, const std::vector<std::string>& words) {
  if (std::ranges::find(words, text) != words.end()) return {};
  return "expects " + listed(words, "or") + ", found " + quoted(text) + didYouMean(text, words);
}

void requireCommand(const CLI::App& app, std::vector<std::string>& words, const std::vector<std::string>& programs) {
  const CLI::App* at = &app;
  for (std::string& word : words) {
    const std::vector<std::string> names = commandsOf(*at, programs);
    if (names.empty()) return;
    if (word == "help") word = "--help";
    const std::vector<std::string> options = optionsOf(*at);
    if (word == "-h" || std::ranges::find(options, word) != options.end()) return;
    const auto known = at->get_subcommands([&](const CLI::App* command) { return command->get_name() == word; });
    const CLI::App* next = known.empty() ? nullptr : known.front();
    if (next == nullptr && takesFiles(*at)) return;  // as presa cost SCENE beside presa cost merge
    if (next == nullptr && word.starts_with("-") && !needsCommand(*at)) return;  // as presa stability beside its merge
    if (next == nullptr) refuseWord(*at, word, names);
    at = next;
  }
  const std::vector<std::string> names = commandsOf(*at, programs);
  if (names.empty() || takesFiles(*at) || !needsCommand(*at)) return;
  const std::string here = commandOf(*at);
  refuse(kBadArgument, here, "a command is missing: " + listed(names, "or"),
         here + " --help tells what each does" +
             (at == &app ? "; presa run config/scenes/cube.xml shows two fingers lift a cube" : ""));
}

void refuseUsage(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = parsedCommand(app);
  refuse(kBadArgument, commandOf(command), sentenceOf(command, error),
         commandOf(command) + " --help lists its options");
}

}  // namespace presa
