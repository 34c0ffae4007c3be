#pragma once

#include <string>
#include <utility>
#include <vector>

#include <beeline/formula/internal/planar_inverse.h>

namespace beeline::internal {

/// A link of a planar arm. R is a rotation by the coordinate plus the bend, then the length along
/// x. P is a rotation by the bend, then the coordinate plus the length along x.
struct PlanarLink {
  bool revolute = true;
  int symbol = -1;  ///< symbol of the coordinate
  Expression length = {};
  Angle bend = {};                 ///< named part of the bend
  int multiple_of_15_degrees = 0;  ///< exact part of the bend, in multiples of 15 degrees

  bool bends() const { return multiple_of_15_degrees != 0 || !bend.is_zero(); }
  Expression bend_cosine() const;
  Expression bend_sine() const;
};

/// Returns the links of an arm with NamingConvention::planar. The tool's offset along x is part of
/// the last link's length. Returns none if the base is not the world, a joint is coupled, or the
/// tool is beside the link.
std::vector<PlanarLink> planar_links(const SymbolicArm& arm);

Tree atan2(Tree y, Tree x);
Tree branch(const Expression& square);  ///< plus or minus the root
Tree over(const Expression& numerator, const Expression& denominator);
Tree positive_first(const Expression& expression);
Tree sum(std::vector<Tree> parts);
Tree difference(Tree a, Tree b);

/// Builds a derivation step by step. Quantities that are defined are symbols of later steps.
class InverseSteps {
 public:
  InverseSteps(const SymbolicArm& arm, bool orientation);

  Expression x() const { return Expression::symbol(derivation_.x); }
  Expression y() const { return Expression::symbol(derivation_.y); }
  Expression theta_cosine() const { return Expression::cosine(theta_angle()); }
  Expression theta_sine() const { return Expression::sine(theta_angle()); }

  /// Returns cosine and sine of theta plus the bend of a link times a sign.
  std::pair<Expression, Expression> turned(const PlanarLink& link, int sign) const;

  /// Returns the components of a point along and across the direction of the first slide.
  std::pair<Expression, Expression> in_slide_axes(const PlanarLink& link, const Expression& u,
                                                  const Expression& v);

  /// Defines an intermediate quantity.
  Expression define(const std::string& letter, const std::string& subscript, Tree right,
                    const std::string& explanation = "");

  /// Defines the coordinate of a slide, or of a rotation from the angle that includes its bend.
  void define_angle(const PlanarLink& link, Tree right, const std::string& explanation = "");
  void define_slide(const PlanarLink& link, Tree right, const std::string& explanation = "");

  /// Defines the coordinate of rotation `last` from theta and the other rotations.
  void define_last_angle(const std::vector<PlanarLink>& links, std::size_t last,
                         const std::string& explanation);

  /// Adds a remark in which each @ stands for the next of the symbols.
  void remark(const std::string& sentence, const std::vector<Expression>& symbols = {});
  InverseDerivation finish() { return std::move(derivation_); }

 private:
  Angle theta_angle() const { return {derivation_.theta, {{derivation_.theta, 1}}}; }
  int add_symbol(const std::string& letter, const std::string& subscript);
  Tree bend_of(const PlanarLink& link, int sign) const;

  InverseDerivation derivation_;
};

/// Compares the solutions with the forward kinematics at random configurations. Throws Error if
/// they differ.
void check_derivation(const SymbolicArm& arm, const InverseDerivation& derivation);

}  // namespace beeline::internal
