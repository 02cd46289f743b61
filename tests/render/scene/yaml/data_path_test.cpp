// Analytic facts: the test program lies in BUILD/bin, so the shipped scenes are BUILD/share/lekalo/scenes.

#include "render/scene/yaml/data_path.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace fs = std::filesystem;
using lekalo::render::data_folders;

TEST(DataPath, BesideTheProgramFirst) {
  const auto folders = data_folders();
  ASSERT_FALSE(folders.empty());
  const auto program = fs::canonical("/proc/self/exe");
  EXPECT_EQ(folders.front(), program.parent_path().parent_path() / "share/lekalo/scenes");
  EXPECT_TRUE(fs::equivalent(folders.front(), fs::path(LEKALO_SOURCE_DIR) / "scenes"));
}

TEST(DataPath, SystemFoldersFollowInOrder) {
  const fs::path top = fs::path(testing::TempDir()) / "lekalo_data_path";
  fs::create_directories(top / "a/lekalo/scenes");
  fs::create_directories(top / "b/lekalo/scenes");
  ::setenv("XDG_DATA_DIRS", ((top / "b").string() + ":relative:" + (top / "a").string() + ":/no/such").c_str(), 1);
  const auto folders = data_folders();
  ::unsetenv("XDG_DATA_DIRS");
  fs::remove_all(top);
  ASSERT_EQ(folders.size(), 3u);
  EXPECT_EQ(folders[1], top / "b/lekalo/scenes");
  EXPECT_EQ(folders[2], top / "a/lekalo/scenes");
}
