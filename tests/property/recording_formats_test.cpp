// Recordings of random trees in each format say the same: JSON Lines, zstd, parts, MCAP, CSV. JSON
// Lines and MCAP are read here by other means than by those that lockstep has.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <tuple>

#include "base/compression/decompressed.h"
#include "property/btcpp_tree.h"
#include "property/random_tree.h"
#include "record/part_names.h"
#include "record/read/recording_parts.h"
#include "record/use/compared_children.h"
#include "record/use/mcap.h"
#include "record/use/mcap_stream.h"
#include "record/use/recording_csv.h"
#include "record/write/recorder.h"
#include "run/shape_of.h"
#include "support/json.h"
#include "support/trials.h"
#include "unit/recording/watched_run.h"

namespace lockstep::host::test {
namespace {

const std::uint64_t kFormatTrees = trials(50);

using nlohmann::json;

struct Node {
  std::string status = "idle";
  double progress = 0;
  bool ticked = false, held = false;

  bool is_active() const { return ticked || status != "idle"; }
  friend bool operator==(const Node&, const Node&) = default;
};

// One of several in a tick: each node's status, and whether it was ticked and held.
struct Moment {
  std::uint64_t times = 0;
  std::vector<std::tuple<std::string, bool, bool>> nodes = {};

  friend bool operator==(const Moment&, const Moment&) = default;
};

struct Tick {
  std::uint64_t tick = 0;
  std::uint64_t time = 0;  // ns
  std::vector<Node> nodes = {};
  std::map<std::uint32_t, std::optional<std::string>> entries = {};  // new values
  std::vector<Moment> moments = {};

  friend bool operator==(const Tick&, const Tick&) = default;
};

using Ticks = std::vector<Tick>;

std::uint64_t nanoseconds(double seconds) {
  return static_cast<std::uint64_t>(std::llround(seconds * 1e9));
}

std::optional<std::string> text_of(const json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<std::string>());
}

// From the last one back to the first: each says how nodes were that differ from the one after it.
std::vector<Moment> moments_of_line(const json& line, const std::vector<Node>& after) {
  std::vector<Moment> moments;
  Moment moment;
  for (const Node& it : after) moment.nodes.emplace_back(it.status, it.ticked, it.held);
  const json all = line.value("moments", json::array());
  for (auto it = all.rbegin(); it != all.rend(); ++it) {
    moment.times = (*it)[0];
    for (const json& node : (*it)[1]) moment.nodes[node[0]] = {node[1], node[2] == 1, node[3] == 1};
    moments.insert(moments.begin(), moment);
  }
  return moments;
}

Ticks ticks_of_lines(const std::string& text) {
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  Tick now;
  now.nodes.resize(parse_json(line)["nodes"].size());
  Ticks ticks;
  while (std::getline(in, line)) {
    const json it = parse_json(line);
    if (!it.contains("tick")) continue;
    now.tick = it["tick"];
    now.time = nanoseconds(it["time_s"]);
    now.entries.clear();
    for (const json& node : it["nodes"]) {
      now.nodes[node[0]] = {node[1], node[2], node[3] == 1, node[4] == 1};
    }
    for (const json& entry : it.value("entries", json::array())) {
      now.entries[entry[0]] = text_of(entry[1]);
    }
    now.moments = moments_of_line(it, now.nodes);
    ticks.push_back(now);
  }
  return ticks;
}

Ticks ticks_of(std::istream& in) {
  RecordingReader reader(in, "recording");
  Ticks ticks;
  std::vector<NodeState> column;
  while (const auto tick = reader.next()) {
    Tick& it = ticks.emplace_back(Tick{.tick = tick->tick, .time = nanoseconds(tick->time)});
    for (const RecordedState& node : tick->nodes) {
      it.nodes.push_back(
          {std::string(to_string(node.status)), node.progress, node.ticked, node.held});
    }
    for (const RecordedEntry& entry : tick->entries) it.entries[entry.entry] = entry.value;
    tick->moments.each(
        column, [&](std::span<const NodeState> nodes, const TickMoment& moment, bool) {
          Moment& last = it.moments.emplace_back(Moment{moment.times});
          for (const NodeState node : nodes) {
            last.nodes.emplace_back(to_string(node.status()), node.ticked(), node.held());
          }
        });
  }
  CHECK(reader.error() == "");
  CHECK(reader.cut() == "");
  return ticks;
}

// A row for each active node.
std::string csv_of(const Ticks& ticks) {
  std::string rows;
  for (const Tick& tick : ticks) {
    for (std::size_t node = 0; node < tick.nodes.size(); ++node) {
      const Node& it = tick.nodes[node];
      if (!it.is_active()) continue;
      rows +=
          fmt::format("{},{},{},{},{},{:d},{:d}\n", tick.tick, static_cast<double>(tick.time) / 1e9,
                      node, it.status, it.progress, it.ticked, it.held);
    }
  }
  return rows;
}

// Without the paths.
std::string short_csv(const std::string& table) {
  std::istringstream in(table);
  std::string rows, row;
  std::getline(in, row);
  while (std::getline(in, row)) {
    std::vector<std::string> cells(1);
    bool is_quoted = false;
    for (const char it : row) {
      if (it == '"') is_quoted = !is_quoted;
      if (it == ',' && !is_quoted) {
        cells.emplace_back();
      } else {
        cells.back() += it;
      }
    }
    REQUIRE(cells.size() == 9);
    for (const std::size_t column : {0, 1, 2, 4, 5, 6}) rows += cells[column] + ",";
    rows += cells[7] + "\n";
  }
  return rows;
}

// --- MCAP: https://mcap.dev/spec -----------------------------------------------------------------

struct Message {
  std::string topic;
  std::uint64_t time = 0;
  json content;
};

class McapReader {
 public:
  std::vector<Message> messages;

  void read(std::string_view records) {
    while (!records.empty()) {
      const auto opcode = static_cast<unsigned char>(records[0]);
      records.remove_prefix(1);
      const std::string_view content = take(records, number<std::uint64_t>(records));
      if (opcode == 0x04) take_channel(content);
      if (opcode == 0x05) take_message(content);
      if (opcode == 0x06) take_chunk(content);
      if (opcode == 0x0F) return;  // the summary repeats what was there
    }
  }

 private:
  static std::string_view take(std::string_view& from, std::uint64_t size) {
    REQUIRE(size <= from.size());
    const std::string_view some = from.substr(0, size);
    from.remove_prefix(size);
    return some;
  }
  template <class Number>
  static Number number(std::string_view& from) {
    Number value = 0;
    int shift = 0;
    for (const char byte : take(from, sizeof(Number))) {
      value |= static_cast<Number>(static_cast<Number>(static_cast<unsigned char>(byte)) << shift);
      shift += 8;
    }
    return value;
  }
  void take_channel(std::string_view content) {
    const auto id = number<std::uint16_t>(content);
    number<std::uint16_t>(content);
    topics_[id] = take(content, number<std::uint32_t>(content));
  }
  void take_message(std::string_view content) {
    const auto channel = number<std::uint16_t>(content);
    number<std::uint32_t>(content);
    const auto time = number<std::uint64_t>(content);
    number<std::uint64_t>(content);
    messages.push_back({topics_.at(channel), time, parse_json(std::string(content))});
  }
  void take_chunk(std::string_view content) {
    take(content, 8 + 8 + 8 + 4);
    REQUIRE(take(content, number<std::uint32_t>(content)) == "zstd");
    std::istringstream bytes{std::string(take(content, number<std::uint64_t>(content)))};
    Decompressed buffer(*bytes.rdbuf());
    const std::string records{std::istreambuf_iterator<char>(&buffer), {}};
    read(records);
  }

  std::map<std::uint16_t, std::string> topics_;
};

std::vector<Message> messages_of(const std::string& file) {
  McapReader reader;
  reader.read(std::string_view(file).substr(8));  // behind the magic bytes
  return std::move(reader.messages);
}

// What an entry of this type is as JSON.
json value_of(const std::string& type, const std::optional<std::string>& text) {
  if (!text) return nullptr;
  if (type == "bool") return *text == "true";
  if (type != "int" && type != "double") return *text;
  std::size_t end = 0;
  const double number = std::stod(*text, &end);
  return std::isfinite(number) && end == text->size() ? json(number) : json(*text);
}

// Each message is used up once, and says what the ticks say.
struct Counts {
  std::size_t changes = 0, progress = 0, entries = 0;
};

void check_mcap(const std::vector<Message>& messages, const Ticks& ticks,
                const RecordingHeader& header, Counts& counts) {
  std::map<std::string, std::size_t> nodes, keys;
  for (std::size_t i = 0; i < header.nodes.size(); ++i) nodes[header.nodes[i].path] = i;
  for (std::size_t i = 0; i < header.entries.size(); ++i) keys[header.entries[i].key] = i;
  std::map<std::string, ComparedChildren> compared;
  for (auto& it : compared_children(header)) compared[header.nodes[it.node].path] = it;
  std::map<std::uint64_t, const Tick*> by_number;
  for (const Tick& it : ticks) by_number[it.tick] = &it;
  std::vector<Node> state(header.nodes.size());
  std::map<std::uint64_t, std::vector<Node>> states;
  std::size_t progress = 0, entries = 0;
  for (const Message& it : messages) {
    if (it.topic == "/lockstep/log") continue;
    const Tick& tick = *by_number.at(it.content["tick"]);
    REQUIRE(it.time == tick.time);
    if (it.topic == "/lockstep/status") {
      for (const json& change : it.content["changes"]) {
        state[nodes.at(change["path"])] = {change["status"], change["progress"], change["ticked"],
                                           change["held"]};
        ++counts.changes;
      }
      states[tick.tick] = state;
    } else if (const std::string begin = "/lockstep/progress/"; it.topic.starts_with(begin)) {
      const ComparedChildren& of = compared.at(it.topic.substr(begin.size()));
      CHECK(tick.nodes[of.node].ticked);
      CHECK(it.content["progress"].size() == of.children.size());
      for (std::size_t i = 0; i < of.children.size(); ++i) {
        const Node& child = tick.nodes[of.children[i]];
        CHECK(header.nodes[of.children[i]].path.ends_with(of.names[i]));
        CHECK(it.content["progress"][of.names[i]] == child.progress);
        CHECK(it.content["held"][of.names[i]] == child.held);
      }
      ++progress;
    } else {
      const std::size_t entry = keys.at(it.topic.substr(std::string("/lockstep/entries/").size()));
      const auto& value = tick.entries.at(static_cast<std::uint32_t>(entry));
      CHECK(it.content["value"] == value_of(header.entries[entry].type, value));
      ++entries;
    }
  }
  // Each tick, each progress and each new value has been seen.
  std::size_t all_progress = 0, all_entries = 0;
  std::vector<Node> now(header.nodes.size());
  for (const Tick& it : ticks) {
    if (const auto found = states.find(it.tick); found != states.end()) now = found->second;
    CHECK(now == it.nodes);
    all_entries += it.entries.size();
    for (const auto& [path, of] : compared) all_progress += it.nodes[of.node].ticked ? 1 : 0;
  }
  CHECK(progress == all_progress);
  CHECK(entries == all_entries);
  counts.progress += progress;
  counts.entries += entries;
}

std::string file_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("each format of a recording of a random tree says the same, tick by tick", "[trials]") {
  Counts counts;
  std::size_t parts = 0, moments = 0;
  for (std::uint64_t seed = 0; seed < kFormatTrees; ++seed) {
    const Trial trial = random_trial(seed);
    INFO("seed " << seed << ": " << tree_text(trial.plan) << ", " << leaves_text(trial.plan));
    // Each fourth is for BehaviorTree.CPP: its ticks may have several moments.
    const bool is_btcpp = seed % 4 == 3;
    const law::Document document = law::random_document(seed);
    auto watched =
        is_btcpp ? std::make_unique<WatchedRun>(law::tree_of(document), law::leaves_text(document))
                 : std::make_unique<WatchedRun>(tree_text(trial.plan), leaves_text(trial.plan));
    WatchedRun& run = *watched;
    const TemporaryPath file;
    const auto options = [&](const char* ending) {
      return RecorderOptions{.path = file.path() + ending,
                             .run = {.tree_file = "a.xml", .rate_hz = 10},
                             .whole_each = 1 + seed % 50};
    };
    {
      Recorder plain(shape_of(run.run.tree()), options(".jsonl")),
          packed(shape_of(run.run.tree()), options(".zst"));
      RecorderOptions rotating = options(".set");
      rotating.rotation.time = std::chrono::milliseconds(300);
      Recorder rotated(shape_of(run.run.tree()), rotating);
      RecorderOptions mcap = options(".mcap");
      mcap.encoder = mcap_encoder(McapTimes::SinceStart);
      Recorder direct(shape_of(run.run.tree()), mcap);
      run.watch({&plain, &packed, &rotated, &direct}, static_cast<std::uint64_t>(trial.ticks));
    }
    const std::string text = file_text(file.path() + ".jsonl");
    const Ticks ticks = ticks_of_lines(text);
    std::istringstream in(text);
    CHECK(ticks_of(in) == ticks);
    for (const Tick& it : ticks) moments += it.moments.size();
    DecompressedFile packed(file.path() + ".zst");
    const std::string unpacked{std::istreambuf_iterator<char>(packed.text()), {}};
    CHECK(unpacked == text);
    RecordingParts set(file.path() + ".set");
    std::istream of_set(&set);
    CHECK(ticks_of(of_set) == ticks);
    parts += parts_that_exist(file.path() + ".set").size();

    std::istringstream again(text);
    RecordingReader for_csv(again, "csv");
    std::string table;
    write_csv(for_csv, [&](std::string_view rows) { return !table.append(rows).empty(); });
    CHECK(short_csv(table) == csv_of(ticks));

    std::istringstream once_more(text);
    RecordingReader for_mcap(once_more, "mcap");
    std::string exported;
    const auto keep = [&](std::string_view bytes) { return !exported.append(bytes).empty(); };
    REQUIRE(write_mcap(for_mcap, {}, keep));
    const auto messages = messages_of(exported);
    check_mcap(messages, ticks, for_mcap.header(), counts);
    const auto live = messages_of(file_text(file.path() + ".mcap"));
    CHECK(std::ranges::equal(live, messages, [](const Message& a, const Message& b) {
      return std::tie(a.topic, a.time, a.content) == std::tie(b.topic, b.time, b.content);
    }));
  }
  CHECK(counts.changes > 10 * kFormatTrees);
  CHECK(counts.progress > kFormatTrees);
  CHECK(counts.entries > kFormatTrees);
  CHECK(parts > 2 * kFormatTrees);
  CHECK(moments > kFormatTrees / 10);
}

}  // namespace lockstep::host::test
