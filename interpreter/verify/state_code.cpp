#include "verify/state_code.h"

#include <algorithm>
#include <cstring>

#include "base/core/value_types.h"
#include "engine/blackboard.h"
#include "verify/packed_numbers.h"

namespace lockstep::host {

// No leaf has so many. Behind it, what one does that was cut.
constexpr std::uint32_t kLevelOfCut = 0x10000;

// A value is its alternative and its bytes.
class StateCode::Writer {
 public:
  explicit Writer(StateBytes& to) : to_(to) {}

  void bytes(const void* from, std::size_t size) {
    const auto* const first = static_cast<const std::byte*>(from);
    to_.insert(to_.end(), first, first + size);
  }
  template <class T>
  void plain(const T& value) {
    bytes(&value, sizeof value);
  }
  // A zero says how many there are. Of any other byte, two of them do so of those behind them.
  void runs(const std::byte* from, std::size_t size) {
    const std::size_t begin = to_.size();
    to_.resize(begin + 2 * size);  // at most
    std::byte* to = to_.data() + begin;
    for (std::size_t at = 0; at < size;) {
      const std::byte it = from[at];
      if (it != std::byte{0} && (at + 1 == size || from[at + 1] != it)) {
        *to++ = it;
        ++at;
        continue;
      }
      const std::size_t count = equal_bytes(from + at, std::min(size - at, kLongestRun));
      const std::size_t alone = it == std::byte{0} ? 1 : 2;
      for (std::size_t i = 0; i < alone; ++i) *to++ = it;
      *to++ = static_cast<std::byte>(count - alone);
      at += count;
    }
    to_.resize(static_cast<std::size_t>(to - to_.data()));
  }
  // Many leaves behind each other keep the same, whether they are held or not.
  void leaves(const std::vector<LeafState>& all) {
    for (std::size_t at = 0; at < all.size();) {
      const LeafState& leaf = all[at++];
      if (leaf.phase == Phase::Idle) continue;
      std::uint64_t more = 0;
      for (; at < all.size(); ++at) {
        if (all[at].phase == Phase::Idle) continue;
        if (all[at].ticks != leaf.ticks || level_of(all[at]) != level_of(leaf)) break;
        ++more;
      }
      put_number(to_, std::uint64_t{leaf.ticks} << 1u | (more > 0 ? 1u : 0u));
      put_number(to_, level_of(leaf));
      if (more > 0) put_number(to_, more);
    }
  }
  void number(std::uint32_t value) { put_number(to_, value); }
  void operator()(const NoValue&) {}
  void operator()(bool value) { plain(value); }
  void operator()(std::int64_t value) { plain(value); }
  void operator()(double value) { plain(value); }
  void operator()(const std::string& value) {
    number(static_cast<std::uint32_t>(value.size()));
    bytes(value.data(), value.size());
  }
  template <class T>
  void operator()(const std::vector<T>& value) {
    number(static_cast<std::uint32_t>(value.size()));
    for (const T& it : value) item(it);
  }
  void operator()(const Object&) {}  // refused before a search begins

 private:
  void item(const std::string& value) { (*this)(value); }
  template <class T>
  void item(const T& value) {
    plain(value);
  }

  static std::uint32_t level_of(const LeafState& leaf) {
    const std::uint32_t of_cut = leaf.phase == Phase::Cut ? kLevelOfCut : 0;
    return of_cut + leaf.level;
  }

  // How many in front are the same.
  static std::size_t equal_bytes(const std::byte* from, std::size_t size) {
    const std::uint64_t all = 0x0101010101010101u * std::to_integer<std::uint64_t>(*from);
    std::size_t count = 1;
    for (std::uint64_t word = 0; count + sizeof word <= size; count += sizeof word) {
      std::memcpy(&word, from + count, sizeof word);
      if (word != all) break;
    }
    while (count < size && from[count] == *from) ++count;
    return count;
  }

  static constexpr std::size_t kLongestRun = 255;
  StateBytes& to_;
};

class StateCode::ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> from) : from_(from) {}

  std::span<const std::byte> rest() const { return from_; }

  void bytes(void* to, std::size_t size) {
    std::ranges::copy(from_.first(size), static_cast<std::byte*>(to));
    from_ = from_.subspan(size);
  }
  template <class T>
  T plain() {
    T value;
    bytes(&value, sizeof value);
    return value;
  }
  void runs(std::byte* to, std::size_t size) {
    for (std::size_t at = 0; at < size;) {
      const std::byte it = plain<std::byte>();
      std::size_t count = 1;
      if (it == std::byte{0}) {
        count += std::to_integer<std::size_t>(plain<std::byte>());
      } else if (at + 1 < size && from_.front() == it) {
        from_ = from_.subspan(1);
        count = 2 + std::to_integer<std::size_t>(plain<std::byte>());
      }
      std::fill_n(to + at, count, it);
      at += count;
    }
  }
  std::uint64_t number() { return take_number(from_); }
  Value value(unsigned alternative) {
    return with_alternative(alternative, [&](auto of) { return Value(read(of)); });
  }

 private:
  template <class T>
  T read(std::type_identity<T>) {
    return plain<T>();
  }
  std::string read(std::type_identity<std::string>) {
    std::string text(number(), '\0');
    bytes(text.data(), text.size());
    return text;
  }
  template <class T>
  std::vector<T> read(std::type_identity<std::vector<T>>) {
    std::vector<T> list(number());
    for (T& it : list) it = read(std::type_identity<T>());
    return list;
  }
  NoValue read(std::type_identity<NoValue>) { return {}; }
  NoValue read(std::type_identity<Object>) { return {}; }  // refused before a search begins

  std::span<const std::byte> from_;
};

namespace {

std::vector<bool> drifting(const LeafModels& models) {
  std::vector<bool> found;
  for (const LeafModel& it : models.leaves) found.push_back(it.drifts());
  return found;
}

}  // namespace

StateCode::StateCode(const Tree& tree, const LeafModels& models, const SavedRun& fresh,
                     std::vector<bool> watched, const Symmetry& symmetry)
    : tree_(tree),
      fresh_(fresh),
      holds_(tree, drifting(models), watched),
      counts_cuts_(models.cuts.most > 0),
      order_(tree, symmetry) {
  for (std::uint32_t slot = 0; slot < models.entries.size(); ++slot) {
    if (models.entries[slot]) entries_.push_back(slot);
  }
  for (NodeIndex node = 0; node < watched.size(); ++node) {
    if (watched[node]) watched_.push_back(node);
  }
}

void StateCode::before_fold(Ticker& ticker) {
  seen_.clear();
  for (const NodeIndex node : watched_) seen_.push_back(ticker.activity(node));
  read_.clear();
  const BoundParameters& parameters = ticker.parameters();
  for (std::uint32_t place = 0; place < tree_.bound.size(); ++place) {
    if (ticker.status(tree_.bound[place].node) != Status::Running) continue;
    if (parameters.are_up_to_date(place)) continue;
    read_.push_back({place, parameters.state().values[place].values});
  }
}

void StateCode::write(const std::vector<ReadValues>& all, Writer& writer) const {
  if (tree_.bound.empty()) return;
  writer.number(static_cast<std::uint32_t>(all.size()));
  for (const ReadValues& it : all) {
    writer.number(it.place);
    for (const Value& value : it.values) {
      writer.plain(static_cast<std::uint8_t>(value.index()));
      std::visit(writer, value);
    }
  }
}

void StateCode::read(ByteReader& reader, std::vector<ReadValues>& all) const {
  all.resize(tree_.bound.empty() ? 0 : reader.number());
  for (ReadValues& it : all) {
    it.place = static_cast<std::uint32_t>(reader.number());
    it.values.clear();
    const std::size_t count = tree_.bound[it.place].kind->type.parameters.size();
    while (it.values.size() < count)
      it.values.push_back(reader.value(reader.plain<std::uint8_t>()));
  }
}

void StateCode::write(const KeptState& state, Writer& writer) {
  writer.runs(reinterpret_cast<const std::byte*>(state.activity.data()), state.activity.size());
  writer.runs(reinterpret_cast<const std::byte*>(state.words.data()),
              state.words.size() * sizeof(std::uint64_t));
  writer.leaves(state.leaves);
}

void StateCode::encode(const Ticker& ticker, ModelLeaves& leaves,
                       std::span<const std::byte> properties, Children children, StateBytes& into) {
  kept_.activity = ticker.run_state().activity;
  holds_.forget_others(ticker, kept_.activity);
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    if (has_ended(status_of(seen_[i]))) kept_.activity[watched_[i]] = seen_[i];
  }
  kept_.words = ticker.run_state().bytes;
  kept_.leaves = leaves.states();
  // `read_` stays as it is: a node of Tree::bound is never in a child that may change its place.
  if (children == Children::Sorted) order_.sort(kept_);
  into.clear();
  Writer writer(into);
  write(kept_, writer);
  write(read_, writer);
  writer.bytes(leaves.facts().data(), leaves.facts().size());
  writer.bytes(properties.data(), properties.size());
  add_entries(ticker, into);
  if (counts_cuts_) writer.plain(cuts_);
}

void StateCode::add_entries(const Ticker& ticker, StateBytes& to) const {
  Writer writer(to);
  for (const std::uint32_t slot : entries_) {
    const Entry& entry = ticker.blackboard().entries[slot];
    writer.plain(static_cast<std::uint8_t>(entry.value().index() | (entry.is_present ? 16u : 0u)));
    std::visit(writer, entry.value());
    writer.number(entry.writes());
    if (fresh_.entries[slot].typing != Typing::Strict) {
      writer.plain(entry.typing);
      writer.plain(entry.type);
    }
  }
}

void StateCode::read(ByteReader& reader, KeptState& state) const {
  state.activity.resize(tree_.nodes.size());
  state.words.resize(fresh_.run.bytes.size());
  state.leaves.assign(tree_.leaves.size(), {});
  reader.runs(reinterpret_cast<std::byte*>(state.activity.data()), state.activity.size());
  reader.runs(reinterpret_cast<std::byte*>(state.words.data()),
              state.words.size() * sizeof(std::uint64_t));
  LeafState like;
  bool was_cut = false;
  std::uint64_t more = 0;  // like that
  for (std::size_t i = 0; i < state.leaves.size(); ++i) {
    const Activity activity = state.activity[tree_.leaves[i].node];
    if (status_of(activity) != Status::Running) continue;
    if (more > 0) {
      --more;
    } else {
      const std::uint64_t head = reader.number();
      like.ticks = static_cast<std::uint32_t>(head >> 1u);
      const std::uint64_t level = reader.number();
      was_cut = level >= kLevelOfCut;
      like.level = static_cast<std::uint16_t>(level % kLevelOfCut);
      if ((head & 1u) != 0) more = reader.number();
    }
    state.leaves[i] = like;
    state.leaves[i].phase = activity == Activity::Paused ? Phase::Paused : Phase::Running;
    if (was_cut) state.leaves[i] = LeafState::cut(like.after_cut());
  }
}

void StateCode::move(std::span<const std::byte> from, std::span<const NodeIndex> places,
                     StateBytes& into) {
  ByteReader reader(from);
  read(reader, kept_);
  order_.move(kept_, places);
  std::vector<ReadValues> values;
  read(reader, values);
  for (ReadValues& it : values) {
    it.place = tree_.place_in_front(places[tree_.bound[it.place].node], FrontCell::Bound);
  }
  into.clear();
  Writer writer(into);
  write(kept_, writer);
  write(values, writer);
  writer.bytes(reader.rest().data(), reader.rest().size());
}

void StateCode::decode(std::span<const std::byte> from, SavedRun& run,
                       std::vector<LeafState>& leaves, std::vector<FactState>& facts,
                       std::span<std::byte> properties, std::vector<ReadValues>& values) {
  ByteReader reader(from);
  read(reader, kept_);
  read(reader, values);
  run.run.activity = kept_.activity;
  run.run.bytes = kept_.words;
  leaves = kept_.leaves;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    run.leaves[i].started = leaves[i].runs();
    run.leaves[i].was_cut = leaves[i].phase == Phase::Cut;
    if (run.leaves[i].was_cut) run.leaves[i].does = leaves[i].after_cut();
  }
  reader.bytes(facts.data(), facts.size());
  reader.bytes(properties.data(), properties.size());
  for (const std::uint32_t slot : entries_) {
    Entry& entry = run.entries[slot];
    entry = fresh_.entries[slot];
    const auto head = reader.plain<std::uint8_t>();
    entry.is_present = (head & 16u) != 0;
    entry.assign(reader.value(head & 15u));
    entry.count_from(static_cast<std::uint32_t>(reader.number()));
    if (fresh_.entries[slot].typing != Typing::Strict) {
      entry.typing = reader.plain<Typing>();
      entry.type = reader.plain<ValueType>();
    }
  }
  if (counts_cuts_) cuts_ = reader.plain<std::uint8_t>();
}

}  // namespace lockstep::host
