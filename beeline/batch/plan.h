#pragma once

#include <limits>
#include <vector>

#include <beeline/batch/batch.h>

namespace beeline {

/// The arm's chain made ready for many configurations: what is exactly nothing, but for rounding
/// (below 1e-15 of the arm's size), is left out, which the kernels then need not do.
template <class Real>
struct BatchPlan {
  enum class Bend { none, quarter, other };  ///< about x: not, by -90 degrees, or else

  /// move(step) * turn_x(alpha)
  struct Move {
    Real step[3] = {0, 0, 0};
    bool steps[3] = {false, false, false};  ///< which are not zero
    Bend bend = Bend::none;
    Real cos_alpha = 1, sin_alpha = 0;
  };
  struct Link {
    Move move;
    int coordinate = 0;
    Real turn = 0, travel = 0;
    bool turns = false, slides = false;  ///< whether these are not zero
    bool plain = false;                  ///< turn is 1
    /// Its angle when the coordinate is zero is (whole - unit) pi + rest. Numbers of unit's size
    /// have no digits behind the point: what is added to them and taken off again is rounded.
    static constexpr Real unit = std::numeric_limits<Real>::digits == 53
                                     ? static_cast<Real>(0x1.8p52)
                                     : static_cast<Real>(0x1.8p23);
    Real whole = unit;
    Real rest = 0, rest_by_pi = 0;
    bool bent = false;                  ///< rest is not zero
    Real cos_angle = 1, sin_angle = 0;  ///< of the whole angle
  };
  /// A pose by its columns: three numbers each, the last one the position.
  struct Columns {
    Real number[12];
  };

  Columns base;  ///< with the first link's Move in it
  std::vector<Link> links;
  Move tool;  ///< then turn_z of ...
  bool turns_tool = false;
  Real cos_tool = 1, sin_tool = 0;    ///< ... this angle
  std::vector<Columns> frame_T_link;  ///< of links 1 to n, in the chain's frames
  Columns base_link;                  ///< link 0 in the world
  int dof = 0;
  bool in_order = true;  ///< link i is driven by coordinate i
  bool planar = false;   ///< all axes are exactly the world's z axis or its opposite

  explicit BatchPlan(const Arm& arm);
};

/// How many configurations the kernels take at least: their number is a multiple of this.
inline constexpr Eigen::Index batch_width = 16;

/// How results are written.
enum class BatchWrite {
  at_once,      ///< where the nearest cache holds all
  by_lines,     ///< gathered in a buffer, to whole lines of the caches behind it
  past_caches,  ///< likewise, to memory: what is not read soon
};

/// What is to be computed for `count` configurations side by side. What is null is left out.
template <class Real>
struct BatchJob {
  const BatchPlan<Real>* plan;
  PoseLayout layout;
  Frame frame;
  const Real* q;         ///< dof numbers each
  Eigen::Index count;    ///< a multiple of batch_width
  Real* world_T_tool;    ///< size(layout) numbers each
  Real* world_T_link;    ///< links + 1 times that
  Real* columns;         ///< 6 dof numbers each
  Real* manipulability;  ///< one each
  BatchWrite write;
  Real* work;  ///< batch_work() numbers, at a multiple of 64 bytes
};

template <class Real>
Eigen::Index batch_work(const BatchPlan<Real>& plan);

template <class Real>
void batch_kernel(const BatchJob<Real>& job);

}  // namespace beeline
