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
    strength: _Floats,
    expansion: _Floats,
    fillet: _Floats,
    node_mass: _Floats,
    force: _Floats,
    increment: _Floats,
    /,
) -> tuple[int, int, int, int, int, int, int, int, _Floats, _Ints, _Ints, _Bytes]: ...
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
    method: int,
    tolerance: float,
    memory: float,
    only_plain_values: int,
    prove: int,
    as_stored: int,
    stage: _Ints,
    label: _Ints,
    first: _Ints,
    place: _Ints,
    value: _Floats,
    scale: _Floats,
    scaled_value: _Floats,
    pair_vector: _Floats,
    /,
) -> tuple[_Floats, _Floats]: ...
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
    number: int,
    as_stored: int,
    is_transposed: int,
    pivot: _Ints,
    entry: _Ints,
    /,
) -> tuple[_Ints, int, int]: ...
def analyse_variants(
    variants: int,
    nodes: _Ints,
    places: _Floats,
    elements: _Ints,
    vectors: _Floats,
    near: float,
    cut_off: float,
    most_reach: float,
    with_values: int,
    memory: float,
    prove: int,
    as_stored: int,
    zero_counts: _Ints,
    zero_limits: _Floats,
    positions: _Floats,
    classes: _Ints,
    /,
) -> tuple[_Floats, _Floats, _Floats, _Floats]: ...
def find_stiffness(
    nodes: _Ints,
    places: _Floats,
    elements: _Ints,
    vectors: _Floats,
    stiffness: _Floats,
    notch: _Floats,
    /,
) -> tuple[_Floats, _Floats]: ...
def follow_path(
    nodes: _Ints,
    places: _Floats,
    elements: _Ints,
    vectors: _Floats,
    stiffness: _Floats,
    mass: _Floats,
    notch: _Floats,
    node_mass: _Floats,
    configuration: _Floats,
    stress: _Floats,
    reaction: _Floats,
    target: _Floats,
    misfit: _Floats,
    force: _Floats,
    gravity: _Floats,
    /,
) -> tuple[int, float, int, int, float, int]: ...
def find_response(
    room: int,
    nodes: _Ints,
    places: _Floats,
    elements: _Ints,
    vectors: _Floats,
    stiffness: _Floats,
    mass: _Floats,
    notch: _Floats,
    node_mass: _Floats,
    configuration: _Floats,
    stress: _Floats,
    reaction: _Floats,
    gravity: _Floats,
    force: _Floats,
    misfit: _Floats,
    shift: _Floats,
    /,
) -> tuple[_Floats, _Floats, _Floats, _Floats, _Floats, int, int, int]: ...
def find_modes(
    count: int,
    nodes: _Ints,
    places: _Floats,
    elements: _Ints,
    vectors: _Floats,
    stiffness: _Floats,
    mass: _Floats,
    notch: _Floats,
    node_mass: _Floats,
    configuration: _Floats,
    stress: _Floats,
    reaction: _Floats,
    gravity: _Floats,
    of_buckling: int,
    /,
) -> tuple[_Floats, _Floats, int, int, int, int, int]: ...
def find_matrices(
    nodes: _Ints,
    places: _Floats,
    elements: _Ints,
    vectors: _Floats,
    stiffness: _Floats,
    mass: _Floats,
    notch: _Floats,
    node_mass: _Floats,
    configuration: _Floats,
    stress: _Floats,
    reaction: _Floats,
    gravity: _Floats,
    independent: _Ints,
    /,
) -> tuple[_Floats, _Floats, _Floats, int, int]: ...
def find_errors(
    nodes: _Ints,
    places: _Floats,
    elements: _Ints,
    vectors: _Floats,
    stiffness: _Floats,
    mass: _Floats,
    notch: _Floats,
    node_mass: _Floats,
    configuration: _Floats,
    stress: _Floats,
    reaction: _Floats,
    gravity: _Floats,
    square: _Floats,
    unit_stress: _Floats,
    length: _Floats,
    /,
) -> tuple[_Floats, _Floats, int, int, int]: ...
