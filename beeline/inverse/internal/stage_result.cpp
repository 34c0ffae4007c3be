#include <beeline/inverse/internal/stage_result.h>
#include <beeline/inverse/numerical/representative.h>

namespace beeline::internal {

void UnconstrainedResult::consider(const Request& request, const Configuration& q) {
  const Configuration nearest =
      nearest_representative(request.arm, q, request.seed, request.bounds);
  const double outside = internal::excess(request.bounds, nearest);
  if (least_outside && !(outside < excess)) return;
  least_outside = nearest;
  excess = outside;
}

}  // namespace beeline::internal
