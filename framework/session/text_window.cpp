#include "framework/session/text_window.h"

#include "framework/plugin/plugin_loader.h"
#include "framework/scene/manifest.h"

namespace presa {

std::unique_ptr<TextWindow> openTextWindow(const std::string& title) {
  using Open = TextWindow* (*)(const char*);
  const auto open = reinterpret_cast<Open>(pluginSymbol(manifestGiving("view").name, "presaOpenTextWindow"));
  return std::unique_ptr<TextWindow>(open(title.c_str()));
}

}  // namespace presa
