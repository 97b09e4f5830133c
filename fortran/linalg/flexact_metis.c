/* SPDX-License-Identifier: BSD-3-Clause */
/* METIS behind one flat function, for flexact_metis.f90: its integers have a width that its header
 * tells, and it ends the process where it gets no memory, so that we ask for it before.
 *
 * To leave its depths after an error it raises SIGTERM or SIGABRT, and handles both while it is at
 * work, by a jump that is good in its own thread alone. So one call goes after the other, and as
 * soon as its handlers are set ours take their place: they leave to METIS what it has raised, and
 * do with all other signals at once what the program wants. */
#include <stddef.h>

#ifdef FLEXACT_WITH_METIS
#include <stdlib.h>
#include <metis.h>

#if defined(__unix__) || defined(__APPLE__)
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <time.h>

enum { handled = 2 };
static const int numbers[handled] = {SIGTERM, SIGABRT};
static pthread_mutex_t turn = PTHREAD_MUTEX_INITIALIZER;
/* Of the call that is at work: what the program wants done with signals, and what METIS does. */
static struct sigaction wanted[handled], theirs[handled];
static pthread_t at_work;
static volatile int is_at_work, is_done, is_looking;

static void restore(void)
{
    int k;
    for (k = 0; k < handled; k++) sigaction(numbers[k], &wanted[k], NULL);
}

static void pass_on(int number, siginfo_t *info, void *context)
{
    int k = number == numbers[0] ? 0 : 1;
    int is_raised = pthread_equal(pthread_self(), at_work);
#ifdef SI_TKILL
    is_raised = is_raised && info->si_code == SI_TKILL;
#endif
    if (is_raised) {
        theirs[k].sa_handler(number);
    } else if (wanted[k].sa_flags & SA_SIGINFO) {
        wanted[k].sa_sigaction(number, info, context);
    } else if (wanted[k].sa_handler == SIG_DFL) {
        sigaction(number, &wanted[k], NULL);
        raise(number);
    } else if (wanted[k].sa_handler != SIG_IGN) {
        wanted[k].sa_handler(number);
    }
}

/* METIS calls nobody between the setting of its handlers and its end, so that another thread has to
 * look; it is there within some hundredths of a millisecond where a processor is free. */
static void *take_over(void *none)
{
    const struct timespec pause = {0, 10000};
    struct sigaction ours;
    int k;
    is_looking = 1;
    ours.sa_sigaction = pass_on;
    ours.sa_flags = SA_SIGINFO | SA_NODEFER;
    sigemptyset(&ours.sa_mask);
    for (k = 0; k < handled; k++) {
        for (;;) {
            if (is_done) return none;
            sigaction(numbers[k], NULL, &theirs[k]);
            if (theirs[k].sa_handler != wanted[k].sa_handler) break;
            nanosleep(&pause, NULL);
        }
        sigaction(numbers[k], &ours, NULL);
    }
    return none;
}

/* The thread that METIS is at work in stays behind in the parent. */
static void in_child(void)
{
    if (is_at_work) restore();
    is_at_work = 0;
    pthread_mutex_init(&turn, NULL);
}

__attribute__((constructor)) static void load(void) { pthread_atfork(NULL, NULL, in_child); }

static int nested_dissection(idx_t *vertices, idx_t *from, idx_t *near, idx_t *order, idx_t *inverse)
{
    pthread_attr_t small;
    pthread_t taker;
    sigset_t all, mask;
    int k, is_taken, status;
    pthread_mutex_lock(&turn);
    for (k = 0; k < handled; k++) sigaction(numbers[k], NULL, &wanted[k]);
    at_work = pthread_self();
    is_done = is_looking = 0;
    is_at_work = 1;
    /* Signals are for the threads of the program. */
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &mask);
    pthread_attr_init(&small);
    pthread_attr_setstacksize(&small, (size_t)1 << 17);
    is_taken = pthread_create(&taker, &small, take_over, NULL) == 0;
    pthread_attr_destroy(&small);
    pthread_sigmask(SIG_SETMASK, &mask, NULL);
    /* What is left is the moment until it looks for the first time. */
    while (is_taken && !is_looking) sched_yield();
    status = METIS_NodeND(vertices, from, near, NULL, NULL, order, inverse);
    is_done = 1;
    if (is_taken) pthread_join(taker, NULL);
    restore();
    pthread_sigmask(SIG_SETMASK, &mask, NULL);
    is_at_work = 0;
    pthread_mutex_unlock(&turn);
    /* One that came before its handler was replaced. */
    if (status == METIS_ERROR) raise(SIGTERM);
    return status;
}

#else

static int nested_dissection(idx_t *vertices, idx_t *from, idx_t *near, idx_t *order, idx_t *inverse)
{
    return METIS_NodeND(vertices, from, near, NULL, NULL, order, inverse);
}
#endif

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
        done = from[n] == 0 ? 0 : nested_dissection(&vertices, from, near, found, found + n) == METIS_OK;
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
