#include "rows.h"

namespace beeline::python {

Configurations::Configurations(const Arm& arm, nb::handle q, const char* name, bool float32)
    : array_(q, name, float32), argument_(q), dof_(arm.dof()), count_(0) {
  const auto shape = array_.shape();
  if (shape.empty() || shape.back() != dof_) {
    const std::string n = std::to_string(dof_);
    throw Error(std::string(name) + " has the shape " + shape_text(shape) + "; arm " + arm.name() +
                " needs (" + n + ",) or (N, " + n + ")");
  }
  count_ = array_.rows(1);
  if (!one()) return;
  if (real() == Real::float64) {
    check_configuration(arm, row(0));
  } else {
    const Eigen::Map<const Eigen::VectorXf> values(array_.data<float>(), dof_);
    check_configuration(arm, Configuration(values.cast<double>()));
  }
}

std::vector<Index> Configurations::shape(std::initializer_list<Index> inner) const {
  const auto all = array_.shape();
  std::vector<Index> shape(all.begin(), all.end() - 1);
  shape.insert(shape.end(), inner);
  return shape;
}

RowArgument::RowArgument(nb::handle value, const char* name, Index size, const Configurations& q)
    : array_(value, name), argument_(value), size_(size), single_(array_.dimensions() == 1) {
  const auto shape = array_.shape();
  const std::vector<Index> each = q.shape({size});
  const bool fits =
      !shape.empty() && shape.back() == size && (single_ || std::ranges::equal(shape, each));
  if (fits) return;
  throw Error(std::string(name) + " has the shape " + shape_text(shape) + "; expected (" +
              std::to_string(size) + ",)" + (q.one() ? "" : " or " + shape_text(each)));
}

int threads_from(nb::handle value) {
  const int threads = Value<int>::from(value, "threads");
  check_threads(threads);
  return threads;
}

void check_threads(int threads) {
  if (threads < 0) throw Error("threads is " + std::to_string(threads) + "; expected 0 or more");
}

}  // namespace beeline::python
