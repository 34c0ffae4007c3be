// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_BATCH_DRAIN_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_BATCH_DRAIN_INL_H
#undef BEELINE_BATCH_DRAIN_INL_H
#else
#define BEELINE_BATCH_DRAIN_INL_H
#endif

#include <algorithm>
#include <cstdint>

#include <beeline/batch/plan.h>

#include <hwy/cache_control.h>

#include <beeline/batch/wide-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

/// The way of one kind of results to where they go: what is too large for the nearest cache is put
/// together in a buffer there, and leaves it by whole lines of 64 bytes.
template <class Real>
class Drain {
 public:
  /// `size` numbers for each configuration; the buffer has room for batch_buffer(size).
  HWY_INLINE Drain(Real* to, Eigen::Index size, Real* buffer, BatchWrite how)
      : to_(to), buffer_(buffer), fresh_(size * Wide<Real>::width), how_(how) {
    if (how == BatchWrite::at_once) return;
    const auto over = static_cast<Eigen::Index>(reinterpret_cast<std::uintptr_t>(to) % 64);
    head_ = (64 - over) % 64 / static_cast<Eigen::Index>(sizeof(Real));
  }

  /// Where the next register's configurations go.
  HWY_INLINE Real* next() const { return how_ == BatchWrite::at_once ? to_ : buffer_ + held_; }

  /// They are there.
  HWY_INLINE void push() {
    if (how_ == BatchWrite::at_once) {
      to_ += fresh_;
      return;
    }
    const typename Wide<Real>::Tag d;
    const Real* from = buffer_;
    Eigen::Index left = held_ + fresh_;
    if (HWY_UNLIKELY(head_ != 0)) {  // once: each line after it is a whole one
      const Eigen::Index some = std::min(head_, left);
      to_ = std::copy(from, from + some, to_);
      from += some;
      left -= some;
      head_ -= some;
    }
    if (how_ == BatchWrite::past_caches) {
      for (; left >= line; left -= line, from += line, to_ += line) {
        for (Eigen::Index i = 0; i < line; i += Wide<Real>::width) {
          hn::Stream(hn::LoadU(d, from + i), d, to_ + i);
        }
      }
    } else {
      for (; left >= line; left -= line, from += line, to_ += line) {
        for (Eigen::Index i = 0; i < line; i += Wide<Real>::width) {
          hn::StoreU(hn::LoadU(d, from + i), d, to_ + i);
        }
      }
    }
    held_ = left;
    if (left != 0) std::copy(from, from + left, buffer_);
  }

  /// No more will come.
  HWY_INLINE void finish() {
    std::copy(buffer_, buffer_ + held_, to_);
    if (how_ == BatchWrite::past_caches) hwy::FlushStream();
  }

 private:
  static constexpr Eigen::Index line = 64 / sizeof(Real);
  Real *to_, *buffer_;
  Eigen::Index fresh_, held_ = 0, head_ = 0;
  BatchWrite how_;
};

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
