#include "study/totals_text.h"

#include <algorithm>

#include "base/json/json.h"
#include "base/json/reader.h"

namespace lockstep::host {
namespace {

Json bucket_json(const QuantileSketch::Bucket& it) {
  std::vector<Json> items{it.low};
  if (it.low != it.high) items.emplace_back(it.high);
  items.emplace_back(it.count);
  return Json::array(std::move(items));
}

Json column_totals_json(const CellTotals::Column& column) {
  Json buckets = Json::array();
  for (const auto& bucket : column.values.buckets()) buckets.push_back(bucket_json(bucket));
  return {{"sum", column.sum.text()}, {"buckets", std::move(buckets)}};
}

QuantileSketch::Bucket bucket_from(JsonValue value) {
  const std::size_t items = value.count_items();
  QuantileSketch::Bucket bucket;
  std::size_t item = 0;
  value.each_item([&](JsonValue number) {
    if (item + 1 == items) {
      bucket.count = number.whole();
    } else {
      bucket.high = number.number();
      if (item == 0) bucket.low = bucket.high;
    }
    ++item;
  });
  return bucket;
}

CellTotals::Column totals_from(JsonObject json) {
  CellTotals::Column column;
  const auto read_sum = [&](JsonValue value) {
    const auto sum = ExactSum::from(value.text());
    if (!sum) throw JsonError("'sum' is not how a sum is written");
    column.sum = *sum;
  };
  const auto read_buckets = [&](JsonValue value) {
    value.each_item([&](JsonValue item) {
      if (!column.values.add(bucket_from(item))) throw JsonError("a bucket cannot be one");
    });
  };
  json.read({{"sum", read_sum}, {"buckets", read_buckets}});
  return column;
}

// The runs of this part.
bool is_possible(const CellTotals& totals, const StudyPlan& plan, std::uint64_t cell,
                 bool is_whole) {
  const ResultCounts& results = totals.results();
  const std::uint64_t all = runs_of_part(plan);
  if (results.runs == 0 || results.runs > all || (is_whole && results.runs != all)) return false;
  if (totals.columns().size() != plan.columns.size()) return false;
  for (std::size_t i = 0; i < plan.columns.size(); ++i) {
    const std::uint64_t most = has_column(plan.columns[i], cell) ? results.runs : 0;
    if (totals.columns()[i].values.count() > most) return false;
  }
  return true;
}

}  // namespace

std::string totals_line(std::uint64_t cell, const CellTotals& totals) {
  Json columns = Json::array();
  for (const auto& column : totals.columns()) columns.push_back(column_totals_json(column));
  Json json{{"cell", cell}};
  for (std::size_t i = 0; i < kResultNames.size(); ++i)
    json.add(std::string(kResultNames[i]), totals.results().of[i]);
  json.add("columns", std::move(columns));
  return json.text() + '\n';
}

Result<CellTotals> read_totals_line(std::string line, const StudyPlan& plan, std::uint64_t cell,
                                    bool is_whole) {
  ResultCounts results;
  std::vector<CellTotals::Column> columns;
  const auto read_columns = [&](JsonValue value) {
    value.each_item([&](JsonValue item) { columns.push_back(totals_from(item.object())); });
  };
  try {
    JsonReader().read(line, [&](JsonObject json) {
      json.read({{kResultNames[0], into(results.of[0])},
                 {kResultNames[1], into(results.of[1])},
                 {kResultNames[2], into(results.of[2])},
                 {"columns", read_columns}});
    });
  } catch (const JsonError& bad) {
    return problem(bad.what());
  }
  for (const std::uint64_t count : results.of) results.runs += count;
  CellTotals totals(results, std::move(columns));
  // Also keys that are not known, numbers that are written in another way, another cell.
  if (!is_possible(totals, plan, cell, is_whole) || totals_line(cell, totals) != line)
    return problem("not what lockstep wrote");
  return totals;
}

}  // namespace lockstep::host
