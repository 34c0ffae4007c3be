#include <algorithm>
#include <cmath>

#include <beeline/inverse/analytic/general_candidates.h>
#include <beeline/inverse/analytic/general_circle.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beeline/inverse/analytic/general_candidates_lanes.cpp"
#include <hwy/foreach_target.h>  // must come before the -inl headers

#include <beeline/inverse/analytic/general_circle-inl.h>
#include <beeline/inverse/analytic/general_determinant-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace {

/// The goal as the elimination wants it: backwards if it is reversed, measured from its origin.
HWY_INLINE Motion motion_of(const GeneralElimination& e, const Motion& goal) {
  Motion m = goal;
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

/// The right side's features at three times three angles of u and v, one number a row.
HWY_NOINLINE void right_values(const GeneralElimination& e, const Motion& m, double (*values)[16]) {
  for (int k = 0; k < 9; k += lane_count) {
    Lanes line[6], half[6], moved[6];
    for (int i = 0; i < 6; ++i) line[i] = Lanes::load(e.line[i] + k);
    for (int r = 0; r < 3; ++r) {
      half[r] = Lanes(m.translation[r]);
      half[3 + r] = Lanes(0);
      for (int c = 0; c < 3; ++c) {
        half[r] = fma(Lanes(m.rotation[r][c]), line[c], half[r]);
        half[3 + r] = fma(Lanes(m.rotation[r][c]), line[3 + c], half[3 + r]);
      }
    }
    for (int r = 0; r < 3; ++r) {
      moved[r] = Lanes::load(e.before[9 + r] + k);
      moved[3 + r] = Lanes(0);
      for (int c = 0; c < 3; ++c) {
        const Lanes entry = Lanes::load(e.before[3 * r + c] + k);
        moved[r] = fma(entry, half[c], moved[r]);
        moved[3 + r] = fma(entry, half[3 + c], moved[3 + r]);
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

/// From values at 0, 1 and 2 quarter turns to the coefficients of 1, cos, sin.
HWY_INLINE void to_circle(double& a, double& b, double& c) {
  const double constant = 0.5 * (a + c), cosine = 0.5 * (a - c), sine = b - constant;
  a = constant;
  b = cosine;
  c = sine;
}

/// Columns 0 to 7: cos u cos v, cos u sin v, sin u cos v, sin u sin v, cos u, sin u, cos v, sin v.
HWY_NOINLINE void fill_rows(const GeneralElimination& e, double (*values)[16], Reduced& reduced) {
  for (int r = 0; r < 14; ++r) {
    double* x = values[r];
    for (int i = 0; i < 3; ++i) to_circle(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
    for (int i = 0; i < 3; ++i) to_circle(x[i], x[3 + i], x[6 + i]);
    double* row = reduced.row[r];
    const double right[8] = {x[4], x[5], x[7], x[8], x[3], x[6], x[1], x[2]};
    for (int i = 0; i < 8; ++i) row[i] = right[i];
    for (int i = 0; i < 27; ++i) row[from_left + i] = e.left[r][i];
    for (const int one : {0, 2, 6, 8}) row[from_left + one] -= x[0];  // 1 = (vv + uu) (vv + uu)
    for (int i = from_left + 27; i < 40; ++i) row[i] = 0;
  }
}

/// Householder reflections that make columns 0 to 7 triangular: rows 8 to 13 are free of them.
HWY_NOINLINE void eliminate(Reduced& reduced) {
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

/// The five angles that a null vector of the hidden angle's matrix tells.
HWY_INLINE void read_angles(const Reduced& reduced, Lanes cosine, Lanes sine, const Lanes* x,
                            Lanes& first, Lanes& second, Lanes& u, Lanes& v) {
  // x holds the products (v^3, v^2 u, v u^2, u^3) x (v v, u v, u u): pairs of neighbours are as v
  // to u in each. The best line through all these pairs is at the half angle.
  Lanes c[2], s[2];
  for (int which = 0; which < 2; ++which) {
    const int stride = which == 0 ? 3 : 1;
    Lanes vv(0), uv(0), uu(0);
    for (int i = 0; i < 12 - stride; ++i) {
      if (which == 1 && i % 3 == 2) continue;
      const Lanes a = x[i], b = x[i + stride];
      vv = fma(a, a, vv);
      uv = fma(a, b, uv);
      uu = fma(b, b, uu);
    }
    const Lanes difference = vv - uu, twice = uv + uv;
    const Lanes scale = Lanes(1) / max(sqrt(fma(difference, difference, twice * twice)), 1e-300);
    c[which] = difference * scale;
    s[which] = twice * scale;
  }
  first = arc_tangent(s[0], c[0]);
  second = arc_tangent(s[1], c[1]);

  Lanes w[9];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Lanes half(0.5);
      const Lanes a = half * (i == 0 ? Lanes(1) + c[0] : i == 1 ? s[0] : Lanes(1) - c[0]);
      const Lanes b = half * (j == 0 ? Lanes(1) + c[1] : j == 1 ? s[1] : Lanes(1) - c[1]);
      w[3 * i + j] = a * b;
    }
  }
  Lanes right[8];  // cos u, sin u, cos v, sin v in 4 to 7
  for (int r = 7; r >= 4; --r) {
    const double* row = reduced.row[r];
    Lanes sum(0);
    for (int i = 0; i < 9; ++i) {
      const double* k = row + from_left + i;
      sum = fma(fma(Lanes(k[18]), sine, fma(Lanes(k[9]), cosine, Lanes(k[0]))), w[i], sum);
    }
    for (int i = r + 1; i < 8; ++i) sum = fnma(Lanes(row[i]), right[i], sum);
    const double diagonal = std::abs(row[r]) > 1e-300 ? row[r] : 1e-300;
    right[r] = sum / Lanes(diagonal);
  }
  u = arc_tangent(right[5], right[4]);
  v = arc_tangent(right[7], right[6]);
}

/// Reads the configurations of eight null vectors into places from `place` on.
HWY_NOINLINE void write(const GeneralElimination& e, const Reduced& reduced, Lanes angle,
                        Lanes cosine, Lanes sine, const Lanes* x, int place,
                        GeneralCandidates& candidates) {
  Lanes first, second, u, v;
  read_angles(reduced, cosine, sine, x, first, second, u, v);
  const Lanes sign(e.reversed ? -1 : 1);
  (sign * angle).store(candidates.q[e.hidden] + place);
  (sign * first).store(candidates.q[e.first] + place);
  (sign * second).store(candidates.q[e.second] + place);
  (sign * u).store(candidates.q[e.u] + place);
  (sign * v).store(candidates.q[e.v] + place);
  Lanes(0).store(candidates.q[e.last] + place);
}

constexpr double small_correction = 1e-5;
constexpr int max_corrections = 3;

HWY_NOINLINE void write_roots(const GeneralElimination& e, const Reduced& reduced,
                              CircleRoots& roots, GeneralCandidates& candidates) {
  Lanes M[6][9], x[12], y[12], s, c;
  Triangle triangle;
  for (int k = 0; k < roots.count; k += lane_count) {
    for (int i = roots.count; i < k + lane_count; ++i) roots.angle[i] = roots.angle[k];
    Lanes angle = Lanes::load(roots.angle + k);
    for (int round = 0;; ++round) {
      sine_cosine(angle, s, c);
      at_angle(reduced, c, s, M);
      make_triangular(M, triangle);
      null_vector(triangle, nullptr, x);
      const Lanes by = correction(reduced, M, c, s, x);
      angle += max(min(by, Lanes(1e-3)), Lanes(-1e-3));
      if (round == max_corrections || bits(abs(by) > Lanes(small_correction)) == 0) break;
    }
    write(e, reduced, angle, c, s, x, k, candidates);
  }
  candidates.count = candidates.expected = roots.count;
  for (int k = 0; k < roots.pair_count; k += lane_count) {
    for (int i = roots.pair_count; i < k + lane_count; ++i) roots.pair[i] = roots.pair[k];
    const Lanes angle = Lanes::load(roots.pair + k);
    sine_cosine(angle, s, c);
    at_angle(reduced, c, s, M);
    make_triangular(M, triangle);
    null_vector(triangle, nullptr, x);
    null_vector(triangle, x, y);
    separate(x, y);
    for (const Lanes* vector : {x, y}) {
      write(e, reduced, angle, c, s, vector, candidates.count, candidates);
      candidates.count += std::min(lane_count, roots.pair_count - k);
    }
  }
}

HWY_INLINE void general_candidates_lanes(const GeneralElimination& e, const CircleTables& tables,
                                         const Motion& goal, GeneralCandidates& candidates) {
  alignas(64) double values[14][16];
  Reduced reduced;
  right_values(e, motion_of(e, goal), values);
  fill_rows(e, values, reduced);
  eliminate(reduced);

  const CircleSamples& samples = e.degree > CircleTables::usual_degree ? tables.most : tables.usual;
  double determinants[CircleSamples::most];
  for (int k = 0; k < samples.count; k += lane_count) {
    Lanes M[6][9];
    Triangle triangle;
    at_angle(reduced, Lanes::load(samples.cosine + k), Lanes::load(samples.sine + k), M);
    make_triangular(M, triangle);
    triangle.determinant.store(determinants + k);
  }
  CirclePolynomial determinant;
  candidates.noise = interpolate(samples, determinants, e.degree, determinant);
  CircleRoots roots;
  find_roots(tables, determinant, candidates.noise, roots);
  write_roots(e, reduced, roots, candidates);
}

}  // namespace

void candidates_kernel(const GeneralElimination& e, const CircleTables& tables, const Motion& goal,
                       GeneralCandidates& candidates) {
  general_candidates_lanes(e, tables, goal, candidates);
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace beeline {

HWY_EXPORT(candidates_kernel);

void general_candidates(const GeneralElimination& elimination, const Motion& goal,
                        GeneralCandidates& candidates) {
  HWY_DYNAMIC_DISPATCH(candidates_kernel)(elimination, circle_tables(), goal, candidates);
}

}  // namespace beeline
#endif
