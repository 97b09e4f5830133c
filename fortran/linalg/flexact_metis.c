/* SPDX-License-Identifier: BSD-3-Clause */
/* METIS behind one flat function, for flexact_metis.f90: its integers have a width that its header
 * tells, and it ends the process where it gets no memory, so that we ask for it before. */
#include <stddef.h>

#ifdef FLEXACT_WITH_METIS
#include <stdlib.h>
#include <metis.h>

int flexact_metis_is_there(void) { return 1; }

/* Whether there is room for what METIS takes, as CHOLMOD's manual puts it. */
static int has_room(size_t n, size_t entries)
{
    void *room = malloc((10 * entries + 50 * n + 4096) * sizeof(idx_t));
    free(room);
    return room != NULL;
}

/* Both triangles, the diagonal left out. */
static void fill(int n, const int *start, const int *place, idx_t *from, idx_t *near)
{
    int j, e;
    for (j = 0; j < n; j++)
        for (e = start[j]; e < start[j + 1]; e++)
            if (place[e] != j) {
                from[j + 2]++;
                from[place[e] + 2]++;
            }
    for (j = 2; j <= n + 1; j++) from[j] += from[j - 1];
    for (j = 0; j < n; j++)
        for (e = start[j]; e < start[j + 1]; e++)
            if (place[e] != j) {
                near[from[j + 1]++] = place[e];
                near[from[place[e] + 1]++] = j;
            }
}

/* 0 with the columns in the order of elimination, or -1 where memory does not suffice. */
int flexact_metis_order(int n, const int *start, const int *place, int *order)
{
    size_t entries = 2 * (size_t)start[n];
    idx_t vertices = n, *from, *near, *found;
    int done, j;
    if (entries >= (size_t)IDX_MAX) return -1;
    from = calloc((size_t)n + 2, sizeof *from);
    near = malloc((entries + 1) * sizeof *near);
    found = malloc(2 * ((size_t)n + 1) * sizeof *found);
    done = from && near && found && has_room((size_t)n, entries);
    if (done) {
        fill(n, start, place, from, near);
        done = from[n] == 0 ? 0 : METIS_NodeND(&vertices, from, near, NULL, NULL, found, found + n) == METIS_OK;
        /* Nothing is joined with anything: any order will do. */
        if (from[n] == 0)
            for (done = 1, j = 0; j < n; j++) found[j] = j;
        for (j = 0; done && j < n; j++) order[j] = (int)found[j];
    }
    free(from);
    free(near);
    free(found);
    return done ? 0 : -1;
}

#else

int flexact_metis_is_there(void) { return 0; }

int flexact_metis_order(int n, const int *start, const int *place, int *order)
{
    (void)n, (void)start, (void)place, (void)order;
    return -1;
}
#endif
