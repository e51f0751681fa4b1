#include "apps/common/options/program.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>

#include "apps/common/exit_status.h"
#include "apps/common/options/usage.h"
#include "apps/common/standard_streams.h"
#include "apps/common/version.h"
#include "framework/core/diagnostics/diagnostics.h"
#include "framework/core/diagnostics/printable.h"
#include "framework/geometry/long_work.h"
#include "framework/input/folders.h"

namespace presa {
namespace {

namespace fs = std::filesystem;

/// Plug-ins are looked for in `folder` first, by this process and its child processes.
void allowPlugins(const std::string& folder) {
  const char* list = std::getenv("PRESA_PLUGIN_PATH");
  const std::string others = list == nullptr ? "" : ":" + std::string(list);
  setenv("PRESA_PLUGIN_PATH", (fs::absolute(folder).lexically_normal().string() + others).c_str(), 1);
}

void offerFolder(CLI::App& app, const char* option, void (*allow)(const std::string&), const char* about) {
  app.add_option_function<std::vector<std::string>>(
         option, [allow](const std::vector<std::string>& folders) { std::ranges::for_each(folders, allow); }, about)
      ->type_name("FOLDER")
      ->check(CLI::ExistingDirectory)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

/// Adds --allow-folder and --allow-plugins to every command that does something itself.
void offerFolders(CLI::App& app) {
  const auto commands = app.get_subcommands([](CLI::App*) { return true; });
  for (CLI::App* command : commands) offerFolders(*command);
  const auto places = app.get_options([](const CLI::Option* option) { return option->get_positional(); });
  if (!commands.empty() && places.empty()) return;  // as presa bus
  offerFolder(app, "--allow-folder", input::allowFolder,
              "files may name files in this folder, too (repeatable; also PRESA_ALLOW_FOLDERS)");
  offerFolder(app, "--allow-plugins", allowPlugins,
              "look for plug-ins in this folder, too, such as one beside a scene (repeatable; also PRESA_PLUGIN_PATH)");
}

fs::path programFolder() {
  std::error_code unknown;
  return fs::read_symlink("/proc/self/exe", unknown).parent_path();
}

/// Replaces this process by the program that the first one or two words name; returns if there is none.
void becomeNamed(int argc, char** argv) {
  for (const int words : {2, 1}) {
    if (argc <= words) continue;
    std::string name = "presa";
    for (int i = 1; i <= words; ++i) name += std::string("-") + argv[i];
    if (name.find('/') != std::string::npos || name.find("--") != std::string::npos) continue;
    const std::string path = programFolder() / name;
    if (access(path.c_str(), X_OK) != 0) continue;
    std::vector<char*> arguments{argv[0]};
    arguments.insert(arguments.end(), argv + 1 + words, argv + argc);
    arguments.push_back(nullptr);
    execv(path.c_str(), arguments.data());
    std::fprintf(stderr, "presa: error: %s does not start: %s\n", path.c_str(), std::strerror(errno));
    std::exit(kExitFault);
  }
}

/// The one-line summary of a program in the same folder; empty if it has none.
std::string summaryOf(const fs::path& program) {
  std::string quoted;  // a path of our own installation, which may still hold any character
  for (const char c : program.string()) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  const auto close = [](FILE* pipe) { pclose(pipe); };
  const std::unique_ptr<FILE, decltype(close)> pipe(popen(("'" + quoted + "' --summary 2>/dev/null").c_str(), "r"),
                                                    close);
  std::array<char, 256> line{};
  if (pipe == nullptr || std::fgets(line.data(), line.size(), pipe.get()) == nullptr) return {};
  return printable(std::string(line.data(), std::strcspn(line.data(), "\n")));
}

/// The other programs of this folder, in order.
std::vector<fs::path> programs() {
  std::vector<fs::path> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(programFolder(), error)) {
    if (entry.path().filename().string().starts_with("presa-") && access(entry.path().c_str(), X_OK) == 0)
      found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::string commandOf(const fs::path& program) { return program.filename().string().substr(std::strlen("presa-")); }

std::vector<std::string> programCommands() {
  std::vector<std::string> names;
  for (const fs::path& program : programs()) names.push_back(commandOf(program));
  return names;
}

/// Lists the programs whose commands stand below `command`, that of `words`, in its help.
void listPrograms(CLI::App& command, const std::vector<std::string>& words) {
  std::string above;
  for (const std::string& word : words) above += word + "-";
  const std::vector<std::string> all = programCommands();
  for (const fs::path& program : programs()) {
    std::string name = commandOf(program);
    if (!name.starts_with(above)) continue;
    name.erase(0, above.size());
    const std::size_t dash = name.find('-');
    const std::string first = name.substr(0, dash);
    if (dash != std::string::npos && std::ranges::find(all, above + first) != all.end()) continue;  // lists it itself
    const auto groups = command.get_subcommands(
        [&](const CLI::App* group) { return dash != std::string::npos && group->get_name() == first; });
    CLI::App* group = groups.empty() ? nullptr : groups.front();
    (group != nullptr ? *group : command)
        .add_subcommand(group != nullptr ? name.substr(dash + 1) : name, summaryOf(program));
  }
}

bool asksForHelp(int argc, char** argv) {
  return std::any_of(argv + 1, argv + argc, [](const char* word) {
    return std::strcmp(word, "--help") == 0 || std::strcmp(word, "-h") == 0 || std::strcmp(word, "help") == 0;
  });
}

/// The arguments of `presa`, preceded by the words of this program.
std::vector<std::string> wordsOf(int argc, char** argv, const Program& program) {
  std::vector<std::string> words = program.words;
  words.insert(words.end(), argv + std::min(argc, 1), argv + argc);
  return words;
}

/// `presa help COMMAND …` and `presa --help COMMAND …` are `presa COMMAND … --help`, for the commands of other programs, too.
void turnHelp(int argc, char** argv) {
  static char help[] = "--help";
  if (argc < 3 || (std::strcmp(argv[1], "help") != 0 && std::strcmp(argv[1], "--help") != 0)) return;
  std::rotate(argv + 1, argv + 2, argv + argc);
  argv[argc - 1] = help;
}

void parse(CLI::App& app, std::vector<std::string> words) {
  requireCommand(app, words, programCommands());
  std::reverse(words.begin(), words.end());  // as the option parser takes them
  try {
    app.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) refuseUsage(app, error);
    app.exit(error);  // help and version are not errors
  }
}

}  // namespace

int runProgram(int argc, char** argv, const Program& program) {
  openStandardStreams();
  if (program.words.empty()) turnHelp(argc, argv);
  if (program.words.empty()) becomeNamed(argc, argv);
  input::allowFoldersOf(argc, argv);
  CLI::App app{"Presa: virtual environments that people pick up with their fingers"};
  app.name("presa");
  app.set_version_flag("--version", std::string("presa ") + kVersion);
  app.require_subcommand(1);
  app.footer(program.footer);
  int status = kExitOk;
  program.declare(Command(app), status);
  CLI::App* command = &app;
  for (const std::string& word : program.words) command = command->get_subcommand(word);
  if (argc == 2 && std::strcmp(argv[1], "--summary") == 0 && !program.words.empty()) {
    std::puts(command->get_description().c_str());
    return kExitOk;
  }
  offerFolders(app);
  if (asksForHelp(argc, argv)) listPrograms(*command, program.words);
  try {
    parse(app, wordsOf(argc, argv, program));
  } catch (const InputError& error) {
    std::fputs(error.diagnostics().text().c_str(), stderr);
    return kExitBadInput;
  } catch (const WorkStopped&) {
    return kExitInterrupted;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "presa: error: %s\n", printableLines(error.what()).c_str());
    return kExitFault;
  }
  return outputLost() && status == kExitOk ? kExitFault : status;
}

}  // namespace presa
