#include <algorithm>
#include <cmath>
#include <cstdio>

#include <beeline/draw/internal/svg.h>
#include <beeline/draw/internal/text.h>
#include <beeline/draw/internal/text_width.h>
#include <beeline/error.h>

namespace beeline::internal {
namespace {

/// Returns text in which no character is markup.
std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : drawable(text)) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}

/// Returns a paint and its opacity, as the attributes `name` and `name`-opacity.
std::string paint_attributes(const std::string& name, const Colour& colour) {
  std::string text = attribute(name.c_str(), svg_colour(colour));
  if (colour.alpha < 1) text += attribute((name + "-opacity").c_str(), svg_number(colour.alpha));
  return text;
}

std::string closed_element(const std::string& begin, const char* name,
                           const std::string& children) {
  return children.empty() ? begin + "/>\n" : begin + ">" + children + "</" + name + ">\n";
}

std::string element(const PaperStroke& stroke, const std::string& children) {
  std::string text = "<path" + attribute("d", path_data(stroke.path));
  if (stroke.fill.alpha > 0) text += paint_attributes("fill", stroke.fill);
  if (stroke.line.alpha > 0 && stroke.width > 0) {
    text += paint_attributes("stroke", stroke.line);
    text += attribute("stroke-width", svg_number(stroke.width));
    if (!stroke.dashes.empty()) {
      std::string dashes;
      for (const double dash : stroke.dashes) {
        dashes += (dashes.empty() ? "" : " ") + svg_number(dash);
      }
      // Round caps would close the gaps between dashes.
      text += attribute("stroke-dasharray", dashes) + attribute("stroke-linecap", "butt");
    }
  }
  return closed_element(text, "path", children);
}

std::string element(const PaperText& text, const std::string& children) {
  const double baseline = 0.36 * text.size;  // half the height of a capital letter
  std::string begin = "<text";
  if (text.upright) {
    begin += attribute("transform", "translate(" + svg_number(text.centre.x()) + " " +
                                        svg_number(text.centre.y()) + ") rotate(-90)") +
             attribute("y", svg_number(baseline));
  } else {
    begin += attribute("x", svg_number(text.centre.x())) +
             attribute("y", svg_number(text.centre.y() + baseline));
  }
  begin += attribute("font-size", svg_number(text.size)) + paint_attributes("fill", text.colour);
  if (text.bold) begin += attribute("font-weight", "bold");
  if (text.halo) begin += " stroke=\"#fff\" stroke-width=\"2.4\" paint-order=\"stroke\"";
  return begin + ">" + escaped(text.text) + children + "</text>\n";
}

}  // namespace

std::string svg_number(double value) {
  constexpr double largest = 1e9;
  if (!(std::abs(value) <= largest)) {
    throw Error("the picture could not be drawn: it has the coordinate " + number(value) +
                "; coordinates on paper must be finite and within 1e9 points");
  }
  const long long hundredths = std::llround(value * 100);
  if (hundredths == 0) return "0";
  std::string text = std::to_string(std::abs(hundredths));
  if (text.size() < 3) text.insert(0, 3 - text.size(), '0');
  text.insert(text.size() - 2, ".");
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  if (text.size() > 1 && text.front() == '0') text.erase(0, 1);
  return hundredths < 0 ? "-" + text : text;
}

std::string path_data(const PaperPath& path) {
  std::string data;
  const PaperPoint* next = path.points.data();
  const auto points = [&](char letter, int count) {
    data += letter;
    for (int i = 0; i < count; ++i, ++next) {
      data += (i == 0 ? "" : " ") + svg_number(next->x()) + " " + svg_number(next->y());
    }
  };
  for (const PaperPath::Verb verb : path.verbs) {
    switch (verb) {
      case PaperPath::Verb::move:
        points('M', 1);
        break;
      case PaperPath::Verb::line:
        points('L', 1);
        break;
      case PaperPath::Verb::curve:
        points('C', 3);
        break;
      case PaperPath::Verb::close:
        data += 'Z';
        break;
    }
  }
  return data;
}

std::string svg_colour(const Colour& colour) {
  const auto part = [](double value) {
    return static_cast<unsigned>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
  };
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", part(colour.red), part(colour.green),
                part(colour.blue));
  return text;
}

std::string svg_element(const PaperMark& mark, const std::string& children) {
  return std::visit([&](const auto& what) { return element(what, children); }, mark);
}

std::string svg_begin(const Picture& page) {
  const std::string width = svg_number(page.width), height = svg_number(page.height);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
         width + "pt\" height=\"" + height + "pt\" viewBox=\"0 0 " + width + " " + height +
         "\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
         "<g fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\" "
         "text-anchor=\"middle\" font-family=\"'" +
         typeface + "', Verdana, sans-serif\">\n";
}

std::string svg_of(const Picture& picture) {
  std::string svg = svg_begin(picture);
  for (const PaperMark& mark : picture.marks) svg += svg_element(mark);
  return svg + svg_end;
}

}  // namespace beeline::internal
