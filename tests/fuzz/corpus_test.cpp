#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

#include <tests/fuzz/target.h>

// Each target on its stored inputs: seeds, and what once failed.

namespace beeline {
namespace {

TEST(FuzzCorpus, EveryTargetHoldsOnItsInputs) {
  for (const auto& [name, target] : fuzz::targets()) {
    int count = 0;
    for (const auto& file : std::filesystem::directory_iterator(BEELINE_CORPUS "/" + name)) {
      SCOPED_TRACE(file.path().string());
      std::ostringstream text;
      text << std::ifstream(file.path(), std::ios::binary).rdbuf();
      target(text.str());
      ++count;
    }
    EXPECT_GT(count, 0) << name << " has no inputs";
  }
  EXPECT_GE(fuzz::targets().size(), 10U);
}

}  // namespace
}  // namespace beeline
