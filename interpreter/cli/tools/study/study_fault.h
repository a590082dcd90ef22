// The message about a leaf that failed in a study.
#pragma once

#include <string>

#include "cli/tools/study/study_loading.h"
#include "study/workers.h"

namespace lockstep::host {

// Which leaf, and in which run.
std::string fault_text(const StudyFault& fault, const LoadedStudy& study);
// The command line that shows the run again.
std::string run_command(const StudyOptions& options, const StudyPlan& plan,
                        const StudyFault& fault);

}  // namespace lockstep::host
