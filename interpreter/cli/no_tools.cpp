// In place of the commands that a build without tools leaves out.
#include "cli/command.h"

namespace lockstep::host {

extern const Command kShowCommand = absent("show"), kDiffCommand = absent("diff"),
                     kNodesCommand = absent("nodes"), kSchemaCommand = absent("schema"),
                     kConvertCommand = absent("convert"), kPluginCommand = absent("plugin"),
                     kLogCommand = absent("log"), kCheckpointCommand = absent("checkpoint"),
                     kReplayCommand = absent("replay"), kStudyCommand = absent("study"),
                     kVerifyCommand = absent("verify"), kTestCommand = absent("test"),
                     kTeamCommand = absent("team"), kNewCommand = absent("new"),
                     kFmtCommand = absent("fmt"), kLspCommand = absent("lsp"),
                     kMcpCommand = absent("mcp"), kCompletionCommand = absent("completion"),
                     kManualCommand = absent("manual"), kDocsCommand = absent("docs"),
                     kExamplesCommand = absent("examples");

}  // namespace lockstep::host
