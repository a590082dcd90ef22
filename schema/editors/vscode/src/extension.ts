import { commands, ExtensionContext, TextEditor, window } from "vscode";
import { LanguageClient } from "vscode-languageclient/node";
import { makeClient, watchSettings } from "./client";
import * as run from "./commands";
import { RunView } from "./run_view";
import { program } from "./settings";
import { isTree } from "./trees";

let client: LanguageClient | undefined;

async function start(): Promise<void> {
  client = makeClient();
  try {
    await client.start();
  } catch {
    const choice = await window.showErrorMessage(
      `lockstep: '${program()}' cannot be started as a language server. Install lockstep, or say where it is.`, "Settings");
    if (choice === "Settings") await commands.executeCommand("workbench.action.openSettings", "lockstep.program");
  }
}

async function restart(): Promise<void> {
  await deactivate();
  await start();
}

function followEditor(editor: TextEditor | undefined): void {
  const shows = editor !== undefined && editor.document.languageId === "xml" && isTree(editor.document.getText());
  void commands.executeCommand("setContext", "lockstep.isTree", shows);
}

export async function activate(context: ExtensionContext): Promise<void> {
  const output = window.createOutputChannel("lockstep runs");
  const view = new RunView(output);
  context.subscriptions.push(
    output,
    commands.registerCommand("lockstep.run", (given?: unknown) => view.run(given)),
    commands.registerCommand("lockstep.test", run.test),
    commands.registerCommand("lockstep.verify", run.verify),
    commands.registerCommand("lockstep.monitor", run.monitor),
    commands.registerCommand("lockstep.restart", restart),
    window.onDidChangeActiveTextEditor(followEditor),
  );
  followEditor(window.activeTextEditor);
  await start();
  if (client !== undefined) context.subscriptions.push(watchSettings(() => client));
}

export async function deactivate(): Promise<void> {
  const ended = client;
  client = undefined;
  await ended?.dispose();
}
