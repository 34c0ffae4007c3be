// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_INVERSE_RAGHAVAN_ROTH_DETERMINANT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_INVERSE_RAGHAVAN_ROTH_DETERMINANT_INL_H
#undef BEELINE_INVERSE_RAGHAVAN_ROTH_DETERMINANT_INL_H
#else
#define BEELINE_INVERSE_RAGHAVAN_ROTH_DETERMINANT_INL_H
#endif

#include <beeline/inverse/analytic/raghavan_roth_elimination.h>

#include <beeline/simd/trigonometry-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

using internal::Elimination;

/// The fourteen equations of an elimination, after the products of the angles u and v have been
/// eliminated from rows 8 to 13.
struct ReducedEquations {
  alignas(
      64) double row[14][40];  ///< columns 0 to 7: right side, triangular; 8 to 34: as in `left`
};

constexpr int left_column = 8;  ///< the column where the left side begins
constexpr int first_free_row = 8;

/// The six equations at a value of the hidden angle, M w = 0 with w the nine products of the other
/// two angles, and the twelve equations of the dialytic elimination in triangular form: M, and M
/// multiplied by one power of the first angle's half tangent.
struct TriangularSystem {
  Lanes m[6][9];  ///< M
  Lanes a[12][12];
  Lanes determinant;
};

/// One Householder reflection: column `Pivot` becomes zero below the diagonal. A template, so that
/// the compiler unrolls the loops.
template <int Pivot, int Rows, int Columns>
HWY_INLINE void reflect(TriangularSystem& t) {
  Lanes v[Rows - Pivot];
  Lanes square(0);
  for (int r = Pivot; r < Rows; ++r) {
    v[r - Pivot] = t.a[r][Pivot];
    square = fma(v[r - Pivot], v[r - Pivot], square);
  }
  const Lanes length = sqrt(square);
  const Lanes signed_length = with_sign(length, v[0]);
  v[0] = v[0] + signed_length;
  const Lanes scale = Lanes(1) / max(abs(v[0]) * length, Lanes(1e-300));
  t.a[Pivot][Pivot] = -signed_length;
  t.determinant *= signed_length;  // a reflection's own determinant is -1
  for (int c = Pivot + 1; c < Columns; ++c) {
    Lanes along(0);
    for (int r = Pivot; r < Rows; ++r) along = fma(v[r - Pivot], t.a[r][c], along);
    along *= scale;
    for (int r = Pivot; r < Rows; ++r) t.a[r][c] = fnma(along, v[r - Pivot], t.a[r][c]);
  }
}

/// Computes M at a value of the hidden angle.
HWY_NOINLINE inline void set_angle(const ReducedEquations& reduced, Lanes cosine, Lanes sine,
                                   TriangularSystem& t) {
  for (int r = 0; r < 6; ++r) {
    const double* k = reduced.row[first_free_row + r] + left_column;
    for (int i = 0; i < 9; ++i) {
      t.m[r][i] = fma(Lanes(k[18 + i]), sine, fma(Lanes(k[9 + i]), cosine, Lanes(k[i])));
    }
  }
}

/// Makes the twelve equations of M triangular.
HWY_NOINLINE inline void triangulate(TriangularSystem& t) {
  for (int r = 0; r < 6; ++r) {
    for (int c = 0; c < 9; ++c) t.a[r][c] = t.a[6 + r][3 + c] = t.m[r][c];
  }
  for (int r = 3; r < 6; ++r) {
    for (int c = 9; c < 12; ++c) t.a[r][c] = Lanes(0);
  }
  t.determinant = Lanes(1);
  reflect<0, 6, 9>(t);
  reflect<1, 6, 9>(t);
  reflect<2, 6, 9>(t);
  reflect<3, 12, 12>(t);
  reflect<4, 12, 12>(t);
  reflect<5, 12, 12>(t);
  reflect<6, 12, 12>(t);
  reflect<7, 12, 12>(t);
  reflect<8, 12, 12>(t);
  reflect<9, 12, 12>(t);
  reflect<10, 12, 12>(t);
  t.determinant *= t.a[11][11];
}

/// Computes the unit vector x that the matrix shortens most, by two inverse iterations. Given that
/// vector as `known`, computes the next one, orthogonal to it.
HWY_NOINLINE inline void null_vector(const TriangularSystem& t, const Lanes* known, Lanes* x) {
  Lanes inverse[12];
  Lanes largest(0);
  for (int k = 0; k < 12; ++k) largest = max(largest, abs(t.a[k][k]));
  const Lanes min_pivot = max(largest * Lanes(1e-17), Lanes(1e-300));
  for (int k = 0; k < 12; ++k) {
    inverse[k] = Lanes(1) / with_sign(max(abs(t.a[k][k]), min_pivot), t.a[k][k]);
    x[k] = Lanes(1 - 0.37 * (k * 7 % 5));  // arbitrary, orthogonal to no particular vector
  }
  for (int round = 0; round < 2; ++round) {
    for (int k = 0; k < 12; ++k) {  // the transpose; columns 9 to 11 begin in row 3
      Lanes sum = x[k];
      for (int r = k < 9 ? 0 : 3; r < k; ++r) sum = fnma(t.a[r][k], x[r], sum);
      x[k] = sum * inverse[k];
    }
    for (int k = 11; k >= 0; --k) {
      Lanes sum = x[k];
      for (int c = k + 1; c < (k < 3 ? 9 : 12); ++c) sum = fnma(t.a[k][c], x[c], sum);
      x[k] = sum * inverse[k];
    }
    for (int pass = 0; known != nullptr && pass < 2; ++pass) {  // twice, against cancellation
      Lanes along(0);
      for (int k = 0; k < 12; ++k) along = fma(known[k], x[k], along);
      for (int k = 0; k < 12; ++k) x[k] = fnma(along, known[k], x[k]);
    }
    Lanes size(1e-300), square(0);
    for (int k = 0; k < 12; ++k) size = max(size, abs(x[k]));
    const Lanes shrink = Lanes(1) / size;
    for (int k = 0; k < 12; ++k) {
      x[k] *= shrink;
      square = fma(x[k], x[k], square);
    }
    const Lanes scale = Lanes(1) / sqrt(square);
    for (int k = 0; k < 12; ++k) x[k] *= scale;
  }
}

/// Replaces x and y, which span a null space, by the null vectors of the two solutions that share
/// the hidden angle. These are the combinations whose entries one power of the half tangent apart
/// are in proportion: eigenvectors of a 2x2 pencil.
HWY_NOINLINE inline void separate(Lanes* x, Lanes* y) {
  const Lanes c(0.8), s(0.6);  // rotates the zero of the angle: pi has an infinite half tangent
  Lanes A[2][2] = {{0, 0}, {0, 0}}, B[2][2] = {{0, 0}, {0, 0}};
  for (int i = 0; i < 9; ++i) {
    const Lanes low[2] = {fma(c, x[i], s * x[i + 3]), fma(c, y[i], s * y[i + 3])};
    const Lanes high[2] = {fma(c, x[i + 3], -(s * x[i])), fma(c, y[i + 3], -(s * y[i]))};
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b < 2; ++b) {
        A[a][b] = fma(low[a], low[b], A[a][b]);
        B[a][b] = fma(low[a], high[b], B[a][b]);
      }
    }
  }
  // det(B - t A) = 0.
  const Lanes square = A[0][0] * A[1][1] - A[0][1] * A[1][0];
  const Lanes half =
      Lanes(0.5) * (A[0][0] * B[1][1] + A[1][1] * B[0][0] - A[0][1] * B[1][0] - A[1][0] * B[0][1]);
  const Lanes constant = B[0][0] * B[1][1] - B[0][1] * B[1][0];
  const Lanes root = sqrt(max(half * half - square * constant, Lanes(0)));
  const Lanes sum = half + with_sign(root, half);
  const Lanes tiny(1e-300);
  const Lanes t[2] = {sum / with_sign(max(abs(square), tiny), square),
                      constant / with_sign(max(abs(sum), tiny), sum)};
  Lanes weight[2][2];
  for (int i = 0; i < 2; ++i) {
    Lanes p = fnma(t[i], A[0][0], B[0][0]), q = fnma(t[i], A[0][1], B[0][1]);
    const Lanes other_p = fnma(t[i], A[1][0], B[1][0]), other_q = fnma(t[i], A[1][1], B[1][1]);
    const LaneMask other = max(abs(p), abs(q)) < max(abs(other_p), abs(other_q));
    weight[i][0] = -choose(other, other_q, q);
    weight[i][1] = choose(other, other_p, p);
  }
  for (int i = 0; i < 12; ++i) {
    const Lanes before = x[i];
    x[i] = fma(weight[0][0], before, weight[0][1] * y[i]);
    y[i] = fma(weight[1][0], before, weight[1][1] * y[i]);
  }
}

/// Returns the first-order correction of the hidden angle to a singular matrix: the Gauss-Newton
/// step of |A(angle) x| for a fixed x.
HWY_NOINLINE inline Lanes angle_correction(const ReducedEquations& reduced,
                                           const TriangularSystem& t, Lanes cosine, Lanes sine,
                                           const Lanes* x) {
  Lanes value_slope(0), value_value(0);
  for (int r = 0; r < 6; ++r) {
    const double* k = reduced.row[first_free_row + r] + left_column;
    Lanes value[2] = {0, 0}, slope[2] = {0, 0};
    for (int i = 0; i < 9; ++i) {
      const Lanes change = fma(Lanes(k[18 + i]), cosine, -(Lanes(k[9 + i]) * sine));
      for (int shift = 0; shift < 2; ++shift) {
        value[shift] = fma(t.m[r][i], x[i + 3 * shift], value[shift]);
        slope[shift] = fma(change, x[i + 3 * shift], slope[shift]);
      }
    }
    for (int shift = 0; shift < 2; ++shift) {
      value_value = fma(value[shift], value[shift], value_value);
      value_slope = fma(value[shift], slope[shift], value_slope);
    }
  }
  const Lanes nonzero = with_sign(max(abs(value_slope), Lanes(1e-300)), value_slope);
  return -(value_value / nonzero);
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
