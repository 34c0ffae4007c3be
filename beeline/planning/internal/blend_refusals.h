#pragma once

#include <cstddef>

namespace beeline::internal {

/// The refusals of motions in a search for blends. They bound the search: a blend that is refused
/// is made smaller first, then a stop, and near the end so are all blends after it.
class BlendRefusals {
 public:
  static constexpr double smaller = 0.4;  ///< of the radius that was refused
  static constexpr int max_smaller = 3;  ///< times that a blend is made smaller before it is a stop

  /// Some refusals more are allowed for lines, which get samples first.
  explicit BlendRefusals(std::size_t lines = 0) : left_(max_refusals + static_cast<int>(lines)) {}

  bool any_left() const { return left_ > 0; }
  void count() { --left_; }

  /// The radius of a blend after a refusal, as a fraction of the one that was refused the `times`th
  /// time.
  double fraction(int times) const {
    return left_ <= stop_refused_from || times > max_smaller ? 0 : smaller;
  }

  /// Whether all blends after one that is refused become stops too.
  bool rest_stops() const { return left_ <= stop_rest_from; }

 private:
  static constexpr int max_refusals = 20;
  static constexpr int stop_refused_from = 10, stop_rest_from = 2;  // refusals left

  int left_;
};

}  // namespace beeline::internal
