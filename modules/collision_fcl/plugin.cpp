#include <fcl/config.h>

#include "framework/session/module_plugin.h"
#include "modules/collision_fcl/collision_module.h"

namespace {

std::unique_ptr<presa::Module> create(std::shared_ptr<const presa::World> world, const presa::RunOptions&) {
  return std::make_unique<presa::CollisionModule>(std::move(world));
}

const presa::ModulePlugin kPlugin{
    .name = "collision_fcl", .create = create, .library = [] { return std::string("FCL " FCL_VERSION); }};

}  // namespace

PRESA_MODULE_PLUGIN(kPlugin)
