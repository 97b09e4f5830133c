"""Types of the extension module made by f2py from fortran/boundary/bindings.f90."""

import numpy as np
from numpy.typing import NDArray

_Ints = NDArray[np.int32]
_Floats = NDArray[np.float64]
_Bytes = NDArray[np.int8]

def count_element_kinds() -> int: ...
def describe_element_kind(kind: int, /) -> tuple[_Bytes, _Ints, int, int, int, _Ints]: ...
def survey_deck(text: _Bytes, /) -> tuple[int, int]: ...
def read_deck(
    text: _Bytes,
    node_number: _Ints,
    node_kind: _Ints,
    node_value: _Floats,
    coordinate_class: _Ints,
    element_number: _Ints,
    element_kind: _Ints,
    element_node: _Ints,
    element_vector: _Floats,
    deformation_class: _Ints,
    element_origin: _Ints,
    element_name: _Ints,
    look_choice: _Ints,
    look_value: _Floats,
    /,
) -> tuple[_Ints, _Ints, _Ints, _Bytes]: ...
def check_model(
    node_number: _Ints,
    node_kind: _Ints,
    node_value: _Floats,
    coordinate_class: _Ints,
    element_number: _Ints,
    element_kind: _Ints,
    element_node: _Ints,
    element_vector: _Floats,
    deformation_class: _Ints,
    /,
) -> tuple[_Ints, _Ints, _Bytes]: ...
def count_model(
    node_kind: _Ints,
    coordinate_class: _Ints,
    element_kind: _Ints,
    deformation_class: _Ints,
    /,
) -> tuple[_Ints, int, int, int]: ...
def assemble(
    entries: int,
    node_number: _Ints,
    node_kind: _Ints,
    node_value: _Floats,
    coordinate_class: _Ints,
    element_number: _Ints,
    element_kind: _Ints,
    element_node: _Ints,
    element_vector: _Floats,
    deformation_class: _Ints,
    configuration: _Floats,
    c_t: _Floats,
    /,
) -> tuple[_Floats, _Ints, _Ints, _Floats, int, int]: ...
def analyse_model(
    least: int,
    pairs: int,
    method: int,
    wishes: _Floats,
    node_number: _Ints,
    node_kind: _Ints,
    node_value: _Floats,
    coordinate_class: _Ints,
    element_number: _Ints,
    element_kind: _Ints,
    element_node: _Ints,
    element_vector: _Floats,
    deformation_class: _Ints,
    stage: _Ints,
    motion_start: _Ints,
    motion_place: _Ints,
    motion_value: _Floats,
    stress_start: _Ints,
    stress_place: _Ints,
    stress_value: _Floats,
    /,
) -> tuple[
    _Ints,
    _Ints,
    _Floats,
    _Floats,
    _Floats,
    _Floats,
    _Floats,
    _Floats,
    _Floats,
    _Floats,
    _Floats,
    _Ints,
    int,
]: ...
def find_sensitivities(
    node_number: _Ints,
    node_kind: _Ints,
    node_value: _Floats,
    coordinate_class: _Ints,
    element_number: _Ints,
    element_kind: _Ints,
    element_node: _Ints,
    element_vector: _Floats,
    deformation_class: _Ints,
    stresses: _Floats,
    motions: _Floats,
    pairs: _Ints,
    /,
) -> tuple[_Floats, _Ints, int]: ...
