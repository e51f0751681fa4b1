// Fields that took long come back from the user's cache; damaged ones are built again.
#include "modules/pointshell/field_cache.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace presa::field_cache_test {
namespace {

namespace fs = std::filesystem;

class FieldCache : public testing::Test {
 protected:
  FieldCache() : folder_(fs::temp_directory_path() / ("presa_cache_" + std::to_string(getpid()))) {
    setenv("XDG_CACHE_HOME", folder_.c_str(), 1);
    mesh_ = makeSphere(0.05, 4);
    buildAdjacency(mesh_);
  }
  ~FieldCache() override {
    unsetenv("XDG_CACHE_HOME");
    fs::remove_all(folder_);
  }
  DistanceField make() const {
    DistanceField::Size size;
    return *cachedField(mesh_, 0, {.voxel = 0.0008}, size);
  }
  fs::path file() const {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_)) {
      if (entry.path().extension() == ".field") return entry.path();
    }
    return {};
  }

  fs::path folder_;
  TriMesh mesh_;
};

TEST_F(FieldCache, GivesBackWhatWasBuilt) {
  const DistanceField built = make();
  ASSERT_FALSE(file().empty());
  const auto written = fs::last_write_time(file());
  EXPECT_EQ(make().bytes(), built.bytes());
  EXPECT_EQ(fs::last_write_time(file()), written) << "it was read, not written again";
}

TEST_F(FieldCache, BuildsADamagedOneAgain) {
  const DistanceField built = make();
  const auto size = fs::file_size(file());
  std::fstream damaged(file(), std::ios::binary | std::ios::in | std::ios::out);
  damaged.seekp(static_cast<std::streamoff>(size / 2));
  damaged.write("damage", 6);
  damaged.close();
  EXPECT_EQ(make().bytes(), built.bytes());
  fs::resize_file(file(), size / 3);
  EXPECT_EQ(make().bytes(), built.bytes());
  EXPECT_EQ(fs::file_size(file()), size) << "the sound one was kept";
}

}  // namespace
}  // namespace presa::field_cache_test
