#pragma once

#include <string>
#include <vector>

#include <beeline/draw/paper.h>
#include <beeline/draw/projection.h>
#include <beeline/draw/scene.h>

namespace beeline {

/// One view of a scene, with what stands below it.
struct Panel {
  Scene scene = {};
  View view = top_view();
  std::string caption = {};
  double zoom = 1;     ///< scale relative to the figure's other panels
  double pen = 1;      ///< factor on the sizes that the scene gives in points
  bool labels = true;  ///< draw the scene's labels
};

/// Panels side by side, each column from above to below. One scale holds for all (times a panel's
/// zoom), the same along both axes, chosen as large as the page allows. Where a panel looks along
/// an axis of the world it gets rulers and a light grid, else a ground grid and a scale bar.
struct Figure {
  std::string title = {};
  std::vector<std::vector<Panel>> columns;
  double width = 500, height = 480;  ///< largest page, in points; margins and text excepted
};

/// The figure on paper: everything lies within the page. Throws Error when the figure has no panel
/// or a point that cannot be drawn.
Drawing compose(const Figure& figure);

}  // namespace beeline
