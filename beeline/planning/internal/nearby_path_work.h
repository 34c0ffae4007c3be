#pragma once

#include <cstdint>

namespace beeline::internal {

/// Max work of one nearby_path(), in units of Budget: it bounds the time of a negative answer.
inline constexpr std::int64_t max_nearby_path_work = 100'000;

}  // namespace beeline::internal
