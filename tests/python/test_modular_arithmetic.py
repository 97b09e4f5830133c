# SPDX-License-Identifier: BSD-3-Clause
"""Arithmetic modulo a prime against Python's integers.

flexact_modular.c is compiled here twice: with integers of 128 bits, and as where there are none.
"""

from __future__ import annotations

import ctypes
import random
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

SOURCE = Path(__file__).resolve().parents[2] / "fortran" / "linalg" / "flexact_modular.c"
#: For these seeds; FLINT 2.9 gives the same.
PRIMES = {
    0: 1436181577168885933,
    1: 2092956725965666991,
    -1: 1374360167231352461,
    2024: 1638610897316569223,
    1 << 62: 1315079820734718793,
}
Matrix = list[list[int]]


@pytest.fixture(scope="module", params=[[], ["-U__SIZEOF_INT128__"]], ids=["wide", "narrow"])
def library(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> ctypes.CDLL:
    if shutil.which("cc") is None:
        pytest.skip("needs a compiler")
    made = tmp_path_factory.mktemp("modular") / "modular.so"
    words = ["cc", "-shared", "-fPIC", "-O2", "-Wall", "-Wextra", "-Werror", *request.param]
    subprocess.run([*words, str(SOURCE), "-o", str(made)], check=True)
    loaded = ctypes.CDLL(str(made))
    for name, count in (("random_prime", 1), ("modular_product", 3), ("modular_inverse", 2)):
        function = getattr(loaded, f"flexact_{name}")
        function.argtypes, function.restype = [ctypes.c_int64] * count, ctypes.c_int64
    return loaded


def entries_of(matrix: Matrix, columns: int) -> ctypes.Array[ctypes.c_int64]:
    return (ctypes.c_int64 * (len(matrix) * columns))(*(x for row in matrix for x in row))


def echelon_of(matrix: Matrix, columns: int, prime: int) -> tuple[int, Matrix]:
    """Gauss's and Jordan's elimination in integers of Python."""
    rows, rank = [list(row) for row in matrix], 0
    for j in range(columns):
        pivot = next((i for i in range(rank, len(rows)) if rows[i][j]), None)
        if pivot is None:
            continue
        rows[rank], rows[pivot] = rows[pivot], rows[rank]
        scale = pow(rows[rank][j], -1, prime)
        rows[rank] = [x * scale % prime for x in rows[rank]]
        for i, row in enumerate(rows):
            if i != rank and row[j]:
                rows[i] = [(x - row[j] * y) % prime for x, y in zip(row, rows[rank], strict=True)]
        rank += 1
    return rank, rows


def test_primes_of_seeds(library: ctypes.CDLL) -> None:
    for seed, prime in PRIMES.items():
        assert library.flexact_random_prime(seed) == prime


def test_products_and_inverses(library: ctypes.CDLL) -> None:
    draw = random.Random(1)
    for prime in (2, 3, (1 << 31) - 1, (1 << 61) - 1, *PRIMES.values()):
        for a in (1, prime - 1, *(draw.randrange(1, prime) for _ in range(200))):
            b = draw.choice((0, 1, prime - 1, draw.randrange(prime)))
            assert library.flexact_modular_product(a, b, prime) == a * b % prime
            assert library.flexact_modular_inverse(a, prime) == pow(a, -1, prime)


@pytest.mark.parametrize(
    "draw_entry",
    [
        lambda draw, prime: draw.randrange(prime),
        lambda draw, prime: draw.choice((0, 0, 0, 1, prime - 1)),
        lambda draw, prime: prime - 1 - draw.randrange(3),
    ],
    ids=["any", "sparse", "largest"],
)
def test_ranks_and_echelon_forms(
    draw_entry: Callable[[random.Random, int], int], library: ctypes.CDLL
) -> None:
    """Of products of narrow matrices, too, whose rank is less than their sides."""
    draw = random.Random(2)
    for prime in (2, 7, (1 << 61) - 1, *PRIMES.values()):
        for _ in range(12):
            rows, columns, inner = draw.randrange(12), draw.randrange(12), draw.randrange(1, 9)
            left = [[draw_entry(draw, prime) for _ in range(inner)] for _ in range(rows)]
            right = [[draw_entry(draw, prime) for _ in range(columns)] for _ in range(inner)]
            matrix = [
                [sum(row[k] * right[k][j] for k in range(inner)) % prime for j in range(columns)]
                for row in left
            ]
            rank, form = echelon_of(matrix, columns, prime)
            given = entries_of(matrix, columns)
            modulus = ctypes.c_int64(prime)
            assert library.flexact_dense_modular_rank(rows, columns, given, modulus) == rank
            assert library.flexact_modular_echelon(rows, columns, given, modulus) == rank
            assert list(given) == [x for row in form for x in row]


def test_a_matrix_that_is_too_large_for_the_stack(library: ctypes.CDLL) -> None:
    """Vandermonde's, with different numbers, has full rank; with one of them twice, one less."""
    prime, n = (1 << 61) - 1, 80
    for numbers, rank in ((range(n), n), ((*range(n - 1), 5), n - 1)):
        matrix = [[pow(x, j, prime) for j in range(n)] for x in numbers]
        given = entries_of(matrix, n)
        assert library.flexact_dense_modular_rank(n, n, given, ctypes.c_int64(prime)) == rank
