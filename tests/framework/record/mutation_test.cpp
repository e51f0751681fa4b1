#include "tests/framework/record/mutation.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "apps/common/scratch_folder.h"

namespace presa::record {
namespace {

// A few hundred of the mutations that `./dev fuzz` tries by the million: values, lengths, attributes, links, storage.
TEST(Mutation, AnyDamageIsRefusedOrLeavesASoundRecording) {
  constexpr std::uint64_t kSpecimenTicks = 40;
  const ScratchFolder folder;
  const std::string specimen = folder.file("specimen.h5"), file = folder.file("run.h5");
  writeSpecimen(specimen, kSpecimenTicks);
  bool accepted = false;
  ASSERT_EQ(judge(specimen, kSpecimenTicks, &accepted), "");
  ASSERT_TRUE(accepted);
  std::mt19937 random(19);
  int taken = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<std::uint8_t> bytes(8 + random() % 60);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    std::filesystem::copy_file(specimen, file, std::filesystem::copy_options::overwrite_existing);
    mutate(file, bytes.data(), bytes.size());
    ASSERT_EQ(judge(file, kSpecimenTicks, &accepted), "") << "round " << round;
    taken += accepted ? 1 : 0;
  }
  // the mutations are neither all refused nor all accepted
  EXPECT_GT(taken, 5);
  EXPECT_LT(taken, 295);
}

}  // namespace
}  // namespace presa::record
