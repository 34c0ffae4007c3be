#include "sampling_argument.h"

namespace beeline::command {
namespace {

constexpr double most = 10'000'000;  // samples or steps

}  // namespace

Option rate_option(Target target, const std::string& of, std::vector<std::string> methods) {
  return {"--rate HZ",
          "Samples per second" + of,
          target,
          {.range = sample_rates, .methods = std::move(methods)}};
}

Option duration_option(std::optional<double>* target, const std::string& of,
                       const std::string& excludes, std::vector<std::string> methods) {
  return {"--duration SECONDS",
          "Duration of the motion" + of +
              "; one that is shorter than the limits allow is refused with the shortest. Default: "
              "the shortest.",
          target,
          {.range = above_zero, .methods = std::move(methods), .excludes = excludes}};
}

Option joint_blend_option(Target target, const std::string& otherwise,
                          std::vector<std::string> methods) {
  return {"--joint-blend D",
          "Largest distance of the joints from a position, the norm of the difference, at which "
          "the motion leaves the straight joint motion to pass it without a stop, rad and m added; "
          "0: the arm stops there. Default: " +
              otherwise,
          target,
          {.range = zero_or_more, .methods = std::move(methods)}};
}

Option max_samples_option(int* target, const std::string& when, std::vector<std::string> methods) {
  return {"--max-samples N",
          "Give up if " + when,
          target,
          {.range = {2, most}, .methods = std::move(methods)}};
}

std::vector<Option> step_options(double* time_step, int* max_steps,
                                 const std::vector<std::string>& methods) {
  return {{"--time-step SECONDS",
           "Duration of one step.",
           time_step,
           {.range = above_zero, .methods = methods}},
          {"--max-steps N",
           "Give up after this many steps.",
           max_steps,
           {.range = {1, most}, .methods = methods}}};
}

}  // namespace beeline::command
