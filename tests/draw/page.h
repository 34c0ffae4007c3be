#pragma once

#include <gtest/gtest.h>
#include <string>

#include <beeline/draw/internal/paper_shapes.h>
#include <beeline/draw/internal/text.h>
#include <beeline/draw/paper.h>

namespace beeline::testing {

/// Returns a rectangle that contains the mark.
inline internal::PaperBox box_of(const PaperMark& mark) {
  internal::PaperBox box;
  if (const auto* stroke = std::get_if<PaperStroke>(&mark)) {
    const double rim = stroke->line.alpha > 0 ? stroke->width / 2 : 0;
    for (const PaperPoint& p : stroke->path.points) box.include(p, {rim, rim});
  } else {
    const PaperText& text = std::get<PaperText>(mark);
    const PaperPoint half = internal::text_size(text.text, text.size, text.bold) / 2;
    box.include(text.centre, text.upright ? PaperPoint(half.y(), half.x()) : half);
  }
  return box;
}

inline void expect_within_page(const Picture& picture, const std::string& what) {
  EXPECT_GT(picture.width, 0);
  EXPECT_GT(picture.height, 0);
  for (const PaperMark& mark : picture.marks) {
    const internal::PaperBox box = box_of(mark);
    if (box.low.x() > box.high.x()) continue;  // nothing
    ASSERT_TRUE(box.low.allFinite() && box.high.allFinite()) << what;
    EXPECT_GE(box.low.x(), 0) << what;
    EXPECT_GE(box.low.y(), 0) << what;
    EXPECT_LE(box.high.x(), picture.width) << what;
    EXPECT_LE(box.high.y(), picture.height) << what;
  }
}

}  // namespace beeline::testing
