// Against the promises of atomic_file.h (and POSIX rename).
#include "render/image/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "render/image/image_error.h"
#include "render/image/temporary_folder.h"

namespace lekalo::render::atomic_file_test {
namespace {

namespace fs = std::filesystem;

TEST(AtomicFile, TheNameAppearsOnlyWithTheWholeContent) {
  const TemporaryFolder folder;
  AtomicFile file(folder / "out.txt");
  file.write("hello ");
  EXPECT_FALSE(fs::exists(folder / "out.txt"));
  file.write("world");
  file.commit();
  EXPECT_EQ(file_bytes(folder / "out.txt"), "hello world");
  EXPECT_EQ(folder.entry_count(), 1u);
}

TEST(AtomicFile, WithoutCommitNothingIsLeftAndTheOldFileStays) {
  const TemporaryFolder folder;
  write_bytes(folder / "out.txt", "old");
  {
    AtomicFile file(folder / "out.txt");
    file.write(std::string(1 << 20, 'x'));
  }
  EXPECT_EQ(file_bytes(folder / "out.txt"), "old");
  EXPECT_EQ(folder.entry_count(), 1u);
}

TEST(AtomicFile, SeekOverwritesEarlierBytes) {
  const TemporaryFolder folder;
  AtomicFile file(folder / "out.bin");
  file.write("0000");
  file.write(std::string(100000, 'b'));
  file.seek(0);
  file.write("1234");
  EXPECT_EQ(file.position(), 4u);
  file.seek(100004);
  file.write("end");
  file.commit();
  EXPECT_EQ(file_bytes(folder / "out.bin"), "1234" + std::string(100000, 'b') + "end");
}

TEST(AtomicFile, KeepsThePermissionsOfTheFileItReplaces) {
  const TemporaryFolder folder;
  write_bytes(folder / "out.txt", "old");
  fs::permissions(folder / "out.txt", fs::perms(0640));
  write_file_atomically(folder / "out.txt", "new");
  EXPECT_EQ(fs::status(folder / "out.txt").permissions(), fs::perms(0640));
  EXPECT_EQ(file_bytes(folder / "out.txt"), "new");
}

TEST(AtomicFile, FollowsLinksInsteadOfReplacingThem) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "store");
  write_bytes(folder / "store/real.txt", "old");
  fs::create_symlink("store/real.txt", folder / "link.txt");
  write_file_atomically(folder / "link.txt", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(file_bytes(folder / "store/real.txt"), "new");
}

TEST(AtomicFile, WritesToDevicesDirectly) {
  write_file_atomically("/dev/null", "gone");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

std::string message_of(const fs::path& path, const std::string& text) {
  try {
    write_file_atomically(path, text);
  } catch (const ImageError& error) {
    return error.what();
  }
  return "no error";
}

TEST(AtomicFile, SaysWhyAndWhatToDo) {
  const TemporaryFolder folder;
  const std::string missing = (folder / "none/out.txt").string();
  EXPECT_EQ(message_of(missing, "x"),
            missing + ": cannot write: No such file or directory (make the folder first, or write elsewhere with -o)");
  EXPECT_NE(message_of(folder.path(), "x").find("Is a directory"), std::string::npos);
  if (fs::exists("/dev/full")) {
    const std::string full = message_of("/dev/full", "x");
    EXPECT_EQ(full, "/dev/full: cannot write: No space left on device (free some disk space)");
  }
}

}  // namespace
}  // namespace lekalo::render::atomic_file_test
