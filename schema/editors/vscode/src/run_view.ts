// A run on the virtual clock, shown beside the text as the page of its recording.
import { execFile } from "node:child_process";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { OutputChannel, ProgressLocation, Uri, ViewColumn, WebviewPanel, window } from "vscode";
import { savedFile, treeOption } from "./commands";
import { argumentOptions, pluginOptions, program, workingDirectory } from "./settings";

interface Ended {
  code: number;
  messages: string;
}

function execute(words: string[], file: Uri, signal: AbortSignal): Promise<Ended> {
  const options = { cwd: workingDirectory(file), signal, maxBuffer: 64 << 20 };
  return new Promise((resolve) => {
    execFile(program(file), words, options, (error, out, messages) => {
      const code = typeof error?.code === "number" ? error.code : error === null ? 0 : -1;
      resolve({ code, messages: messages + out + (code === -1 ? `${error?.message}\n` : "") });
    });
  });
}

export class RunView {
  private readonly panels = new Map<string, WebviewPanel>();

  constructor(private readonly output: OutputChannel) {}

  async run(given?: unknown): Promise<void> {
    const file = await savedFile(given);
    if (file === undefined) return;
    const title = `Run of ${basename(file.fsPath)}`;
    await window.withProgress({ location: ProgressLocation.Notification, title, cancellable: true }, async (_, cancel) => {
      const abort = new AbortController();
      cancel.onCancellationRequested(() => abort.abort());
      await this.show(file, treeOption(given), abort.signal);
    });
  }

  private async show(file: Uri, tree: string[], signal: AbortSignal): Promise<void> {
    const folder = await mkdtemp(join(tmpdir(), "lockstep-"));
    try {
      const recording = join(folder, "run.jsonl");
      const page = join(folder, "run.html");
      const options = [...tree, ...argumentOptions(file), ...pluginOptions(file)];
      const ended = await execute(
        ["run", file.fsPath, "--clock", "virtual", "--view", "plain", "--record", recording, ...options], file, signal);
      if (signal.aborted) return;
      this.output.append(ended.messages);
      const made = await execute(["log", "page", recording, "--out", page], file, signal);
      if (made.code === 0) {
        this.panel(file).webview.html = await readFile(page, "utf8");
      } else {
        this.output.show(true); // no run: the tree or a plugin was refused
        void window.showErrorMessage(`lockstep: there was no run; see the output of lockstep (exit code ${ended.code}).`);
      }
    } finally {
      await rm(folder, { recursive: true, force: true });
    }
  }

  // One for each file, beside its text.
  private panel(file: Uri): WebviewPanel {
    const key = file.toString();
    const known = this.panels.get(key);
    if (known !== undefined) {
      known.reveal(undefined, true);
      return known;
    }
    const panel = window.createWebviewPanel(
      "lockstep.run", `Run of ${basename(file.fsPath)}`, { viewColumn: ViewColumn.Beside, preserveFocus: true },
      { enableScripts: true, localResourceRoots: [], retainContextWhenHidden: true });
    panel.onDidDispose(() => this.panels.delete(key));
    this.panels.set(key, panel);
    return panel;
  }
}
