#include <cstdio>

#include <beeline/draw/internal/keyframes.h>
#include <beeline/draw/internal/svg.h>

namespace beeline::internal {
namespace {

/// Returns a fraction of the loop with five decimals, which resolves a millisecond of 100 s.
std::string fraction_text(double fraction) {
  if (fraction <= 0) return "0";
  if (fraction >= 1) return "1";
  char text[16];
  std::snprintf(text, sizeof text, "%.5f", fraction);
  std::string digits = text;
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return digits;
}

std::string loop_attributes(const Timeline& timeline) {
  return "dur=\"" + svg_number(timeline.seconds) + "s\" repeatCount=\"indefinite\"";
}

}  // namespace

std::string animation_values(const Timeline& timeline, std::span<const std::size_t> keyframes,
                             const std::vector<std::string>& values) {
  std::string times, list;
  const auto add = [&](double fraction, const std::string& value) {
    times += (times.empty() ? "" : ";") + fraction_text(fraction);
    list += (list.empty() ? "" : ";") + value;
  };
  if (timeline.frames[keyframes.front()] > 0) add(0, values.front());
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    add(timeline.frames[keyframes[i]], values[i]);
  }
  if (timeline.frames[keyframes.back()] < 1) add(1, values.back());
  return loop_attributes(timeline) + " keyTimes=\"" + times + "\" values=\"" + list + "\"";
}

std::string visible_between(const Timeline& timeline, double begin, double end) {
  if (begin <= 0 && end >= 1) return "";
  std::string times = "0", values = begin <= 0 ? "visible" : "hidden";
  if (begin > 0) {
    times += ";" + fraction_text(begin);
    values += ";visible";
  }
  if (end < 1) {
    times += ";" + fraction_text(end);
    values += ";hidden";
  }
  return "<animate attributeName=\"visibility\" calcMode=\"discrete\" " +
         loop_attributes(timeline) + " keyTimes=\"" + times + "\" values=\"" + values + "\"/>";
}

}  // namespace beeline::internal
