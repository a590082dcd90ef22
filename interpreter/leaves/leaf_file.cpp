#include "leaves/leaf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/suggest.h"
#include "core/value.h"
#include "core/wording.h"
#include "document/document.h"
#include "document/file.h"
#include "document/reporter.h"
#include "leaves/leaf_words.h"
#include "leaves/word_check.h"

namespace lockstep::host {
namespace {

using leaf_words::Tag;
using leaf_words::Word;

// "3", "1..5", "2..inf".
std::optional<WholeRange> parse_range(std::string_view text) {
  const auto parts = split(text, "..");
  const auto least = parse_int(parts.front());
  if (!least || parts.size() > 2) return std::nullopt;
  if (parts.size() == 1) return WholeRange{*least, least};
  if (parts[1] == "inf") return WholeRange{*least, std::nullopt};
  const auto most = parse_int(parts[1]);
  if (!most || *most < *least) return std::nullopt;
  return WholeRange{*least, most};
}

class Reader {
 public:
  Reader(const Document& document, LeafFile& file, Diagnostics& diagnostics)
      : document_(document), file_(file), report_(file.sources, diagnostics) {}

  bool read() {
    const Element& root = document_.elements()[0];
    if (root.tag != "leaves") {
      report_.at(root.place, fmt::format("'{}' is no leaf file", brief(root.tag)),
                 "it begins with <leaves lockstep=\"1\">");
      return false;
    }
    check_words(0, "leaves", leaf_words::kRoot);
    if (const Attribute* version = document_.find_attribute(0, "lockstep");
        version != nullptr && version->value != "1") {
      report_.at_value(version->place, fmt::format("unknown version '{}'", brief(version->value)),
                       "this lockstep knows version 1");
    }
    if (const Attribute* rate = document_.find_attribute(0, "rate")) {
      file_.rate = parse_double(rate->value);
      if (!file_.rate || *file_.rate < 0.001 || *file_.rate > 100000) {
        report_.at_value(rate->place, "'rate' must be a number from 0.001 to 100000");
      }
    }
    for (std::uint32_t at = 1; at < root.end; at = document_.elements()[at].end) read_element(at);
    return true;
  }

 private:
  void read_element(std::uint32_t at) {
    const Element& element = document_.elements()[at];
    const auto* const tag = std::ranges::find(leaf_words::kTags, element.tag, &Tag::name);
    if (tag == std::end(leaf_words::kTags)) {
      std::vector<std::string_view> names;
      for (const Tag& it : leaf_words::kTags) names.push_back(it.name);
      report_.at(element.place, fmt::format("unknown element '{}'", brief(element.tag)),
                 suggest(element.tag, names, "elements of 'leaves'"));
      return;
    }
    if (element.end > at + 1) {
      report_.at(document_.elements()[at + 1].place,
                 fmt::format("'{}' cannot contain elements", element.tag));
    }
    if (!check_words(at, tag->name, tag->words)) return;
    if (tag->name == "tree") file_.tree_ends = document_.find_attribute(at, "ends")->value == "yes";
    if (tag->name == "fact") read_fact(at);
    if (tag->name == "leaf") read_leaf(at);
    if (tag->name == "accept") {
      const Attribute& finding = *document_.find_attribute(at, "finding");
      file_.accepted.push_back({std::string(finding.value),
                                std::string(document_.find_attribute(at, "because")->value),
                                finding.place});
    }
  }

  bool check_words(std::uint32_t at, std::string_view tag, std::span<const Word> words) {
    const std::string_view open = tag == "leaf" ? leaf_words::kOutput : std::string_view();
    return host::check_words(document_, at, open, words, report_);
  }

  void read_fact(std::uint32_t at) {
    FactRow fact;
    const Attribute& name = *document_.find_attribute(at, "name");
    fact.name = name.value;
    fact.place = name.place;
    if (std::ranges::find(file_.facts, fact.name, &FactRow::name) != file_.facts.end()) {
      report_.at_value(name.place, fmt::format("fact '{}' is declared twice", brief(name.value)));
    }
    if (const Attribute* changes = document_.find_attribute(at, "changes")) {
      constexpr std::array<std::string_view, 4> kWords{"never", "freely", "rises", "falls"};
      fact.changes =
          static_cast<Changes>(std::ranges::find(kWords, changes->value) - kWords.begin());
    }
    file_.facts.push_back(std::move(fact));
  }

  void read_leaf(std::uint32_t at) {
    LeafRow row;
    row.place = document_.elements()[at].place;
    for (const Attribute& it : document_.attributes(at)) read_leaf(it, row);
    if (row.of.empty() == row.path.empty()) {
      report_.at(document_.elements()[at].place, "give exactly one of 'of' and 'path'");
      return;
    }
    file_.leaves.push_back(std::move(row));
  }

  void read_leaf(const Attribute& it, LeafRow& row) {
    const std::string_view name = it.name, value = it.value;
    if (name == "of" || name == "path") {
      (name == "of" ? row.of : row.path) = value;
      row.place = it.place;
    } else if (name == "result") {
      row.results = results(it);
    } else if (name == "ticks") {
      row.ticks = range(it, 1, "1..5, 3 or 2..inf");
    } else if (name == "ends") {
      row.ends = value == "yes";
    } else if (name == "progress") {
      row.progress = progress(it);
    } else if (name == "step") {
      row.step = range(it, std::nullopt, "0..2, 1 or 0..inf");
    } else if (name == "finish") {
      row.finishes_full = value == "full";
    } else if (name == "held") {
      row.held = value == "still" ? WholeRange{0, 0} : range(it, std::nullopt, "still or -1..0");
      if (!row.held->most) report_.at_value(it.place, "'held' has no end", "still or -1..0");
    } else if (name == "writes") {
      row.writes = value == "start"  ? Writes::AtStart
                   : value == "tick" ? Writes::InEachTick
                                     : Writes::OnSuccess;
    } else if (name == "fact") {
      row.fact = LeafRow::Named{std::string(value), "", it.place};
    } else if (name == "sets") {
      for (const std::string_view part : split(value, ";")) read_set(it, part, row);
    } else if (name.starts_with(leaf_words::kOutput)) {
      row.outputs.push_back(
          {std::string(name.substr(leaf_words::kOutput.size())), std::string(value), it.place});
    }
  }

  void read_set(const Attribute& it, std::string_view part, LeafRow& row) {
    const auto sign = part.find('=');
    const std::string_view to = sign == std::string_view::npos ? "" : part.substr(sign + 1);
    if (to == "true" || to == "false") {
      row.sets.push_back({std::string(part.substr(0, sign)), std::string(to), it.place});
    } else {
      report_.at_value(it.place,
                       fmt::format("'{}' does not say what becomes of a fact", brief(part)),
                       "write charged=true, or charged=true;seen=false");
    }
  }

  std::optional<ResultSet> results(const Attribute& it) {
    constexpr std::array<std::string_view, 4> kWords{"success", "failure", "skipped", "fault"};
    std::array<bool, 4> has{};
    for (const std::string_view part : split(it.value, ";")) {
      const auto* const word = std::ranges::find(kWords, part);
      if (word == kWords.end()) {
        report_.at_value(it.place, fmt::format("'{}' is no result", brief(part)),
                         suggest(part, kWords, "results"));
        return std::nullopt;
      }
      has[static_cast<std::size_t>(word - kWords.begin())] = true;
    }
    return ResultSet{has[0], has[1], has[2], has[3]};
  }

  WholeRange range(const Attribute& it, std::optional<std::int64_t> least, std::string_view as) {
    constexpr std::int64_t kMost = 1'000'000;
    const auto range = parse_range(it.value);
    const bool fits = range && std::abs(range->least) <= kMost &&
                      (!least || range->least >= *least) &&
                      std::abs(range->most.value_or(0)) <= kMost;
    if (fits) return *range;
    report_.at_value(it.place, fmt::format("'{}' is no range", brief(it.value)),
                     fmt::format("write {}", as));
    return {1, std::nullopt};
  }

  std::optional<ProgressWay> progress(const Attribute& it) {
    constexpr std::int64_t kMost = 1000;
    if (it.value == "none") return ProgressWay{ProgressWay::Kind::None, 0};
    if (it.value == "cuts") return ProgressWay{ProgressWay::Kind::Cuts, 0};
    constexpr std::string_view kGrid = "grid:";
    const auto parts =
        it.value.starts_with(kGrid) ? parse_int(it.value.substr(kGrid.size())) : std::nullopt;
    if (parts && *parts >= 1 && *parts <= kMost) {
      return ProgressWay{ProgressWay::Kind::Grid, static_cast<std::uint32_t>(*parts)};
    }
    report_.at_value(it.place, fmt::format("'{}' is no kind of progress", brief(it.value)),
                     "write none, cuts, or grid:10 (at most 1000 parts)");
    return std::nullopt;
  }

  const Document& document_;
  LeafFile& file_;
  const Reporter report_;
};

}  // namespace

std::unique_ptr<LeafFile> read_leaf_file(std::string path, std::string text,
                                         Diagnostics& diagnostics) {
  const auto document = Document::parse(std::move(path), std::move(text), diagnostics);
  if (document == nullptr) return nullptr;
  auto file = std::make_unique<LeafFile>();
  file->sources.add(document->source());
  return Reader(*document, *file, diagnostics).read() ? std::move(file) : nullptr;
}

std::unique_ptr<LeafFile> load_leaf_file(const std::string& path, Diagnostics& diagnostics) {
  constexpr std::size_t kMost = std::size_t{16} << 20u;
  auto text = read_file(path, kMost);
  if (text) return read_leaf_file(path, std::move(*text), diagnostics);
  diagnostics.error({path}, "cannot be read: " + text.error().message, text.error().hint);
  return nullptr;
}

}  // namespace lockstep::host
