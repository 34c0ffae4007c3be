// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_BATCH_INTERNAL_TRANSPOSE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_BATCH_INTERNAL_TRANSPOSE_INL_H
#undef BEELINE_BATCH_INTERNAL_TRANSPOSE_INL_H
#else
#define BEELINE_BATCH_INTERNAL_TRANSPOSE_INL_H
#endif

#include <algorithm>

#include <beeline/batch/internal/packet-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

// Transposition between rows (one register for each number) and columns (one configuration each).
// Four numbers are transposed at a time, by shuffles within blocks of 128 bits and then of whole
// blocks.

template <class Real>
using PacketRegister = hn::Vec<typename Packet<Real>::Tag>;

#if HWY_TARGET != HWY_SCALAR

/// Transposes the 4 x 4 floats in each block of 128 bits of four registers. The function is its own
/// inverse.
template <class V>
HWY_INLINE void transpose_blocks(V (&v)[4]) {
  const hn::DFromV<V> d;
  const hn::Repartition<double, decltype(d)> pairs;
  const auto a = hn::BitCast(pairs, hn::InterleaveLower(d, v[0], v[1]));
  const auto b = hn::BitCast(pairs, hn::InterleaveLower(d, v[2], v[3]));
  const auto e = hn::BitCast(pairs, hn::InterleaveUpper(d, v[0], v[1]));
  const auto f = hn::BitCast(pairs, hn::InterleaveUpper(d, v[2], v[3]));
  v[0] = hn::BitCast(d, hn::InterleaveLower(pairs, a, b));
  v[1] = hn::BitCast(d, hn::InterleaveUpper(pairs, a, b));
  v[2] = hn::BitCast(d, hn::InterleaveLower(pairs, e, f));
  v[3] = hn::BitCast(d, hn::InterleaveUpper(pairs, e, f));
}

/// Exchanges blocks in each pair: a becomes the first blocks of a and b, and b the second blocks.
template <class V>
HWY_INLINE void pair_blocks(V& a, V& b) {
  const V first = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(b), a);
  b = hn::OddEvenBlocks(b, hn::SwapAdjacentBlocks(a));
  a = first;
}

/// Load and store blocks of `block_size` numbers, `apart` numbers from each other, as one register.
template <class D, class Real>
HWY_INLINE hn::Vec<D> gather_blocks(D d, int block_size, const Real* from, Eigen::Index apart) {
  if constexpr (hn::MaxLanes(D()) * sizeof(Real) <= 16) {
    return hn::LoadU(d, from);
  } else {
    const int lanes = static_cast<int>(hn::MaxLanes(d));
    const hn::Half<D> half;
    if (lanes == block_size) return hn::LoadU(d, from);
    const auto low = gather_blocks(half, block_size, from, apart);
    const auto high =
        gather_blocks(half, block_size, from + apart * (lanes / block_size / 2), apart);
    return hn::Combine(d, high, low);
  }
}
template <class D, class Real>
HWY_INLINE void scatter_blocks(D d, hn::Vec<D> v, int block_size, Real* to, Eigen::Index apart) {
  if constexpr (hn::MaxLanes(D()) * sizeof(Real) <= 16) {
    hn::StoreU(v, d, to);
  } else {
    const int lanes = static_cast<int>(hn::MaxLanes(d));
    const hn::Half<D> half;
    if (lanes == block_size) return hn::StoreU(v, d, to);
    scatter_blocks(half, hn::LowerHalf(half, v), block_size, to, apart);
    scatter_blocks(half, hn::UpperHalf(half, v), block_size, to + apart * (lanes / block_size / 2),
                   apart);
  }
}

/// Loads four numbers of each configuration, `stride` numbers apart, as four rows.
template <class Real>
HWY_INLINE void load_four(const Real* from, Eigen::Index stride, Real* rows) {
  const typename Packet<Real>::Tag d;
  constexpr int width = Packet<Real>::width;
  PacketRegister<Real> v[4];
  if constexpr (sizeof(Real) == 4) {
    for (int c = 0; c < 4; ++c) v[c] = gather_blocks(d, 4, from + c * stride, 4 * stride);
    transpose_blocks(v);
  } else {
    if constexpr (width == 2) {
      for (int c = 0; c < 4; ++c) v[c] = hn::LoadU(d, from + (c % 2) * stride + c / 2 * 2);
    } else {
      // Configurations 0 and 4, 2 and 6 beside them; 1 and 5, 3 and 7.
      for (int c = 0; c < 2; ++c) {
        v[c] = gather_blocks(d, 4, from + c * stride, 4 * stride);
        v[c + 2] = gather_blocks(d, 4, from + (c + 2) * stride, 4 * stride);
        pair_blocks(v[c], v[c + 2]);
      }
    }
    const PacketRegister<Real> a = v[0], b = v[1], e = v[2], f = v[3];
    v[0] = hn::InterleaveLower(d, a, b);
    v[1] = hn::InterleaveUpper(d, a, b);
    v[2] = hn::InterleaveLower(d, e, f);
    v[3] = hn::InterleaveUpper(d, e, f);
  }
  for (int i = 0; i < 4; ++i) hn::Store(v[i], d, rows + i * width);
}

#if HWY_MAX_BYTES >= 32
/// Transposes four rows into blocks of four numbers: register c has the blocks of configurations c,
/// c + 4 and so on.
template <class Real>
HWY_INLINE void transpose_rows(PacketRegister<Real> (&v)[4]) {
  const typename Packet<Real>::Tag d;
  if constexpr (sizeof(Real) == 4) {
    transpose_blocks(v);
  } else {
    const PacketRegister<Real> a = v[0], b = v[1], e = v[2], f = v[3];
    v[0] = hn::InterleaveLower(d, a, b);
    v[1] = hn::InterleaveUpper(d, a, b);
    v[2] = hn::InterleaveLower(d, e, f);
    v[3] = hn::InterleaveUpper(d, e, f);
    pair_blocks(v[0], v[2]);
    pair_blocks(v[1], v[3]);
  }
}
#endif

/// Stores four rows, the inverse of load_four().
template <class Real>
HWY_INLINE void store_four(Packet<Real> a, Packet<Real> b, Packet<Real> e, Packet<Real> f, Real* to,
                           Eigen::Index stride) {
  const typename Packet<Real>::Tag d;
  PacketRegister<Real> v[4] = {a.v, b.v, e.v, f.v};
#if HWY_MAX_BYTES >= 32
  transpose_rows<Real>(v);
  for (int c = 0; c < 4; ++c) scatter_blocks(d, v[c], 4, to + c * stride, 4 * stride);
#else
  if constexpr (sizeof(Real) == 4) {
    transpose_blocks(v);
    for (int c = 0; c < 4; ++c) hn::StoreU(v[c], d, to + c * stride);
  } else {
    for (int i = 0; i < 2; ++i) {
      hn::StoreU(hn::InterleaveLower(d, v[2 * i], v[2 * i + 1]), d, to + 2 * i);
      hn::StoreU(hn::InterleaveUpper(d, v[2 * i], v[2 * i + 1]), d, to + stride + 2 * i);
    }
  }
#endif
}

#else

template <class Real>
HWY_INLINE void store_four(Packet<Real> a, Packet<Real> b, Packet<Real> e, Packet<Real> f, Real* to,
                           Eigen::Index) {
  a.store(to);
  b.store(to + 1);
  e.store(to + 2);
  f.store(to + 3);
}

#endif  // HWY_TARGET != HWY_SCALAR

/// Loads `count` numbers of each configuration as rows. The last four overlap the previous ones if
/// the count is not a multiple of four.
template <class Real>
HWY_INLINE void load_rows(const Real* from, int count, Real* rows) {
  constexpr int width = Packet<Real>::width;
#if HWY_TARGET != HWY_SCALAR
  for (int i = 0; count >= 4 && i < count; i += 4) {
    const int first = std::min(i, count - 4);
    load_four(from + first, count, rows + first * width);
  }
  if (count >= 4) return;
#endif
  for (int i = 0; i < count; ++i) {
    for (int c = 0; c < width; ++c) rows[i * width + c] = from[c * count + i];
  }
}

/// Stores `count` rows; the numbers of the configurations are `stride` apart.
template <class Real>
HWY_INLINE void store_rows(const Real* rows, int count, Real* to, Eigen::Index stride) {
  constexpr int width = Packet<Real>::width;
#if HWY_TARGET != HWY_SCALAR
  for (int i = 0; count >= 4 && i < count; i += 4) {
    const int first = std::min(i, count - 4);
    const Real* row = rows + first * width;
    store_four(Packet<Real>::load(row), Packet<Real>::load(row + width),
               Packet<Real>::load(row + 2 * width), Packet<Real>::load(row + 3 * width), to + first,
               stride);
  }
  if (count >= 4) return;
#endif
  for (int i = 0; i < count; ++i) {
    for (int c = 0; c < width; ++c) to[c * stride + i] = rows[i * width + c];
  }
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
