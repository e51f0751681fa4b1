#include <charconv>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/common/options/bus_options.h"
#include "apps/common/terminal/interruption.h"
#include "apps/presa/commands/commands.h"
#include "apps/presa/remote/commanding.h"
#include "apps/presa/remote/viewer.h"
#include "framework/core/diagnostics/printable.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa {
namespace {

struct Setting {
  std::string parameter;
  double value = 0;
};

std::string text(double value) {
  std::array<char, 40> digits;
  std::snprintf(digits.data(), digits.size(), "%.6g", value);
  return digits.data();
}

std::string rangeOf(double min, double max) { return text(min) + " to " + text(max); }
std::string nameOf(const FoundRun& run) {
  return "run " + textOfRun(run.info.run) + " of scene '" + printable(run.info.scene_name) + "'";
}

/// Parses all values before the first one is sent. NaN and infinity are accepted here; the run refuses them.
std::vector<Setting> parseSettings(const std::vector<std::string>& words) {
  std::vector<Setting> settings;
  Diagnostics diagnostics;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    Setting setting{word.substr(0, equals)};
    const char* begin = word.data() + (equals == std::string::npos ? word.size() : equals + 1);
    const auto [end, error] = std::from_chars(begin, word.data() + word.size(), setting.value);
    const bool number = error == std::errc{} && end == word.data() + word.size();
    if (setting.parameter.empty() || setting.parameter.size() > bus::kLongestParameter || !number)
      diagnostics.error(123, {"presa bus set", 0, 0}, "expected NAME=NUMBER, found " + quote(word),
                        "for example material/steel/stiffness=500; presa bus list shows the names");
    settings.push_back(std::move(setting));
  }
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  return settings;
}

int fail(int code, int status, const std::string& message, const std::string& help) {
  Diagnostics diagnostics;
  diagnostics.error(code, {"bus", 0, 0}, message, help);
  std::fputs(diagnostics.text().c_str(), stderr);
  return status;
}

/// The run that the options select; null: none, and `status` is the exit status.
const FoundRun* choose(const std::vector<FoundRun>& runs, std::uint64_t id, int& status) {
  const FoundRun* chosen = nullptr;
  const FoundRun* closed = nullptr;
  std::string open;
  for (const FoundRun& run : runs) {
    if (id != 0 && run.info.run != id) continue;
    if (!run.info.commands) {
      closed = &run;
      continue;
    }
    chosen = &run;
    open += (open.empty() ? "" : ", ") + textOfRun(run.info.run);
  }
  if (open.find(',') != std::string::npos) {
    status = fail(724, kExitBadInput, "several runs take commands: " + open, "--run ID says which; presa bus list");
    return nullptr;
  }
  if (chosen == nullptr && closed != nullptr)
    status = fail(723, kExitNoRun, nameOf(*closed) + " takes no commands", "start it with presa run … --bus-commands");
  if (chosen == nullptr && closed == nullptr)
    status = fail(722, kExitNoRun, id != 0 ? "no run " + textOfRun(id) + " on the bus" : "no run on the bus",
                  "presa run SCENE --bus loopback --bus-commands; --wait says how long to look for one");
  return chosen;
}

/// Prints the outcome of one command; returns whether it was accepted.
bool tell(const FoundRun& run, const Setting& setting, const bus::Answer& answer) {
  using Verdict = bus::Answer::Verdict;
  if (answer.verdict == Verdict::kAccepted) {
    std::printf("%s = %s (%s)\n", setting.parameter.c_str(), text(answer.value).c_str(),
                rangeOf(answer.min, answer.max).c_str());
    return true;
  }
  const std::string found = setting.parameter + "=" + text(setting.value);
  if (answer.verdict == Verdict::kUnknown) {
    std::vector<std::string> names;
    for (const bus::OpenParameter& parameter : run.parameters) names.push_back(parameter.name);
    fail(726, 0,
         nameOf(run) + " has no parameter " + quote(setting.parameter) + " that is open to commands" +
             didYouMean(setting.parameter, names),
         "presa bus list shows them");
    return false;
  }
  const std::string keeps = "; it stays " + text(answer.value);
  if (answer.verdict == Verdict::kOutOfRange)
    fail(727, 0, "refused: " + found + " is outside of " + rangeOf(answer.min, answer.max) + keeps, {});
  else if (answer.verdict == Verdict::kNotANumber)
    fail(728, 0, "refused: " + found + " is not a number" + keeps, rangeOf(answer.min, answer.max) + " is allowed");
  else if (answer.verdict == Verdict::kOutOfOrder)
    fail(757, 0,
         "refused: " + found + " has a sequence number out of order; another program sends commands under this name",
         {});
  else
    fail(729, 0, "refused: " + found + " was overtaken by a later command" + keeps, {});
  return false;
}

struct ParameterArguments {
  std::vector<std::string> words;
  std::string run;
  double wait = 3;
  bool json = false;
};

std::uint64_t wantedRun(const std::string& words) {
  const std::uint64_t id = words.empty() ? 0 : runFrom(words);
  if (id == 0 && !words.empty())
    refuse(123, "--run", "expected the id of a run, hexadecimal, found " + quote(words), "presa bus list shows them");
  return id;
}

int set(const ParameterArguments& arguments, const BusSettings& bus) {
  const std::vector<Setting> settings = parseSettings(arguments.words);
  const std::uint64_t id = wantedRun(arguments.run);
  const terminal::Interruption interruption;
  Commanding commanding(bus);
  commanding.look(arguments.wait, id);
  if (terminal::Interruption::came()) return kExitInterrupted;
  int status = kExitOk;
  const FoundRun* found = choose(commanding.look(0, id), id, status);
  if (found == nullptr) return status;
  const FoundRun run = *found;
  for (const Setting& setting : settings) {
    const auto answer = commanding.set(run.info.run, setting.parameter, setting.value, arguments.wait);
    if (terminal::Interruption::came()) return kExitInterrupted;
    if (!answer)
      return fail(725, kExitNoRun, nameOf(run) + " did not answer within " + text(arguments.wait) + " s",
                  "it has ended, is suspended, or was killed; presa bus list shows the runs that are there");
    if (!tell(run, setting, *answer)) status = kExitFault;
  }
  return status;
}

void print(const FoundRun& run) {
  std::printf("%s, %s%s\n", printable(nameOf(run)).c_str(), run.info.realtime ? "real time" : "lockstep",
              run.info.commands ? "" : ", takes no commands");
  for (const bus::OpenParameter& parameter : run.parameters)
    std::printf("  %-44s %10s   %s\n", printable(parameter.name).c_str(), text(parameter.value).c_str(),
                rangeOf(parameter.min, parameter.max).c_str());
}

nlohmann::ordered_json toJson(const FoundRun& run) {
  auto parameters = nlohmann::ordered_json::array();
  for (const bus::OpenParameter& parameter : run.parameters)
    parameters.push_back(
        {{"name", parameter.name}, {"value", parameter.value}, {"least", parameter.min}, {"most", parameter.max}});
  return {{"run", textOfRun(run.info.run)},
          {"scene", run.info.scene_name},
          {"realtime", run.info.realtime},
          {"commands", run.info.commands},
          {"parameters", parameters}};
}

int list(const ParameterArguments& arguments, const BusSettings& bus) {
  const terminal::Interruption interruption;
  Commanding commanding(bus);
  const std::vector<FoundRun>& runs = commanding.look(arguments.wait, 0);
  if (terminal::Interruption::came()) return kExitInterrupted;
  if (arguments.json) {
    auto all = nlohmann::ordered_json::array();
    for (const FoundRun& run : runs) all.push_back(toJson(run));
    // names are bytes from outside: escape them, so that the output is always ASCII
    std::printf("%s\n", all.dump(2, ' ', true, nlohmann::json::error_handler_t::replace).c_str());
  } else {
    for (const FoundRun& run : runs) print(run);
  }
  if (!runs.empty()) return kExitOk;
  return fail(722, kExitNoRun, "no run on the bus within " + text(arguments.wait) + " s",
              "presa run SCENE --bus loopback; the same --bus and --domain on both sides");
}

}  // namespace

void addBusList(Command app, int& status) {
  auto a = std::make_shared<ParameterArguments>();
  auto bus = std::make_shared<std::optional<BusSettings>>();
  Command command = app.command("list", "The runs on the bus, and which of their parameters may be set");
  addBusOptions(command, *bus, "the network to look on");
  command.option("--wait", a->wait, "seconds to look for runs").nonNegative().showDefault();
  command.flag("--json", a->json, "as JSON");
  command.footer("Exit status: 0 there is a run, 3 none within --wait, 130 Ctrl-C.");
  command.action([=, &status] { status = list(*a, bus->value_or(BusSettings{})); });
}

void addBusSet(Command app, int& status) {
  auto a = std::make_shared<ParameterArguments>();
  auto bus = std::make_shared<std::optional<BusSettings>>();
  Command command = app.command("set", "Set parameters of a run that takes commands");
  command.option("SETTING", a->words, "NAME=VALUE: a parameter and its new value, as presa bus list shows them")
      .required();
  command.option("--run", a->run, "id of the run, where several take commands");
  addBusOptions(command, *bus, "the network that the run is on");
  command.option("--wait", a->wait, "seconds to wait for the run, and for each answer").nonNegative().showDefault();
  command.footer(
      "Parameters that may be set, if the run has them: material/NAME/stiffness (up to what the scene loaded with),\n"
      "material/NAME/friction/static (up to twice that) and /dynamic (up to the static one), time/held (0, 1) and\n"
      "time/speed of a lockstep run that is kept to the clock, assembly/undone (a value one higher removes the body "
      "placed\n"
      "last). Surfaces change within half a second, so that a finger feels no step. Forces, limits and faults cannot "
      "be set from elsewhere.\n"
      "Exit status: 0 all accepted, 1 one was refused, 2 bad input, 3 no such run or no answer, 130 Ctrl-C.\n"
      "Example:  presa run config/scenes/cube.xml --bus loopback --bus-commands &\n"
      "          presa bus list;  presa bus set material/rubber/stiffness=500");
  command.action([=, &status] { status = set(*a, bus->value_or(BusSettings{})); });
}

}  // namespace presa
