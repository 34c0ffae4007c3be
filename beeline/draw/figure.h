#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/draw/drawing.h>
#include <beeline/draw/paper.h>
#include <beeline/error.h>

namespace beeline {

/// A direction of view of a parallel projection. The rows are the world directions that point to
/// the right on paper, up on paper, and towards the viewer.
using View = Rotation;

View top_view();    ///< x to the right, y up
View front_view();  ///< x to the right, z up
View side_view();   ///< y to the right, z up

/// Returns the view from a direction at `azimuth` from x towards y and `elevation` above the
/// ground, radians; z is up. Throws Error when an angle is not finite.
View oblique_view(double azimuth, double elevation);

/// One view of a drawing with a caption.
struct Panel {
  Drawing drawing = {};
  View view = top_view();
  std::string caption = {};
  double zoom = 1;     ///< scale relative to the other panels of the figure
  double pen = 1;      ///< factor on the sizes that the drawing gives in points (line widths, text)
  bool labels = true;  ///< whether to draw the drawing's labels
  bool axes = true;    ///< whether to draw rulers, or the ground grid with the scale bar
};

/// Panels in columns, each column from top to bottom. All panels have one scale (times their zoom),
/// which is equal along both axes and as large as the page allows. A panel that looks along an axis
/// of the world has rulers and a light grid; any other panel has a ground grid and a scale bar.
struct Figure {
  std::string title = {};
  std::vector<std::vector<Panel>> columns;
  double width = 500, height = 480;  ///< max size of the page without margins and title, points
  bool fill = false;  ///< whether to widen the plots until they fill a page of this size
};

/// Lays the figure out on a page that contains all of it. Throws Error for a figure without panels,
/// a page size outside 100 to 10000 points and coordinates that cannot be drawn.
Picture compose(const Figure& figure);

enum class Format { svg, png, pdf };

/// Returns the format that the file extension names, in upper or lower case. Throws Error for any
/// extension other than svg, png and pdf.
Format format_of(std::string_view path);

/// Returns the bytes of the picture file. Equal figures give equal bytes. A PNG has 180 pixels per
/// inch. Throws Error where compose() does.
std::string render(const Picture& picture, Format format);
std::string render(const Figure& figure, Format format);

/// Writes the figure in the format that the path's extension names. Writes to a temporary file and
/// renames it, so that no incomplete file remains. Throws Error when the file cannot be written.
void save(const Figure& figure, const std::string& path);

}  // namespace beeline
