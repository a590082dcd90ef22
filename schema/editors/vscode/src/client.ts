// The language server: `lockstep lsp`.
import { Disposable, TextDocument, workspace } from "vscode";
import { DidOpenTextDocumentNotification, LanguageClient, Middleware } from "vscode-languageclient/node";
import { program, serverSettings } from "./settings";
import { isLockstep } from "./trees";

// The server gets files that are lockstep's, also those that become one while they are written.
export function onlyLockstep(client: () => LanguageClient): Middleware {
  const open = new Set<string>();
  const begins = (document: TextDocument) => {
    const key = document.uri.toString();
    if (open.has(key) || !isLockstep(document.getText())) return false;
    open.add(key);
    return true;
  };
  return {
    didOpen: async (document, next) => {
      if (begins(document)) await next(document);
    },
    didChange: async (event, next) => {
      if (open.has(event.document.uri.toString())) return next(event);
      if (!begins(event.document)) return;
      const params = client().code2ProtocolConverter.asOpenTextDocumentParams(event.document);
      await client().sendNotification(DidOpenTextDocumentNotification.type, params);
    },
    didSave: async (document, next) => {
      if (open.has(document.uri.toString())) await next(document);
    },
    didClose: async (document, next) => {
      if (open.delete(document.uri.toString())) await next(document);
    },
  };
}

export function makeClient(): LanguageClient {
  const client: LanguageClient = new LanguageClient(
    "lockstep",
    "lockstep",
    { command: program(), args: ["lsp"] },
    {
      documentSelector: [
        { scheme: "file", language: "xml" },
        { scheme: "untitled", language: "xml" },
      ],
      initializationOptions: () => serverSettings(),
      middleware: onlyLockstep(() => client),
    },
  );
  return client;
}

// Settings that change, and the trust that the user grants.
export function watchSettings(client: () => LanguageClient | undefined): Disposable {
  const tell = async () => client()?.sendNotification("workspace/didChangeConfiguration", { settings: { lockstep: serverSettings() } });
  return Disposable.from(
    workspace.onDidChangeConfiguration((event) => {
      if (event.affectsConfiguration("lockstep")) void tell();
    }),
    workspace.onDidGrantWorkspaceTrust(() => void tell()),
  );
}
