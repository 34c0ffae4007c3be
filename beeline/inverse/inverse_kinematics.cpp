#include <algorithm>
#include <ostream>
#include <utility>

#include <beeline/error.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/internal/enum_names.h>
#include <beeline/inverse/internal/solve.h>
#include <beeline/inverse/internal/solve_unblocked.h>
#include <beeline/inverse/inverse_kinematics.h>

namespace beeline {
namespace {

using internal::EnumNames;

constexpr EnumNames<InverseMethod> methods("method");
constexpr EnumNames<Redundancy> redundancies("redundancy");
constexpr EnumNames<InverseStatus> statuses("status");

}  // namespace

InverseMethod inverse_method_named(std::string_view name) { return methods.named(name); }
std::string name(InverseMethod method) { return methods.of(method); }

Redundancy redundancy_named(std::string_view name) { return redundancies.named(name); }
std::string name(Redundancy redundancy) { return redundancies.of(redundancy); }

std::string name(InverseStatus status) { return statuses.of(status); }

std::vector<std::string> inverse_status_names() { return statuses.all(); }

std::ostream& operator<<(std::ostream& out, const InverseResult& result) {
  out << name(result.status);
  if (result.unexplained) {
    InverseResult explained = result;
    explain(explained);
    return out << ": " << explained.reason;
  }
  if (result.solutions.empty()) return out << ": " << result.reason;
  const std::size_t count = result.solutions.size();
  out << ", " << count << (count == 1 ? " solution" : " solutions")
      << (result.self_motion_dimension > 0 ? " of infinitely many, " : ", ");
  if (!result.blocked.empty()) out << result.blocked.size() << " blocked, ";
  out << result.method;
  constexpr std::size_t most = 20;
  for (std::size_t i = 0; i < std::min(count, most); ++i) {
    out << '\n';
    for (const double value : result.solutions[i]) {
      out << "  " << number(std::abs(value) < 1e-12 ? 0 : value);
    }
  }
  if (count > most) out << "\n  and " << count - most << " more";
  return out;
}

bool has_closed_form(const Arm& arm, const InverseOptions& options) {
  return internal::SolverState(arm, options).family != nullptr;
}

std::string inverse_method(const Arm& arm, const InverseOptions& options) {
  return internal::method_name(internal::SolverState(arm, options));
}

InverseResult inverse_kinematics(const Arm& arm, const Pose& world_T_tool,
                                 const InverseOptions& options) {
  internal::SolverState state(arm, options);
  internal::BudgetMeter budget(options.budget);
  if (state.plane()) state.plane()->check(world_T_tool);
  return internal::solve_unblocked(
      state, world_T_tool, options.seed ? *options.seed : state.defaults->middle,
      // A solution that explain() finds would not be asked about.
      options.blocked_by ? internal::FailureDetail::nearest : internal::FailureDetail::status,
      budget);
}

void explain(InverseResult& result, const Budget& budget) {
  if (!result.unexplained) return;
  const InverseRequest asked = *std::exchange(result.unexplained, std::nullopt);
  internal::SolverState state(asked.arm, asked.options);
  internal::BudgetMeter meter(budget);
  InverseResult all = internal::solve_thoroughly(state, asked.world_T_tool, *asked.options.seed,
                                                 internal::FailureDetail::nearest, meter);
  if (all) {
    result = std::move(all);
    return;
  }
  result.nearest = std::move(all.nearest);
  result.residual = all.residual;
  const bool denied = result.status == InverseStatus::unreachable ||
                      result.status == InverseStatus::orientation_unreachable;
  if (denied && all.status == InverseStatus::outside_limits) result.status = all.status;
  if (all.status == result.status) {
    result.reason = std::move(all.reason);
  } else if (result.status == InverseStatus::orientation_unreachable && result.nearest) {
    result.reason.set(ReasonField::angle, result.nearest->error.orientation);
  }
}

int inverse_kinematics(const Arm& arm, const Pose& world_T_tool, const ConfigurationRef& seed,
                       Eigen::Ref<Eigen::MatrixXd> solutions, const InverseOptions& options) {
  internal::SolverState state(arm, options);
  state.set_near_seed();
  internal::BudgetMeter budget(options.budget);
  if (solutions.rows() != arm.dof() || solutions.cols() < 1) {
    throw Error("solutions need " + std::to_string(arm.dof()) + " rows and at least one column");
  }
  if (state.plane()) state.plane()->check(world_T_tool);
  if (!options.blocked_by) {
    return internal::solve_into(state, world_T_tool, seed, budget, solutions);
  }
  const InverseResult result =
      internal::solve_unblocked(state, world_T_tool, seed, internal::FailureDetail::none, budget);
  const Eigen::Index found = static_cast<Eigen::Index>(result.solutions.size());
  const Eigen::Index count = std::min(solutions.cols(), found);
  for (Eigen::Index i = 0; i < count; ++i) solutions.col(i) = result.solutions[i];
  return static_cast<int>(count);
}

}  // namespace beeline
