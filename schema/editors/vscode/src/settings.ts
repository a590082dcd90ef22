// The settings of the workspace, as the server and the command line take them.
import { existsSync } from "node:fs";
import { isAbsolute, join } from "node:path";
import { Uri, workspace } from "vscode";

function folderOf(file?: Uri): string | undefined {
  const folder = file === undefined ? undefined : workspace.getWorkspaceFolder(file);
  return (folder ?? workspace.workspaceFolders?.[0])?.uri.fsPath;
}

function inFolder(path: string, folder: string | undefined): string {
  return isAbsolute(path) || folder === undefined ? path : join(folder, path);
}

export function program(file?: Uri): string {
  const name = workspace.getConfiguration("lockstep", file).get("program", "lockstep");
  return name.includes("/") ? inFolder(name, folderOf(file)) : name;
}

export interface ServerSettings {
  trusted: boolean;
  plugins: string[];
  pluginPath: string[];
  arguments: Record<string, string>;
}

// A directory that is not there yet, as that of a build, is no mistake.
export function serverSettings(file?: Uri): ServerSettings {
  const settings = workspace.getConfiguration("lockstep", file);
  const folder = folderOf(file);
  return {
    trusted: workspace.isTrusted && settings.get("loadPlugins", true),
    plugins: settings.get<string[]>("plugins", []).map((it) => (it.includes("/") ? inFolder(it, folder) : it)),
    pluginPath: settings.get<string[]>("pluginPath", []).map((it) => inFolder(it, folder)).filter((it) => existsSync(it)),
    arguments: settings.get<Record<string, string>>("arguments", {}),
  };
}

// The same as options of a command that runs trees.
export function pluginOptions(file: Uri): string[] {
  const settings = serverSettings(file);
  return [
    ...settings.pluginPath.flatMap((it) => ["--plugin-path", it]),
    ...settings.plugins.flatMap((it) => ["--plugin", it]),
  ];
}

export function argumentOptions(file: Uri): string[] {
  return Object.entries(serverSettings(file).arguments).flatMap(([name, value]) => ["--arg", `${name}=${value}`]);
}

export function workingDirectory(file: Uri): string | undefined {
  return folderOf(file);
}
