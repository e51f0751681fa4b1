#pragma once
#include "apps/common/exit_status.h"
#include "apps/common/options/command_line.h"

namespace presa {

/// Each function adds one command, which stores its exit status in `status`.
void addRun(Command app, int& status);
void addGallery(Command app, int& status);
void addCheck(Command app, int& status);
void addExplain(Command app, int& status);
void addPlugins(Command app, int& status);
void addSchema(Command app, int& status);
void addNew(Command app, int& status);
void addReplay(Command app, int& status);
void addView(Command app, int& status);
void addBus(Command app, int& status);
void addBusList(Command bus, int& status);
void addBusSet(Command bus, int& status);
void addBusKeys(Command bus, int& status);

}  // namespace presa
