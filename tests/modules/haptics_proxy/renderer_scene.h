#pragma once
#include <gtest/gtest.h>

#include <string>

#include "tests/apps/support/support.h"

namespace presa::test {

/// The shipped scene of a renderer loads its library and not the god-object's, and runs to its end.
inline void expectOwnRenderer(const std::string& renderer) {
  const std::string scene = source("config/scenes/renderer_" + renderer + ".xml");
  const Outcome explained = presa("explain " + scene);
  EXPECT_EQ(explained.status, 0) << explained.err;
  EXPECT_NE(explained.out.find("presa_" + renderer + ".so"), std::string::npos) << explained.out;
  EXPECT_EQ(explained.out.find("presa_god_object.so"), std::string::npos) << explained.out;
  const Outcome run = presa("run " + scene + " --lockstep");
  EXPECT_EQ(run.status, 0) << run.out << run.err;
}

}  // namespace presa::test
