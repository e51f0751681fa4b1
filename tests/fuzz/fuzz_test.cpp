#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "framework/core/math/random.h"
#include "tests/fuzz/targets.h"

namespace presa::fuzz {
namespace {

std::vector<std::string> shippedScenes() {
  std::vector<std::string> texts;
  for (const auto& entry : std::filesystem::directory_iterator(PRESA_SOURCE_DIR "/config/scenes")) {
    if (entry.path().extension() != ".xml") continue;
    std::ifstream file(entry.path(), std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return texts;
}

void expectSound(const std::string& text) {
  EXPECT_EQ(scene(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()), "") << text;
}

TEST(FuzzTargets, ReadShippedScenesWholeCutAndDamaged) {
  constexpr int kEach = 8;
  constexpr std::array kBytes{'<', '>', '"', '&', '9', '-', '\0', '\xff'};
  RandomStream random(1, "scenes");
  const auto place = [&](const std::string& text) { return static_cast<std::size_t>(random.below(text.size())); };
  const std::vector<std::string> scenes = shippedScenes();
  ASSERT_GT(scenes.size(), 40U);
  for (const std::string& text : scenes) {
    expectSound(text);
    expectSound(text + "set rates/haptic=1e99");
    for (int i = 0; i < kEach; ++i) {
      expectSound(text.substr(0, place(text)));
      std::string damaged = text;
      damaged[place(text)] = kBytes[static_cast<std::size_t>(i)];
      expectSound(damaged);
    }
  }
}

TEST(FuzzTargets, RefuseDamagedRecordings) {
  RandomStream random(2, "recordings");
  std::vector<std::uint8_t> bytes(40);
  for (int i = 0; i < 50; ++i) {
    std::ranges::generate(bytes, [&] { return static_cast<std::uint8_t>(random.bits()); });
    EXPECT_EQ(recording(bytes.data(), bytes.size()), "") << i;
  }
}

}  // namespace
}  // namespace presa::fuzz
