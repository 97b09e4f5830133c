// SPDX-License-Identifier: BSD-3-Clause
/* Arithmetic modulo a prime by FLINT (https://flintlib.org), where the build has it; elsewhere
 * flexact_modular.c does the same. */
#include <stdint.h>

#include <flint/flint.h>
#include <flint/nmod_mat.h>
#include <flint/ulong_extras.h>

int flexact_flint_is_there(void) { return 1; }

/* The next number of a generator by Steele, Lea and Flood, OOPSLA 2014 ("splitmix"). */
static uint64_t next_of(uint64_t *state)
{
    uint64_t z = (*state += UINT64_C(0x9e3779b97f4a7c15));
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/* A prime from 2**60 to 2**61, each as likely as any other. */
int64_t flexact_flint_prime(int64_t seed)
{
    uint64_t state = (uint64_t)seed, candidate;
    do
        candidate = (UINT64_C(1) << 60) | (next_of(&state) >> 4) | 1;
    while (!n_is_prime(candidate));
    return (int64_t)candidate;
}

int64_t flexact_flint_times(int64_t a, int64_t b, int64_t modulus)
{
    return (int64_t)n_mulmod2((ulong)a, (ulong)b, (ulong)modulus);
}

int64_t flexact_flint_inverse(int64_t a, int64_t prime)
{
    return (int64_t)n_invmod((ulong)a, (ulong)prime);
}

/* Rank of a matrix modulo a prime, row by row. */
int flexact_flint_rank(int rows, int columns, const int64_t *entry, int64_t modulus)
{
    nmod_mat_t matrix;
    nmod_mat_init(matrix, rows, columns, (ulong)modulus);
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < columns; j++)
            nmod_mat_entry(matrix, i, j) = (ulong)entry[(int64_t)i * columns + j];
    int rank = (int)nmod_mat_rank(matrix);
    nmod_mat_clear(matrix);
    return rank;
}

/* The reduced echelon form modulo a prime in place of a matrix, row by row; its rank. */
int flexact_flint_echelon(int rows, int columns, int64_t *entry, int64_t modulus)
{
    nmod_mat_t matrix;
    nmod_mat_init(matrix, rows, columns, (ulong)modulus);
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < columns; j++)
            nmod_mat_entry(matrix, i, j) = (ulong)entry[(int64_t)i * columns + j];
    int rank = (int)nmod_mat_rref(matrix);
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < columns; j++)
            entry[(int64_t)i * columns + j] = (int64_t)nmod_mat_entry(matrix, i, j);
    nmod_mat_clear(matrix);
    return rank;
}
