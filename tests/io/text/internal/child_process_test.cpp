#include <csignal>
#include <gtest/gtest.h>

#include <beeline/io/text/internal/child_process.h>

#include <tests/refusal.h>
#include <unistd.h>

namespace beeline::internal {
namespace {

constexpr ChildLimits limits{.memory = std::uint64_t{1} << 30, .seconds = 60};

std::optional<std::string> child(const std::function<std::string()>& work) {
  return in_child_process(work, limits);
}

TEST(ChildProcess, ReturnsWhatTheWorkReturns) {
  EXPECT_EQ(child([] { return ""; }), "");
  const std::string zeros(3'000'000, '\0');
  EXPECT_EQ(child([&] { return zeros + "end."; }), zeros + "end.");
  EXPECT_REFUSED(child([]() -> std::string { throw FileError("a", 3, "is bad"); }), "is bad");
  EXPECT_REFUSED(child([]() -> std::string { throw std::runtime_error("worse"); }), "worse");
}

TEST(ChildProcess, ACrashIsNoAnswer) {
  EXPECT_EQ(child([]() -> std::string { std::abort(); }), std::nullopt);
  EXPECT_EQ(child([]() -> std::string { ::_exit(0); }), std::nullopt);
  EXPECT_EQ(child([]() -> std::string { throw std::bad_alloc(); }), std::nullopt);
  EXPECT_EQ(child([]() -> std::string { throw 1; }), std::nullopt);
}

TEST(ChildProcess, OneThatSleepsIsEnded) {
  const auto sleep = []() -> std::string {
    for (;;) ::pause();
  };
  EXPECT_EQ(in_child_process(sleep, {.memory = limits.memory, .seconds = 1}), std::nullopt);
}

TEST(ChildProcess, TheHostMayIgnoreOrHandleSignals) {
  const auto ignored = std::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(child([] { return "a"; }), "a");
  EXPECT_EQ(child([]() -> std::string { ::_exit(0); }), std::nullopt);
  std::signal(SIGCHLD, ignored);
  for (const int signal : {SIGINT, SIGTERM}) {
    const auto before = std::signal(signal, SIG_IGN);
    const auto ended_by = [=]() -> std::string {
      std::raise(signal);
      return "not ended";
    };
    EXPECT_EQ(child(ended_by), std::nullopt);
    std::signal(signal, before);
  }
}

}  // namespace
}  // namespace beeline::internal
