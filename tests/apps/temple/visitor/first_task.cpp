#include "tests/apps/temple/visitor/first_task.h"

#include <gtest/gtest.h>

#include "apps/temple/building/building.h"
#include "apps/temple/building/words.h"
#include "apps/temple/ruins.h"
#include "apps/temple/written_scene.h"

namespace presa::temple::test {

Loaded loadFirstTask(std::uint64_t seed, const std::string& folder, const RunOptions& options,
                     const std::string& language) {
  Diagnostics diagnostics;
  const Building first = makeBuilding(shippedProportions("first", diagnostics), 0.1, seed);
  SceneSpec spec = assembled(first);
  spec.name = "first_ruins";
  const Ruins ruins = strewRuins(first, seed, folder, {});
  for (SceneSpec::Stone& stone : spec.stones) stone.X_WB = ruins.X_WB[stone.block];
  spec.to_be_built = true;
  spec.words = shippedWords(language, diagnostics);
  spec.rig = PRESA_SOURCE_DIR "/config/rigs/pointer_pair.xml";
  Loaded loaded = loadWorld({writeScene(first, spec, folder), "", {}}, options, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  return loaded;
}

}  // namespace presa::temple::test
