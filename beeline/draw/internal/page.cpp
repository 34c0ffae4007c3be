#include <beeline/draw/internal/page.h>
#include <beeline/draw/internal/text.h>

namespace beeline::internal {

double draw_title(const std::string& title, double width, Picture& picture) {
  constexpr double size = 12, leading = 16;
  double top = page_margin;
  for (const std::string& line : balanced(title, size, width, true)) {
    PaperText text{line, {picture.width / 2, top + 0.6 * size}, size};
    text.bold = true;
    picture.marks.emplace_back(text);
    top += leading;
  }
  return top;
}

}  // namespace beeline::internal
