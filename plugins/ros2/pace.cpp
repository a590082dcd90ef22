#include "pace.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

namespace ros2 {
namespace {

using namespace std::chrono_literals;
using Kind = Field::Kind;

constexpr auto kBetween = 100ms;  // at most 10 messages in a second
constexpr double kBand = 0.05;    // and only what differs as much

constexpr const char* kScaling = "control_msgs/msg/SpeedScalingFactor";
constexpr const char* kSlider = "ur_msgs/srv/SetSpeedSliderFraction";
constexpr const char* kLimit = "nav2_msgs/msg/SpeedLimit";

const char* usual_type(Target::Way way) {
  return way == Target::Way::Topic ? kScaling : way == Target::Way::Service ? kSlider : "";
}

}  // namespace

std::optional<double> Pace::at(double factor) const {
  Expression::Memory memory = value.memory();
  const auto number = value.value({{}, {}, factor}, memory);
  if (!number || target.field == nullptr || target.field->kind != Kind::Int) return number;
  // A whole number for a robot that moves is not the one for a robot that stands.
  if (factor == 0) return std::round(*number);
  const double rounded = std::round(*number), standing = at(0).value_or(0);
  if (rounded != standing || *number == standing) return rounded;
  return standing + std::copysign(1, *number - standing);
}

Result<Pace> read_pace(const FixedTexts& texts, const lockstep_port& pace,
                       const lockstep_port& type, const lockstep_port& value,
                       const lockstep_port*& port) {
  const std::string text = texts[pace];
  if (text.empty()) return Pace{};
  port = &pace;
  const auto target = target_named(text);
  if (!target) {
    return Problem{"'" + text + "' is not a way to slow a robot",
                   "write topic:NAME, service:NAME or parameter:NODE/NAME"};
  }
  Pace read{true, *target};
  port = &type;
  const std::string name = texts[type];
  if (auto problem = find_type(read.target, name.empty() ? usual_type(target->way) : name,
                               {Kind::Double, Kind::Int}, "number")) {
    if (problem->hint.empty()) problem->hint = std::string(usual_type(target->way)) + " has one";
    return *problem;
  }
  port = &value;
  const std::string given = texts[value];
  auto expression = read_factor(given.empty() ? "factor" : given);
  if (!expression) return expression.problem();
  read.value = std::move(*expression);
  const auto full = read.at(1), half = read.at(0.5);
  if (full && half && *full != *half) return read;
  return Problem{"the value '" + given + "' does not depend on factor",
                 "write an expression with factor, which is 1 at full speed: 100 * factor"};
}

std::optional<Problem> why_no_hold(const Pace& pace) {
  if (!pace.is_given) {
    return Problem{"hold=\"pace\" needs the attribute pace",
                   "write pace=\"topic:NAME\", or another hold"};
  }
  const Target& target = pace.target;
  const char* const hint = "write hold=\"cancel\" or another hold";
  if (target.type() == kLimit) {
    return Problem{"0 in a '" + std::string(kLimit) + "' means no limit: the robot continues",
                   hint};
  }
  if (target.type() == kSlider) {
    return Problem{"the driver rejects a speed slider below 0.01, so it cannot hold the robot",
                   hint};
  }
  if (!pace.at(0)) return Problem{"the value has no result for factor 0", hint};
  return std::nullopt;
}

std::shared_ptr<PaceSignal> PaceSignal::of(const Pace& pace) {
  static std::mutex mutex;
  static auto& all = *new std::map<std::string, std::weak_ptr<PaceSignal>>;
  const std::lock_guard lock(mutex);
  std::weak_ptr<PaceSignal>& known = all[pace.target.words() + ' ' + pace.target.type()];
  std::shared_ptr<PaceSignal> signal = known.lock();
  if (signal == nullptr) known = signal = std::make_shared<PaceSignal>(pace);
  return signal;
}

void PaceSignal::open() {
  if (leaves_++ != 0) return;
  teller_ = make_teller(pace_->target, "latched");
  teller_->open();
  Middleware::get().add(shared_from_this());
}

// The last leaf leaves no robot slow.
void PaceSignal::close(const UserPtr& user) {
  end(user, user->activation_);
  if (--leaves_ != 0) return;
  if (told_ && !is_told(wanted())) teller_->tell(wanted());
  forget();
  is_open_ = is_heard_ = false;
  listeners_.clear();
  teller_->close();
  Middleware::get().remove(this);
}

void PaceSignal::begin(const UserPtr& user, std::uint64_t activation,
                       std::shared_ptr<Message> message, std::optional<double> given) {
  end(user, user->activation_);
  ending_.erase(std::remove(ending_.begin(), ending_.end(), user), ending_.end());
  user->activation_ = activation;
  user->factor_ = 1;
  user->is_held_ = false;
  users_.push_back(user);
  pace_ = &user->pace_;
  is_obeyed_ = true;
  if (!told_) given_ = given;
  if (message != nullptr) teller_->use(std::move(message));
  show();
  update();
}

void PaceSignal::tell_again() {
  if (!told_) told_ = std::nan("");
  is_again_ = true;
  show();
}

void PaceSignal::show() {
  for (const auto& user : users_) {
    user->found_ = found().value_or(std::nan(""));
    user->is_told_ = told_.has_value();
  }
}

void PaceSignal::slow(User& user, double factor) {
  user.factor_ = factor;
  update();
}

void PaceSignal::hold(User& user, bool held) {
  user.is_held_ = held;
  update();
}

void PaceSignal::end(const UserPtr& user, std::uint64_t activation) {
  const auto at = std::find(users_.begin(), users_.end(), user);
  if (at == users_.end() || user->activation_ != activation) return;
  users_.erase(at);
  ending_.push_back(user);
  update();
}

// The largest factor does no harm: a leaf that is too fast is held, as without a pace.
void PaceSignal::update() {
  const bool was_slow = is_slow();
  factor_ = users_.empty() ? 1 : 0;
  for (const auto& user : users_) {
    factor_ = std::max(factor_, user->is_held_ ? 0 : user->factor_);
  }
  if (!was_slow) missing_since_ = Clock::now();
}

bool PaceSignal::poll(Clock::time_point now) {
  find_listeners(now);
  take_answer();
  const bool is_urgent = is_held() != is_told_held_;
  if (is_open_ && !is_urgent) return true;
  if (!told_ && !is_slow()) return forget(), false;
  if (listeners_.empty()) {
    if (!users_.empty()) return false;
    warn("has no listener at the end: the previous value is not restored");
    return forget(), false;
  }
  if ((!told_ || is_after_cut()) && look(now)) return true;
  const double value = wanted();
  if (is_told(value)) {
    if (!is_slow()) forget();
    return false;
  }
  if (is_urgent || now >= next_) tell(value, now);
  return true;
}

void PaceSignal::find_listeners(Clock::time_point now) {
  if (listeners_.empty() || now >= next_look_) {
    const Ids before = std::exchange(listeners_, teller_->listeners());
    const bool has_new =
        !std::includes(before.begin(), before.end(), listeners_.begin(), listeners_.end());
    if (has_new && told_) is_again_ = true;
    next_look_ = now + kBetween;
  }
  is_heard_ = !listeners_.empty() && is_obeyed_;
  if (!listeners_.empty() || !is_slow()) missing_since_ = now;
  const bool may_come = is_after_cut() && now - missing_since_ < 1s;
  if (is_held() && listeners_.empty() && !may_come) {
    warn("has no listener: the robot continues");
  }
  if (now - missing_since_ > 1s) warn("has no listener: the robot is not slowed");
}

void PaceSignal::take_answer() {
  if (!is_open_) return;
  const auto wrong = teller_->answer();
  is_open_ = !wrong;
  if (wrong) take(*wrong);
}

void PaceSignal::take(const std::string& wrong) {
  is_obeyed_ = wrong.empty();
  is_again_ |= wrong == kNoAnswer;
  if (!is_obeyed_) warn("was not set: " + wrong);
}

// Whether it is not known yet what the robot has.
bool PaceSignal::look(Clock::time_point now) {
  if (!is_looked_) teller_->look();
  is_looked_ = true;
  return teller_->is_looking(now);
}

std::optional<double> PaceSignal::found() {
  return given_ ? given_ : teller_->found();
}

// Never faster than it was found.
double PaceSignal::wanted() {
  const double full = *pace_->at(1), standing = pace_->at(0).value_or(0);
  const double here = found().value_or(full);
  if (!is_slow()) return here;
  if (is_held()) return standing;
  const double share = (here - standing) / (full - standing);
  return pace_->at(share > 0 && share < 1 ? factor_ * share : factor_).value_or(full);
}

bool PaceSignal::is_told(double value) const {
  if (!told_ || is_again_ || is_held() != is_told_held_) return false;
  return value == *told_ || (is_slow() && std::abs(value - *told_) < kBand * std::abs(*told_));
}

void PaceSignal::tell(double value, Clock::time_point now) {
  const std::string wrong = teller_->tell(value);
  told_ = value;
  is_told_held_ = is_held();
  is_again_ = false;
  next_ = now + kBetween;
  show();
  is_open_ = wrong.empty();
  if (!is_open_) take(wrong);
}

// The robot has what was found.
void PaceSignal::forget() {
  told_.reset();
  is_looked_ = is_told_held_ = is_again_ = false;
  show();
  for (const auto& user : ending_) user->restored_ = user->activation_;
  ending_.clear();
}

void PaceSignal::warn(const std::string& what) {
  if (what == warned_) return;
  warned_ = what;
  lines_.add(pace_->target.words() + " " + what);
}

}  // namespace ros2
