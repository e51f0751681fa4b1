#include <fcl/config.h>

#include "framework/session/module_plugin.h"
#include "modules/collision_fcl/collision_module.h"

namespace {

std::unique_ptr<presa::Module> create(std::shared_ptr<const presa::World> world, const presa::RunOptions&) {
  return std::make_unique<presa::CollisionModule>(std::move(world));
}

const presa::ModulePlugin kPlugin{
    presa::kPluginAbi, "collision_fcl",
    "bodies near each finger (FCL broad phase), and cuts through the hierarchies of their meshes", create,
    [] { return std::string("FCL " FCL_VERSION); }};

}  // namespace

PRESA_MODULE_PLUGIN(kPlugin)
