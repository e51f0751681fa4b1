#include "framework/session/participant_page.h"

#include "framework/plugin/plugin_loader.h"
#include "framework/scene/manifest.h"

namespace presa {

std::unique_ptr<ParticipantPage> openParticipantPage() {
  using Open = ParticipantPage* (*)();
  const auto open = reinterpret_cast<Open>(pluginSymbol(manifestGiving("view").name, "presaOpenParticipantPage"));
  return std::unique_ptr<ParticipantPage>(open());
}

}  // namespace presa
