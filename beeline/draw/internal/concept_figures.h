#pragma once

#include <beeline/draw/figure.h>
#include <beeline/model/arm.h>

namespace beeline::internal {

/// Figures 1.1 to 1.5 of Dellaert, *Serial Link Manipulators*, which explain joints, frames and
/// transformations. `arm` is the chapter's arm of three links.
Figure figure_1_1(const Arm& arm);
Figure figure_1_2(const Arm& arm);
Figure figure_1_3(const Arm& arm);
Figure figure_1_4(const Arm& arm);
Figure figure_1_5(const Arm& arm);

}  // namespace beeline::internal
