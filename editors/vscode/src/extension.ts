// SPDX-License-Identifier: BSD-3-Clause
// Starts flexact lsp for decks, and shows the verdict in the status bar.

import * as vscode from "vscode";
import { LanguageClient } from "vscode-languageclient/node";

/** What the server says of a deck, in messages flexact/verdict. */
interface Verdict {
  uri: string;
  words: string;
  verdict: string | null;
  errors: number;
}

const LANGUAGE = "flexact-deck";
let client: LanguageClient | undefined;

export async function activate(context: vscode.ExtensionContext): Promise<void> {
  const status = vscode.window.createStatusBarItem(vscode.StatusBarAlignment.Left, 10);
  status.command = "workbench.actions.view.problems";
  const verdicts = new Map<string, Verdict>();

  const show = (): void => {
    const document = vscode.window.activeTextEditor?.document;
    if (document?.languageId !== LANGUAGE) {
      status.hide();
      return;
    }
    const said = verdicts.get(document.uri.toString());
    if (said === undefined || (said.errors === 0 && said.words === "")) {
      status.text = "$(sync~spin) Flexact";
    } else if (said.errors > 0) {
      status.text = `$(error) ${said.errors} error${said.errors > 1 ? "s" : ""}`;
    } else {
      const sign = said.verdict === "exactly constrained" ? "check" : "warning";
      status.text = `$(${sign}) ${said.words}`;
    }
    status.tooltip = said?.words || "The verdict comes when typing rests.";
    status.show();
  };

  const start = async (): Promise<void> => {
    await client?.stop();
    verdicts.clear();
    const [command, ...args] = vscode.workspace
      .getConfiguration("flexact")
      .get<string[]>("command", ["flexact", "lsp"]);
    client = new LanguageClient(
      "flexact",
      "Flexact",
      { command, args },
      {
        documentSelector: [{ language: LANGUAGE }],
        initializationOptions: { verdict: true },
      },
    );
    client.onNotification("flexact/verdict", (said: Verdict) => {
      verdicts.set(vscode.Uri.parse(said.uri).toString(), said);
      show();
    });
    try {
      await client.start();
    } catch (error) {
      client = undefined;
      void vscode.window.showErrorMessage(
        `${command} could not be started: ${String(error)}. ` +
          "Install it with pip install 'flexact[editor]', or say in the setting flexact.command where it is.",
      );
    }
  };

  context.subscriptions.push(
    status,
    vscode.commands.registerCommand("flexact.restart", start),
    vscode.window.onDidChangeActiveTextEditor(show),
    vscode.workspace.onDidCloseTextDocument((document) => verdicts.delete(document.uri.toString())),
    vscode.workspace.onDidChangeConfiguration((change) => {
      if (change.affectsConfiguration("flexact.command")) void start();
    }),
  );
  show();
  await start();
}

export async function deactivate(): Promise<void> {
  await client?.stop();
}
