# SPDX-License-Identifier: BSD-3-Clause
"""Types of the extension module made by f2py from fortran/boundary/bindings.f90."""

import numpy as np
from numpy.typing import NDArray

_Ints = NDArray[np.int32]
_Floats = NDArray[np.float64]
_Bytes = NDArray[np.int8]

def describe_element(kind: int, /) -> tuple[_Bytes, _Ints, int]: ...
def describe_names(enumeration: _Bytes, /) -> tuple[_Bytes, int, int]: ...
def read_deck(
    text: _Bytes,
    nodes: _Ints,
    places: _Floats,
    elements: _Ints,
    vectors: _Floats,
    element_name: _Ints,
    node_name: _Ints,
    cross_section: _Ints,
    drawn: _Ints,
    dimensions: _Floats,
    colour: _Floats,
    edge_colour: _Floats,
    opacity: _Floats,
    stiffness: _Floats,
    mass: _Floats,
    node_mass: _Floats,
    force: _Floats,
    increment: _Floats,
    /,
) -> tuple[int, int, int, int, int, int, int, _Floats, _Ints, _Ints, _Bytes]: ...
def find_tokens(text: _Bytes, lines: _Ints, words: _Ints, /) -> None: ...
def check_model(
    text: _Bytes,
    nodes: _Ints,
    places: _Floats,
    elements: _Ints,
    vectors: _Floats,
    name: _Ints,
    /,
) -> tuple[_Ints, _Ints, _Bytes]: ...
def count_model(nodes: _Ints, elements: _Ints, /) -> tuple[_Ints, _Ints]: ...
def find_frames(
    nodes: _Ints, places: _Floats, elements: _Ints, vectors: _Floats, /
) -> tuple[_Floats, _Floats]: ...
def assemble(
    nodes: _Ints,
    places: _Floats,
    elements: _Ints,
    vectors: _Floats,
    configuration: _Floats,
    c_t: _Floats,
    place: _Ints,
    value: _Floats,
    /,
) -> tuple[_Floats, int]: ...
def analyse_model(
    nodes: _Ints,
    places: _Floats,
    elements: _Ints,
    vectors: _Floats,
    wishes: _Floats,
    stage: _Ints,
    index: _Ints,
    place: _Ints,
    value: _Floats,
    by_size: _Floats,
    /,
) -> _Floats: ...
def find_sensitivities(
    nodes: _Ints,
    places: _Floats,
    elements: _Ints,
    vectors: _Floats,
    modes: _Floats,
    pair: _Ints,
    /,
) -> tuple[_Floats, _Ints, int]: ...
def find_echelon(
    nodes: _Ints,
    places: _Floats,
    elements: _Ints,
    vectors: _Floats,
    wishes: _Ints,
    pivot: _Ints,
    place: _Ints,
    /,
) -> _Ints: ...
def analyse_variants(
    nodes: _Ints,
    places: _Floats,
    elements: _Ints,
    vectors: _Floats,
    wishes: _Floats,
    positions: _Floats,
    classes: _Ints,
    facts: _Floats,
    /,
) -> None: ...
def find_stiffness(
    nodes: _Ints,
    places: _Floats,
    elements: _Ints,
    vectors: _Floats,
    of_elements: _Floats,
    /,
) -> tuple[_Floats, _Floats]: ...
def follow_path(
    nodes: _Ints,
    places: _Floats,
    elements: _Ints,
    vectors: _Floats,
    of_nodes: _Floats,
    of_elements: _Floats,
    gravity: _Floats,
    /,
) -> tuple[_Floats, _Floats, _Floats, _Floats]: ...
def study_state(
    nodes: _Ints,
    places: _Floats,
    elements: _Ints,
    vectors: _Floats,
    of_nodes: _Floats,
    of_elements: _Floats,
    wishes: _Floats,
    given: _Floats,
    answer: _Floats,
    /,
) -> _Floats: ...
