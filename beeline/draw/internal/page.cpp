#include <algorithm>

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

void draw_columns(const std::vector<std::vector<PageCell>>& columns, PaperPoint corner,
                  double gap) {
  for (const std::vector<PageCell>& column : columns) {
    PaperPoint at = corner;
    double width = 0;
    for (const PageCell& cell : column) {
      cell.draw(at);
      at.y() += cell.size.y();
      width = std::max(width, cell.size.x());
    }
    corner.x() += width + gap;
  }
}

}  // namespace beeline::internal
