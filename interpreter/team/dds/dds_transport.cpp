// Words of a team over DDS (Cyclone DDS): a topic with a key, of which each member is an instance.
// Reliable, and the last word of each is kept for those that come later.
#include <dds/dds.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <semaphore.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "base/core/triple_buffer.h"
#include "team.h"
#include "team/network.h"

namespace lockstep::host {
namespace {

using Sample = lockstep_msgs_msg_dds__TeamMember_;

constexpr const char* kTopic = "rt/lockstep/team";
constexpr Nanoseconds kBetweenLooks = std::chrono::seconds(1);  // at the addresses of this machine

// From one thread to another. What does not fit is left out: a newer word comes.
class Ring {
 public:
  void push(const HeardWord& word) {
    const auto end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) == words_.size()) return;
    words_[end % words_.size()] = word;
    end_.store(end + 1, std::memory_order_release);
  }
  bool pop(HeardWord& into) {
    const auto begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_.load(std::memory_order_acquire)) return false;
    into = words_[begin % words_.size()];
    begin_.store(begin + 1, std::memory_order_release);
    return true;
  }

 private:
  std::array<HeardWord, 4096> words_;
  std::atomic<std::size_t> begin_{0}, end_{0};
};

// A word as it is sent; the lists of `it` are in this object.
struct SampleOf {
  explicit SampleOf(const TeamWord& word) {
    it.run = word.run;
    it.number = word.number;
    it.declaration = word.declaration;
    it.round = word.round;
    it.passed = word.passed;
    it.is_in = word.is_in;
    it.progress = word.progress;
    it.period = word.period;
    it.pool = word.pool.declaration;
    it.term = word.pool.term;
    it.decider = word.pool.decider;
    it.follows = word.pool.follows;
    it.has_left = word.pool.has_left;
    if (word.pool.declaration == 0) return;
    for (std::size_t i = 0; i < asks.size(); ++i) {
      const PoolWord::Ask& ask = word.pool.asks[i];
      asks[i] = {.number = ask.number, .owns = ask.owns, .set = ask.set};
    }
    for (std::size_t i = 0; i < word.pool.answer_count; ++i)
      answers[i] = {.run = word.pool.answers[i].run, .number = word.pool.answers[i].number};
    it.asks._maximum = it.asks._length = kMostAsked;
    it.asks._buffer = asks.data();
    it.answers._maximum = PoolWord::kMostAnswers;
    it.answers._length = word.pool.answer_count;
    it.answers._buffer = answers.data();
  }
  SampleOf(const SampleOf&) = delete;
  SampleOf& operator=(const SampleOf&) = delete;

  Sample it{};
  std::array<lockstep_msgs_msg_dds__TeamAsk_, kMostAsked> asks{};
  std::array<lockstep_msgs_msg_dds__TeamAnswer_, PoolWord::kMostAnswers> answers{};
};

TeamWord word_of(const Sample& it) {
  TeamWord word{.run = it.run,
                .number = it.number,
                .declaration = it.declaration,
                .round = it.round,
                .passed = it.passed,
                .is_in = it.is_in,
                .progress = it.progress,
                .period = it.period};
  PoolWord& pool = word.pool;
  pool.declaration = it.pool;
  pool.term = it.term;
  pool.decider = it.decider;
  pool.follows = it.follows;
  pool.has_left = it.has_left;
  const std::size_t asks = std::min<std::size_t>(it.asks._length, pool.asks.size());
  for (std::size_t i = 0; i < asks; ++i) {
    const auto& ask = it.asks._buffer[i];
    pool.asks[i] = {.number = ask.number, .owns = ask.owns, .set = ask.set};
  }
  pool.answer_count = std::min<std::uint32_t>(it.answers._length, PoolWord::kMostAnswers);
  for (std::size_t i = 0; i < pool.answer_count; ++i)
    pool.answers[i] = {.run = it.answers._buffer[i].run, .number = it.answers._buffer[i].number};
  return word;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char it : text) {
    if (it == '<' || it == '&' || it == '"')
      out += fmt::format("&#{};", static_cast<int>(it));
    else
      out += it;
  }
  return out;
}

// Robots are found within a second. Threads end also where this machine cannot send to itself,
// which it cannot when the interface is gone.
constexpr const char* kDefaults =
    "<Internal><MultipleReceiveThreads>false</MultipleReceiveThreads></Internal>"
    "<Discovery><SPDPInterval>1s</SPDPInterval></Discovery>";

// A later one wins: the options.
std::string config_of(const TeamNetworkOptions& options) {
  std::string config = kDefaults;
  if (const char* const uri = secure_getenv("CYCLONEDDS_URI"); uri != nullptr && *uri != 0)
    config += fmt::format(",{}", uri);
  if (!options.interface.empty()) {
    config +=
        fmt::format(",<General><Interfaces><NetworkInterface name=\"{}\"/></Interfaces></General>",
                    escaped(options.interface));
  }
  if (!options.peers.empty()) {
    std::string peers;
    for (const std::string& it : options.peers)
      peers += fmt::format("<Peer address=\"{}\"/>", escaped(it));
    config += fmt::format(
        ",<General><AllowMulticast>false</AllowMulticast></General><Discovery>"
        "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>100"
        "</MaxAutoParticipantIndex><Peers>{}</Peers></Discovery>",
        peers);
  }
  return config;
}

// Of this machine's interfaces: where they differ, sockets may be of one that is gone.
std::string addresses() {
  std::string all;
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return all;
  for (const ifaddrs* it = list; it != nullptr; it = it->ifa_next) {
    if (it->ifa_addr == nullptr || it->ifa_addr->sa_family != AF_INET) continue;
    sockaddr_in address{};
    std::memcpy(&address, it->ifa_addr, sizeof address);
    all += fmt::format("{} {} {}\n", it->ifa_name, if_nametoindex(it->ifa_name),
                       address.sin_addr.s_addr);
  }
  freeifaddrs(list);
  return all;
}

class DdsTransport final : public TeamTransport {
 public:
  DdsTransport(std::span<const TeamDeclaration> teams, const TeamNetworkOptions& options)
      : teams_(teams.begin(), teams.end()), options_(options) {
    for (std::size_t i = 0; i < teams.size(); ++i) own_.emplace_back(TeamWord());
  }

  ~DdsTransport() override {
    {
      const std::scoped_lock lock(ends_);
      stops_ = true;
    }
    ended_.notify_all();
    sem_post(&said_);
    if (speaker_.joinable()) speaker_.join();
    if (watcher_.joinable()) watcher_.join();
    // The last word says what this robot has completed.
    if (writer_ > 0) dds_wait_for_acks(writer_, DDS_SECS(1));
    const auto no_log = [](void*, const dds_log_data_t*) {};
    dds_set_log_sink(no_log, nullptr);
    dds_set_trace_sink(no_log, nullptr);
    disconnect();
    sem_destroy(&said_);
  }

  // "": it is open.
  std::string open() {
    sem_init(&said_, 0, 0);
    dds_set_log_sink(log_sink, this);
    dds_set_trace_sink(log_sink, this);
    std::string why = connect();
    if (!why.empty()) return why;
    watcher_ = std::thread([this] { look_at_addresses(); });
    speaker_ = std::thread([this] { speak(); });
    return "";
  }

  bool take(HeardWord& into) override { return heard_.pop(into); }

  void say(std::uint32_t team, const TeamWord& word) override {
    own_[team].back() = word;
    own_[team].publish();
    sem_post(&said_);
  }

 private:
  std::string failure(const char* what, dds_return_t code) const {
    const std::string interface =
        options_.interface.empty() ? "" : fmt::format(" (interface {})", options_.interface);
    const std::scoped_lock lock(mutex_);
    std::string why = first_log_.empty() ? "" : ": " + first_log_;
    if (last_log_ != first_log_) why += "; " + last_log_;
    return fmt::format("the team cannot be reached: {}{}: {}{}", what, interface,
                       dds_strretcode(code), why);
  }

  static void log_sink(void* self, const dds_log_data_t* data) {
    auto& it = *static_cast<DdsTransport*>(self);
    std::string line(data->message, data->size);
    while (!line.empty() && line.back() == '\n') line.pop_back();
    it.tell_once("network: " + line, true);
  }
  // Lines of DDS that differ in numbers or in what a packet has, such as those of 100 ports, are
  // one.
  void tell_once(const std::string& line, bool is_log) {
    std::string kind = is_log ? line.substr(0, line.find('<')) : line;
    if (is_log) std::erase_if(kind, [](char it) { return it >= '0' && it <= '9'; });
    {
      constexpr std::size_t kMost = 30;
      const std::scoped_lock lock(mutex_);
      if (is_log && first_log_.empty()) first_log_ = line;
      if (is_log) last_log_ = line;
      if (told_.size() >= kMost || !told_.insert(kind).second) return;
    }
    if (options_.tell) options_.tell(line);
  }

  // "": it is connected.
  std::string connect() {
    {
      const std::scoped_lock lock(mutex_);
      first_log_.clear();
      last_log_.clear();
    }
    addresses_ = addresses();
    domain_ = dds_create_domain(options_.domain, config_of(options_).c_str());
    if (domain_ < 0) return failure("its configuration is refused", domain_);
    const dds_entity_t participant = dds_create_participant(options_.domain, nullptr, nullptr);
    if (participant < 0) return failure("the network cannot be used", participant);
    dds_qos_t* const qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(10));
    dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
    const dds_entity_t topic = dds_create_topic(
        participant, &lockstep_msgs_msg_dds__TeamMember__desc, kTopic, qos, nullptr);
    // Before DDS keeps anything: it never forgets a name.
    const dds_topic_filter filter{
        .mode = DDS_TOPIC_FILTER_SAMPLE_ARG, .f = {.sample_arg = is_wanted}, .arg = this};
    if (topic > 0) dds_set_topic_filter_extended(topic, &filter);
    dds_listener_t* const listener = dds_create_listener(this);
    dds_lset_data_available(listener, [](dds_entity_t reader, void* self) {
      static_cast<DdsTransport*>(self)->take_all(reader);
    });
    reader_ = topic < 0 ? topic : dds_create_reader(participant, topic, qos, listener);
    dds_delete_listener(listener);
    const dds_entity_t writer =
        topic < 0 ? topic : dds_create_writer(participant, topic, qos, nullptr);
    dds_delete_qos(qos);
    if (reader_ < 0 || writer < 0) return failure("the topic cannot be made", reader_);
    const std::scoped_lock lock(writes_);
    writer_ = writer;
    return "";
  }

  void disconnect() {
    {
      const std::scoped_lock lock(writes_);
      writer_ = 0;
    }
    if (domain_ > 0) dds_delete(domain_);
    domain_ = reader_ = 0;
  }

  void look_at_addresses() {
    std::unique_lock lock(ends_);
    while (!ended_.wait_for(lock, kBetweenLooks, [&] { return stops_.load(); })) {
      lock.unlock();
      connect_again();
      lock.lock();
    }
  }

  // DDS keeps the interface and the address that it began with. Where these have changed, and no
  // other robot is heard, it begins again.
  void connect_again() {
    const bool is_heard = monotonic_now() - heard_at_.load() < kBetweenLooks;
    if (reader_ > 0 && (is_heard || addresses() == addresses_)) return;
    disconnect();
    const std::string why = connect();
    if (!why.empty()) disconnect();
    tell_once(why.empty() ? "the addresses of this machine have changed: DDS begins again" : why,
              false);
  }

  static bool is_wanted(const void* sample, void* self) {
    return static_cast<DdsTransport*>(self)->is_wanted(*static_cast<const Sample*>(sample));
  }
  bool is_wanted(const Sample& it) {
    bool is_member = false;
    for (const TeamDeclaration& team : teams_) {
      if (team.team != it.team) continue;
      is_member |=
          team.self == it.member || std::ranges::find(team.others, it.member) != team.others.end();
      if (is_member) continue;
      tell_once(fmt::format("the team '{}' has no member '{}': its words are left out", team.team,
                            std::string(it.member).substr(0, 64)),
                false);
    }
    return is_member;
  }

  // In a thread of DDS.
  void take_all(dds_entity_t reader) {
    constexpr int kMost = 64;
    std::array<void*, kMost> samples{};
    std::array<dds_sample_info_t, kMost> infos{};
    const std::scoped_lock lock(takes_);
    for (;;) {
      const auto count = dds_take(reader, samples.data(), infos.data(), kMost, kMost);
      if (count <= 0) return;
      const Nanoseconds now = monotonic_now();
      for (int i = 0; i < count; ++i) {
        if (infos[i].valid_data) take(*static_cast<const Sample*>(samples[i]), now);
      }
      dds_return_loan(reader, samples.data(), count);
    }
  }

  void take(const Sample& it, Nanoseconds now) {
    for (std::uint32_t i = 0; i < teams_.size(); ++i) {
      const TeamDeclaration& team = teams_[i];
      if (team.team != it.team) continue;
      const auto other = std::ranges::find(team.others, it.member);
      if (other != team.others.end()) heard_at_ = now;
      heard_.push({.team = i,
                   .member = team.self == it.member
                                 ? HeardWord::kOwnName
                                 : static_cast<std::uint32_t>(other - team.others.begin()),
                   .word = word_of(it),
                   .at = now});
    }
  }

  void speak() {
    for (bool is_last = false; !is_last;) {
      sem_wait(&said_);
      is_last = stops_;
      for (std::size_t i = 0; i < teams_.size(); ++i) {
        if (!own_[i].take()) continue;
        const TeamWord& word = own_[i].front();
        SampleOf sample(word);
        sample.it.team = teams_[i].team.data();
        sample.it.member = teams_[i].self.data();
        const std::scoped_lock lock(writes_);
        if (writer_ > 0) dds_write(writer_, &sample.it);
      }
    }
  }

  std::vector<TeamDeclaration> teams_;
  const TeamNetworkOptions options_;
  std::deque<TripleBuffer<TeamWord>> own_;
  sem_t said_{};
  Ring heard_;
  std::atomic<bool> stops_{false};
  dds_entity_t domain_ = 0, reader_ = 0;
  std::string addresses_;                              // when it was connected
  std::atomic<Nanoseconds> heard_at_{Nanoseconds(0)};  // any other robot
  std::mutex writes_;  // the writer is used by the thread that speaks
  dds_entity_t writer_ = 0;
  mutable std::mutex mutex_;
  std::set<std::string> told_;
  // Since it began to connect. The first is mostly the reason, and the others follow from it.
  std::string first_log_, last_log_;
  std::condition_variable ended_;
  std::mutex ends_, takes_;
  std::thread watcher_, speaker_;
};

}  // namespace
}  // namespace lockstep::host

extern "C" [[gnu::visibility("default")]] lockstep::host::TeamTransport* lockstep_open_team(
    std::span<const lockstep::host::TeamDeclaration> teams,
    const lockstep::host::TeamNetworkOptions& options, std::string& why) {
  auto transport = std::make_unique<lockstep::host::DdsTransport>(teams, options);
  why = transport->open();
  return why.empty() ? transport.release() : nullptr;
}
