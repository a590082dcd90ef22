// Verdicts for other programs: what a workflow shows as tests.
#include <fmt/format.h>

#include "base/core/wording.h"
#include "cli/tools/verify/verify_report.h"
#include "describe/xsd.h"

namespace lockstep::host {
namespace {

std::string in_xml(std::string_view text) {
  return xsd_escaped(printable(text));
}

std::string why(const Finding& finding) {
  return joined(finding.more, "\n");
}

}  // namespace

// A test for each line of the verdict that says something, and for each finding.
std::string to_junit(const VerifyReport& report) {
  const std::string suite = in_xml("verify " + report.tree);
  std::string tests;
  std::size_t count = 0, failures = 0, skipped = 0;
  const auto add = [&](std::string_view name, std::string_view inside) {
    ++count;
    tests += fmt::format("    <testcase classname=\"{}\" name=\"{}\"", suite, in_xml(name));
    tests += inside.empty() ? "/>\n" : fmt::format(">{}</testcase>\n", inside);
  };
  for (const VerdictLine& it : report.verdict.facts) {
    if (it.is_good) add(it.name, "");
  }
  for (const Finding& it : report.verdict.findings) {
    if (it.accepted.empty()) {
      ++failures;
      add(it.name,
          fmt::format("<failure message=\"{}\">{}</failure>", in_xml(it.message), in_xml(why(it))));
    } else {
      ++skipped;
      add(it.name, fmt::format("<skipped message=\"{}\"/>", in_xml("accepted: " + it.accepted)));
    }
  }
  if (!report.internal_error.empty()) {
    ++failures;
    add("internal error", fmt::format("<failure message=\"{}\"/>", in_xml(report.internal_error)));
  } else if (!report.found.is_proof()) {
    ++skipped;
    add("all behaviors", fmt::format("<skipped message=\"{}\"/>", in_xml(conclusion(report))));
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
      "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" skipped=\"{}\" time=\"{:.3f}\">\n"
      "{}  </testsuite>\n</testsuites>\n",
      suite, count, failures, skipped, to_seconds(report.found.took), tests);
}

}  // namespace lockstep::host
