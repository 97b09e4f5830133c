# SPDX-License-Identifier: BSD-3-Clause
"""What the site has besides docs/: a front page, live drawings, and pages of the Python names."""

from __future__ import annotations

import ast
import posixpath
import re
from pathlib import Path
from typing import Any

from mkdocs.structure.files import File, Files

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
GALLERY = "gallery/"
LIVE = "gallery/live/"
#: Pages of names, and the rooms of the package whose names they hold.
NAMES = {
    "models": ("Models and decks", ("deck", "model")),
    "analysis": ("Analysis, results, advice", ("api", "analysis", "advice", "util")),
    "stiffness": ("Stiffness and cost", ("elasticity", "costs")),
    "designs": ("Designs", ("designs",)),
    "sweeps": ("Sweeps, tracing, notebooks", ("sweeps", "tracing", "show")),
}


def repository() -> str:
    """The address of the project's source, of pyproject.toml."""
    text = (ROOT / "pyproject.toml").read_text("utf-8")
    found = re.search(r'^Source = "(.*)"$', text, re.MULTILINE)
    if not found:
        raise SystemExit("pyproject.toml has no Source in [project.urls].")
    return found[1]


def public_names() -> dict[str, list[str]]:
    """Public names by page, read from the package without importing it."""
    tree = ast.parse((ROOT / "python" / "flexact" / "__init__.py").read_text("utf-8"))
    found: dict[str, list[str]] = {page: [] for page in NAMES}
    homes = (node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.level)
    for node in homes:
        part = (node.module or "").split(".")[0]
        for page, (_, parts) in NAMES.items():
            if part in parts:
                found[page] += [each.name for each in node.names if each.name[0] != "_"]
    known = {name for names in found.values() for name in names}
    missing = set(exported(tree)) - known - {"__version__"}
    if missing:
        raise SystemExit(f"tools/site/hooks.py has no page for {sorted(missing)}.")
    return {page: sorted(set(names) & set(exported(tree))) for page, names in found.items()}


def exported(tree: ast.Module) -> list[str]:
    """The names of `__all__`."""
    for node in tree.body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
            names: list[str] = ast.literal_eval(node.value)
            return names
    raise SystemExit("The package has no __all__.")


def on_files(files: Files, config: Any) -> Files:
    """Add what is generated."""
    names = public_names()
    lines = [
        "# Python, name by name\n",
        "Made from the docstrings. [From Python](../python.md) tells it in order.\n",
    ]
    for page, (title, _) in NAMES.items():
        links = ", ".join(f"[`{name}`]({page}.md#flexact.{name})" for name in names[page])
        lines.append(f"- [{title}]({page}.md): {links}")
        entries = "\n\n".join(f"::: flexact.{name}" for name in names[page])
        files.append(File.generated(config, f"api/{page}.md", content=f"# {title}\n\n{entries}\n"))
    files.append(File.generated(config, "api/index.md", content="\n".join(lines) + "\n"))
    for name in ("site.css", "iframe-worker.js"):
        files.append(File.generated(config, name, abs_src_path=str(HERE / name)))
    for path in sorted((ROOT / "results" / "live").iterdir()):
        files.append(File.generated(config, LIVE + path.name, abs_src_path=str(path)))
    return files


def on_page_markdown(markdown: str, page: Any, config: Any, files: Files) -> str:
    """Links out of docs/ lead to the repository; pages of the gallery get their drawing."""
    source = page.file.src_uri
    folder = posixpath.dirname(source)

    def led(found: re.Match[str]) -> str:
        target = posixpath.normpath(posixpath.join("docs", folder, found[2]))
        if target.startswith("docs/") and files.get_file_from_path(target[5:]):
            return found[0]
        if not (ROOT / target).exists():
            return found[0]
        kind = "tree" if (ROOT / target).is_dir() else "blob"
        return f"{found[1]}{repository()}/{kind}/main/{target}"

    markdown = re.sub(r"(\]\()(?!https?:|#|mailto:)([^)#\s]+)", led, markdown)
    if source == "README.md":
        return (
            (HERE / "front.md").read_text("utf-8")
            + "\n"
            + markdown.replace("# Pages", "## Where to begin", 1)
        )
    stem = Path(source).stem
    if folder == "gallery" and (ROOT / "results" / "live" / f"{stem}.html").exists():
        picture = f"({stem}.png)\n"
        if picture not in markdown:
            raise SystemExit(
                f"{source} has no picture {stem}.png before which its drawing would stand."
            )
        title = re.findall(r"^# (.*)$", markdown, re.MULTILINE)[0]
        markdown = markdown.replace(
            picture, picture + "\n" + frame(f"live/{stem}.html", title) + "\n", 1
        )
    return markdown


def frame(address: str, title: str) -> str:
    """A drawing that is loaded when it comes into view, and a link to it alone."""
    return (
        f'<iframe class="live" loading="lazy" src="{address}" title="{title}, to turn and to move">'
        f'</iframe>\n\n<p><a href="{address}">Its page alone</a></p>\n'
    )


def on_post_build(config: Any) -> None:
    """Leave out the page for addresses that lead nowhere: from disk its links would, too."""
    (Path(config["site_dir"]) / "404.html").unlink(missing_ok=True)
