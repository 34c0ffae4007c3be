#pragma once

#include <map>
#include <string>
#include <vector>

#include <beeline/formula/formula.h>
#include <beeline/formula/internal/program.h>
#include <beeline/formula/internal/symbolic_vector.h>
#include <beeline/formula/internal/tree.h>
#include <beeline/kinematics/jacobian.h>

namespace beeline::internal {

/// The kinematics of an arm as a program. Its variables are the symbols' names; those of the
/// coordinates are q[0], q[1], ..., of the rates dq[0], ...
class ProgramChain {
 public:
  /// `numbers`: constants are numbers, not variables.
  ProgramChain(const SymbolicArm& arm, bool numbers);

  Program& program() { return program_; }
  const Program& program() const { return program_; }

  /// The values of the constants that are variables, by name.
  const std::map<std::string, double>& constants() const { return constants_; }

  /// The 16 entries of the tool's pose in the world, row by row.
  std::vector<Program::Id> pose();

  /// The entries of the Jacobian, 6 x dof, row by row; and of its time derivative.
  std::vector<Program::Id> jacobian(Frame frame);
  std::vector<Program::Id> derivative(Frame frame);

  Program::Id expression(const Expression& expression);  ///< as factored() writes it

 private:
  /// The motion of a joint: its axis and a point of it in the world.
  struct Motion {
    int coordinate = 0;
    bool rotates = true;
    Program::Id rate = 0;  ///< of the motion for unit rate of the coordinate
    ProgramVector axis = {}, point = {};
  };
  struct Twist {
    ProgramVector linear = {}, angular = {};
  };

  Program::Id constant(const std::string& name, double value);
  Program::Id symbol(int number);
  Program::Id tree(const Tree& tree);
  Program::Id sum(const Angle& angle);
  std::string trig_name(const Trig& trig, Program::Id sum) const;
  Program::Id trig(const Trig& trig);
  Program::Id rate(const Motion& motion);
  ProgramRotation axis_rotation(int axis, const Angle& angle);
  ProgramVector constant_column(int axis);
  ProgramRotation turned();
  ProgramVector current_position();
  void close();
  void move_end();
  void append_rotation(const ElementaryTransform& transform);
  void append_translation(const ElementaryTransform& transform);
  void add_motions(const ElementaryTransform& transform);
  Twist twist(const Motion& motion, Frame frame);
  std::vector<Twist> rates_of_twists(Frame frame);
  std::vector<Program::Id> matrix(const std::vector<Twist>& twists);
  Twist in_axes(const Twist& twist, Frame frame);

  const SymbolicArm& arm_;
  bool numbers_;
  Program program_;
  std::map<std::string, double> constants_;
  // As in SymbolicPose; the position of a sum of rotations is added up in its own frame.
  ProgramRotation closed_{};
  ProgramVector position_{}, open_position_{}, end_position_{};
  ExpressionRotation constant_ = identity_rotation();
  int axis_ = -1;
  Angle angle_ = {};
  Angle last_angle_ = {};  ///< the sum that was formed last
  Program::Id last_sum_ = 0;
  std::vector<Motion> motions_;
  ProgramRotation rotation_{};  ///< of the tool
};

}  // namespace beeline::internal
