// A stand-in for VS Code, which is not in Debian: the part that the extension uses, and a record of what was done with it.
import { pathToFileURL } from "node:url";

export class Uri {
  constructor(path) {
    Object.assign(this, { scheme: "file", fsPath: path });
  }
  static file = (path) => new Uri(path);
  static parse = (text) => new Uri(decodeURIComponent(new URL(text).pathname));
  toString = () => pathToFileURL(this.fsPath).href;
}

export const stub = { settings: {}, folder: "", tasks: [], errors: [], panels: [], saved: [], isTrusted: true };

export const workspace = {
  get isTrusted() {
    return stub.isTrusted;
  },
  get workspaceFolders() {
    return [{ uri: Uri.file(stub.folder) }];
  },
  get textDocuments() {
    return stub.documents.map((path) => ({ uri: Uri.file(path), save: async () => stub.saved.push(path) > 0 }));
  },
  getWorkspaceFolder: () => ({ uri: Uri.file(stub.folder) }),
  onDidChangeConfiguration: (told) => void (stub.changed = told),
  onDidGrantWorkspaceTrust: (told) => void (stub.granted = told),
  getConfiguration: () => ({ get: (name, otherwise) => stub.settings[name] ?? otherwise }),
};

export class ProcessExecution {
  constructor(program, words, options) {
    Object.assign(this, { program, words, options });
  }
}
export class Task {
  constructor(definition, scope, name, source, execution) {
    Object.assign(this, { definition, scope, name, source, execution });
  }
}
export const TaskScope = { Global: 1, Workspace: 2 }, TaskRevealKind = { Always: 1 }, TaskPanelKind = { Dedicated: 2 };
export const ViewColumn = { Beside: -2 }, ProgressLocation = { Notification: 15 };
export const tasks = { executeTask: async (task) => stub.tasks.push(task) };
export const window = {
  get activeTextEditor() {
    return stub.active === undefined ? undefined : { document: { uri: Uri.file(stub.active) } };
  },
  showErrorMessage: async (text) => void stub.errors.push(text),
  withProgress: (_, work) => work({ report() {} }, { onCancellationRequested() {} }),
  createWebviewPanel(kind, title, place, options) {
    const panel = { kind, title, place, options, webview: { html: "" }, onDidDispose() {}, reveal() {} };
    stub.panels.push(panel);
    return panel;
  },
};
export const Disposable = { from() {} };

// The part of vscode-languageclient.
export const DidOpenTextDocumentNotification = { type: "didOpen" };
export class LanguageClient {}
