#include "framework/session/module_plugin.h"

namespace presa {
namespace {

class Misplaced final : public Module {
 public:
  Misplaced() : Module("misplaced", RateGroup::kHaptic) {}
  void step(const Tick&) noexcept override {}
};

const ModulePlugin kPlugin{.name = "misplaced",
                           .create = [](std::shared_ptr<const World>, const RunOptions&) -> std::unique_ptr<Module> {
                             return std::make_unique<Misplaced>();
                           }};

}  // namespace
}  // namespace presa

PRESA_MODULE_PLUGIN(presa::kPlugin)
