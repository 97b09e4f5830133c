# SPDX-License-Identifier: BSD-3-Clause
"""Files of other formats: tables as JSON and YAML, meshes of lines, and the command."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest
from reference_decks import NAMES, ROOT, truth_of
from reference_decks import text_of as deck_of

import flexact
from flexact.apps.cli.main import main
from flexact.apps.convert.files import bytes_of, read_any, read_tables, text_of
from flexact.apps.convert.mesh_files import MeshError, mesh_bytes, mesh_of, model_of_mesh
from flexact.apps.convert.tables import TablesError, tables_of
from flexact.util.errors import BatchError

BAR = "TRUSS 1 1 2 % bar\nX 2 1 0 0\nFIX 1\nFIX 2 2 3\n"
WRONG_JSON = b"""\
{
  "nodes": [[0, 0, 0],
            [1, 0, "x"]],
  "elements": [[1, 2]],
  "nprops": {"1": {"fix": "yes"}},
  "opt": {"rls": [
    {"def": 9}
  ]}
}
"""
WRONG_YAML = b"""\
nodes:
- [0, 0, 0]
- [1, 0, x]
elements: [[1, 2]]
nprops: {1: {fix: maybe}}
opt:
  rls:
  - def: 9
"""


@pytest.fixture
def deck(tmp_path: Path) -> Path:
    path = tmp_path / "bar.dat"
    path.write_text(BAR)
    return path


# Text of tables


@pytest.mark.parametrize(
    ("raw", "suffix", "places"),
    [
        (WRONG_JSON, ".json", [(3, 20, 22), (5, 27, 31), (7, 13, 13)]),
        (WRONG_YAML, ".yaml", [(3, 10, 10), (5, 19, 23), (8, 10, 10)]),
    ],
)
def test_mistakes_have_their_places(
    raw: bytes, suffix: str, places: list[Any], tmp_path: Path
) -> None:
    """Lines and columns were counted by hand."""
    path = tmp_path / f"wrong{suffix}"
    path.write_bytes(raw)
    with pytest.raises(TablesError) as error:
        read_any(path)
    items = error.value.diagnostics
    assert [(item.line, item.column, item.last_column) for item in items] == places
    assert [item.message.split(":")[0] for item in items] == [
        *("nodes[2][3]", "nprops[1].fix", "opt.rls[1].def")
    ]
    assert f"{path}:{places[0][0]}:{places[0][1]}" in str(error.value)


@pytest.mark.parametrize(
    ("raw", "suffix", "line"),
    [
        (b'{"nodes": [}', ".json", 1),
        (b'{"nodes": [],\n"nodes": []}', ".json", 0),
        (b"[1, 2]", ".json", 0),
        (b"", ".json", 1),
        (b'{"a": ' + b"[" * 100_000, ".json", 0),
        (b'{"a":\n"\xff"}', ".json", 2),
        (b"nodes: [", ".yaml", 1),
        (b"nodes: &a [1]\nelements: *a\n", ".yaml", 1),
        (b"nodes: 1\nnodes: 2\n", ".yaml", 2),
        (b"? [a]\n: 1\n", ".yaml", 1),
        (b"", ".yaml", 0),
        (b"a: 2001-99-99\n", ".yaml", 0),
        (b"a: !!python/object:os.system x\n", ".yaml", 1),
    ],
)
def test_what_is_no_table_is_told(raw: bytes, suffix: str, line: int) -> None:
    with pytest.raises(TablesError) as error:
        read_tables(raw, "tables", suffix)
    (item,) = error.value.diagnostics
    assert item.line == line


@pytest.mark.parametrize("depth", [10, 100, 300, 800, 3000])
def test_lists_in_lists_are_told(depth: int, tmp_path: Path) -> None:
    for suffix in (".json", ".yaml"):
        path = tmp_path / f"deep{suffix}"
        path.write_text('{"nodes": ' + "[" * depth + "]" * depth + ', "elements": [[1, 2]]}')
        with pytest.raises(TablesError):
            read_any(path)


@pytest.mark.parametrize("suffix", [".json", ".yaml"])
@pytest.mark.parametrize("name", ["paper/six_folded_sheets", "linkages/rssr"])
def test_text_reads_back_to_the_last_bit(name: str, suffix: str) -> None:
    tables = tables_of(flexact.read_text(deck_of(name)))
    again, _ = read_tables(text_of(tables, suffix).encode(), "again", suffix)
    assert again == tables


def test_a_row_of_json_is_a_line() -> None:
    lines = text_of(tables_of(flexact.read_text(BAR)), ".json").splitlines()
    assert "    [1.0, 0.0, 0.0]" in lines
    assert "    [1, 2]" in lines


def test_without_pyyaml_it_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "yaml", None)
    with pytest.raises(BatchError, match="PyYAML"):
        read_tables(b"nodes: []", "tables", ".yaml")
    with pytest.raises(BatchError, match="pip install PyYAML"):
        text_of({}, ".yaml")
    assert text_of({}, ".json") == "{}\n"


# Meshes


def lines_alone(name: str) -> bool:
    model = flexact.read_text(deck_of(name))
    try:
        mesh_of(model)
    except MeshError:
        return False
    return True


MESHED = [name for name in NAMES if lines_alone(name)]


def test_many_decks_are_lines() -> None:
    assert len(MESHED) > 30


@pytest.mark.parametrize("name", MESHED)
def test_a_deck_through_a_mesh_has_the_same_counts(name: str) -> None:
    model = flexact.read_text(deck_of(name))
    again = model_of_mesh(mesh_of(model)[0], kind="plbeam" if model.planar else "beam")
    analysis = flexact.analyse(again)
    assert (analysis.under_constrained, analysis.over_constrained) == truth_of(name)


@pytest.mark.parametrize("suffix", [".vtu", ".vtk", ".msh", ".avs"])
def test_files_keep_what_the_verdict_depends_on(suffix: str, tmp_path: Path) -> None:
    model = flexact.read_text(deck_of("flexures/parallel_guide"))
    path = tmp_path / f"guide{suffix}"
    content, notes = bytes_of(model, path)
    path.write_bytes(content)
    assert not [item for item in notes if str(item.severity) == "warning"]
    analysis = flexact.analyse(read_any(path))
    assert (analysis.under_constrained, analysis.over_constrained) == (0, 1)


def test_a_format_that_loses_data_is_told_and_one_without_lines_refused(tmp_path: Path) -> None:
    model = flexact.read_text(deck_of("paper/twelve_trusses"))
    _, notes = bytes_of(model, tmp_path / "trusses.ply")
    lost = [item.message for item in notes if item.code == "lost"]
    assert [next(n for n in ("fixed", "truss") if n in words) for words in lost] == [
        *("fixed", "truss")
    ]
    for suffix in (".stl", ".obj"):
        with pytest.raises(MeshError, match=r"lines|triangle"):
            bytes_of(model, tmp_path / f"trusses{suffix}")
    mixed = flexact.read_text("TRUSS 1 1 2\nPLTRUSS 2 1 2\nX 2 1 0 0\nFIX 1\n")
    with pytest.raises(MeshError, match="kind pltruss"):
        bytes_of(mixed, tmp_path / "mixed.vtu")
    with pytest.raises(MeshError, match=r"truss|hinge|share"):
        bytes_of(flexact.read_text(deck_of("linkages/rssr")), tmp_path / "linkage.vtu")


def test_lines_of_a_mesh_are_beams_or_trusses_and_points_are_fixed_as_told() -> None:
    points = np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0], [9, 9, 9]])
    mesh = meshio.Mesh(
        points,
        [("line", [[0, 1], [1, 2]]), ("triangle", [[0, 1, 2]])],
        point_data={"fixed": np.array([1.0, 0, 0, 0]), "heat": np.zeros(4)},
    )
    model = model_of_mesh(mesh, kind="truss", fixed=[3])
    assert model.element_keywords == ("TRUSS", "TRUSS")
    assert model.coordinate_classes.tolist() == [[1] * 3, [2] * 3, [1] * 3]
    told = [item.message for item in model.diagnostics if item.code == "left-out"]
    assert told == [
        *("cells that are no lines: triangle (1)", "points at which no line ends (1)"),
        "data of points: heat (1)",
    ]
    analysis = flexact.analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (2, 1)
    model = model_of_mesh(mesh)
    assert model.element_keywords == ("BEAM", "BEAM")
    assert flexact.analyse(model).verdict.value == "exactly constrained"


def test_curved_lines_are_two_and_sets_of_points_are_known() -> None:
    points = np.array([[0.0, 0], [2, 0], [1, 0.5]])
    mesh = meshio.Mesh(points, [("line3", [[0, 1, 2]])], point_sets={"fixed": np.array([0])})
    model = model_of_mesh(mesh, kind="plbeam")
    assert model.planar and model.element_numbers.size == 2
    assert model.positions[model.element_nodes[0, 2]].tolist() == [1.0, 0.5, 0.0]
    assert flexact.analyse(model).verdict.value == "exactly constrained"


@pytest.mark.parametrize(
    ("words", "mesh", "options"),
    [
        ("no lines", meshio.Mesh(np.zeros((3, 3)), [("triangle", [[0, 1, 2]])]), {}),
        ("point 7", meshio.Mesh(np.eye(3), [("line", [[0, 1]])]), {"fixed": [7]}),
        ("z = 0", meshio.Mesh(np.eye(3), [("line", [[0, 2]])]), {"kind": "pltruss"}),
        (
            "released",
            meshio.Mesh(np.eye(3), [("line", [[0, 1]])], cell_data={"released": [[[1.0, 2]]]}),
            {},
        ),
        (
            "fixed",
            meshio.Mesh(np.eye(3), [("line", [[0, 1]])], point_data={"fixed": np.ones((3, 2))}),
            {},
        ),
        ("not there", meshio.Mesh(np.eye(3), [("line", [[0, 5]])]), {}),
    ],
)
def test_a_mesh_that_is_no_mechanism_is_told(words: str, mesh: Any, options: Any) -> None:
    with pytest.raises(MeshError, match=words):
        model_of_mesh(mesh, **options)


@pytest.mark.parametrize("suffix", [".vtu", ".vtk", ".msh", ".ply"])
def test_a_broken_mesh_file_is_told(
    suffix: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / f"broken{suffix}"
    for content in (b"", b"nonsense\n" * 9, bytes_of(flexact.read_text(BAR), path)[0][:200]):
        path.write_bytes(content)
        with pytest.raises(MeshError):
            read_any(path)
    assert capsys.readouterr() == ("", "")


def test_without_meshio_it_is_told(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setitem(sys.modules, "meshio", None)
    with pytest.raises(flexact.FlexactError, match="pip install meshio"):
        read_any(tmp_path / "mesh.vtu")
    with pytest.raises(MeshError, match="pip install meshio"):
        mesh_bytes(None, ".vtu")


# The command


@pytest.mark.parametrize("suffix", [".json", ".yaml", ".vtu", ".msh"])
def test_the_command_converts_there_and_back(
    suffix: str, deck: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other, again = deck.with_suffix(suffix), deck.with_name("again.dat")
    assert main(["convert", str(deck), "-o", str(other)]) == 0
    out, err = capsys.readouterr()
    assert out == f"{deck}: written to {other}, 1 element, 2 nodes\n"
    assert "left-out" in err
    assert main(["convert", str(other), "-o", str(again)]) == 0
    assert main(["analyse", str(again), "--expect", "exact"]) == 0


def test_the_command_says_what_is_wrong(
    deck: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    wrong = tmp_path / "wrong.json"
    wrong.write_bytes(WRONG_JSON)
    broken = ROOT / "input_decks" / "broken" / "bad_number.dat"
    target = tmp_path / "target.dat"
    for words, code, said in (
        ([str(wrong), "-o", str(target)], 1, "3 errors"),
        ([str(broken), "-o", str(tmp_path / "t.json")], 1, "bad-number"),
        ([str(tmp_path / "none.json"), "-o", str(target)], 1, "no such file"),
        ([str(tmp_path / "none.vtu"), "-o", str(target)], 1, "no such file"),
        ([str(tmp_path / "none.dat"), "-o", str(tmp_path / "t.json")], 1, "no such file"),
        ([str(deck), "-o", str(tmp_path / "t.foo")], 2, "says no format"),
        ([str(deck), "-o", str(deck)], 2, "overwrite"),
        ([str(deck), "-o", str(tmp_path / "t.stl")], 2, "no lines"),
        ([str(deck), "-o", str(tmp_path / "t.json"), "--fix", "0"], 2, "points from 1"),
        ([str(deck), "-o", str(tmp_path / "t.json"), "--as", "wheel"], 2, "invalid value 'wheel'"),
        ([str(deck), "-o", str(tmp_path / "t.json"), "--fix", "1"], 2, "is for a mesh"),
        ([str(deck), "-o", str(tmp_path / "t.json"), "--flexible", "released"], 2, "for tables"),
    ):
        assert main(["convert", *words]) == code
        assert said in capsys.readouterr().err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["bar.dat", "wrong.json"]


def test_the_command_fixes_points_and_releases_what_is_flexible(tmp_path: Path) -> None:
    mesh, tables, target = (tmp_path / name for name in ("m.vtk", "t.json", "t.dat"))
    meshio.Mesh(np.eye(3), [("line", [[0, 1], [1, 2]])]).write(mesh)
    assert main(["convert", str(mesh), "-o", str(target), "--as", "truss", "--fix", "1,3-3"]) == 0
    assert flexact.read(target).coordinate_classes[[0, 2]].tolist() == [[1] * 3] * 2
    tables.write_text(
        json.dumps(
            {
                "nodes": [[0, 0, 0], [1, 0, 0]],
                "elements": [1, 2],
                "nprops": {"fix": True},
                "eprops": {"elems": 1, "flex": [2, 5, 6]},
            }
        )
    )
    for option, wanted in (("independent", 3), ("released", 2)):
        assert main(["convert", str(tables), "-o", str(target), "--flexible", option]) == 0
        assert flexact.read(target).deformation_classes.tolist() == [
            [1, wanted, 1, 1, wanted, wanted]
        ]


@pytest.mark.posix
@pytest.mark.parametrize("suffix", [".json", ".yaml", ".vtu"])
def test_pipes_and_devices_are_refused(suffix: str, tmp_path: Path) -> None:
    """Which would keep whoever reads them for ever, or have no end."""
    pipe, zero = tmp_path / f"pipe{suffix}", tmp_path / f"zero{suffix}"
    os.mkfifo(pipe)
    zero.symlink_to("/dev/zero")
    for path in (pipe, zero):
        with pytest.raises(flexact.FlexactError, match=r"not a regular file|no such file"):
            read_any(path)


def test_errors_of_meshes_move_no_cursor(tmp_path: Path) -> None:
    path = tmp_path / "\x1b[2Jx.vtu"
    path.write_text("<\x1b]0;evil\x07")
    with pytest.raises(MeshError) as caught:
        read_any(path)
    assert str(caught.value).isprintable()
