#include "study/result_file.h"

namespace lockstep::host {

std::string_view result_file_name(StudyRows rows) {
  switch (rows) {
    case StudyRows::Csv:
      return "runs.csv";
    case StudyRows::Zst:
      return "runs.csv.zst";
    case StudyRows::None:
      break;
  }
  return "cells.jsonl";
}

std::unique_ptr<ResultFile> make_result_file(const ResultPlace& place) {
  switch (place.plan.rows) {
    case StudyRows::Csv:
      return plain_rows(place);
    case StudyRows::Zst:
      return compressed_rows(place);
    case StudyRows::None:
      break;
  }
  return totals_file(place);
}

}  // namespace lockstep::host
