// Commands of the palette and of code lenses: a lens gives the file, and what in it is meant.
import { ProcessExecution, Task, TaskPanelKind, TaskRevealKind, TaskScope, tasks, Uri, window, workspace } from "vscode";
import { argumentOptions, commandOptions, program, workingDirectory } from "./settings";

// The file of a lens, as a URI or a path, else that of the editor; saved, since a command reads it.
export async function savedFile(given?: unknown): Promise<Uri | undefined> {
  const file = fileOf(given) ?? window.activeTextEditor?.document.uri;
  if (file?.scheme !== "file") {
    void window.showErrorMessage("lockstep: save the file first, then run it.");
    return undefined;
  }
  const document = workspace.textDocuments.find((it) => it.uri.toString() === file.toString());
  return document === undefined || (await document.save()) ? file : undefined;
}

function fileOf(given: unknown): Uri | undefined {
  if (given instanceof Uri) return given;
  if (typeof given !== "string") return undefined;
  return given.startsWith("file:") ? Uri.parse(given) : Uri.file(given);
}

// Shows the command in a terminal, which stays when it has ended.
async function inTerminal(words: string[], file: Uri): Promise<void> {
  const task = new Task(
    { type: "lockstep" },
    workspace.workspaceFolders === undefined ? TaskScope.Global : TaskScope.Workspace,
    words[0],
    "lockstep",
    new ProcessExecution(program(file), words, { cwd: workingDirectory(file) }),
  );
  task.presentationOptions = { reveal: TaskRevealKind.Always, panel: TaskPanelKind.Dedicated, clear: true };
  await tasks.executeTask(task);
}

const treeOption = (tree: unknown) => (typeof tree === "string" ? ["--tree", tree] : []);

export async function test(given?: unknown, scenario?: unknown): Promise<void> {
  const file = await savedFile(given);
  if (file === undefined) return;
  const filter = typeof scenario === "string" ? ["--filter", scenario] : [];
  await inTerminal(["test", file.fsPath, ...filter, ...commandOptions(file)], file);
}

export async function verify(given?: unknown, tree?: unknown): Promise<void> {
  const file = await savedFile(given);
  if (file === undefined) return;
  await inTerminal(["verify", file.fsPath, ...treeOption(tree), ...argumentOptions(file), ...commandOptions(file)], file);
}

export async function monitor(given?: unknown, tree?: unknown): Promise<void> {
  const file = await savedFile(given);
  if (file === undefined) return;
  const options = ["--monitor", "--monitor-open", ...treeOption(tree), ...argumentOptions(file), ...commandOptions(file)];
  await inTerminal(["run", file.fsPath, ...options], file);
}
