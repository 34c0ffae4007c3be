#pragma once

#include <vector>

#include <beeline/model/arm.h>

#include "interruption.h"
#include "value.h"

namespace beeline::python {

/// What arguments of configurations are, in signatures' documentation.
inline constexpr const char* configurations_doc =
    "Configuration (n,), or many (..., n), rad and m, within limits or not.";

/// Configurations (n,) or (..., n) of an arm, float64, or float32 where accepted. Throws Error for
/// another last dimension, and for one configuration that is not finite.
class Configurations {
 public:
  Configurations(const Arm& arm, nb::handle q, const char* name = "q", bool float32 = false);

  /// As given.
  nb::handle argument() const { return argument_; }
  const char* name() const { return array_.name(); }

  bool one() const { return array_.dimensions() == 1; }
  Index count() const { return count_; }
  Real real() const { return array_.real(); }
  template <class T = double>
  const T* data() const {
    return array_.data<T>();
  }
  ConfigurationRef row(Index i) const {
    return Eigen::Map<const Configuration>(data() + i * dof_, dof_);
  }
  /// The shape of a result: all dimensions but the last, then `inner`.
  std::vector<Index> shape(std::initializer_list<Index> inner) const;

 private:
  InputArray array_;
  nb::handle argument_;
  Index dof_, count_;
};

/// One vector of `size` numbers for each configuration, or the same for all.
class RowArgument {
 public:
  RowArgument(nb::handle value, const char* name, Index size, const Configurations& q);
  nb::handle argument() const { return argument_; }
  const char* name() const { return array_.name(); }
  Eigen::Map<const Eigen::VectorXd> row(Index i) const {
    return {array_.data() + (single_ ? 0 : i * size_), size_};
  }

 private:
  InputArray array_;
  nb::handle argument_;
  Index size_;
  bool single_;
};

int threads_from(nb::handle value);
/// Throws Error for a negative number of threads.
void check_threads(int threads);

/// Calls evaluate(i, results of row i) for each configuration: without Python's lock, and until
/// Ctrl-C, where there are many. Returns the results or the caller's `out`. They are written with
/// their last two dimensions column by column, as Eigen's matrices are. `others` are what
/// evaluate() reads besides q.
template <class Evaluate, class... Rows>
nb::object for_rows(const Configurations& q, std::initializer_list<Index> inner, nb::handle out,
                    Evaluate evaluate, const Rows&... others) {
  check_apart(out, q.argument(), q.name());
  (check_apart(out, others.argument(), others.name()), ...);
  OutputArray results(out, "out", q.shape(inner), Real::float64, inner.size() > 1);
  Index size = 1;
  for (Index n : inner) size *= n;
  if (q.one()) {
    evaluate(Index(0), results.data());
    return results.finish();
  }
  Budget budget;
  unlocked(budget, [&] {
    for (Index i = 0; i < q.count() && !(i % 256 == 255 && budget.cancelled()); ++i) {
      evaluate(i, results.data() + i * size);
    }
    return true;
  });
  return results.finish();
}

}  // namespace beeline::python
