#include <algorithm>
#include <cmath>

#include <beeline/control/internal/recording_limits.h>
#include <beeline/control/player.h>
#include <beeline/error.h>
#include <beeline/timing/point_to_point.h>
#include <beeline/trajectory/internal/interval_polynomial.h>

namespace beeline {
namespace {

void check_player_speed(double speed) {
  if (speed >= 0 && speed <= 1) return;
  throw Error("the speed of a player must be from 0 to 1, not " + number(speed));
}

void check_player(const PlayerOptions& options) {
  for (const double positive : {options.time_step, options.ramp}) {
    if (positive > 0 && std::isfinite(positive)) continue;
    throw Error("the time step and the ramp of a player must be above zero, not " +
                number(positive) + " s");
  }
  check_player_speed(options.speed);
}

}  // namespace

namespace internal {

/// The state of a Player.
class Playback {
 public:
  Playback(const Arm& arm, const Trajectory& recording, const ConfigurationRef& start,
           const PlayerOptions& options);

  void set_speed(double speed);
  const Command& step();
  void measured(const ConfigurationRef& q);

  bool leading_in() const { return lead_time_ < lead_.duration; }
  bool done() const { return !leading_in() && time_ >= recording_.times.back(); }
  double speed() const { return speed_; }
  double recording_time() const { return time_; }
  TrackingError tracking() const;

 private:
  double max_speed_change() const;
  void sample_at(double time);

  Arm arm_;
  PlayerOptions options_;
  Trajectory recording_;
  PointToPoint lead_;  ///< from the start to the recording's first sample
  double lead_time_ = 0, time_ = 0;
  double speed_ = 0, target_speed_ = 1;
  std::size_t segment_ = 0;  ///< index of the sample before `time_`
  Command command_;
  Configuration velocity_, acceleration_;  ///< derivatives with respect to the recording's time
  Configuration largest_, squares_;        ///< largest tracking errors, and sums of their squares
  long steps_ = 0;
};

Playback::Playback(const Arm& arm, const Trajectory& recording, const ConfigurationRef& start,
                   const PlayerOptions& options)
    : arm_(arm),
      options_(options),
      recording_(matched_to(arm, recording)),
      target_speed_(options.speed),
      velocity_(Configuration::Zero(arm.dof())),
      acceleration_(Configuration::Zero(arm.dof())),
      largest_(Configuration::Zero(arm.dof())),
      squares_(Configuration::Zero(arm.dof())) {
  check_player(options);
  if (recording_.size() == 0) throw Error("the recording has no samples");
  const Reason violation = first_violation(arm, recording_);
  if (violation) throw Error(sentence(violation));
  lead_ = point_to_point(arm, start, recording_.positions.front(),
                         {.synchronise = Synchronise::straight});
  time_ = recording_.times.front();
  command_ = {start, Configuration::Zero(arm.dof())};
}

void Playback::set_speed(double speed) {
  check_player_speed(speed);
  target_speed_ = speed;
}

/// Sets the position and its derivatives at a time of the recording.
void Playback::sample_at(double time) {
  const auto& t = recording_.times;
  while (segment_ + 2 < t.size() && t[segment_ + 1] <= time) ++segment_;
  if (t.size() == 1) {
    command_.q = recording_.positions[0];
    return;
  }
  const double h = t[segment_ + 1] - t[segment_];
  const double u = std::clamp((time - t[segment_]) / h, 0.0, 1.0);
  for (Eigen::Index k = 0; k < command_.q.size(); ++k) {
    const Polynomial p = interval_polynomial(recording_, segment_, k);
    command_.q[k] = p(u);
    velocity_[k] = time_derivative(p, 1, h)(u);
    acceleration_[k] = time_derivative(p, 2, h)(u);
  }
}

/// Returns the largest change of the speed s in one step. The joint acceleration a s² + v ṡ must be
/// within the limits.
double Playback::max_speed_change() const {
  // Fraction of the ramp's rate; a recording at its limits must be able to pause.
  constexpr double min_rate = 0.05;
  double rate = 1 / options_.ramp;
  for (Eigen::Index k = 0; k < velocity_.size(); ++k) {
    const double limit = arm_.limits(k).acceleration;
    const double available = limit - std::abs(acceleration_[k]) * speed_ * speed_;
    if (std::abs(velocity_[k]) * rate > available) rate = available / std::abs(velocity_[k]);
  }
  return std::max(rate, min_rate / options_.ramp) * options_.time_step;
}

const Command& Playback::step() {
  const double dt = options_.time_step;
  const double before = speed_, change = max_speed_change();
  speed_ += std::clamp(target_speed_ - speed_, -change, change);
  if (leading_in()) {
    lead_time_ += dt * (before + speed_) / 2;
    at(lead_, std::min(lead_time_, lead_.duration), command_.q, velocity_, acceleration_);
    command_.velocity = speed_ * velocity_;
    if (!leading_in()) speed_ = 0;  // at rest at the first sample
    return command_;
  }
  time_ = std::min(time_ + dt * (before + speed_) / 2, recording_.times.back());
  sample_at(time_);
  const bool ended = time_ >= recording_.times.back();
  command_.velocity = (ended ? 0 : speed_) * velocity_;
  return command_;
}

void Playback::measured(const ConfigurationRef& q) {
  if (q.size() != command_.q.size()) {
    throw Error("the measured configuration has " + std::to_string(q.size()) +
                " values; the arm has " + std::to_string(command_.q.size()) + " coordinates");
  }
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const double error = std::abs(q[k] - command_.q[k]);
    largest_[k] = std::max(largest_[k], error);
    squares_[k] += error * error;
  }
  ++steps_;
}

TrackingError Playback::tracking() const {
  const double count = std::max(1.0, static_cast<double>(steps_));
  return {largest_, (squares_ / count).cwiseSqrt(), steps_};
}

}  // namespace internal

Player::Player(const Arm& arm, const Trajectory& recording, const ConfigurationRef& start,
               const PlayerOptions& options)
    : playback_(std::make_unique<internal::Playback>(arm, recording, start, options)) {}

Player::Player(const Player& other)
    : playback_(std::make_unique<internal::Playback>(*other.playback_)) {}

Player::Player(Player&& other) noexcept = default;

Player& Player::operator=(Player other) noexcept {
  playback_.swap(other.playback_);
  return *this;
}

Player::~Player() = default;

void Player::set_speed(double speed) { playback_->set_speed(speed); }
const Command& Player::step() { return playback_->step(); }
void Player::measured(const ConfigurationRef& q) { playback_->measured(q); }
bool Player::leading_in() const { return playback_->leading_in(); }
bool Player::done() const { return playback_->done(); }
double Player::speed() const { return playback_->speed(); }
double Player::recording_time() const { return playback_->recording_time(); }
TrackingError Player::tracking() const { return playback_->tracking(); }

}  // namespace beeline
