#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "tests/apps/support/support.h"

namespace presa {
namespace {

using Statuses = std::set<int>;

/// The table of docs/exit_status.md: command, and the statuses that it has an entry for besides 0 and 2.
std::map<std::string, Statuses> documentedStatuses() {
  std::map<std::string, Statuses> table;
  std::ifstream in(test::source("docs/exit_status.md"));
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("| `")) continue;
    std::vector<std::string> cells;
    std::istringstream row(line.substr(1));
    for (std::string cell; std::getline(row, cell, '|');) cells.push_back(cell);
    const std::string name = cells.at(0).substr(2, cells.at(0).rfind('`') - 2);
    const std::vector<int> columns{1, 3, 130};
    Statuses& statuses = table[name];
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (cells.at(i + 1).find_first_not_of(' ') != std::string::npos) statuses.insert(columns[i]);
    }
  }
  return table;
}

/// The commands that a help text lists.
std::vector<std::string> commandsIn(const std::string& help) {
  std::vector<std::string> commands;
  std::istringstream lines(help);
  bool listed = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("Subcommands:")) {
      listed = true;
    } else if (listed && line.empty()) {
      break;
    } else if (listed && line.size() > 3 && line.starts_with("  ") && line[2] != ' ') {
      commands.push_back(line.substr(2, line.find(' ', 2) - 2));
    }
  }
  return commands;
}

/// Adds the help of a command that does something itself, and of those below it.
void addHelp(const std::string& command, std::map<std::string, std::string>& all) {
  const std::string help = test::presa(command + " --help").out;
  const std::vector<std::string> inner = commandsIn(help);
  if (inner.empty() || help.find("[SUBCOMMAND]") != std::string::npos) all[command] = help;
  for (const std::string& name : inner) addHelp(command + " " + name, all);
}

std::map<std::string, std::string> helpOfEveryCommand() {
  std::map<std::string, std::string> all;
  for (const std::string& command : commandsIn(test::presa("--help").out)) addHelp(command, all);
  return all;
}

/// The statuses of "Exit status: 0 done, 1 …", besides 0 and 2.
Statuses statusesIn(const std::string& help) {
  Statuses statuses;
  const std::size_t begin = help.find("Exit status:");
  if (begin == std::string::npos) return statuses;
  std::string sentence = help.substr(begin, help.find("\nExample", begin) - begin);
  std::ranges::replace(sentence, '\n', ' ');
  static const std::regex kStatus(R"((?:: |, )(0|1|2|3|130) )");
  for (std::sregex_iterator found(sentence.begin(), sentence.end(), kStatus), end; found != end; ++found)
    statuses.insert(std::stoi((*found)[1]));
  statuses.erase(0);
  statuses.erase(2);
  return statuses;
}

// Scripts rely on exit statuses: the table has every command, and every status that a command's help tells.
TEST(ExitStatus, TableHasWhatTheHelpOfEveryCommandSays) {
  const auto table = documentedStatuses();
  const auto helps = helpOfEveryCommand();
  ASSERT_GT(helps.size(), 30u);
  for (const auto& [command, help] : helps) {
    ASSERT_TRUE(table.contains(command)) << command;
    const Statuses told = statusesIn(help);
    for (const int status : told) EXPECT_TRUE(table.at(command).contains(status)) << command << " " << status;
  }
  for (const auto& [command, statuses] : table) EXPECT_TRUE(helps.contains(command)) << command;
  EXPECT_NE(test::presa("--help").out.find("docs/exit_status.md"), std::string::npos);
}

}  // namespace
}  // namespace presa
