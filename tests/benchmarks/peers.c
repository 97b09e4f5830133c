/* SPDX-License-Identifier: BSD-3-Clause */
/* Null spaces by bare SuiteSparse, for run.py to compare with.

   peers FILE qr|cholesky metis|default motions|both

   FILE holds D(c), scaled: rows, columns and entries as int64, then a matrix of compressed
   columns: starts and row numbers as int64, values as double. Prints one line of JSON:
   time and processor time [s], growth of the resident memory [bytes] while it ran, numbers of null vectors found
   of D and, with `both`, of its transpose (-1: not asked for, -2: more than it can hold), and
   the largest residual of a null vector of unit length.

   qr        SuiteSparse QR of D; null vectors are -R11 \ R12 and the identity below.
   cholesky  Supernodal Cholesky of D'D + c eps I, three block inverse iterations, and
             Rayleigh-Ritz on D itself, with a block that is widened until it holds a
             vector that is no null vector. */

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "SuiteSparseQR_C.h"
#include "cholmod.h"

typedef SuiteSparse_long Long;

/* What counts as zero among singular values of a matrix with rows of unit length. */
static const double zero = 1e-11;
static const Long most_vectors = 512;

void dgeqrf_(int *, int *, double *, int *, double *, double *, int *, int *);
void dorgqr_(int *, int *, int *, double *, int *, double *, double *, int *, int *);
void dgesvd_(char *, char *, int *, int *, double *, int *, double *, double *, int *, double *, int *,
             double *, int *, int *);

typedef struct {
    Long vectors;
    double residual;
} result_t;

static void give_up(const char *why) {
    fprintf(stderr, "peers: %s\n", why);
    exit(1);
}

static double seconds(clockid_t clock) {
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* A line of /proc/self/status [bytes]; 0 where there is none. */
static long memory(const char *name) {
    char line[256];
    long kilobytes = 0;
    FILE *file = fopen("/proc/self/status", "r");
    if (!file) return 0;
    while (fgets(line, sizeof line, file))
        if (!strncmp(line, name, strlen(name))) sscanf(line + strlen(name), "%ld", &kilobytes);
    fclose(file);
    return 1024 * kilobytes;
}

/* Makes the highest resident memory the present one. */
static void forget_peak(void) {
    FILE *file = fopen("/proc/self/clear_refs", "w");
    if (!file) return;
    fputs("5", file);
    fclose(file);
}

static void take(FILE *file, void *into, size_t size, size_t count) {
    if (fread(into, size, count, file) != count) give_up("the file of the matrix is short");
}

static cholmod_sparse *read_matrix(const char *path, cholmod_common *common) {
    int64_t size[3];
    FILE *file = fopen(path, "rb");
    if (!file) give_up("the file of the matrix is missing");
    take(file, size, sizeof *size, 3);
    cholmod_sparse *d = cholmod_l_allocate_sparse((size_t)size[0], (size_t)size[1], (size_t)size[2], 1, 1, 0,
                                                  CHOLMOD_REAL, common);
    if (!d) give_up("not enough memory for the matrix");
    take(file, d->p, sizeof(Long), (size_t)size[1] + 1);
    take(file, d->i, sizeof(Long), (size_t)size[2]);
    take(file, d->x, sizeof(double), (size_t)size[2]);
    fclose(file);
    return d;
}

/* The largest |D x| of the columns of X (n, k), each of unit length. */
static double largest_residual(cholmod_sparse *d, const double *x, Long k) {
    const Long *start = d->p, *row = d->i;
    const double *value = d->x;
    double *y = malloc(d->nrow * sizeof *y), largest = 0.0;
    for (Long v = 0; v < k; v++, x += d->ncol) {
        double square = 0.0, norm = 0.0;
        memset(y, 0, d->nrow * sizeof *y);
        for (size_t j = 0; j < d->ncol; j++) {
            norm += x[j] * x[j];
            for (Long p = start[j]; p < start[j + 1]; p++) y[row[p]] += value[p] * x[j];
        }
        for (size_t i = 0; i < d->nrow; i++) square += y[i] * y[i];
        largest = fmax(largest, sqrt(square / norm));
    }
    free(y);
    return largest;
}

/* X (n, k) = E [-R11 \ R12; I], by columns of R, which is upper triangular up to its rank. */
static void solve_for_null_vectors(cholmod_sparse *r, const Long *order, Long rank, double *x) {
    const Long *start = r->p, *row = r->i, n = (Long)r->ncol;
    const double *value = r->x;
    double *y = malloc((size_t)n * sizeof *y);
    for (Long v = rank; v < n; v++, x += n) {
        memset(y, 0, (size_t)n * sizeof *y);
        y[v] = -1.0;
        for (Long p = start[v]; p < start[v + 1]; p++)
            if (row[p] < rank) y[row[p]] = value[p];
        for (Long j = rank - 1; j >= 0; j--) {
            if (y[j] == 0.0) continue;
            y[j] /= value[start[j + 1] - 1]; /* the diagonal stands last */
            for (Long p = start[j]; p < start[j + 1] - 1; p++) y[row[p]] -= value[p] * y[j];
        }
        for (Long j = 0; j < n; j++) x[order ? order[j] : j] = y[j];
    }
    free(y);
}

static result_t by_qr(cholmod_sparse *d, int metis, cholmod_common *common) {
    result_t result = {0, 0.0};
    cholmod_sparse *r = NULL;
    Long *order = NULL;
    const int ordering = metis ? SPQR_ORDERING_METIS : SPQR_ORDERING_DEFAULT;
    const Long rank = SuiteSparseQR_C(ordering, SPQR_DEFAULT_TOL, 0, 0, d, NULL, NULL, NULL, NULL, &r, &order, NULL,
                                      NULL, NULL, common);
    if (rank < 0) give_up("SuiteSparse QR failed");
    cholmod_l_sort(r, common);
    result.vectors = (Long)d->ncol - rank;
    if (result.vectors > most_vectors) {
        result.vectors = -2;
    } else if (result.vectors > 0) {
        double *x = malloc((size_t)result.vectors * d->ncol * sizeof *x);
        solve_for_null_vectors(r, order, rank, x);
        result.residual = largest_residual(d, x, result.vectors);
        free(x);
    }
    cholmod_l_free_sparse(&r, common);
    cholmod_l_free((size_t)d->ncol, sizeof *order, order, common);
    return result;
}

static void orthonormalise(double *x, int n, int k) {
    int info, words = 64 * k;
    double *tau = malloc((size_t)k * sizeof *tau), *work = malloc((size_t)words * sizeof *work);
    dgeqrf_(&n, &k, x, &n, tau, work, &words, &info);
    dorgqr_(&n, &k, &k, x, &n, tau, work, &words, &info);
    free(tau);
    free(work);
}

/* Y (m, k) = D X. */
static void multiply(cholmod_sparse *d, cholmod_dense *x, cholmod_dense *y, cholmod_common *common) {
    double one[2] = {1.0, 0.0}, none[2] = {0.0, 0.0};
    cholmod_l_sdmult(d, 0, one, none, x, y, common);
}

/* Singular values (k) of Y (m, k), descending, and their right vectors' transpose (k, k). */
static void small_svd(double *y, int m, int k, double *s, double *vt) {
    int info, words = 64 * k + 10 * k, one = 1;
    double *tau = malloc((size_t)k * sizeof *tau), *work = malloc((size_t)words * sizeof *work);
    double *r = calloc((size_t)k * (size_t)k, sizeof *r);
    dgeqrf_(&m, &k, y, &m, tau, work, &words, &info);
    for (int j = 0; j < k; j++)
        for (int i = 0; i <= j; i++) r[i + k * j] = y[i + (size_t)m * (size_t)j];
    dgesvd_("N", "A", &k, &k, r, &k, s, NULL, &one, vt, &k, work, &words, &info);
    free(tau);
    free(work);
    free(r);
}

/* The last `zeros` rows of vt taken of X: vectors (n, zeros). */
static double *ritz_vectors(const double *x, const double *vt, Long n, Long k, Long zeros) {
    double *made = calloc((size_t)(n * zeros) + 1, sizeof *made);
    for (Long v = 0; v < zeros; v++)
        for (Long j = 0; j < k; j++)
            for (Long i = 0; i < n; i++) made[i + n * v] += x[i + n * j] * vt[k - zeros + v + k * j];
    return made;
}

static void iterate(cholmod_factor *factor, cholmod_dense **x, cholmod_common *common) {
    cholmod_dense *next = NULL, *work1 = NULL, *work2 = NULL;
    for (int step = 0; step < 3; step++) {
        cholmod_l_solve2(CHOLMOD_A, factor, *x, NULL, &next, NULL, &work1, &work2, common);
        cholmod_dense *old = *x;
        *x = next;
        next = old;
        orthonormalise((*x)->x, (int)(*x)->nrow, (int)(*x)->ncol);
    }
    cholmod_l_free_dense(&next, common);
    cholmod_l_free_dense(&work1, common);
    cholmod_l_free_dense(&work2, common);
}

/* Null vectors in a block of width k; k of them where the block is too narrow. */
static result_t rayleigh_ritz(cholmod_sparse *d, cholmod_factor *factor, Long k, cholmod_common *common) {
    result_t result = {0, 0.0};
    const Long n = (Long)d->ncol;
    cholmod_dense *x = cholmod_l_allocate_dense((size_t)n, (size_t)k, (size_t)n, CHOLMOD_REAL, common);
    cholmod_dense *y = cholmod_l_allocate_dense(d->nrow, (size_t)k, d->nrow, CHOLMOD_REAL, common);
    double *s = malloc((size_t)k * sizeof *s), *vt = malloc((size_t)(k * k) * sizeof *vt);
    for (Long i = 0; i < n * k; i++) ((double *)x->x)[i] = drand48() - 0.5;
    iterate(factor, &x, common);
    multiply(d, x, y, common);
    small_svd(y->x, (int)d->nrow, (int)k, s, vt);
    while (result.vectors < k && s[k - 1 - result.vectors] <= zero) result.vectors++;
    double *null = ritz_vectors(x->x, vt, n, k, result.vectors);
    if (result.vectors < k) result.residual = largest_residual(d, null, result.vectors);
    free(null);
    free(s);
    free(vt);
    cholmod_l_free_dense(&x, common);
    cholmod_l_free_dense(&y, common);
    return result;
}

static result_t by_cholesky(cholmod_sparse *d, int metis, cholmod_common *common) {
    double shift[2] = {0.0, 0.0};
    result_t result = {-2, 0.0};
    const double norm = cholmod_l_norm_sparse(d, 1, common) * cholmod_l_norm_sparse(d, 0, common);
    common->nmethods = 1;
    common->method[0].ordering = metis ? CHOLMOD_METIS : CHOLMOD_AMD;
    common->postorder = 1;
    common->supernodal = CHOLMOD_SUPERNODAL;
    shift[0] = 10.0 * 2.2e-16 * norm;
    cholmod_sparse *transpose = cholmod_l_transpose(d, 1, common);
    cholmod_sparse *gram = cholmod_l_aat(transpose, NULL, 0, 1, common);
    cholmod_l_free_sparse(&transpose, common);
    gram->stype = 1;
    cholmod_factor *factor = cholmod_l_analyze(gram, common);
    cholmod_l_factorize_p(gram, shift, NULL, 0, factor, common);
    if (common->status != CHOLMOD_OK) give_up("Cholesky failed");
    cholmod_l_free_sparse(&gram, common);
    for (Long k = 12; k <= most_vectors; k *= 2) {
        const Long width = k < (Long)d->ncol ? k : (Long)d->ncol;
        const Long most = width < (Long)d->nrow ? width : (Long)d->nrow;
        result = rayleigh_ritz(d, factor, most, common);
        if (result.vectors < most) break;
        result.vectors = -2;
    }
    cholmod_l_free_factor(&factor, common);
    return result;
}

int main(int count, char **word) {
    cholmod_common common;
    if (count != 5) give_up("usage: peers FILE qr|cholesky metis|default motions|both");
    const int qr = !strcmp(word[2], "qr"), metis = !strcmp(word[3], "metis"), both = !strcmp(word[4], "both");
    cholmod_l_start(&common);
    common.SPQR_nthreads = 1;
    cholmod_sparse *d = read_matrix(word[1], &common);
    forget_peak();
    const long before = memory("VmRSS:");
    const double start = seconds(CLOCK_MONOTONIC), busy = seconds(CLOCK_PROCESS_CPUTIME_ID);
    result_t left = {-1, 0.0}, right = qr ? by_qr(d, metis, &common) : by_cholesky(d, metis, &common);
    if (both) {
        cholmod_sparse *transpose = cholmod_l_transpose(d, 1, &common);
        left = qr ? by_qr(transpose, metis, &common) : by_cholesky(transpose, metis, &common);
        cholmod_l_free_sparse(&transpose, &common);
    }
    const double time = seconds(CLOCK_MONOTONIC) - start, processor = seconds(CLOCK_PROCESS_CPUTIME_ID) - busy;
    printf("{\"time\": %.9g, \"processor\": %.9g, \"memory\": %ld, \"motions\": %ld, \"stresses\": %ld, \"residual\": %.3g}\n", time, processor,
           memory("VmHWM:") - before, (long)right.vectors, (long)left.vectors, fmax(left.residual, right.residual));
    cholmod_l_free_sparse(&d, &common);
    cholmod_l_finish(&common);
    return 0;
}
