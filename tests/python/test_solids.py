# SPDX-License-Identifier: BSD-3-Clause
"""Models as solids: what OpenCASCADE, lib3mf and trimesh read of the files.

Volumes are closed forms of the sizes that the models give, beside each.
"""

import itertools
import json
import math
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import flexact
from flexact.__main__ import main
from flexact.show.drawing import move
from flexact.show.drawing.selection import select_motion
from flexact.show.solids.files import solid_bytes
from flexact.show.solids.shapes import (
    Curve,
    Piece,
    Prism,
    apart,
    box,
    circle,
    cut_ears,
    hull,
    polygon,
)
from flexact.show.solids.solids import solids_of
from flexact.show.solids.step import real, step_bytes, string

read = pytest.importorskip("solids_read")
DECKS = Path(__file__).parents[2] / "input_decks"
FLEXIBLE = ("sheet", "wire", "bar", "beam", "notch")


def parallel_guide() -> flexact.Model:
    model = flexact.Model(name="guide", units="mm")
    for k, x in enumerate((0, 100), 1):
        model.sheet((x, 0, 0), (x, 0, 50), "y", name=f"sheet {k}", section=(40, 0.3))
        model.fix((x, 0, 0))
    model.body([(0, 0, 50), (100, 0, 50)], name="stage")
    model.independent("stage", "x")
    return model


def notched(contour: str, **sizes: float) -> flexact.Model:
    model = flexact.Model(name="lever on a notch", units="mm")
    model.notch(
        *((0, 0, 0), "y"),
        **{"q": (10, 0, 0), "name": "neck", "contour": contour, "breadth": 8, **sizes},
    )
    model.fix((0, 0, 0))
    model.body([(10, 0, 0), (40, 0, 0)], name="lever")
    model.independent("lever", "z")
    return model


def cross_hinge() -> flexact.Model:
    model = flexact.Model(name="cross hinge", units="mm")
    hinge = model.cross_hinge(
        [(-30, -20, 0), (30, 0, 0), (-30, 20, 0)],
        [(30, -20, 80), (-30, 0, 80), (30, 20, 80)],
        section=(14, 0.5),
    )
    model.fix(*hinge.ground)
    model.independent("body", "ry")
    return model


def folded() -> flexact.Model:
    model = flexact.Model(name="folded", units="mm")
    model.folded_sheet((0, 0, 0), (0, 0, 60), (50, 0, 60), name="fold A", section=(30, 0.4))
    model.fix((0, 0, 0))
    model.body([(50, 0, 60), (80, 0, 60)], name="stage")
    return model


def file_of(tmp_path: Path, model: flexact.Model | Path) -> Path:
    target = tmp_path / "x.step"
    target.write_bytes(solid_bytes(flexact.analyse(model), None, ".step"))
    return target


MODELS = {
    "parallel guide": parallel_guide,
    "cross hinge": cross_hinge,
    "folded": folded,
    "notch": lambda: notched("circular", thickness=0.5, radius=4),
    "five folded sheets": lambda: DECKS / "paper" / "five_folded_sheets.dat",
    "notch guide": lambda: DECKS / "flexures" / "notch_guide.dat",
    "wires": lambda: DECKS / "paper" / "five_wires.dat",
    "bent": lambda: DECKS / "flexures" / "parallel_guide_bent_16_beams.dat",
    "released": lambda: DECKS / "flexures" / "parallel_guide_body_released.dat",
    "trusses": lambda: DECKS / "paper" / "twelve_trusses.dat",
    "planar": lambda: DECKS / "flexures" / "planar_parallel_guide.dat",
}


@pytest.mark.parametrize("name", MODELS)
def test_solids_are_sound_and_touch_as_a_design_does(tmp_path: Path, name: str) -> None:
    """Valid, closed, outside out; flexures touch what holds them, bodies are apart."""
    analysis = flexact.analyse(MODELS[name]())
    solids = solids_of(analysis)
    path = tmp_path / "x.step"
    path.write_bytes(solid_bytes(analysis, None, ".step"))
    whole, parts = read.read_assembly(path)
    assert whole == solids.name
    assert [part.name for part in parts] == [each.name for each in solids.products]
    for part, product in zip(parts, solids.products, strict=True):
        assert all(map(read.is_sound, part.solids)), part.name
        made = [read.volume(solid) for solid in part.solids]
        assert made == pytest.approx([1e9 * shape.volume for shape in product.shapes], rel=1e-9)
    holders: dict[int, int] = {}
    for i, j in itertools.combinations(range(len(parts)), 2):
        pairs = list(itertools.product(parts[i].solids, parts[j].solids))
        near = [pair for pair in pairs if read.distance(*pair) < 1e-6]
        kinds = [solids.products[k].kind in FLEXIBLE for k in (i, j)]
        if kinds[0] == kinds[1]:
            assert not near, (parts[i].name, parts[j].name)
        for pair in near:
            assert read.shared(*pair) == pytest.approx(0.0, abs=1e-6)
            flexure = i if kinds[0] else j
            holders[flexure] = holders.get(flexure, 0) + 1
    flexures = {k for k, each in enumerate(solids.products) if each.kind in FLEXIBLE}
    assert holders == dict.fromkeys(flexures, 2)
    for part in parts:
        # A body of several solids is connected.
        reached, rest = part.solids[:1], part.solids[1:]
        for one in reached:
            for other in [each for each in rest if read.distance(one, each) < 1e-6]:
                assert read.shared(one, other) == pytest.approx(0.0, abs=1e-6)
                reached.append(other)
                rest.remove(other)
        assert not rest


def volumes(path: Path) -> dict[str, float]:
    _, parts = read.read_assembly(path)
    return {part.name: sum(map(read.volume, part.solids)) for part in parts}


def test_sheets_have_their_true_sizes(tmp_path: Path) -> None:
    found = volumes(file_of(tmp_path, parallel_guide()))
    assert found["sheet 1"] == pytest.approx(50 * 40 * 0.3, rel=1e-9)
    assert list(found) == ["sheet 1", "sheet 2", "ground clamp 1", "ground clamp 2", "stage"]


def test_a_folded_sheet_is_one_mitred_solid(tmp_path: Path) -> None:
    # Leaves of 60 and 50 mm, mitred on their middle planes: what the one has more on the outer
    # side of the fold it has less on the inner one.
    found = volumes(file_of(tmp_path, folded()))
    assert found["fold A"] == pytest.approx((60 + 50) * 30 * 0.4, rel=1e-9)


def test_wires_are_cylinders_and_square_ones_are_not(tmp_path: Path) -> None:
    model = flexact.Model(name="wires", units="mm")
    model.wire((0, 0, 0), (0, 0, 70), name="round", thickness=0.8)
    model.wire((20, 0, 0), (20, 0, 70), name="square", section=(0.8, 0.8))
    model.fix((0, 0, 0))
    model.fix((20, 0, 0))
    model.body([(0, 0, 70), (20, 0, 70)], name="stage")
    found = volumes(file_of(tmp_path, model))
    assert found["round"] == pytest.approx(math.pi * 0.16 * 70, rel=1e-9)
    assert found["square"] == pytest.approx(0.64 * 70, rel=1e-9)


def test_reinforced_and_tapered_sheets(tmp_path: Path) -> None:
    model = flexact.Model(name="sheets", units="mm")
    section = {"thickness": 0.4, "breadth": 20, "material": "steel"}
    model.sheet((0, 0, 0), (0, 0, 50), "y", name="thick", reinforced=(0.6, 3), **section)
    model.sheet((40, 0, 0), (40, 0, 50), "y", name="taper", tapered=(10, 0.2), **section)
    model.fix((0, 0, 0))
    model.fix((40, 0, 0))
    model.body([(0, 0, 50), (40, 0, 50)], name="stage")
    found = volumes(file_of(tmp_path, model))
    assert found["thick"] == pytest.approx(20 * (20 * 0.4 + 30 * 3), rel=1e-9)
    # Of a frustum of rectangles b by t, whose sizes go evenly: L (b0 t0 + b1 t1 + half of both
    # mixed products) / 3; the ends are found from the beams.
    exact = 50 / 3 * (20 * 0.4 + 10 * 0.2 + (20 * 0.2 + 10 * 0.4) / 2)
    assert found["taper"] == pytest.approx(exact, rel=1e-6)


def test_a_middle_has_its_section_and_a_released_sheet_its_waist(tmp_path: Path) -> None:
    model = parallel_guide()
    model.release("sheet 1", "in-plane bending", at="stage")
    model.sheet((50, 0, 0), (50, 0, 50), "y", name="leg", reinforced=0.6, section=(20, 0.5))
    model.fix((50, 0, 0))
    model.body(["stage", (50, 0, 50)])
    found = volumes(file_of(tmp_path, model))
    # Its middle is drawn four times as thick.
    assert found["leg, middle"] == pytest.approx(30 * 20 * 2, rel=1e-9)
    # The waist: half ellipses on both edges, 15 mm less a fiftieth at the end, 3/8 of 40 mm deep.
    cut = math.pi / 2 * (0.98 * 22.5 / 2) * 15
    assert found["sheet 1"] == pytest.approx(0.3 * (50 * 40 - 2 * cut), rel=1e-9)
    assert found["sheet 2"] == pytest.approx(0.3 * 50 * 40, rel=1e-9)


def test_sheets_without_sections_pass_each_other() -> None:
    """The sheets lie 20 mm apart; drawn, they would be 0.14 of the diagonal of the points broad."""
    model = flexact.Model(name="cross hinge", units="mm")
    hinge = model.cross_hinge(
        [(-30, -10, 0), (100, 10, 60)], [(70, -10, 80), (-30, 10, 120)], width="y"
    )
    model.fix(*hinge.ground)
    solids = solids_of(flexact.analyse(model))
    assert solids.drawing.members.section[:2].max() > 0.02
    breadths = [each.flexure.sizes.max() for each in solids.products if each.kind == "sheet"]
    assert max(breadths) < 0.02
    assert not any("run through" in note for note in solids.notes)


def test_parts_that_fit_nowhere_end_in_words() -> None:
    """A mechanism of chance at a few points: no block fits, and it is not sought for long."""
    from random_models import mechanism

    analysis = flexact.analyse(mechanism(np.random.default_rng(1), planar=False, held=False))
    solids = solids_of(analysis)
    assert solids.products
    assert any("no block without that was found" in note for note in solids.notes)


@pytest.mark.parametrize(
    ("contour", "sizes", "cut"),
    [
        # Area of one cut beside the neck; the plate is 10 mm long and 8 mm broad.
        ("circular", {"thickness": 0.5, "radius": 4}, math.pi * 16 / 2),
        ("fillet", {"thickness": 0.5, "radius": 1, "length": 6}, 4 * 1 + math.pi / 2),
        ("elliptic", {"thickness": 0.5, "length": 8, "height": 6.5}, math.pi * 4 * 3 / 2),
        ("parabolic", {"thickness": 0.5, "length": 8, "height": 6.5}, 2 / 3 * 8 * 3),
    ],
)
def test_notches_are_as_made(
    tmp_path: Path, contour: str, sizes: dict[str, float], cut: float
) -> None:
    height = sizes.get("height", sizes["thickness"] + 2 * sizes.get("radius", 0.0))
    path = file_of(tmp_path, notched(contour, **sizes))
    assert volumes(path)["neck"] == pytest.approx(8 * (10 * height - 2 * cut), rel=1e-9)
    assert all(map(read.is_sound, read.read_step(path)))


def test_a_deck_tells_the_radius_of_a_notch(tmp_path: Path) -> None:
    model = notched("circular", thickness=0.5, radius=4)
    copy = flexact.read_text(model.to_deck())
    kept = volumes(file_of(tmp_path, model))["neck"]
    assert volumes(file_of(tmp_path, copy))["neck"] == pytest.approx(kept, rel=1e-9)


def test_names_of_any_language(tmp_path: Path) -> None:
    model = parallel_guide()
    model.rename("sheet 1", "Blattfeder 'äußere' \\ 板ばね 🙂")
    names = list(volumes(file_of(tmp_path, model)))
    assert names[0] == "Blattfeder 'äußere' \\ 板ばね 🙂"


def test_strings_and_numbers_of_iso_10303_21() -> None:
    # The examples of 6.4.3.3 and those of clause 6.4.2.
    assert string("cat") == "'cat'"
    assert string("Don't") == "'Don''t'"
    assert string("a\\b") == "'a\\\\b'"
    assert string("\u03c0r") == "'\\X2\\03C0\\X0\\r'"
    assert string("\U0001f642") == "'\\X4\\0001F642\\X0\\'"
    assert [real(x) for x in (1.0, 1e-5, -2.5e20, 0.1)] == ["1.0", "1.E-05", "-2.5E+20", "0.1"]
    assert float(real(1 / 3)) == 1 / 3


def test_places_are_read_back_to_the_last_digits(tmp_path: Path) -> None:
    solid = box(np.array((1 / 3, 2 / 7, 0.1)), np.eye(3), (0.01, 0.02, 1 / 30))
    path = tmp_path / "x.step"
    path.write_bytes(step_bytes("box", [("box", ["box"], [solid], np.ones(3), 1.0)]))
    text = path.read_text()
    corners = re.findall(r"VERTEX_POINT\('',#(\d+)\)", text)
    places = dict(re.findall(r"#(\d+)=CARTESIAN_POINT\('',\((.*?)\)\);", text))
    found = np.array([[float(x) for x in places[k].split(",")] for k in corners])
    assert np.abs(found / 1000 - solid.points).max() < 1e-16


def test_no_clock_and_no_path_in_the_file() -> None:
    analysis = flexact.analyse(DECKS / "paper" / "five_wires.dat")
    for suffix in (".step", ".glb", ".3mf", ".stl"):
        made = solid_bytes(analysis, None, suffix)
        assert made == solid_bytes(analysis, None, suffix)
        assert str(DECKS).encode() not in made


def test_a_motion_s_position(tmp_path: Path) -> None:
    """Bent sheets end where the body has moved to, and are still valid solids."""
    path = tmp_path / "x.step"
    deck = DECKS / "flexures" / "parallel_guide.dat"
    assert main(["export", str(deck), "--freedom", "1", "-o", str(path)]) == 0
    parts = {part.name: part.solids for part in read.read_assembly(path)[1]}
    assert all(map(read.is_sound, itertools.chain(*parts.values())))
    # A tenth of the diagonal of its points, 100 mm by 50 mm.
    straight = {
        part.name: part.solids
        for part in read.read_assembly(
            file_of(tmp_path, DECKS / "flexures" / "parallel_guide.dat")
        )[1]
    }
    moved = _middle(parts["body"][0]) - _middle(straight["body"][0])
    assert np.linalg.norm(moved) == pytest.approx(0.1 * math.hypot(100, 50), rel=0.01)
    for sheet in ("left sheet", "right sheet"):
        assert read.distance(parts[sheet][0], parts["body"][0]) < 1e-6
        assert read.shared(parts[sheet][0], parts["body"][0]) < 1e-6
        # What is drawn bends on a cubic: it keeps its volume to second order.
        assert read.volume(parts[sheet][0]) == pytest.approx(600, rel=0.02)


def _middle(solid: object) -> np.ndarray:
    properties = read.GProp_GProps()
    read.BRepGProp.VolumeProperties_s(solid, properties)
    place = properties.CentreOfMass()
    return np.array((place.X(), place.Y(), place.Z()))


def chunks(glb: bytes) -> tuple[dict, bytes]:
    assert glb[:4] == b"glTF"
    version, length = np.frombuffer(glb[4:12], np.uint32).tolist()
    assert (version, length) == (2, len(glb))
    size = int(np.frombuffer(glb[12:16], np.uint32)[0])
    return json.loads(glb[20 : 20 + size]), glb[28 + size :]


def values(content: dict, data: bytes, accessor: int) -> np.ndarray:
    about = content["accessors"][accessor]
    view = content["bufferViews"][about["bufferView"]]
    raw = data[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
    kind = np.float32 if about["componentType"] == 5126 else np.uint32
    return np.frombuffer(raw, kind).reshape(about["count"], -1)


def test_glb_plays_the_motion() -> None:
    """Bodies where the poses have them; the end of each sheet goes with its body."""
    analysis = flexact.analyse(DECKS / "flexures" / "parallel_guide.dat")
    shown = select_motion(analysis)
    assert shown is not None
    content, data = chunks(solid_bytes(analysis, shown.motion, ".glb"))
    poses = move(solids_of(analysis).drawing, shown.motion).poses
    (animation,) = content["animations"]
    names = [node["name"] for node in content["nodes"]]
    body = names.index("body")
    for channel in animation["channels"]:
        sampler = animation["samplers"][channel["sampler"]]
        times = values(content, data, sampler["input"]).ravel()
        assert (np.diff(times) > 0).all() and times[0] == 0
        made = values(content, data, sampler["output"])
        if channel["target"]["path"] == "translation":
            assert channel["target"]["node"] == body
            node = analysis.given.node_index[13]
            # From rest to the one end, over rest to the other, and back.
            assert made[8] == pytest.approx(poses[-1].position[node], abs=1e-6)
            assert made[24] == pytest.approx(poses[0].position[node], abs=1e-6)
            assert made[0] == pytest.approx(poses[8].position[node], abs=1e-6)
        if channel["target"]["path"] == "weights":
            shares = made.reshape(len(times), 16)
            assert (shares[0] == 0).all() and shares[8, 15] == 1 and shares[24, 0] == 1
    (primitive,) = content["meshes"][names.index("left sheet")]["primitives"]
    rest = values(content, data, primitive["attributes"]["POSITION"])
    last = values(content, data, primitive["targets"][15]["POSITION"])
    way = poses[-1].position - poses[8].position
    top = rest[:, 2] > 0.05 - 1e-6
    assert last[top] == pytest.approx(
        np.tile(way[analysis.given.node_index[13]], (top.sum(), 1)), abs=1e-5
    )
    assert last[rest[:, 2] < 1e-6] == pytest.approx(0.0, abs=1e-7)


def test_glb_has_the_colours_of_the_self_stress() -> None:
    """Both sheets carry a constant in-plane moment, opposite: the ends of the scale."""
    analysis = flexact.analyse(DECKS / "flexures" / "parallel_guide.dat")
    content, data = chunks(solid_bytes(analysis, None, ".glb"))
    found = {
        mesh["name"]: values(content, data, mesh["primitives"][0]["attributes"]["COLOR_0"])
        for mesh in content["meshes"]
    }
    # Red and blue of Moreland's scale, of sRGB as amounts of light.
    ends = np.array([(180, 4, 38), (59, 76, 192)]) / 255
    ends = np.where(ends <= 0.04045, ends / 12.92, ((ends + 0.055) / 1.055) ** 2.4)
    sheets = [found["left sheet"], found["right sheet"]]
    assert all(np.ptp(each, axis=0).max() < 1e-6 for each in sheets)
    made = sorted((each[0] for each in sheets), key=lambda colour: -colour[0])
    assert np.array(made) == pytest.approx(ends, abs=1e-6)


@pytest.mark.parametrize("deck", ["paper/five_folded_sheets.dat", "flexures/notch_guide.dat"])
def test_meshes_are_closed(tmp_path: Path, deck: str) -> None:
    trimesh, lib3mf = pytest.importorskip("trimesh"), pytest.importorskip("lib3mf")
    analysis = flexact.analyse(DECKS / deck)
    solids = solids_of(analysis)
    count = sum(len(each.shapes) for each in solids.products)
    for suffix in (".stl", ".3mf", ".glb"):
        (tmp_path / f"x{suffix}").write_bytes(solid_bytes(analysis, None, suffix))
    mesh = trimesh.load(tmp_path / "x.stl")
    assert mesh.is_watertight and mesh.is_winding_consistent
    assert mesh.volume == pytest.approx(
        1e9 * sum(shape.volume for each in solids.products for shape in each.shapes), rel=0.02
    )
    reader_of = lib3mf.get_wrapper().CreateModel()
    reader = reader_of.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(str(tmp_path / "x.3mf"))
    assert not reader.GetWarningCount()
    assert reader_of.GetUnit() == lib3mf.ModelUnit.MilliMeter
    found, objects = [], reader_of.GetMeshObjects()
    while objects.MoveNext():
        each = objects.GetCurrentMeshObject()
        assert each.IsValid() and each.IsManifoldAndOriented()
        found.append(each.GetName())
    assert found == [name for each in solids.products for name in each.names()]
    scene = trimesh.load(tmp_path / "x.glb")
    surfaces = [each.merge_vertices(merge_norm=True) or each for each in scene.geometry.values()]
    assert len(surfaces) == count
    assert all(each.is_watertight and each.volume > 0 for each in surfaces)


def test_no_tool_of_cad_is_loaded() -> None:
    code = (
        "import sys, flexact; from flexact.show.solids.files import solid_bytes;"
        f"a = flexact.analyse({str(DECKS / 'paper' / 'five_wires.dat')!r});"
        "[solid_bytes(a, None, s) for s in ('.step', '.glb', '.3mf', '.stl')];"
        "print(sorted(set(sys.modules) & {'OCP', 'scipy', 'vtk', 'trimesh', 'lib3mf'}))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_analyse_loads_nothing_that_makes_solids() -> None:
    """The command starts in 1.5 times `import numpy`, and most of its runs write no solids."""
    deck = str(DECKS / "flexures" / "parallel_guide.dat")
    code = (
        f"import sys; from flexact.apps.cli.main import main; main(['analyse', {deck!r}, '-q']);"
        "print([name for name in sys.modules if name.startswith('flexact.show.solids')])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"


def test_a_table_of_flexures_is_saved_and_shows_no_motion(tmp_path: Path) -> None:
    analysis = flexact.analyse(DECKS / "flexures" / "parallel_guide.dat")
    analysis.save(tmp_path / "x.csv")
    assert (tmp_path / "x.csv").read_text().startswith("kind,name,from,to,")
    with pytest.raises(flexact.FlexactError, match="shows no freedom of its own choice"):
        analysis.save(tmp_path / "y.csv", freedom=1)


# What the command says ----------------------------------------------------------------------


def test_export_tells_what_is_assumed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    deck = DECKS / "flexures" / "cross_hinge.dat"
    assert main(["export", str(deck), "-o", str(tmp_path / "x.step")]) == 0
    shown = capsys.readouterr()
    assert shown.out.endswith("x.step\n")
    assert "first sheet and second sheet: no section is given (CROSSDIM, section=)" in " ".join(
        shown.err.split()
    )
    assert "run through each other" in " ".join(shown.err.split())


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--motion", "3", "-o", "x.step"], "there is no motion 3"),
        (["--stress", "5", "-o", "x.glb"], "there is no self-stress 5: the analysis gives 1"),
        (["--stress", "1", "-o", "x.step"], "x.step shows no stress of its own choice"),
        (["-o", "x.iges"], "mesh format 'iges' is not known"),
        (["-o", "x"], "the suffix of x is to say what to write"),
    ],
)
def test_export_refuses_in_words(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    options: list[str],
    told: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    deck = DECKS / "flexures" / "parallel_guide.dat"
    assert main(["export", str(deck), *options]) in (1, 2)
    assert told in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_saving_from_python(tmp_path: Path) -> None:
    analysis = flexact.analyse(parallel_guide())
    for name in ("x.step", "x.stp", "x.glb", "x.3mf", "x.stl"):
        analysis.save(tmp_path / name)
    assert (tmp_path / "x.step").read_bytes() == solid_bytes(analysis, None, ".step")
    analysis.save(tmp_path / "moved.step", freedom=1)
    assert (tmp_path / "moved.step").read_bytes() != (tmp_path / "x.step").read_bytes()
    analysis.save(tmp_path / "x.glb", stress=1)
    with pytest.raises(flexact.FlexactError, match="there is no self-stress 2"):
        analysis.save(tmp_path / "x.glb", stress=2)


# Shapes -------------------------------------------------------------------------------------


def test_a_hull_has_flat_faces() -> None:
    cube = np.array(list(itertools.product((0.0, 1.0), repeat=3)))
    made = hull(np.concatenate((cube, [[0.5, 0.5, 0.5], [0.5, 0.5, 1.0]])))
    assert made is not None
    assert sorted(map(len, made.faces)) == [4] * 6
    assert made.volume == pytest.approx(1.0, rel=1e-12)
    assert hull(cube[cube[:, 2] == 0.0]) is None


def test_a_hull_of_many_points_is_that_of_few() -> None:
    chance = np.random.default_rng(3)
    points = np.concatenate(
        [box(p, np.eye(3), (0.1, 0.2, 0.3)).points for p in chance.random((6, 3))]
    )
    made = hull(points)
    assert made is not None
    spatial = pytest.importorskip("scipy.spatial")
    assert made.volume == pytest.approx(spatial.ConvexHull(points).volume, rel=1e-12)
    height = (points[:, None] - made.points[[face[0] for face in made.faces]]) * made.normals
    assert height.sum(axis=-1).max() < 1e-12


def test_how_far_boxes_are_apart() -> None:
    one = box(np.zeros(3), np.eye(3), (2, 2, 2))
    turn = np.array([[1, -1, 0], [1, 1, 0], [0, 0, math.sqrt(2)]]) / math.sqrt(2)
    # The edge of a turned cube points at a face of the other.
    other = box(np.array((1 + math.sqrt(2) + 0.25, 0, 0)), turn, (2, 2, 2))
    assert apart(one, other) == pytest.approx(0.25, rel=1e-9)
    assert apart(one, box(np.array((1.5, 0, 0)), np.eye(3), (2, 2, 2))) == pytest.approx(-0.5)


def test_ears_of_a_polygon_that_is_not_convex() -> None:
    corner = np.array([(0, 0), (4, 0), (4, 3), (3, 3), (3, 1), (1, 1), (1, 3), (0, 3)], float)
    ears = np.array(cut_ears(corner))
    a, b, c = np.moveaxis(corner[ears], 1, 0)
    size = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    assert (size > 0).all() and size.sum() / 2 == pytest.approx(8.0)


def test_contours_of_curves_read_by_opencascade(tmp_path: Path) -> None:
    half = math.pi / 2
    wave = (
        Piece((0.0, 0.0), Curve.PARABOLA, (1.0, -0.5)),
        Piece((2.0, 0.0)),
        Piece((2.0, 1.0), Curve.ELLIPSE, (1.0, 1.0), (1.0, 0.4), True),
        Piece((0.0, 1.0)),
    )
    turn = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0]
    turn = turn * np.sign(np.linalg.det(turn))
    prisms = [Prism(wave, np.ones(3), turn, 0.5), Prism(circle(3.0), np.zeros(3), turn, 2.0)]
    prisms.append(Prism(polygon([(0, 0), (1, 0), (0, 1)]), np.zeros(3), turn, 1.0))
    exact = (2 + 2 / 3 * 2 * 0.5 + half * 0.4) * 0.5, math.pi * 2.25 * 2, 0.5
    path = tmp_path / "x.step"
    path.write_bytes(step_bytes("x", [("x", ["a", "b", "c"], prisms, np.ones(3), 0.5)]))
    found = read.read_step(path)
    assert all(map(read.is_sound, found))
    assert [read.volume(each) / 1e9 for each in found] == pytest.approx(exact, rel=1e-9)
    assert [each.volume for each in prisms] == pytest.approx(exact, rel=1e-12)
