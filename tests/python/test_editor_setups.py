# SPDX-License-Identifier: BSD-3-Clause
"""What docs/editors.md says of Neovim and Emacs, tried in them where they are at hand."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from reference_decks import ROOT
from test_editor_words import GUIDE

pytest.importorskip("pygls")
PAGE = (ROOT / "docs" / "editors.md").read_text(encoding="utf-8")
PATIENCE = 60

NEOVIM = """
local function wait(what, found)
  io.stdout:write(what, " ", tostring(vim.wait(20000, found, 50)), "\\n")
end
local function has(words)
  return function()
    for _, one in ipairs(vim.diagnostic.get(0)) do
      if one.message:find(words, 1, true) then return true end
    end
    return false
  end
end
vim.ui.select = function(items, _, take) take(items[1], 1) end
wait("verdict", has("over-constrained by 1; "))
vim.api.nvim_win_set_cursor(0, { 13, 5 })
vim.lsp.buf.definition()
wait("definition", function() return vim.api.nvim_win_get_cursor(0)[1] == 4 end)
vim.api.nvim_buf_set_lines(0, 9, 10, false, { "FIXX 6" })
wait("problem", has("FIXX is not a keyword"))
vim.api.nvim_win_set_cursor(0, { 10, 0 })
vim.lsp.buf.code_action()
wait("mended", function() return vim.api.nvim_buf_get_lines(0, 9, 10, false)[1] == "FIX 6" end)
wait("verdict again", has("over-constrained by 1; "))
vim.api.nvim_win_set_cursor(0, { 1, 0 })
vim.lsp.buf.code_action()
wait("exact", has("exactly constrained; "))
vim.cmd("qa!")
"""
EMACS = """
(require 'cl-lib)
(defun wait-for (what found)
  (let ((tries 0) (got nil))
    (while (and (not (setq got (funcall found))) (< (setq tries (1+ tries)) 300))
      (accept-process-output nil 0.05) (flymake-start) (sit-for 0.01))
    (princ (format "%s %s\\n" what (if got t nil)))))
(defun has (words)
  (cl-find-if (lambda (one) (string-match-p (regexp-quote words) (flymake-diagnostic-text one)))
              (flymake-diagnostics)))
(setq eglot-sync-connect t)
(find-file "guide.dat")
(apply #'eglot--connect (eglot--guess-contact))
(eglot--maybe-activate-editing-mode)
(wait-for "verdict" (lambda () (has "over-constrained by 1; ")))
(goto-char (point-min))
(search-forward "DYNX ")
(princ (format "definition %s\\n"
  (= 4 (xref-location-line (xref-item-location (car (xref-backend-definitions 'eglot "3")))))))
(goto-char (point-min))
(forward-line 9)
(insert "X")
(eglot--signal-textDocument/didChange)
(wait-for "problem" (lambda () (has "XFIX is not a keyword")))
(set-buffer-modified-p nil)
(kill-emacs 0)
"""


def shown(language: str) -> str:
    (block,) = re.findall(rf"^```{language}\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)
    return str(block)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """With a deck, a home of its own, and the command on the PATH."""
    (tmp_path / "guide.dat").write_text(GUIDE)
    (tmp_path / ".emacs.d").mkdir()
    (tmp_path / ".git").mkdir()
    command = tmp_path / "bin" / "flexact"
    command.parent.mkdir()
    command.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m flexact "$@"\n')
    command.chmod(0o755)
    monkeypatch.setenv("PATH", f"{command.parent}{os.pathsep}{os.environ['PATH']}")
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def answers(command: list[str]) -> dict[str, str]:
    """The last word of each line by what stands before it."""
    ended = subprocess.run(
        command,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
        stdin=subprocess.DEVNULL,
    )
    lines = (line.strip().rpartition(" ") for line in ended.stdout.splitlines())
    found = {what: said for what, _, said in lines}
    assert found, ended.stderr
    return found


@pytest.mark.posix
def test_neovim(folder: Path) -> None:
    neovim = shutil.which("nvim")
    if neovim is None:
        pytest.skip("Neovim is not installed")
    (folder / "init.lua").write_text(shown("lua"))
    (folder / "try.lua").write_text(NEOVIM)
    ended = [neovim, "--clean", "--headless", "-u", "init.lua"]
    found = answers([*ended, "guide.dat", "-c", "luafile try.lua"])
    asked = ("verdict", "definition", "problem", "mended", "verdict again", "exact")
    assert {what: found.get(what) for what in asked} == dict.fromkeys(asked, "true")


@pytest.mark.posix
def test_emacs(folder: Path) -> None:
    emacs = shutil.which("emacs")
    if emacs is None:
        pytest.skip("Emacs is not installed")
    # Debian keeps packages apart from Emacs, each in a folder with its version.
    apart = sorted(Path("/usr/share/emacs/site-lisp/elpa").glob("*-[0-9]*"))
    batch = [emacs, "-Q", "--batch", *(word for path in apart for word in ("-L", str(path)))]
    loads = [*batch, "-l", "eglot"]
    if subprocess.run(loads, capture_output=True, timeout=PATIENCE, check=False).returncode:
        pytest.skip("eglot is not installed")
    (folder / "init.el").write_text(shown("elisp"))
    (folder / "try.el").write_text(EMACS)
    found = answers([*loads, "-l", "init.el", "-l", "try.el"])
    asked = ("verdict", "definition", "problem")
    assert {what: found.get(what) for what in asked} == dict.fromkeys(asked, "t")
