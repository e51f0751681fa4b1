#include "apps/common/options/command_line.h"

#include <CLI/CLI.hpp>
#include <sstream>
#include <utility>

#include "apps/common/options/usage.h"

namespace presa {
namespace {

/// Says what is wrong with a number before the parser does.
CLI::Validator number(NumberRule rule, const std::string& kind) {
  return CLI::Validator([rule](const std::string& value) { return numberTrouble(value, rule); }, kind);
}

/// In the help.
std::string rangeText(double min, double max) {
  std::ostringstream text;
  text << "in [" << min << " - " << max << "]";
  return text.str();
}

constexpr NumberRule kAny{}, kWhole{.whole = true}, kCount{.whole = true, .min = 0};

/// An option whose values are numbers of this kind.
Option numeric(CLI::Option& option, const NumberRule& rule) { return Option(*option.check(number(rule, ""))); }

}  // namespace

Option& Option::required() { return option_->required(), *this; }
Option& Option::positive() { return option_->check(number({.above = true, .min = 0}, "POSITIVE")), *this; }
Option& Option::nonNegative() { return option_->check(number({.min = 0}, "NONNEGATIVE")), *this; }
Option& Option::within(double min, double max) {
  return option_->check(number({.min = min, .max = max}, rangeText(min, max))), *this;
}
Option& Option::withinCount(int min, int max) {
  return option_->check(number({.whole = true, .min = static_cast<double>(min), .max = static_cast<double>(max)},
                               rangeText(min, max))),
         *this;
}
Option& Option::oneOf(const std::vector<std::string>& words) {
  return checked([words](const std::string& value) { return choiceTrouble(value, words); },
                 "{" + CLI::detail::join(words, ",") + "}");
}
Option& Option::existingFile() { return option_->check(CLI::ExistingFile), *this; }
Option& Option::existingFolder() { return option_->check(CLI::ExistingDirectory), *this; }
Option& Option::checked(std::function<std::string(const std::string&)> problem, const std::string& kind) {
  option_->check(
      CLI::Validator([problem = std::move(problem)](const std::string& value) { return problem(value); }, kind));
  return *this;
}
Option& Option::excludes(const Option& other) { return option_->excludes(other.option_), *this; }
Option& Option::values(int min, int max) { return option_->expected(min, max), *this; }
Option& Option::oneValueEach() { return option_->allow_extra_args(false), *this; }
Option& Option::separatedBy(char delimiter) { return option_->delimiter(delimiter), *this; }
Option& Option::showDefault() { return option_->capture_default_str(), *this; }
Option& Option::kind(const std::string& name) { return option_->type_name(name), *this; }
Option& Option::atOnce() { return option_->trigger_on_parse(), *this; }

Command Command::command(const std::string& name, const std::string& summary) {
  return Command(*app_->add_subcommand(name, summary));
}
void Command::needCommand() { app_->require_subcommand(1); }
void Command::footer(const std::string& text) { app_->footer(text); }
void Command::action(std::function<void()> run) { app_->callback(std::move(run)); }

Option Command::option(const std::string& name, std::string& value, const std::string& help) {
  return Option(*app_->add_option(name, value, help));
}
Option Command::option(const std::string& name, double& value, const std::string& help) {
  return numeric(*app_->add_option(name, value, help), kAny);
}
Option Command::option(const std::string& name, int& value, const std::string& help) {
  return numeric(*app_->add_option(name, value, help), kWhole);
}
Option Command::option(const std::string& name, unsigned& value, const std::string& help) {
  return numeric(*app_->add_option(name, value, help), kCount);
}
Option Command::option(const std::string& name, std::uint64_t& value, const std::string& help) {
  return numeric(*app_->add_option(name, value, help), kCount);
}
Option Command::option(const std::string& name, std::optional<double>& value, const std::string& help) {
  return numeric(*app_->add_option(name, value, help), kAny);
}
Option Command::option(const std::string& name, std::optional<int>& value, const std::string& help) {
  return numeric(*app_->add_option(name, value, help), kWhole);
}
Option Command::option(const std::string& name, std::optional<std::uint64_t>& value, const std::string& help) {
  return numeric(*app_->add_option(name, value, help), kCount);
}
Option Command::option(const std::string& name, std::optional<std::string>& value, const std::string& help) {
  return Option(*app_->add_option(name, value, help));
}
Option Command::option(const std::string& name, std::vector<std::string>& values, const std::string& help) {
  return Option(*app_->add_option(name, values, help));
}
Option Command::option(const std::string& name, std::vector<double>& values, const std::string& help) {
  return numeric(*app_->add_option(name, values, help), kAny);
}
Option Command::flag(const std::string& name, bool& set, const std::string& help) {
  return Option(*app_->add_flag(name, set, help));
}
Option Command::each(const std::string& name, std::function<void(const std::string&)> take, const std::string& help) {
  return Option(*app_->add_option_function<std::string>(name, std::move(take), help));
}
Option Command::eachNumber(const std::string& name, std::function<void(int)> take, const std::string& help) {
  return numeric(*app_->add_option_function<int>(
                     name, [take = std::move(take)](const int& value) { take(value); }, help),
                 kWhole);
}
bool Command::given(const std::string& name) const { return app_->count(name) > 0; }
Option Command::named(const std::string& name) { return Option(*app_->get_option(name)); }

}  // namespace presa
