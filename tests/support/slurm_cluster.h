#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/apps/support/support.h"

namespace presa::test {

/// Fixture with a real Slurm cluster of one node on the loopback, and a folder that the node sees. Where none can be
/// started, runs_ is false, and why_ tells the reason for a skip.
class SlurmCluster : public testing::Test {
 protected:
  SlurmCluster() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    const Outcome started = shell(script() + " start " + folder_ + "/cluster");
    runs_ = started.status == 0;
    why_ = started.out + started.err;
    setenv("SLURM_CONF", (folder_ + "/cluster/slurm.conf").c_str(), 1);
  }
  ~SlurmCluster() override {
    shell(script() + " stop " + folder_ + "/cluster");
    unsetenv("SLURM_CONF");
    std::filesystem::remove_all(folder_);
  }
  std::string in(const std::string& name) const { return folder_ + "/" + name; }
  /// `presa COMMAND`, beside which the task of a part is killed once, as soon as there is a file or folder of that name.
  Outcome presaAndKill(const std::string& command, int part, const std::string& once) const {
    const std::string kill = "while ! [ -e " + once + " ]; do sleep 0.02; done; " +
                             "scancel --signal=KILL --full $(squeue --noheader --array --format='%i %K' | awk '$2 == " +
                             std::to_string(part) + " {print $1}')";
    return shell("(" + kill + ") & " + std::string(PRESA_BINARY_DIR) + "/bin/presa " + command);
  }

  const std::string folder_ = testing::TempDir() + "presa_slurm_" + std::to_string(getpid());
  bool runs_ = false;
  std::string why_;

 private:
  static std::string script() { return "bash " + source("tests/support/slurm.sh"); }
};

}  // namespace presa::test
