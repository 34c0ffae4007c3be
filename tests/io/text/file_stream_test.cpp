#include <filesystem>
#include <gtest/gtest.h>
#include <thread>

#include <beeline/io/text/file.h>

#include <sys/stat.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline::internal {
namespace {

TEST(InputFile, ReadsFromFrontToEnd) {
  const testing::TemporaryFolder folder;
  InputFile file(folder.write("a", "some bytes"));
  char bytes[16] = {};
  EXPECT_EQ(file.size(), 10);
  EXPECT_EQ(file.read(bytes, 4), 4);
  EXPECT_EQ(std::string(bytes, 4), "some");
  EXPECT_EQ(file.position(), 4);
  EXPECT_EQ(file.read(bytes, 16), 6);
  EXPECT_EQ(std::string(bytes, 6), " bytes");
  EXPECT_EQ(file.read(bytes, 16), 0);
}

TEST(InputFile, PeekDoesNotAdvance) {
  const testing::TemporaryFolder folder;
  InputFile file(folder.write("a", "some bytes"));
  EXPECT_EQ(file.peek(6), "some b");
  EXPECT_EQ(file.peek(2), "so");
  EXPECT_EQ(file.position(), 0u);
  std::string text(8, '-');
  EXPECT_EQ(file.read(text.data(), 3), 3u);
  EXPECT_EQ(file.peek(100), "e bytes");
  EXPECT_EQ(file.read(text.data() + 3, 5), 5u);
  EXPECT_EQ(text, "some byt");
  EXPECT_EQ(file.position(), 8u);
  EXPECT_EQ(file.peek(3), "es");
  EXPECT_EQ(file.read(text.data(), 8), 2u);
  EXPECT_EQ(file.peek(1), "");
}

TEST(InputFile, FillsABlockFromAPipeThatBringsLittleByLittle) {
  const testing::TemporaryFolder folder;
  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&pipe] {
    std::ofstream stream(pipe);
    for (int i = 0; i < 100; ++i) stream << "0123456789" << std::flush;
  });
  InputFile file(pipe);
  std::string bytes(1000, '\0');
  EXPECT_EQ(file.read(bytes.data(), 1000), 1000);
  EXPECT_FALSE(file.size());
  EXPECT_EQ(bytes.substr(990), "0123456789");
  writer.join();
}

TEST(InputFile, RefusesWhatCannotBeRead) {
  const testing::TemporaryFolder folder;
  EXPECT_REFUSED(InputFile(folder.file("none")), "cannot be read");
  EXPECT_REFUSED(InputFile(std::filesystem::path(folder.file("a")).parent_path()), "folder");
}

TEST(OutputFile, IsThereWholeOrNotAtAll) {
  const testing::TemporaryFolder folder;
  folder.write("a", "old");
  {
    OutputFile file(folder.file("a"));
    file.append("new, but not finished");
  }
  EXPECT_EQ(folder.content("a"), "old");
  EXPECT_EQ(folder.count(), 1);
  OutputFile file(folder.file("a"));
  EXPECT_TRUE(file.replaces());
  file.append("____ and whole");
  file.overwrite_front("anew");
  EXPECT_EQ(folder.content("a"), "old");
  file.commit();
  EXPECT_EQ(folder.content("a"), "anew and whole");
  EXPECT_EQ(folder.count(), 1);
}

TEST(OutputFile, KeepsTheFilesModeAndTheLinkToIt) {
  const testing::TemporaryFolder folder;
  const std::string target = folder.write("target", "old"), link = folder.file("link");
  ASSERT_EQ(::chmod(target.c_str(), 0640), 0);
  std::filesystem::create_symlink("target", link);
  OutputFile file(link);
  file.append("new");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(folder.content("target"), "new");
  struct stat status {};
  ASSERT_EQ(::stat(target.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0640);
}

TEST(OutputFile, MakesWhatALinkPointsTo) {
  const testing::TemporaryFolder folder;
  std::filesystem::create_symlink("later", folder.file("link"));
  OutputFile file(folder.file("link"));
  file.append("here");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link")));
  EXPECT_EQ(folder.content("later"), "here");
}

TEST(OutputFile, RefusesWhatCannotBeWritten) {
  const testing::TemporaryFolder folder;
  EXPECT_REFUSED(OutputFile(folder.file("none/a")), "cannot be written");
  EXPECT_REFUSED(OutputFile(std::filesystem::path(folder.file("a")).parent_path()), "folder");
}

}  // namespace
}  // namespace beeline::internal
