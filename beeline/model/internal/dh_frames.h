#pragma once

#include <vector>

#include <beeline/model/arm.h>

namespace beeline::internal {

/// The axis of a joint in link 0 at joint values 0: a line through `point`. Of a prismatic joint
/// the point is free; it is chosen.
struct DhAxis {
  Vector3 direction;  ///< unit length
  Vector3 point;      ///< m
  bool slides = false;
};

/// What two neighbouring axes leave open of the frame between them.
enum class DhNormal { unique, parallel, coincident };

/// The frames of a DH table in link 0, whose place in the world rounds nothing, at joint values 0,
/// from frame 0 to frame n, and what the axes leave open of the frames between two axes.
struct DhFrames {
  std::vector<DhAxis> axes;
  std::vector<Pose> frames;
  std::vector<DhNormal> normals;  ///< of frames 1 to n - 1
  std::vector<double> distances;  ///< from their link frames, m
};

/// Returns the frames of a chain without helical joints. Where the axes leave a frame open, it is
/// the nearest one to the frame of the arm's link.
DhFrames dh_frames(const Arm& arm, DhConvention convention);

}  // namespace beeline::internal
