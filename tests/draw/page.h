#pragma once

#include <gtest/gtest.h>
#include <string>

#include <beeline/draw/internal/paper_shapes.h>
#include <beeline/draw/paper.h>

namespace beeline::testing {

inline void expect_within_page(const Picture& picture, const std::string& what) {
  EXPECT_GT(picture.width, 0);
  EXPECT_GT(picture.height, 0);
  for (const PaperMark& mark : picture.marks) {
    const internal::PaperBox box = internal::box_of(mark);
    if (box.low.x() > box.high.x()) continue;  // nothing
    ASSERT_TRUE(box.low.allFinite() && box.high.allFinite()) << what;
    EXPECT_GE(box.low.x(), 0) << what;
    EXPECT_GE(box.low.y(), 0) << what;
    EXPECT_LE(box.high.x(), picture.width) << what;
    EXPECT_LE(box.high.y(), picture.height) << what;
  }
}

}  // namespace beeline::testing
