# SPDX-License-Identifier: BSD-3-Clause
"""Run the notebooks of docs/gallery, and write each with its outputs, and as a page with pictures.

Called by `make gallery`. Nothing of Jupyter is needed: cells are run one after the other, and what
the last expression of one gives is shown as a notebook shows it.
"""

import ast
import base64
import contextlib
import io
import json
from pathlib import Path
from typing import Any

GALLERY = Path(__file__).resolve().parents[1] / "docs" / "gallery"


def notebooks() -> list[Path]:
    """The notebooks, in the order of their names."""
    return sorted(GALLERY.glob("*.ipynb"))


def cells_of(notebook: Path) -> list[dict[str, Any]]:
    """The cells of a notebook."""
    cells: list[dict[str, Any]] = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    return cells


def source_of(cell: dict[str, Any]) -> str:
    """What stands in a cell."""
    return "".join(cell["source"])


def title_of(notebook: Path) -> str:
    """The heading of the first cell."""
    return source_of(cells_of(notebook)[0]).splitlines()[0].removeprefix("# ")


def run(code: str, names: dict[str, Any]) -> list[dict[str, Any]]:
    """Run a cell and give its outputs, as a notebook has them."""
    tree = ast.parse(code)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    said, value = io.StringIO(), None
    with contextlib.redirect_stdout(said):
        exec(compile(tree, "cell", "exec"), names)
        if isinstance(last, ast.Expr):
            value = eval(compile(ast.Expression(last.value), "cell", "eval"), names)
    outputs: list[dict[str, Any]] = []
    if said.getvalue():
        text = said.getvalue().splitlines(keepends=True)
        outputs.append({"name": "stdout", "output_type": "stream", "text": text})
    if value is not None:
        data: dict[str, Any] = {"text/plain": [type(value).__name__]}
        if hasattr(value, "_repr_png_"):
            data["image/png"] = base64.b64encode(value._repr_png_()).decode()
        else:
            data["text/plain"] = repr(value).splitlines(keepends=True)
        outputs.append({"data": data, "metadata": {}, "output_type": "display_data"})
    return outputs


def executed(notebook: Path) -> dict[str, Any]:
    """The notebook with the outputs of all its cells."""
    made: dict[str, Any] = json.loads(notebook.read_text(encoding="utf-8"))
    names: dict[str, Any] = {"__name__": "__main__"}
    number = 0
    for cell in made["cells"]:
        if cell["cell_type"] == "code":
            number += 1
            cell["execution_count"] = number
            cell["outputs"] = run(source_of(cell), names)
    return made


def page_of(made: dict[str, Any], stem: str) -> tuple[str, dict[str, bytes]]:
    """The page of a notebook, and its pictures by the names of their files."""
    parts: list[str] = []
    pictures: dict[str, bytes] = {}
    for cell in made["cells"]:
        if cell["cell_type"] == "markdown":
            parts.append(source_of(cell).strip())
            continue
        parts.append(f"```python\n{source_of(cell).strip()}\n```")
        for output in cell["outputs"]:
            picture = output.get("data", {}).get("image/png")
            if picture is not None:
                name = f"{stem}.png" if not pictures else f"{stem}_{len(pictures) + 1}.png"
                pictures[name] = base64.b64decode(picture)
                parts.append(f"![{source_of(made['cells'][0]).splitlines()[0][2:]}]({name})")
                continue
            lines = "".join(output.get("text") or output["data"]["text/plain"]).splitlines()
            parts.append("\n".join(f"    {line}".rstrip() for line in lines))
    parts.append(f"[The notebook]({stem}.ipynb)")
    return "\n\n".join(parts) + "\n", pictures


def main() -> None:
    """Run all notebooks and write them and their pages."""
    for notebook in notebooks():
        made = executed(notebook)
        page, pictures = page_of(made, notebook.stem)
        text = json.dumps(made, indent=1, ensure_ascii=False) + "\n"
        notebook.write_text(text, encoding="utf-8")
        notebook.with_suffix(".md").write_text(page, encoding="utf-8")
        for name, data in pictures.items():
            (GALLERY / name).write_bytes(data)
        print(f"{notebook.stem}: {len(pictures)} pictures")


if __name__ == "__main__":
    main()
