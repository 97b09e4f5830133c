/* SPDX-License-Identifier: BSD-3-Clause */
/* CHOLMOD behind flat functions, for flexact_cholmod.f90. In C because CHOLMOD's
 * settings and factors are fields of structs whose layout changes between its
 * versions. Indices count from 0.
 *
 * Symmetric matrices are given by their lower triangles, column by column. */
#include <stddef.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <cholmod.h>

typedef struct {
    cholmod_common common;
    cholmod_factor *factor;
    cholmod_dense *x, *y, *e; /* kept from one solution to the next */
} chol;

static cholmod_sparse lower(int n, int *start, int *place, double *value)
{
    cholmod_sparse a;
    memset(&a, 0, sizeof a);
    a.nrow = a.ncol = n;
    a.nzmax = start[n];
    a.p = start;
    a.i = place;
    a.x = value;
    a.stype = -1;
    a.itype = CHOLMOD_INT;
    a.xtype = value ? CHOLMOD_REAL : CHOLMOD_PATTERN;
    a.dtype = CHOLMOD_DOUBLE;
    a.sorted = 0;
    a.packed = 1;
    return a;
}

static void begin(cholmod_common *common)
{
    cholmod_start(common);
    common->print = 0;
    common->nmethods = 1;
    common->postorder = 1;
    common->final_ll = 1;
}

void flexact_cholmod_free(void *handle)
{
    chol *c = handle;
    if (!c)
        return;
    cholmod_free_dense(&c->x, &c->common);
    cholmod_free_dense(&c->y, &c->common);
    cholmod_free_dense(&c->e, &c->common);
    cholmod_free_factor(&c->factor, &c->common);
    cholmod_finish(&c->common);
    free(c);
}

/* Symbolic analysis in a given order; entries: of the factor that will come, widest: of
 * its longest column. */
void *flexact_cholmod_analyse(int n, int *start, int *place, int *order, double *entries, int *widest)
{
    chol *c = calloc(1, sizeof *c);
    cholmod_sparse a = lower(n, start, place, NULL);
    if (!c)
        return NULL;
    begin(&c->common);
    c->common.method[0].ordering = CHOLMOD_GIVEN;
    c->factor = cholmod_analyze_p(&a, order, NULL, 0, &c->common);
    *entries = c->common.lnz;
    if (!c->factor) {
        flexact_cholmod_free(c);
        return NULL;
    }
    *widest = 0;
    for (int j = 0; j < n; j++) {
        int count = ((int *)c->factor->ColCount)[j];
        *widest = count > *widest ? count : *widest;
    }
    return c;
}

/* 0, or the column (from 1) at which the matrix is not positive definite, or -1
 * where memory does not suffice. */
int flexact_cholmod_factor(void *handle, int n, int *start, int *place, double *value)
{
    chol *c = handle;
    cholmod_sparse a = lower(n, start, place, value);
    c->common.status = CHOLMOD_OK;
    if (!cholmod_factorize(&a, c->factor, &c->common) || c->common.status < 0)
        return -1;
    if (c->factor->minor < (size_t)n) {
        int *order = c->factor->Perm;
        return 1 + (order ? order[c->factor->minor] : (int)c->factor->minor);
    }
    return 0;
}

/* The squares of the diagonal of the factor, in the order of the matrix. */
void flexact_cholmod_pivots(void *handle, double *pivot)
{
    chol *c = handle;
    cholmod_factor *f = c->factor;
    int *order = f->Perm;
    double *x = f->x;
    size_t n = f->n, j, s;
    if (f->is_super) {
        int *super = f->super, *pi = f->pi, *px = f->px;
        for (s = 0; s < f->nsuper; s++) {
            size_t rows = (size_t)(pi[s + 1] - pi[s]);
            for (j = 0; j < (size_t)(super[s + 1] - super[s]); j++) {
                double d = x[(size_t)px[s] + j * rows + j];
                size_t column = (size_t)super[s] + j;
                pivot[order ? (size_t)order[column] : column] = d * d;
            }
        }
    } else {
        int *p = f->p;
        for (j = 0; j < n; j++) {
            double d = x[p[j]];
            pivot[order ? (size_t)order[j] : j] = f->is_ll ? d * d : d;
        }
    }
}

/* Columns of L that share their rows, side by side: a supernode, or one column. Entry
 * (i, j) is value[i + j * rows], i >= j; the first rows are the columns themselves. */
typedef struct {
    size_t rows, columns;
    int *row;
    double *value;
} panel;

static size_t panels_of(cholmod_factor *f) { return f->is_super ? f->nsuper : f->n; }

static panel panel_of(cholmod_factor *f, size_t k)
{
    panel made;
    if (f->is_super) {
        int *first = f->super, *pi = f->pi, *px = f->px, *row = f->s;
        made.rows = (size_t)(pi[k + 1] - pi[k]);
        made.columns = (size_t)(first[k + 1] - first[k]);
        made.row = row + pi[k];
        made.value = (double *)f->x + px[k];
    } else {
        int *p = f->p, *nz = f->nz, *row = f->i;
        made.rows = (size_t)nz[k];
        made.columns = 1;
        made.row = row + p[k];
        made.value = (double *)f->x + p[k];
    }
    return made;
}

/* Four sums side by side, which the processor adds at once. */
static double sum_of_products(size_t n, const double *a, const double *x)
{
    double s0 = 0, s1 = 0, s2 = 0, s3 = 0;
    size_t i;
    for (i = 0; i + 4 <= n; i += 4) {
        s0 += fabs(a[i]) * x[i];
        s1 += fabs(a[i + 1]) * x[i + 1];
        s2 += fabs(a[i + 2]) * x[i + 2];
        s3 += fabs(a[i + 3]) * x[i + 3];
    }
    for (; i < n; i++)
        s0 += fabs(a[i]) * x[i];
    return (s0 + s1) + (s2 + s3);
}

/* z = |L| |L'| x, with room for two more vectors. */
static void multiply_twice(cholmod_factor *f, const double *x, double *z, double *room)
{
    size_t i, j, k;
    double *from = room, *to = room + f->n;
    memset(z, 0, sizeof(double) * f->n);
    for (k = 0; k < panels_of(f); k++) {
        panel p = panel_of(f, k);
        for (i = 0; i < p.rows; i++) {
            from[i] = x[p.row[i]];
            to[i] = 0;
        }
        for (j = 0; j < p.columns; j++) {
            double *column = p.value + j * p.rows;
            double sum = sum_of_products(p.rows - j, column + j, from + j);
            for (i = j; i < p.rows; i++)
                to[i] += fabs(column[i]) * sum;
        }
        for (i = 0; i < p.rows; i++)
            z[p.row[i]] += to[i];
    }
}

/* Entries of L in each of its rows, zeros that pad a supernode with them. */
static void count_in_rows(cholmod_factor *f, double *count)
{
    size_t i, k;
    memset(count, 0, sizeof(double) * f->n);
    for (k = 0; k < panels_of(f); k++) {
        panel p = panel_of(f, k);
        for (i = 0; i < p.rows; i++)
            count[p.row[i]] += (double)(i < p.columns ? i + 1 : p.columns);
    }
}

/* By how much, in the 2-norm, L L' may differ from what was factorised: see
 * flexact_backward_error.f90. Infinite where memory does not suffice. enough: no better bound than
 * this is sought. */
double flexact_cholmod_error(void *handle, double unit, int extra, double enough)
{
    chol *c = handle;
    cholmod_factor *f = c->factor;
    size_t n = f->n, i;
    int round, sound = 1;
    double *w = malloc(5 * n * sizeof *w), *x, *z, bound = HUGE_VAL;
    if (!w)
        return HUGE_VAL;
    x = w + n;
    z = x + n;
    count_in_rows(f, w);
    for (i = 0; i < n; i++) {
        double k = (w[i] + extra) * unit;
        w[i] = k / (1 - k);
        x[i] = sqrt(w[i]);
    }
    for (round = 0; round < 2 && bound > enough; round++) {
        double largest = 0;
        multiply_twice(f, x, z, z + n);
        for (i = 0; i < n; i++) {
            double next = w[i] * z[i];
            double ratio = next / x[i];
            sound = sound && ratio < HUGE_VAL;
            largest = ratio > largest ? ratio : largest;
            x[i] = next;
        }
        bound = largest < bound ? largest : bound;
    }
    free(w);
    return sound ? bound : HUGE_VAL;
}

/* Solve for k right-hand sides, side by side. */
int flexact_cholmod_solve(void *handle, int n, int k, double *b, double *x)
{
    chol *c = handle;
    cholmod_dense right;
    memset(&right, 0, sizeof right);
    right.nrow = right.d = n;
    right.ncol = k;
    right.nzmax = (size_t)n * (size_t)k;
    right.x = b;
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    if (!cholmod_solve2(CHOLMOD_A, c->factor, &right, NULL, &c->x, NULL, &c->y, &c->e, &c->common))
        return -1;
    memcpy(x, c->x->x, sizeof(double) * (size_t)n * (size_t)k);
    return 0;
}
