#include <beeline/formula/internal/convention_text.h>

namespace beeline::internal {
namespace {

struct Sentence {
  const char* text;
  const char* latex;
};

constexpr Sentence sentence(NamingConvention convention) {
  switch (convention) {
    case NamingConvention::planar:
      return {"Planar links: Tᵢ = Rz(qᵢ + θᵢ) Tx(aᵢ), for a prismatic joint Rz(θᵢ) Tx(aᵢ + qᵢ).",
              "Planar links: $T_i = R_z(q_i + \\theta_i)\\,T_x(a_i)$, for a prismatic joint "
              "$R_z(\\theta_i)\\,T_x(a_i + q_i)$."};
    case NamingConvention::standard:
      return {
          "Standard Denavit-Hartenberg parameters: Tᵢ = Rz(qᵢ + θᵢ) Tz(dᵢ) Tx(aᵢ) Rx(αᵢ), "
          "for a prismatic joint Rz(θᵢ) Tz(qᵢ + dᵢ) Tx(aᵢ) Rx(αᵢ).",
          "Standard Denavit--Hartenberg parameters: $T_i = "
          "R_z(q_i + \\theta_i)\\,T_z(d_i)\\,T_x(a_i)\\,R_x(\\alpha_i)$, for a prismatic joint "
          "$R_z(\\theta_i)\\,T_z(q_i + d_i)\\,T_x(a_i)\\,R_x(\\alpha_i)$."};
    case NamingConvention::modified:
      return {
          "Modified Denavit-Hartenberg parameters: Tᵢ = Tx(aᵢ₋₁) Rx(αᵢ₋₁) Rz(qᵢ + θᵢ) Tz(dᵢ), "
          "for a prismatic joint Tx(aᵢ₋₁) Rx(αᵢ₋₁) Rz(θᵢ) Tz(qᵢ + dᵢ).",
          "Modified Denavit--Hartenberg parameters: $T_i = "
          "T_x(a_{i-1})\\,R_x(\\alpha_{i-1})\\,R_z(q_i + \\theta_i)\\,T_z(d_i)$, for a prismatic "
          "joint $T_x(a_{i-1})\\,R_x(\\alpha_{i-1})\\,R_z(\\theta_i)\\,T_z(q_i + d_i)$."};
    case NamingConvention::offsets:
      break;
  }
  return {
      "Tᵢ is the offset of joint i in link i−1, a translation (xᵢ, yᵢ, zᵢ) and fixed rotations, "
      "then the motion of the joint.",
      "$T_i$ is the offset of joint $i$ in link $i-1$, a translation $(x_i, y_i, z_i)$ and fixed "
      "rotations, then the motion of the joint."};
}

}  // namespace

std::string convention_text(NamingConvention convention, bool latex) {
  const Sentence both = sentence(convention);
  return latex ? both.latex : both.text;
}

}  // namespace beeline::internal
