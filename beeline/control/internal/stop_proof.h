#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <beeline/collision/internal/moving_capsule.h>
#include <beeline/control/internal/bounded_list.h>
#include <beeline/control/internal/pair_bounds.h>

namespace beeline::internal {

/// Proves that a straight joint motion from the current configuration keeps the clearances of a
/// CollisionModel: the line q + s (line), s from 0 to 1. A pair of bodies that is certainly at or
/// below its clearance at q must not come closer on the line, along the direction of its nearest
/// points. If the bounds of its distance at q do not decide it, the line is not proved. Does not
/// allocate after construction.
class StopProof {
 public:
  /// A pair of bodies that may come below its clearance on the line.
  struct NearPair {
    std::size_t pair = 0;
    double excess = 0;      ///< lower bound of its distance beyond its clearance at q, m
    double rounding = 0;    ///< of distances, m
    double remainder = 0;   ///< of the whole line, m
    double floor = 0;       ///< distance that is kept on the line, with its rounding, m
    double gap = 0;         ///< distance at q, m
    double approach = 0;    ///< decrease of the distance on the line to first order at q, m
    double least = 0;       ///< least lower bound on the line beyond `floor`, m
    double least_at = 0;    ///< s where it is
    int part = 0;           ///< its part of the line
    bool finished = false;  ///< whether the rest of the line is proved
    bool is_below = false;  ///< whether it is at or below its clearance at q
    NearestPoints start_points, least_points;
    NearestPoints last_points;  ///< of the last separation on the line
  };

  enum class Effort { first_violation, all_pairs };

  /// `gain` is the one of the damper, 1/s, for which near() looks ahead.
  StopProof(const CollisionBodies& bodies, double gain);

  /// Forgets the steps so far.
  void reset();

  void begin_step(const ConfigurationRef& q);

  /// Returns whether each clearance is proved on the line, which the arm passes at the initial
  /// velocity line / time. Sets near(), with the least bound of each pair; after `first_violation`
  /// some have none.
  bool prove(const ConfigurationRef& q, const Eigen::VectorXd& line, double time, Effort effort);

  // Of the line of the last proof:
  const BoundedList<NearPair>& near() const { return near_; }  ///< the nearest first
  double time() const { return time_; }
  int parts() const { return parts_; }  ///< number of parts that the line is divided into
  /// Returns the pair that comes closest if that is below its clearance, else the one whose
  /// distance falls fastest if that is faster than the damper allows. With more near pairs than
  /// near() holds, returns the nearest.
  std::optional<std::size_t> violated_pair() const;
  /// Whether no distance falls faster than the damper allows.
  bool is_damped() const;

  /// Sets the frames to the start of a part of the line, unless they are there.
  void set_frames(const ConfigurationRef& q, int part, int parts);
  /// Sets the derivative of n . (second - first) by the coordinates, at the frames.
  void fill_gradient(std::size_t pair, const NearestPoints& points,
                     Eigen::VectorXd& gradient) const;

  /// Returns the names of the bodies of a pair. They live as long as the model.
  std::array<std::string_view, 2> names(std::size_t pair) const;

 private:
  /// The separation of a pair in the last step that computed it.
  struct LastSeparation {
    NearestPoints points;
    double excess = 0;
    bool is_below = false;
    std::uint64_t step = 0;
  };
  /// Where the next search for a pair begins.
  struct PairStart {
    std::size_t pair = 0;
    SearchStart search = {};
  };
  /// A lower bound of a distance along a direction, at both ends of a part of the line, m. The end
  /// is to first order.
  struct PartBound {
    double start = 0, end = 0;
  };

  bool find_near_pairs(const ConfigurationRef& q);
  BoundedList<NearPair>::Iterator farthest_near();
  double damper_slack(const NearPair& near) const;
  MovingCapsule capsule(std::uint32_t body, std::size_t from) const;
  double displacement(const MovingCapsule& capsule) const;
  void add_if_near(std::size_t pair, const MovingCapsule& capsule, double reach);
  bool is_clear_along(const BodyPair& pair, const MovingCapsule& capsule, const Vector3& n,
                      double& excess);
  int part_count() const;
  bool prove_part(int part, int parts);
  PartBound bound_on_part(const BodyPair& pair, const Vector3& n) const;

  const ConvexBody& placed(std::uint32_t body);
  const ConvexBody& second_of(const BodyPair& pair);
  std::size_t frame_of_second(const BodyPair& pair) const;
  double rounding(const BodyPair& pair);
  Separation separate(std::size_t pair, double tolerance);

  const CollisionBodies* bodies_;
  double gain_;
  PairBounds pairs_;
  ChainMotion motion_;
  std::vector<ConvexBody> placed_;
  std::vector<char> is_placed_;
  std::vector<LastSeparation> last_separations_;  ///< of each pair
  std::vector<PairStart> starts_;                 ///< by the pair, modulo their number
  std::uint64_t step_ = 0;                        ///< counts steps, from 1
  BoundedList<NearPair> near_;                    ///< the nearest first
  bool too_many_ = false;                         ///< whether more pairs are near than near_ holds
  double time_ = 0;
  int parts_ = 1;
  Eigen::VectorXd line_, line_end_, part_line_, part_start_;
  Eigen::VectorXd framed_line_, framed_start_;  ///< the line and the start of the frames
  Eigen::VectorXd zero_;
};

}  // namespace beeline::internal
