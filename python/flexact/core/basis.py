# SPDX-License-Identifier: BSD-3-Clause
"""Vectors side by side, of which only the entries that are not zero are stored."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .arrays import FloatArray, IntArray


class Basis(NamedTuple):
    """Vectors side by side, of which only the entries that are not zero are stored."""

    size: int
    """Length of each vector."""
    start: IntArray
    """(k + 1,) where the entries of each of the k vectors begin, and where the last one ends."""
    place: IntArray
    """(entries,) place in the vector, from 0, ascending within a vector."""
    value: FloatArray
    """(entries,)."""

    @property
    def vectors(self) -> int:
        """Number of vectors."""
        return self.start.size - 1

    def vector(self, k: int) -> FloatArray:
        """(size,) vector k with its zeros."""
        made = np.zeros(self.size)
        place, value = self.entries(k)
        made[place] = value
        return made

    def entries(self, k: int) -> tuple[IntArray, FloatArray]:
        """Places and values of what is stored of vector k."""
        part = slice(int(self.start[k]), int(self.start[k + 1]))
        return self.place[part], self.value[part]

    def toarray(self) -> FloatArray:
        """(size, k) all vectors with their zeros."""
        made = np.zeros((self.size, self.vectors))
        made[self.place, self.of_entries()] = self.value
        return made

    def only(self, vectors: IntArray) -> Basis:
        """Some of the vectors."""
        counts = np.diff(self.start)[vectors]
        start = np.concatenate(([0], np.cumsum(counts)))
        entries = np.repeat(self.start[vectors] - start[:-1], counts) + np.arange(start[-1])
        return Basis(self.size, start.astype(np.int32), self.place[entries], self.value[entries])

    def of_entries(self) -> IntArray:
        """(entries,) the vector that each entry belongs to."""
        return np.repeat(np.arange(self.vectors, dtype=np.int32), np.diff(self.start))

    @classmethod
    def of_dense(cls, columns: FloatArray) -> Basis:
        """From the columns of a matrix (size, k)."""
        vector, index = np.nonzero(columns.T)
        start = np.searchsorted(vector, np.arange(columns.shape[1] + 1)).astype(np.int32)
        return cls(columns.shape[0], start, index.astype(np.int32), columns.T[vector, index])
