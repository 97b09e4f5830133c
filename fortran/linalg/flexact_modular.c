/* SPDX-License-Identifier: BSD-3-Clause */
/* Arithmetic modulo a prime, for flexact_modular.f90. Primes are below 2**61, so that four times
 * one fits. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* So many entries are copied to the stack instead of the heap, where there may be no room. */
enum { few = 64 * 64 };

static uint64_t below(uint64_t x, uint64_t bound) { return x < bound ? x : x - bound; }

#ifdef __SIZEOF_INT128__

__extension__ typedef unsigned __int128 wide;

static uint64_t times(uint64_t a, uint64_t b, uint64_t modulus) { return (uint64_t)((wide)a * b % modulus); }

/* The upper half of a product. */
static uint64_t times_high(uint64_t a, uint64_t b) { return (uint64_t)((wide)a * b >> 64); }

/* a * 2**64 by the modulus, which a is below. */
static uint64_t quotient_of(uint64_t a, uint64_t modulus) { return (uint64_t)(((wide)a << 64) / modulus); }

#else

/* The same bit by bit, on processors without integers of 128 bits. */
static uint64_t times(uint64_t a, uint64_t b, uint64_t modulus)
{
    uint64_t product = 0;
    a = below(a, modulus);
    for (; b > 0; b >>= 1) {
        if (b & 1) product = below(product + a, modulus);
        a = below(2 * a, modulus);
    }
    return product;
}

static uint64_t times_high(uint64_t a, uint64_t b)
{
    const uint64_t low = UINT32_MAX, middle = (a >> 32) * (b & low) + ((a & low) * (b & low) >> 32);
    return (a >> 32) * (b >> 32) + (middle >> 32) + (((a & low) * (b >> 32) + (middle & low)) >> 32);
}

static uint64_t quotient_of(uint64_t a, uint64_t modulus)
{
    uint64_t quotient = 0;
    for (int bit = 0; bit < 64; bit++) {
        quotient = 2 * quotient + (2 * a >= modulus);
        a = below(2 * a, modulus);
    }
    return quotient;
}

#endif

/* a b / 2**64 modulo an odd modulus, which both are below; inverse: of the modulus, modulo 2**64
 * (Montgomery, Mathematics of Computation 44, 1985). */
static uint64_t montgomery(uint64_t a, uint64_t b, uint64_t modulus, uint64_t inverse)
{
    const uint64_t high = times_high(a, b), other = times_high(a * b * inverse, modulus);
    return high < other ? high + (modulus - other) : high - other;
}

/* The inverse of an odd number modulo 2**64: each step doubles the bits that are right, three at first. */
static uint64_t inverse_of(uint64_t odd)
{
    uint64_t inverse = odd;
    for (int step = 0; step < 5; step++) inverse *= 2 - odd * inverse;
    return inverse;
}

/* Miller's and Rabin's test with the first twelve primes, which no number below 2**64 passes
 * that is composite (Sorenson and Webster, Mathematics of Computation 86, 2017). Numbers are
 * held times 2**64. */
static int is_prime(uint64_t n)
{
    static const uint64_t base[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};
    uint64_t odd = n - 1, one;
    const uint64_t inverse = inverse_of(n);
    int twos = 0;
    for (size_t i = 0; i < sizeof base / sizeof *base; i++)
        if (n % base[i] == 0) return n == base[i];
    for (; odd % 2 == 0; odd /= 2) twos++;
    one = -n % n;
    for (size_t i = 0; i < sizeof base / sizeof *base; i++) {
        uint64_t x = one, a = times(base[i], one, n);
        int k = 0;
        for (uint64_t exponent = odd; exponent > 0; exponent >>= 1) {
            if (exponent & 1) x = montgomery(x, a, n, inverse);
            a = montgomery(a, a, n, inverse);
        }
        if (x == one) continue;
        for (; x != n - one && k < twos; k++) x = montgomery(x, x, n, inverse);
        if (k == twos) return 0;
    }
    return 1;
}

/* The next number of a generator by Steele, Lea and Flood, OOPSLA 2014 ("splitmix"). */
static uint64_t next_of(uint64_t *state)
{
    uint64_t z = (*state += UINT64_C(0x9e3779b97f4a7c15));
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

int64_t flexact_random_prime(int64_t seed)
{
    uint64_t state = (uint64_t)seed, candidate;
    do
        candidate = (UINT64_C(1) << 60) | (next_of(&state) >> 4) | 1;
    while (!is_prime(candidate));
    return (int64_t)candidate;
}

int64_t flexact_modular_product(int64_t a, int64_t b, int64_t modulus)
{
    return (int64_t)times((uint64_t)a, (uint64_t)b, (uint64_t)modulus);
}

/* Euclid's algorithm, with the multiple of a that each remainder is. */
int64_t flexact_modular_inverse(int64_t a, int64_t prime)
{
    int64_t older = prime, newer = a, before = 0, now = 1;
    while (newer != 0) {
        int64_t quotient = older / newer, next = older - quotient * newer;
        older = newer, newer = next;
        next = before - quotient * now;
        before = now, now = next;
    }
    return before < 0 ? before + prime : before;
}

/* factor * number / 2**64 modulo an odd modulus, which both are below, without a division: a
 * multiple of the modulus that ends in the same 64 bits is taken off (Montgomery, Mathematics of
 * Computation 44, 1985). */
void flexact_modular_multiples(int count, int64_t *number, int64_t factor, int64_t modulus)
{
    const uint64_t m = (uint64_t)modulus, f = (uint64_t)factor;
    const uint64_t inverse = inverse_of(m);
    for (int j = 0; j < count; j++) number[j] = (int64_t)montgomery(f, (uint64_t)number[j], m, inverse);
}

/* row := row + factor * pivot, all below twice the modulus, which factor is below. Products with
 * one factor need no division: its quotient by the modulus is known beforehand (Shoup; see
 * Harvey, Journal of Symbolic Computation 60, 2014). */
static void add_multiple(uint64_t *row, const uint64_t *pivot, int count, uint64_t factor, uint64_t modulus)
{
    const uint64_t quotient = quotient_of(factor, modulus);
    for (int j = 0; j < count; j++) {
        const uint64_t turns = times_high(quotient, pivot[j]);
        row[j] = below(row[j] + (factor * pivot[j] - turns * modulus), 2 * modulus);
    }
}

static void scale(uint64_t *row, int count, uint64_t factor, uint64_t modulus)
{
    for (int j = 0; j < count; j++) row[j] = times(row[j], factor, modulus);
}

static void swap(uint64_t *a, uint64_t *b, int count)
{
    for (int j = 0; j < count; j++) {
        const uint64_t kept = a[j];
        a[j] = b[j];
        b[j] = kept;
    }
}

/* Gauss's elimination of rows below each pivot, and of those above it for the reduced form. */
static int eliminate(int rows, int columns, uint64_t *entry, uint64_t modulus, int is_reduced)
{
    int rank = 0;
    for (int j = 0; j < columns && rank < rows; j++) {
        uint64_t *pivot = entry + (int64_t)rank * columns + j;
        int i = rank;
        for (; i < rows; i++)
            if (below(entry[(int64_t)i * columns + j], modulus) != 0) break;
        if (i == rows) continue;
        if (i != rank) swap(pivot, entry + (int64_t)i * columns + j, columns - j);
        scale(pivot, columns - j, (uint64_t)flexact_modular_inverse((int64_t)below(*pivot, modulus), (int64_t)modulus),
              modulus);
        for (int k = is_reduced ? 0 : rank + 1; k < rows; k++) {
            uint64_t *row = entry + (int64_t)k * columns + j;
            const uint64_t first = below(*row, modulus);
            if (k != rank && first != 0) add_multiple(row, pivot, columns - j, modulus - first, modulus);
        }
        rank++;
    }
    return rank;
}

/* The rank; -1 where there is no room. */
int flexact_dense_modular_rank(int rows, int columns, const int64_t *entry, int64_t modulus)
{
    uint64_t small[few], *copy = small;
    const size_t count = (size_t)rows * (size_t)columns;
    int rank;
    if (count > few) copy = malloc(count * sizeof *copy);
    if (!copy) return -1;
    memcpy(copy, entry, count * sizeof *copy);
    rank = eliminate(rows, columns, copy, (uint64_t)modulus, 0);
    if (copy != small) free(copy);
    return rank;
}

int flexact_modular_echelon(int rows, int columns, int64_t *entry, int64_t modulus)
{
    uint64_t *row = (uint64_t *)entry;
    const int rank = eliminate(rows, columns, row, (uint64_t)modulus, 1);
    for (int64_t k = 0; k < (int64_t)rows * columns; k++) row[k] = below(row[k], (uint64_t)modulus);
    return rank;
}
