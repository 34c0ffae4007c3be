#include <cmath>

#include <beeline/draw/figure.h>
#include <beeline/draw/internal/page_layout.h>
#include <beeline/error.h>

namespace beeline {

View top_view() { return View::Identity(); }

View front_view() {
  View view;
  view << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return view;
}

View side_view() {
  View view;
  view << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  return view;
}

View oblique_view(double azimuth, double elevation) {
  if (!std::isfinite(azimuth) || !std::isfinite(elevation)) {
    throw Error("azimuth " + number(azimuth) + " and elevation " + number(elevation) +
                " of a view must be finite angles");
  }
  const double ca = std::cos(azimuth), sa = std::sin(azimuth);
  const double ce = std::cos(elevation), se = std::sin(elevation);
  View view;
  view << -sa, ca, 0, -se * ca, -se * sa, ce, ce * ca, ce * sa, se;
  return view;
}

Picture compose(const Figure& figure) {
  const internal::PageLayout layout = internal::laid_out(figure);
  Picture picture;
  picture.width = layout.width;
  picture.height = layout.height;
  for (const internal::FrameMark& mark : internal::frame_marks(layout, nullptr)) {
    picture.marks.push_back(*mark.mark);
  }
  return picture;
}

}  // namespace beeline
