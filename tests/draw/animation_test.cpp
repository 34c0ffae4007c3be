#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <regex>

#include <beeline/draw/animation.h>
#include <beeline/draw/arm_figure.h>
#include <beeline/draw/internal/animation_frames.h>
#include <beeline/draw/internal/page_layout.h>
#include <beeline/model/catalog.h>

#include <tests/random_arm.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline {
using namespace internal;
namespace {

/// An element of an SVG file.
struct Element {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::vector<Element> children;

  std::string get(const std::string& key) const {
    const auto found = attributes.find(key);
    return found == attributes.end() ? "" : found->second;
  }
};

/// Reads elements up to the end of the one that is open.
std::vector<Element> elements(std::sregex_iterator& tag) {
  static const std::regex attribute(R"re(([\w:-]+)="([^"]*)")re");
  std::vector<Element> found;
  for (; tag != std::sregex_iterator(); ++tag) {
    const std::smatch& match = *tag;
    if (match.str(1) == "/") return found;
    Element element{match.str(2), {}, {}};
    const std::string list = match.str(3);
    for (std::sregex_iterator a(list.begin(), list.end(), attribute), end; a != end; ++a) {
      element.attributes[a->str(1)] = a->str(2);
    }
    const bool closed = !list.empty() && list.back() == '/';
    if (!closed) element.children = elements(++tag);
    found.push_back(std::move(element));
  }
  return found;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, ';');) parts.push_back(part);
  return parts;
}

std::vector<double> numbers(const std::string& text) {
  static const std::regex number(R"(-?(\d+\.?\d*|\.\d+))");
  std::vector<double> values;
  for (std::sregex_iterator n(text.begin(), text.end(), number), end; n != end; ++n) {
    values.push_back(std::stod(n->str()));
  }
  return values;
}

/// The numbers of an animated attribute at a fraction of the loop, interpolated linearly.
std::vector<double> animated(const Element& animation, double at) {
  const std::vector<std::string> times = split(animation.get("keyTimes")),
                                 values = split(animation.get("values"));
  EXPECT_EQ(times.size(), values.size());
  EXPECT_EQ(times.front(), "0");
  EXPECT_EQ(times.back(), "1");
  std::size_t i = 1;
  while (i + 1 < times.size() && std::stod(times[i]) <= at) ++i;
  const double from = std::stod(times[i - 1]), to = std::stod(times[i]);
  const double t = to > from ? (at - from) / (to - from) : 1;
  const std::vector<double> a = numbers(values[i - 1]), b = numbers(values[i]);
  EXPECT_EQ(a.size(), b.size());
  std::vector<double> between;
  for (std::size_t n = 0; n < a.size(); ++n) between.push_back(a[n] + t * (b[n] - a[n]));
  return between;
}

bool visible(const Element& element, double at) {
  bool shown = element.get("visibility") != "hidden";
  for (const Element& child : element.children) {
    if (child.get("attributeName") != "visibility") continue;
    const std::vector<std::string> times = split(child.get("keyTimes")),
                                   values = split(child.get("values"));
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (std::stod(times[i]) <= at) shown = values[i] == "visible";
    }
  }
  return shown;
}

constexpr double later = 2e-5;  // of the loop: keyframes are rounded

/// Collects the coordinates of each path that is seen at a fraction of the loop, in their order.
void collect(const Element& element, double at, std::vector<std::vector<double>>& paths) {
  if (!visible(element, at + later)) return;
  std::vector<double> path = numbers(element.get("d"));
  for (const Element& child : element.children) {
    if (child.get("attributeName") == "d") path = animated(child, at);
  }
  if (element.name == "path") paths.push_back(path);
  for (const Element& child : element.children) collect(child, at, paths);
}

/// The group of the file that moves.
Element moving(const std::string& svg) {
  static const std::regex tag(R"re(<(/?)(\w+)((?:[^<>"]|"[^"]*")*)>)re");
  const std::size_t begin = svg.find("<g class=\"moving\">"), end = svg.find("<g class=\"still\"");
  EXPECT_LT(begin, end);
  const std::string part = svg.substr(begin, end - begin);
  std::sregex_iterator first(part.begin(), part.end(), tag);
  return elements(first).front();
}

Trajectory random_trajectory(testing::Random& random, const Arm& arm, int samples, double step) {
  Trajectory motion{arm.joint_names(), {}, {}, {}, {}};
  for (int k = 0; k < samples; ++k) {
    motion.times.push_back(step * k);
    motion.positions.push_back(0.3 * random.configuration(arm));
    motion.velocities.push_back(0.3 * random.configuration(arm));
  }
  return motion;
}

/// Compares what the file shows at the time of each frame with the frame's own drawing.
void expect_shows_every_frame(const Animation& animation, double tolerance) {
  const PlaybackOptions options;
  const Element group = moving(animated_svg(animation, options));
  const PageLayout layout = laid_out(animation.figure, animation.frames);
  const Timeline timeline = timeline_of(animation, options);
  for (std::size_t k = 0; k < animation.frames.size(); k += 3) {
    std::vector<std::vector<double>> shown;
    collect(group, timeline.frames[k], shown);
    std::size_t paths = 0;
    std::vector<std::vector<double>> left = shown;
    for (const FrameMark& mark : frame_marks(layout, &animation.frames[k])) {
      const auto* stroke = std::get_if<PaperStroke>(mark.mark.get());
      if (stroke == nullptr || mark.appears > animation.times[k] + later * timeline.seconds)
        continue;
      ++paths;
      // The order may differ where it cannot be seen.
      const auto same = [&](const std::vector<double>& path) {
        if (path.size() != 2 * stroke->path.points.size()) return false;
        for (std::size_t n = 0; n < path.size(); ++n) {
          const double at = stroke->path.points[n / 2][static_cast<int>(n % 2)];
          if (!(std::abs(path[n] - at) <= tolerance)) return false;
        }
        return true;
      };
      const auto found = std::find_if(left.begin(), left.end(), same);
      ASSERT_TRUE(found != left.end())
          << "frame " << k << ", path " << paths << " from "
          << (stroke->path.points.empty() ? PaperPoint::Zero() : stroke->path.points[0])
                 .transpose();
      left.erase(found);
    }
    EXPECT_EQ(shown.size(), paths) << "frame " << k;
  }
}

TEST(AnimatedSvg, ShowsEveryFrameOfRandomMotions) {
  testing::Random random;
  for (int trial = 0; trial < testing::cases(12); ++trial) {
    const Arm arm =
        trial % 3 == 0 ? built_in("rrr") : testing::random_arm(random, random.integer(1, 6), 5);
    const Trajectory motion = random_trajectory(random, arm, random.integer(1, 3), 0.6);
    ArmFigureOptions options;
    options.small_views = false;
    expect_shows_every_frame(motion_animation(arm, motion, {}, options), 0.3);
  }
  expect_shows_every_frame(chapter_animation("1.7"), 0.3);
}

TEST(AnimatedSvg, OfALongWildMotionIsBounded) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Trajectory motion = random_trajectory(random, arm, testing::example_size(100'000), 0.05);
  const std::string svg = animated_svg(motion_animation(arm, motion));
  EXPECT_LT(svg.size(), max_svg_size + 250'000);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(AnimatedSvg, HonoursReducedMotionAndRepeats) {
  const std::string svg = animated_svg(chapter_animation("1.9"));
  EXPECT_NE(svg.find("prefers-reduced-motion: reduce"), std::string::npos);
  EXPECT_NE(svg.find("<g class=\"still\" display=\"none\">"), std::string::npos);
  EXPECT_NE(svg.find("repeatCount=\"indefinite\""), std::string::npos);
  EXPECT_EQ(svg, animated_svg(chapter_animation("1.9")));
  EXPECT_LT(svg.size(), 500'000u);
}

TEST(AnimatedSvg, PlaysInRealTimeBetweenItsRests) {
  const Animation animation = chapter_animation("1.7");
  for (const double speed : {0.5, 1.0, 4.0}) {
    const PlaybackOptions options{.speed = speed, .rest_before = 0.25, .rest_after = 2};
    const Timeline timeline = timeline_of(animation, options);
    EXPECT_NEAR(timeline.seconds, 2.25 + animation.times.back() / speed, 1e-9);
    for (std::size_t k = 0; k < animation.times.size(); ++k) {
      EXPECT_NEAR(timeline.frames[k] * timeline.seconds, 0.25 + animation.times[k] / speed, 1e-9);
    }
  }
}

TEST(Animation, RefusesWhatCannotBePlayed) {
  Animation animation = chapter_animation("1.7");
  const double nan = std::nan("");
  EXPECT_REFUSED(animated_svg(animation, {.speed = 0}), "speed of an animation is 0");
  EXPECT_REFUSED(animated_svg(animation, {.rest_after = nan}), "rest_after");
  EXPECT_REFUSED(animated_svg(animation, {.frames_per_second = 1000}), "frames_per_second");
  Animation slow = animation;
  slow.times.back() = 1e9;
  EXPECT_REFUSED(animated_svg(slow), "longer than a day");
  animation.times[2] = animation.times[1];
  EXPECT_REFUSED(animated_svg(animation), "frame 2");
  animation.times.pop_back();
  EXPECT_REFUSED(animated_svg(animation), "as many of both");
  EXPECT_REFUSED(animated_svg(Animation{}), "0 frames");
  EXPECT_REFUSED(chapter_animation("1.6"), "1.7, 1.9");
  EXPECT_REFUSED(motion_animation(built_in("rrr"), {}), "without samples");
  Animation broken = chapter_animation("1.7");
  broken.frames[3].add(Layer::mark, Dots{{{nan, 0, 0}}});
  EXPECT_REFUSED(animated_svg(broken), "finite");
}

TEST(Animation, TellsTheFormatByTheExtension) {
  EXPECT_EQ(animation_format_of("a.b/c.SVG"), AnimationFormat::svg);
  EXPECT_EQ(animation_format_of("a.webp"), AnimationFormat::webp);
  for (const char* path : {"a.png", "gif", "a.mp4/x", ""}) {
    EXPECT_REFUSED(animation_format_of(path), ".svg, .gif, .mp4 or .webp");
  }
}

#ifdef BEELINE_CAIRO
bool has_ffmpeg() { return std::system("ffmpeg -version > /dev/null 2>&1") == 0; }

TEST(Animation, IsEncodedByFfmpeg) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  const testing::TemporaryFolder folder;
  const Animation animation = chapter_animation("1.7");
  const std::map<std::string, std::pair<std::size_t, std::string>> signatures{
      {"a.gif", {0, "GIF89a"}}, {"a.webp", {8, "WEBP"}}, {"a.mp4", {4, "ftyp"}}};
  for (const auto& [name, signature] : signatures) {
    save(animation, folder.file(name), {.speed = 4, .rest_after = 0.5, .frames_per_second = 10});
    const std::string bytes = folder.content(name);
    EXPECT_EQ(bytes.substr(signature.first, signature.second.size()), signature.second) << name;
    EXPECT_GT(bytes.size(), 5'000u);
    EXPECT_LT(bytes.size(), 1'000'000u);
  }
  EXPECT_EQ(folder.count(), 3u);
  EXPECT_NE(folder.content("a.gif").find("NETSCAPE2.0"), std::string::npos);  // it repeats
}

TEST(Animation, NamesWhatToInstall) {
  const testing::TemporaryFolder folder;
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  EXPECT_REFUSED(save(chapter_animation("1.7"), folder.file("a.gif")), "apt install ffmpeg");
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(folder.count(), 0u);
}
#endif

}  // namespace
}  // namespace beeline
