#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// The command line of Presa's programs: a narrow facade over the option parser, whose templates are compiled once, in
/// command_line.cpp. Everything is declared before parse(); the values are in place when a command's action runs.
/// Thread: main. Errors in a declaration (a name used twice) throw std::logic_error.
namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace presa {

/// One option, flag or positional argument. A handle: copies name the same option.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option& required();
  Option& positive();     ///< a number above 0
  Option& nonNegative();  ///< a number of at least 0
  Option& within(double min, double max);
  Option& withinCount(int min, int max);  ///< whole numbers
  Option& oneOf(const std::vector<std::string>& words);
  Option& existingFile();
  Option& existingFolder();
  /// `problem` returns what is wrong with a value, or an empty string; `kind` names the value in the help.
  Option& checked(std::function<std::string(const std::string&)> problem, const std::string& kind);
  Option& excludes(const Option& other);
  Option& values(int min, int max);  ///< how many values follow it
  Option& oneValueEach();            ///< repeatable, one value each time
  Option& separatedBy(char delimiter);
  Option& showDefault();
  Option& kind(const std::string& name);  ///< of the value, in the help
  Option& atOnce();                       ///< its action runs as soon as it is parsed, not after the last option

 private:
  CLI::Option* option_;
};

/// A command, or a group of commands (`presa bus`).
class Command {
 public:
  explicit Command(CLI::App& app) : app_(&app) {}

  Command command(const std::string& name, const std::string& summary);
  void needCommand();  ///< one of its subcommands must follow
  void footer(const std::string& text);
  void action(std::function<void()> run);  ///< runs after its options have been parsed

  // Positional if the name has no dashes. `value` must live until the program ends.
  Option option(const std::string& name, std::string& value, const std::string& help);
  Option option(const std::string& name, double& value, const std::string& help);
  Option option(const std::string& name, int& value, const std::string& help);
  Option option(const std::string& name, unsigned& value, const std::string& help);
  Option option(const std::string& name, std::uint64_t& value, const std::string& help);
  Option option(const std::string& name, std::optional<double>& value, const std::string& help);
  Option option(const std::string& name, std::optional<int>& value, const std::string& help);
  Option option(const std::string& name, std::optional<std::uint64_t>& value, const std::string& help);
  Option option(const std::string& name, std::optional<std::string>& value, const std::string& help);
  Option option(const std::string& name, std::vector<std::string>& values, const std::string& help);
  Option option(const std::string& name, std::vector<double>& values, const std::string& help);
  Option flag(const std::string& name, bool& set, const std::string& help);
  /// Calls `take` with each value.
  Option each(const std::string& name, std::function<void(const std::string&)> take, const std::string& help);
  Option eachNumber(const std::string& name, std::function<void(int)> take, const std::string& help);
  bool given(const std::string& name) const;  ///< in an action: whether the user gave it
  /// An option that was declared before.
  Option named(const std::string& name);

 private:
  CLI::App* app_;
};

}  // namespace presa
