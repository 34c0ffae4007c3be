// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_BATCH_DRAIN_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_BATCH_DRAIN_INL_H
#undef BEELINE_BATCH_DRAIN_INL_H
#else
#define BEELINE_BATCH_DRAIN_INL_H
#endif

#include <algorithm>
#include <cstdint>
#include <utility>

#include <beeline/batch/plan.h>

#include <hwy/cache_control.h>

#include <beeline/batch/wide-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

/// The way of one kind of results to where they go: what is too large for the nearest cache is put
/// together in a buffer there, and leaves it by whole lines of 64 bytes, little by little while the
/// next ones are computed: the machine then does both at a time.
template <class Real, bool buffered>
class Drain {
 public:
  /// `size` numbers for each configuration; two buffers, one behind the other, of as many as a
  /// register has, and batch_width more. Then flow() is called twice for each link.
  HWY_INLINE Drain(Real* to, Eigen::Index size, Real* buffers, Eigen::Index links, BatchWrite how)
      : to_(to), buffer_(buffers), fresh_(size * Wide<Real>::width), how_(how) {
    if (!buffered) return;
    other_ = buffers + fresh_ + batch_width;
    share_ = fresh_ / line / (2 * links) + 1;
    const auto over = static_cast<Eigen::Index>(reinterpret_cast<std::uintptr_t>(to) % 64);
    head_ = (64 - over) % 64 / static_cast<Eigen::Index>(sizeof(Real));
  }

  /// Where the next register's configurations go.
  HWY_INLINE Real* next() const { return !buffered ? to_ : buffer_ + held_; }

  /// They are there.
  HWY_INLINE void push() {
    if (!buffered) {
      to_ += fresh_;
      return;
    }
    flow(lines_);
    from_ = buffer_;
    Eigen::Index left = held_ + fresh_;
    if (HWY_UNLIKELY(head_ != 0)) {  // once: each line after it is a whole one
      const Eigen::Index some = std::min(head_, left);
      to_ = std::copy(from_, from_ + some, to_);
      from_ += some;
      left -= some;
      head_ -= some;
    }
    lines_ = left / line;
    held_ = left % line;
    if (held_ != 0) std::copy_n(from_ + lines_ * line, held_, other_);
    std::swap(buffer_, other_);
  }

  /// A few lines leave.
  HWY_INLINE void flow() {
    if (buffered && lines_ != 0) flow(std::min(share_, lines_));
  }

  /// No more will come.
  HWY_INLINE void finish() {
    if (!buffered) return;
    flow(lines_);
    std::copy_n(buffer_, held_, to_);
    if (how_ == BatchWrite::past_caches) hwy::FlushStream();
  }

 private:
  static constexpr Eigen::Index line = 64 / sizeof(Real);

  HWY_INLINE void flow(Eigen::Index lines) {
    const typename Wide<Real>::Tag d;
    lines_ -= lines;
    for (; lines > 0; --lines, from_ += line, to_ += line) {
      for (Eigen::Index i = 0; i < line; i += Wide<Real>::width) {
        const auto some = hn::LoadU(d, from_ + i);
        if (how_ == BatchWrite::past_caches) {
          hn::Stream(some, d, to_ + i);
        } else {
          hn::StoreU(some, d, to_ + i);
        }
      }
    }
  }

  Real *to_, *buffer_, *other_ = nullptr;
  const Real* from_ = nullptr;
  Eigen::Index fresh_, held_ = 0, head_ = 0, lines_ = 0, share_ = 0;
  BatchWrite how_;
};

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
