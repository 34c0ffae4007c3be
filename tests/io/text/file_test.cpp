#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <thread>

#include <beeline/io/text/file.h>

#include <sys/stat.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>
#include <unistd.h>

namespace beeline::internal {
namespace {

using testing::TemporaryFolder;
namespace fs = std::filesystem;

/// Root ignores permissions, so the tests run as another user.
class AsNobody {
 public:
  explicit AsNobody(const std::string& folder) : root_(::geteuid() == 0) {
    constexpr uid_t nobody = 65534;
    if (!root_) return;
    EXPECT_EQ(::chown(folder.c_str(), nobody, nobody), 0);
    EXPECT_EQ(::seteuid(nobody), 0);
  }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;
  ~AsNobody() {
    if (root_ && ::seteuid(0) != 0) std::abort();  // the tests after this one would not be root
  }

 private:
  bool root_;
};

TEST(File, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.csv");
  std::string content = "\0\r\n\xff binary";
  content.append(300000, 'x');
  for (const std::string& text : {std::string(), content, std::string("short")}) {
    write_file(path, text);
    EXPECT_EQ(read_file(path), text);
    EXPECT_EQ(folder.content("a.csv"), text);
  }
  EXPECT_EQ(folder.count(), 1u) << "something was left behind";
}

TEST(File, ExtensionIsThePartBehindTheLastDotInLowerCase) {
  EXPECT_EQ(extension("a/b.d/arm.URDF"), "urdf");
  EXPECT_EQ(extension("a.tar.gz"), "gz");
  EXPECT_EQ(extension("a.b/arm"), "");
  EXPECT_EQ(extension("arm."), "");
  EXPECT_EQ(extension(""), "");
}

TEST(File, UnreadableFilesAreNamedWithTheReason) {
  const TemporaryFolder folder;
  EXPECT_REFUSED(read_file(folder.file("none.csv")), "none.csv: cannot be read: No such file");
  EXPECT_REFUSED(read_file(folder.file("")), "is a folder, not a file");
  EXPECT_REFUSED(read_file("/dev/zero"), "/dev/zero: is larger than 64 MiB");
}

TEST(File, UnwritableTargetsAreNamedAndLeaveNothingBehind) {
  const TemporaryFolder folder;
  EXPECT_REFUSED(write_file(folder.file("no/such/a.csv"), "x"),
                 "no/such/a.csv: cannot be written: No such file or directory");
  EXPECT_REFUSED(write_file(folder.file(""), "x"), "cannot be written: it is a folder");
  EXPECT_REFUSED(write_file("", "x"), "cannot be written");
  folder.write("plain", "");
  EXPECT_REFUSED(write_file(folder.file("plain/a.csv"), "x"), "Not a directory");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(File, AFullDiskIsReported) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  EXPECT_REFUSED(write_file("/dev/full", "x"), "/dev/full: cannot be written: No space left");
}

TEST(File, ProtectedFilesAndFoldersStayAsTheyAre) {
  const TemporaryFolder folder;
  const AsNobody nobody(folder.file(""));
  folder.write("old.csv", "old");
  ::chmod(folder.file("old.csv").c_str(), 0444);
  EXPECT_REFUSED(write_file(folder.file("old.csv"), "new"), "Permission denied");
  ::chmod(folder.file("").c_str(), 0555);
  EXPECT_REFUSED(write_file(folder.file("new.csv"), "new"), "Permission denied");
  ::chmod(folder.file("").c_str(), 0755);
  EXPECT_EQ(folder.content("old.csv"), "old");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(File, PermissionsOfAReplacedFileStay) {
  const TemporaryFolder folder;
  folder.write("a.csv", "old");
  ::chmod(folder.file("a.csv").c_str(), 0640);
  write_file(folder.file("a.csv"), "new");
  struct stat status {};
  ASSERT_EQ(::stat(folder.file("a.csv").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST(File, ALinkStaysALink) {
  const TemporaryFolder folder;
  folder.write("real.csv", "old");
  fs::create_symlink("real.csv", folder.file("link.csv"));
  write_file(folder.file("link.csv"), "new");
  EXPECT_TRUE(fs::is_symlink(folder.file("link.csv")));
  EXPECT_EQ(folder.content("real.csv"), "new");
}

TEST(File, APipeIsWrittenTo) {
  const TemporaryFolder folder;
  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = read_file(pipe); });
  write_file(pipe, "through the pipe");
  reader.join();
  EXPECT_EQ(received, "through the pipe");
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST(File, ManyWritersLeaveOneWholeFile) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.csv");
  write_file(path, std::string(100000, 'a'));
  std::vector<std::thread> writers;
  for (const char letter : {'b', 'c', 'd', 'e'}) {
    writers.emplace_back([&path, letter] {
      for (int i = 0; i < 50; ++i) write_file(path, std::string(100000, letter));
    });
  }
  for (int i = 0; i < 200; ++i) {
    const std::string seen = read_file(path);
    EXPECT_EQ(seen, std::string(100000, seen[0]));
  }
  for (std::thread& writer : writers) writer.join();
  EXPECT_EQ(folder.count(), 1u);
}

}  // namespace
}  // namespace beeline::internal
