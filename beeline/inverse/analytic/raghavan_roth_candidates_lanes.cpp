#include <algorithm>
#include <cmath>

#include <beeline/inverse/analytic/raghavan_roth_candidates.h>
#include <beeline/inverse/analytic/trigonometric_polynomial.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beeline/inverse/analytic/raghavan_roth_candidates_lanes.cpp"
#include <hwy/foreach_target.h>  // must come before the -inl headers

#include <beeline/inverse/analytic/raghavan_roth_determinant-inl.h>
#include <beeline/inverse/analytic/rigid_motion-inl.h>
#include <beeline/inverse/analytic/trigonometric_polynomial-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace {

using internal::EliminationCandidates;

/// Returns the goal in the frame of the elimination: inverted if it is reversed, relative to its
/// origin.
RigidMotion motion_of(const Elimination& e, const RigidMotion& goal) {
  RigidMotion m = goal;
  if (e.reversed) {
    for (int r = 0; r < 3; ++r) {
      m.translation[r] = 0;
      for (int c = 0; c < 3; ++c) {
        m.rotation[r][c] = goal.rotation[c][r];
        m.translation[r] -= goal.rotation[c][r] * goal.translation[c];
      }
    }
  }
  for (int r = 0; r < 3; ++r) {
    m.translation[r] -= e.origin[r];
    for (int c = 0; c < 3; ++c) m.translation[r] += m.rotation[r][c] * e.origin[c];
  }
  return m;
}

/// Computes the right side's line at three times three angles of u and v. Each row has one of its
/// 14 numbers.
void right_values(const Elimination& e, const RigidMotion& m, double (*values)[16]) {
  for (int k = 0; k < 9; k += lane_count) {
    Lanes line[6], by_goal[6], moved[6];
    for (int i = 0; i < 6; ++i) line[i] = Lanes::load(e.line[i] + k);
    for (int r = 0; r < 3; ++r) {
      by_goal[r] = Lanes(m.translation[r]);
      by_goal[3 + r] = Lanes(0);
      for (int c = 0; c < 3; ++c) {
        by_goal[r] = fma(Lanes(m.rotation[r][c]), line[c], by_goal[r]);
        by_goal[3 + r] = fma(Lanes(m.rotation[r][c]), line[3 + c], by_goal[3 + r]);
      }
    }
    for (int r = 0; r < 3; ++r) {
      moved[r] = Lanes::load(e.before[9 + r] + k);
      moved[3 + r] = Lanes(0);
      for (int c = 0; c < 3; ++c) {
        const Lanes entry = Lanes::load(e.before[3 * r + c] + k);
        moved[r] = fma(entry, by_goal[c], moved[r]);
        moved[3 + r] = fma(entry, by_goal[3 + c], moved[3 + r]);
      }
    }
    const Lanes *p = moved, *l = moved + 3;
    const Lanes pp = fma(p[0], p[0], fma(p[1], p[1], p[2] * p[2]));
    const Lanes pl = fma(p[0], l[0], fma(p[1], l[1], p[2] * l[2]));
    for (int r = 0; r < 3; ++r) {
      const int s = (r + 1) % 3, t = (r + 2) % 3;
      l[r].store(values[r] + k);
      p[r].store(values[3 + r] + k);
      fnma(p[t], l[s], p[s] * l[t]).store(values[8 + r] + k);
      fnma(Lanes(2) * pl, p[r], pp * l[r]).store(values[11 + r] + k);
    }
    pp.store(values[6] + k);
    pl.store(values[7] + k);
  }
}

/// Converts values at 0, 1 and 2 quarter turns to the coefficients of 1, cos, sin.
HWY_INLINE void to_circle(double& a, double& b, double& c) {
  const double constant = 0.5 * (a + c), cosine = 0.5 * (a - c), sine = b - constant;
  a = constant;
  b = cosine;
  c = sine;
}

/// Columns 0 to 7: cos u cos v, cos u sin v, sin u cos v, sin u sin v, cos u, sin u, cos v, sin v.
void fill_rows(const Elimination& e, double (*values)[16], ReducedEquations& reduced) {
  for (int r = 0; r < 14; ++r) {
    double* x = values[r];
    for (int i = 0; i < 3; ++i) to_circle(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
    for (int i = 0; i < 3; ++i) to_circle(x[i], x[3 + i], x[6 + i]);
    double* row = reduced.row[r];
    const double right[8] = {x[4], x[5], x[7], x[8], x[3], x[6], x[1], x[2]};
    for (int i = 0; i < 8; ++i) row[i] = right[i];
    for (int i = 0; i < 27; ++i) row[left_column + i] = e.left[r][i];
    for (const int one : {0, 2, 6, 8}) row[left_column + one] -= x[0];  // 1 = (vv + uu)(vv + uu)
    for (int i = left_column + 27; i < 40; ++i) row[i] = 0;
  }
}

/// Makes columns 0 to 7 triangular by Householder reflections: rows 8 to 13 are then free of u, v.
void eliminate(ReducedEquations& reduced) {
  constexpr int blocks = 40 / lane_count;
  for (int k = 0; k < 8; ++k) {
    double v[14], square = 0;
    for (int r = k; r < 14; ++r) {
      v[r] = reduced.row[r][k];
      square += v[r] * v[r];
    }
    const double length = std::sqrt(square);
    v[k] += v[k] < 0 ? -length : length;
    const double scale = 1 / std::max(std::abs(v[k]) * length, 1e-300);
    Lanes along[blocks];
    for (Lanes& sum : along) sum = Lanes(0);
    for (int r = k; r < 14; ++r) {
      for (int b = 0; b < blocks; ++b) {
        along[b] = fma(Lanes(v[r]), Lanes::load(reduced.row[r] + b * lane_count), along[b]);
      }
    }
    for (Lanes& sum : along) sum *= Lanes(scale);
    for (int r = k; r < 14; ++r) {
      for (int b = 0; b < blocks; ++b) {
        double* to = reduced.row[r] + b * lane_count;
        fnma(Lanes(v[r]), along[b], Lanes::load(to)).store(to);
      }
    }
  }
}

/// Returns the angle whose half tangent is the ratio of neighbouring entries of a null vector, in
/// proportion v : u. The entries are the products (v^3, v^2 u, v u^2, u^3) of the first angle x (v
/// v, u v, u u) of the second: neighbours are `stride` 3 or 1 apart. The line of best fit through
/// all such pairs has the half angle's direction.
HWY_INLINE void half_tangent_angle(const Lanes* x, int stride, Lanes& cosine, Lanes& sine) {
  Lanes vv(0), uv(0), uu(0);
  for (int i = 0; i < 12 - stride; ++i) {
    if (stride == 1 && i % 3 == 2) continue;
    const Lanes a = x[i], b = x[i + stride];
    vv = fma(a, a, vv);
    uv = fma(a, b, uv);
    uu = fma(b, b, uu);
  }
  const Lanes difference = vv - uu, twice = uv + uv;
  const Lanes scale = Lanes(1) / max(sqrt(fma(difference, difference, twice * twice)), 1e-300);
  cosine = difference * scale;
  sine = twice * scale;
}

/// Angles in the order of Elimination, in eight lanes.
struct EliminationAngles {
  Lanes first, second, u, v;
};

/// Returns the angles for a value of the hidden angle and its null vector x.
EliminationAngles read_angles(const ReducedEquations& reduced, Lanes cosine, Lanes sine,
                              const Lanes* x) {
  Lanes c[2], s[2];
  half_tangent_angle(x, 3, c[0], s[0]);
  half_tangent_angle(x, 1, c[1], s[1]);
  Lanes w[9];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Lanes half(0.5);
      const Lanes a = half * (i == 0 ? Lanes(1) + c[0] : i == 1 ? s[0] : Lanes(1) - c[0]);
      const Lanes b = half * (j == 0 ? Lanes(1) + c[1] : j == 1 ? s[1] : Lanes(1) - c[1]);
      w[3 * i + j] = a * b;
    }
  }
  Lanes right[8];  // cos u, sin u, cos v, sin v in 4 to 7, by back substitution
  for (int r = 7; r >= 4; --r) {
    const double* row = reduced.row[r];
    Lanes sum(0);
    for (int i = 0; i < 9; ++i) {
      const double* k = row + left_column + i;
      sum = fma(fma(Lanes(k[18]), sine, fma(Lanes(k[9]), cosine, Lanes(k[0]))), w[i], sum);
    }
    for (int i = r + 1; i < 8; ++i) sum = fnma(Lanes(row[i]), right[i], sum);
    const double diagonal = std::abs(row[r]) > 1e-300 ? row[r] : 1e-300;
    right[r] = sum / Lanes(diagonal);
  }
  return {arc_tangent(s[0], c[0]), arc_tangent(s[1], c[1]), arc_tangent(right[5], right[4]),
          arc_tangent(right[7], right[6])};
}

/// Writes the configurations of eight null vectors x as candidates from number `begin` on.
HWY_NOINLINE void write(const Elimination& e, const ReducedEquations& reduced, Lanes angle,
                        Lanes cosine, Lanes sine, const Lanes* x, int begin,
                        EliminationCandidates& candidates) {
  const EliminationAngles angles = read_angles(reduced, cosine, sine, x);
  const Lanes sign(e.reversed ? -1 : 1);
  (sign * angle).store(candidates.q[e.hidden] + begin);
  (sign * angles.first).store(candidates.q[e.first] + begin);
  (sign * angles.second).store(candidates.q[e.second] + begin);
  (sign * angles.u).store(candidates.q[e.u] + begin);
  (sign * angles.v).store(candidates.q[e.v] + begin);
  Lanes(0).store(candidates.q[e.last] + begin);
}

/// Writes the candidates at simple zeros. The determinant has lost digits that its matrix still
/// has. Gauss-Newton corrections of the angle restore them.
void write_simple(const Elimination& e, const ReducedEquations& reduced, TrigonometricZeros& zeros,
                  EliminationCandidates& candidates) {
  constexpr int max_corrections = 3;
  constexpr double small_correction = 1e-5;  // radians; the next one is of its square
  constexpr double max_correction = 1e-3;  // a longer one comes from a second small singular value
  Lanes x[12], s, c;
  TriangularSystem system;
  for (int k = 0; k < zeros.count; k += lane_count) {
    for (int i = zeros.count; i < k + lane_count; ++i) zeros.angle[i] = zeros.angle[k];
    Lanes angle = Lanes::load(zeros.angle + k);
    for (int round = 0;; ++round) {
      sine_cosine(angle, s, c);
      set_angle(reduced, c, s, system);
      triangulate(system);
      null_vector(system, nullptr, x);
      const Lanes correction = angle_correction(reduced, system, c, s, x);
      angle += max(min(correction, Lanes(max_correction)), Lanes(-max_correction));
      const bool small = bits(abs(correction) > Lanes(small_correction)) == 0;
      if (round == max_corrections || small) break;
    }
    write(e, reduced, angle, c, s, x, k, candidates);
  }
  candidates.count = candidates.expected = zeros.count;
  std::copy(zeros.uncertain, zeros.uncertain + zeros.count, candidates.uncertain);
}

/// Writes two candidates for each double zero, from the two vectors of its null space.
void write_double(const Elimination& e, const ReducedEquations& reduced, TrigonometricZeros& zeros,
                  EliminationCandidates& candidates) {
  Lanes x[12], y[12], s, c;
  TriangularSystem system;
  for (int k = 0; k < zeros.double_count; k += lane_count) {
    for (int i = zeros.double_count; i < k + lane_count; ++i) {
      zeros.double_angle[i] = zeros.double_angle[k];
    }
    const Lanes angle = Lanes::load(zeros.double_angle + k);
    sine_cosine(angle, s, c);
    set_angle(reduced, c, s, system);
    triangulate(system);
    null_vector(system, nullptr, x);
    null_vector(system, x, y);
    separate(x, y);
    for (const Lanes* vector : {x, y}) {
      write(e, reduced, angle, c, s, vector, candidates.count, candidates);
      candidates.count += std::min(lane_count, zeros.double_count - k);
    }
  }
}

}  // namespace

void elimination_candidates_kernel(const Elimination& e, const TrigonometricTables& tables,
                                   const RigidMotion& goal, EliminationCandidates& candidates) {
  alignas(64) double values[14][16];
  ReducedEquations reduced;
  right_values(e, motion_of(e, goal), values);
  fill_rows(e, values, reduced);
  eliminate(reduced);

  const bool usual = e.degree <= TrigonometricTables::usual_degree;
  const SampleAngles& samples = usual ? tables.usual : tables.largest;
  double determinants[SampleAngles::max_count];
  for (int k = 0; k < samples.count; k += lane_count) {
    TriangularSystem system;
    set_angle(reduced, Lanes::load(samples.cosine + k), Lanes::load(samples.sine + k), system);
    triangulate(system);
    system.determinant.store(determinants + k);
  }
  TrigonometricPolynomial determinant;
  candidates.noise = interpolate(samples, determinants, e.degree, determinant);
  TrigonometricZeros zeros;
  find_zeros(tables, determinant, candidates.noise, zeros);
  write_simple(e, reduced, zeros, candidates);
  write_double(e, reduced, zeros, candidates);
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace beeline {

HWY_EXPORT(elimination_candidates_kernel);

namespace internal {

void elimination_candidates(const Elimination& elimination, const RigidMotion& goal,
                            EliminationCandidates& candidates) {
  HWY_DYNAMIC_DISPATCH(elimination_candidates_kernel)
  (elimination, trigonometric_tables(), goal, candidates);
}

}  // namespace internal
}  // namespace beeline
#endif
