#include <algorithm>
#include <cstdio>
#include <memory>

#include "apps/common/atomic_file.h"
#include "apps/common/output_place.h"
#include "apps/common/terminal/status_line.h"
#include "apps/common/terminal/text.h"
#include "apps/presa/commands/commands.h"
#include "apps/presa/gallery/entries.h"
#include "apps/presa/gallery/listing.h"
#include "apps/presa/gallery/page.h"
#include "apps/presa/gallery/play.h"
#include "framework/core/diagnostics/printable.h"

namespace presa {
namespace {

constexpr std::size_t kColumns = 80;  // where the output is no terminal

struct GalleryArguments {
  std::string name, page;
  std::string of_a_run;  ///< an option that only a run has, as given; empty: none
  bool by_hand = false, file = false;
  RunArguments run;
};

/// The first option given that says something about a run.
std::string optionOfARun(const Command& command) {
  for (const char* option :
       {"--mouse",      "--rig",           "--lockstep", "--realtime",   "--for",          "--allow-no-rt",
        "--seed",       "--set",           "--record",   "--flight",     "--overwrite",    "--view",
        "--screenshot", "--screenshot-at", "--video",    "--speed",      "--camera",       "--picture-size",
        "--video-rate", "--hud",           "--legend",   "--background", "--light",        "--sound",
        "--show",       "--bus",           "--bus-keys", "--domain",     "--bus-commands", "--guide",
        "--summary",    "--report",        "--plug-ins", "--quiet",      "--memory"})
    if (command.given(option)) return option;
  return {};
}

/// The scene to run, or none.
std::optional<std::size_t> check(const GalleryArguments& arguments, const std::vector<gallery::Entry>& entries,
                                 Diagnostics& diagnostics) {
  if (diagnostics.hasErrors()) return std::nullopt;
  std::optional<std::size_t> scene;
  if (!arguments.name.empty()) scene = gallery::find(entries, arguments.name, diagnostics);
  if (!scene && !arguments.of_a_run.empty() && !diagnostics.hasErrors())
    diagnostics.error(123, {arguments.of_a_run, 0, 0}, "belongs to the run of a scene, and no scene is named",
                      "presa gallery NAME " + arguments.of_a_run + " …; presa gallery lists the names");
  if (arguments.file && (!scene || !arguments.of_a_run.empty()) && !diagnostics.hasErrors())
    diagnostics.error(
        123, {"--file", 0, 0},
        "tells where one scene lies and runs nothing, found " + (scene ? arguments.of_a_run : std::string("no name")),
        "presa gallery cube --file");
  if (arguments.page.empty()) return scene;
  if (scene)
    diagnostics.error(123, {"--page", 0, 0}, "shows all scenes, found the name " + quote(arguments.name),
                      "leave out one of them; --report FILE.html is the page of a run");
  if (const std::string trouble = placeTrouble(arguments.page); !trouble.empty())
    diagnostics.error(124, {"--page", 0, 0}, "'" + printable(arguments.page) + "' cannot be written: " + trouble,
                      "name a file in a folder that you may write to");
  return scene;
}

int show(const GalleryArguments& arguments) {
  Diagnostics diagnostics;
  const std::vector<gallery::Entry> entries = gallery::entries(diagnostics);
  const std::optional<std::size_t> scene = check(arguments, entries, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.hasErrors()) return kExitBadInput;
  if (!arguments.page.empty()) {
    writeFileAtomically(arguments.page, gallery::page(entries));
    std::printf("%s: %zu scenes\n", printable(arguments.page).c_str(), entries.size());
    return kExitOk;
  }
  if (scene && arguments.file) {
    std::printf("%s\n", entries[*scene].file.c_str());
    return kExitOk;
  }
  if (scene) return gallery::play(entries, *scene, arguments.by_hand, arguments.run);
  const std::size_t columns = terminal::columnsOf(stdout);
  std::fputs(gallery::listing(entries, columns > 0 ? columns : kColumns, wantsColor(stdout)).c_str(), stdout);
  return kExitOk;
}

}  // namespace

void addGallery(Command app, int& status) {
  auto a = std::make_shared<GalleryArguments>();
  a->run.options.duration = 0;
  Command command = app.command("gallery", "List the shipped scenes, each with its one idea, or run one by its name");
  command.option("NAME", a->name, "scene to run, such as cube; without a name the scenes are listed");
  command.option("--page", a->page, "write the list with pictures as one HTML file, which needs no network");
  command.flag("--file", a->file, "print where the scene lies, for other commands; nothing runs");
  Option mouse = command.flag("--mouse", a->by_hand,
                              "mouse and keys move the fingers (key ? of the window lists them); in scenes with more\n"
                              "than one hand, the other one keeps its motion");
  addRunOptions(command, a->run);
  mouse.excludes(command.named("--rig"));
  command.footer(
      "In a window, the key m shows a menu of all scenes: arrows choose, Enter runs the scene, Space gives it to mouse "
      "and\n"
      "keys. A scene that comes to its end begins again there, until Esc; with --for it ends then. Files that the "
      "command\n"
      "asks for (--record, --report, ...) are those of the first run.\n"
      "Exit status: 0 no fault, 1 fault while running, 2 bad input (nothing written), 130 Ctrl-C.\n"
      "Examples:  presa gallery\n"
      "           presa gallery tripod\n"
      "           presa gallery cube --mouse\n"
      "           presa gallery incline --lockstep --for 6 --report incline.html\n"
      "           presa gallery --page gallery.html\n"
      "           presa explain $(presa gallery cube --file)");
  command.action([a, command, &status] {
    a->of_a_run = optionOfARun(command);
    status = show(*a);
  });
}

}  // namespace presa
