// Commands of the palette, which are about the file of the editor, and of code lenses, which say what they are about.
import { ProcessExecution, Task, TaskPanelKind, TaskRevealKind, TaskScope, tasks, Uri, window, workspace } from "vscode";
import { argumentOptions, pluginOptions, program, workingDirectory } from "./settings";

// As the server's code lenses have it: a tree or a scenario of a file. Menus give a URI, the palette nothing.
export interface Lens {
  uri: string;
  name?: string;
}

export function nameOf(given: unknown): string | undefined {
  return isLens(given) ? given.name : undefined;
}

function isLens(given: unknown): given is Lens {
  return typeof given === "object" && given !== null && typeof (given as Lens).uri === "string";
}

function fileOf(given: unknown): Uri | undefined {
  if (given instanceof Uri) return given;
  return isLens(given) ? Uri.parse(given.uri) : window.activeTextEditor?.document.uri;
}

// The file of a command that runs trees, saved, since lockstep reads it. A code lens calls a command whatever package.json
// says of trust.
export async function savedFile(given: unknown): Promise<Uri | undefined> {
  if (!workspace.isTrusted) {
    void window.showErrorMessage("lockstep: a tree runs the code of plugins: trust the workspace first.");
    return undefined;
  }
  const file = fileOf(given);
  if (file?.scheme !== "file") {
    void window.showErrorMessage("lockstep: save the file first, then run it.");
    return undefined;
  }
  const document = workspace.textDocuments.find((it) => it.uri.toString() === file.toString());
  return document === undefined || (await document.save()) ? file : undefined;
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

export function treeOption(given: unknown): string[] {
  const tree = nameOf(given);
  return tree === undefined ? [] : ["--tree", tree];
}

export async function test(given?: unknown): Promise<void> {
  const file = await savedFile(given);
  if (file === undefined) return;
  const scenario = nameOf(given);
  const filter = scenario === undefined ? [] : ["--filter", scenario];
  await inTerminal(["test", file.fsPath, ...filter, ...pluginOptions(file)], file);
}

export async function verify(given?: unknown): Promise<void> {
  const file = await savedFile(given);
  if (file === undefined) return;
  await inTerminal(["verify", file.fsPath, ...treeOption(given), ...argumentOptions(file), ...pluginOptions(file)], file);
}

export async function monitor(given?: unknown): Promise<void> {
  const file = await savedFile(given);
  if (file === undefined) return;
  const options = ["--monitor", "--monitor-open", ...treeOption(given), ...argumentOptions(file), ...pluginOptions(file)];
  await inTerminal(["run", file.fsPath, ...options], file);
}
