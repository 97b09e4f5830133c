# SPDX-License-Identifier: BSD-3-Clause
"""The same topology in another geometry, or with something else held."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import BoolArray, FloatArray, IntArray, floats
from ..core.elements import AXES, Class, NodeKind, coordinate_name
from .data import ModelData


def positions_given(data: ModelData, given: ArrayLike, *, many: bool) -> FloatArray:
    """(nodes, 3) positions [m] as given for a model, or (variants, nodes, 3).

    What stands for nodes that are orientations, and for z in a planar model, is ignored.

    Raises:
        TypeError: they are no numbers.
        ValueError: the shape is another, or a position is not finite.
    """
    array = data.units.si(floats(given, "positions"), "m")
    _require_shape("positions", array.shape, (data.arrays.node_number.size, 3), many)
    used = axes_used(data)
    wrong = ~np.isfinite(array) & used
    if wrong.any():
        place = np.argwhere(wrong)[0].tolist()
        number = int(data.arrays.node_number[place[-2]])
        where = f"variant {place[0]}, counted from 0, has " if many else "there is "
        value = data.units.shown(float(array[tuple(place)]), "m")
        raise ValueError(
            f"{where}{value} as {'xyz'[place[-1]]} of node {number}; positions must be finite"
        )
    return array


def axes_used(data: ModelData) -> BoolArray:
    """(nodes, 3) which of the numbers of positions there are."""
    kind = data.arrays.node_kind
    used = np.zeros((kind.size, 3), np.bool_)
    used[kind == NodeKind.POSITION] = True
    used[kind == NodeKind.PLANAR_POSITION, :2] = True
    return used


def held_given(data: ModelData, given: ArrayLike, *, many: bool) -> BoolArray:
    """(elements, 6) which deformations are held, as given for a model, or (variants, elements, 6).

    What stands for deformations that an element has not is ignored.

    Raises:
        TypeError: they are no truth values.
        ValueError: the shape is another.
    """
    try:
        array = np.asarray(given)
    except ValueError:
        raise ValueError("what is held must be truth values of one shape") from None
    if array.dtype != np.bool_:
        raise TypeError(f"what is held must be truth values (bool), not {array.dtype}")
    _require_shape("what is held", array.shape, (data.arrays.element_number.size, 6), many)
    return array


def _require_shape(what: str, shape: Sequence[int], one: tuple[int, int], many: bool) -> None:
    if tuple(shape[-2:]) == one and len(shape) == (3 if many else 2):
        return
    rows = "nodes" if what == "positions" else "elements"
    wanted = f"(variants, {one[0]} {rows}, {one[1]})" if many else f"({one[0]} {rows}, {one[1]})"
    raise ValueError(f"{what} must have the shape {wanted}, not {tuple(shape)}")


def with_positions(data: ModelData, positions: FloatArray) -> ModelData:
    """The model with its nodes at other positions, (nodes, 3) as `positions_given` gives them."""
    arrays = data.arrays
    value = arrays.node_value.copy(order="F")
    used = axes_used(data).T
    value[:3][used] = positions.T[used]
    return _changed(data, replace_arrays={"node_value": value})


def with_vectors(data: ModelData, vectors: Mapping[int, Sequence[float]]) -> ModelData:
    """The model with other y vectors or axes of some elements.

    Args:
        data: The model.
        vectors: (3,) vector by the number of the element.

    Raises:
        KeyError: there is no such element.
    """
    made = data.arrays.element_vector.copy(order="F")
    for element, vector in vectors.items():
        made[:, data.element_index[element]] = vector
    return _changed(data, replace_arrays={"element_vector": made})


def with_held(data: ModelData, held: BoolArray) -> ModelData:
    """The model with these deformations held, (elements, 6), and the others released.

    What is declared independent stays so unless it is held.
    """
    return _changed(data, replace_arrays={"deformation_class": classes_held(data, held)})


def with_classes(
    data: ModelData,
    deformations: Mapping[tuple[int, int], Class],
    coordinates: Mapping[tuple[int, str], Class],
) -> ModelData:
    """The model with other classes of some deformations and coordinates.

    Args:
        data: The model.
        deformations: Class by the number of the element and that of the deformation, from 1.
        coordinates: Class by the number of the node and the coordinate's name, such as "rz".

    Raises:
        KeyError: there is no such element, deformation, node or coordinate.
    """
    arrays = data.arrays
    of_deformation = arrays.deformation_class.copy(order="F")
    of_coordinate = arrays.coordinate_class.copy(order="F")
    for (element, number), given in deformations.items():
        index = data.element_index[element]
        if not 1 <= number <= 6 or of_deformation[number - 1, index] == Class.NONE:
            raise KeyError((element, number))
        of_deformation[number - 1, index] = given
    for (node, name), given in coordinates.items():
        index = data.node_index[node]
        kind = int(arrays.node_kind[index])
        axis = next((a for a in AXES[kind] if coordinate_name(kind, a) == name), None)
        if axis is None:
            raise KeyError((node, name))
        of_coordinate[axis, index] = given
    changed = {"deformation_class": of_deformation, "coordinate_class": of_coordinate}
    return _changed(data, replace_arrays=changed)


def varied(data: ModelData, positions: FloatArray | None, held: BoolArray | None) -> ModelData:
    """The model with its nodes at other positions, or with something else held, or both."""
    made = data if positions is None else with_positions(data, positions)
    return made if held is None else with_held(made, held)


def classes_held(data: ModelData, held: BoolArray) -> IntArray:
    """(..., 6, elements) classes where these are held, (..., elements, 6)."""
    own = data.arrays.deformation_class
    released = np.where(own == Class.INDEPENDENT, own, np.int32(Class.DEPENDENT))
    made = np.where(np.swapaxes(held, -1, -2), np.int32(Class.FIXED), released)
    return np.where(own == Class.NONE, own, made).astype(np.int32)


def _changed(data: ModelData, replace_arrays: dict[str, np.ndarray]) -> ModelData:
    """The data with other arrays, to be checked anew; comments of its deck stay."""
    made = data.arrays._replace(
        **{name: np.asfortranarray(array) for name, array in replace_arrays.items()}
    )
    return replace(
        data, arrays=made, source=None, found=None, began_as=data.source or data.began_as
    )
