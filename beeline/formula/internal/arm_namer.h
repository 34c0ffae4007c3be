#pragma once

#include <set>
#include <string>

#include <beeline/formula/formula.h>

namespace beeline::internal {

/// Builds a SymbolicArm: names each number of an arm as its transforms are added, in their order.
/// Zero lengths and angles are omitted, see zero_length and SymbolicArm::dropped_length.
class ArmNamer {
 public:
  ArmNamer(const Arm& arm, const SymbolicOptions& options);

  SymbolicArm& arm() { return named_; }

  /// Gives lengths of equal magnitude one symbol from now on.
  void share_lengths() { shares_lengths_ = true; }

  void begin_transform() { named_.transforms.emplace_back(); }
  void rotate(int axis, double angle, const std::string& letter, const std::string& subscript,
              const std::string& meaning);
  void translate(int axis, double length, const std::string& letter, const std::string& subscript,
                 const std::string& meaning);

  /// Adds a constant pose: translations along x, y and z, then rotations. `before` and `after` are
  /// the axes of the joints on both sides, see axis_rotations().
  void place(const Pose& pose, const std::string& subscript, int before, int after);

  /// Adds the motion of joint i (from 0) about or along an axis of the current frame.
  void move(std::size_t i, int axis, int sign = 1);

  /// Adds the motion of joint i about its screw, at any position in the frame of link i.
  void move_about_screw(std::size_t i);

  /// Returns the axis (0, 1, 2) of joint i (from 1) in its link frame. Returns 2 if it is no axis
  /// of the frame, or there is no such joint.
  int axis_of(std::size_t i) const;

  /// Returns the arm with the symbols of the rates.
  SymbolicArm finish();

 private:
  void add(ElementaryTransform transform);
  int symbol(Symbol symbol);
  int coordinate_symbol(int coordinate);
  int mimic_symbol(std::size_t i);
  Expression shared_constant(SymbolKind kind, double value, const std::string& letter,
                             const std::string& subscript, const std::string& meaning);

  const Arm& source_;
  SymbolicArm named_;
  std::set<std::string> names_;  ///< names of the symbols
  double unit_ = 1;              ///< length_unit()
  bool shares_lengths_ = false;
};

}  // namespace beeline::internal
