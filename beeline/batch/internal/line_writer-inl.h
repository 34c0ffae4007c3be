// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_BATCH_INTERNAL_LINE_WRITER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_BATCH_INTERNAL_LINE_WRITER_INL_H
#undef BEELINE_BATCH_INTERNAL_LINE_WRITER_INL_H
#else
#define BEELINE_BATCH_INTERNAL_LINE_WRITER_INL_H
#endif

#include <algorithm>
#include <cstdint>
#include <utility>

#include <beeline/batch/internal/kernel.h>

#include <hwy/cache_control.h>

#include <beeline/batch/internal/packet-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

using internal::batch_width;

/// Writes one kind of results to memory. Results that exceed the caches are collected in a buffer
/// and written from it past the caches by whole cache lines of 64 bytes, a few at a time while the
/// next results are computed, so that both overlap. Without `buffered` it only advances a pointer.
template <class Real, bool buffered>
class LineWriter {
 public:
  /// For `size` numbers of each configuration. `buffers` holds two buffers, one after the other, of
  /// size * Packet::width + batch_width numbers each. write_some() is called twice for each link.
  HWY_INLINE LineWriter(Real* to, Eigen::Index size, Real* buffers, Eigen::Index links)
      : to_(to), buffer_(buffers), packet_size_(size * Packet<Real>::width) {
    if (!buffered) return;
    other_ = buffers + packet_size_ + batch_width;
    lines_at_once_ = packet_size_ / line / (2 * links) + 1;
    const auto misaligned = static_cast<Eigen::Index>(reinterpret_cast<std::uintptr_t>(to) % 64);
    head_ = (64 - misaligned) % 64 / static_cast<Eigen::Index>(sizeof(Real));
  }

  /// Returns the address for the results of the next packet of configurations.
  HWY_INLINE Real* next() const { return !buffered ? to_ : buffer_ + held_; }

  /// Adds the results stored at next().
  HWY_INLINE void push() {
    if (!buffered) {
      to_ += packet_size_;
      return;
    }
    write_lines(lines_);
    from_ = buffer_;
    Eigen::Index left = held_ + packet_size_;
    if (HWY_UNLIKELY(head_ != 0)) {  // up to the first line boundary
      const Eigen::Index count = std::min(head_, left);
      to_ = std::copy(from_, from_ + count, to_);
      from_ += count;
      left -= count;
      head_ -= count;
    }
    lines_ = left / line;
    held_ = left % line;
    if (held_ != 0) std::copy_n(from_ + lines_ * line, held_, other_);
    std::swap(buffer_, other_);
  }

  /// Writes a few of the complete lines.
  HWY_INLINE void write_some() {
    if (buffered && lines_ != 0) write_lines(std::min(lines_at_once_, lines_));
  }

  /// Writes the remaining results.
  HWY_INLINE void finish() {
    if (!buffered) return;
    write_lines(lines_);
    std::copy_n(buffer_, held_, to_);
    hwy::FlushStream();
  }

 private:
  static constexpr Eigen::Index line = 64 / sizeof(Real);

  HWY_INLINE void write_lines(Eigen::Index lines) {
    const typename Packet<Real>::Tag d;
    lines_ -= lines;
    for (; lines > 0; --lines, from_ += line, to_ += line) {
      for (Eigen::Index i = 0; i < line; i += Packet<Real>::width) {
        hn::Stream(hn::LoadU(d, from_ + i), d, to_ + i);
      }
    }
  }

  Real *to_, *buffer_, *other_ = nullptr;
  const Real* from_ = nullptr;
  Eigen::Index packet_size_, held_ = 0, head_ = 0, lines_ = 0, lines_at_once_ = 0;
};

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
