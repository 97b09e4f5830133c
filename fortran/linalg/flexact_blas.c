/* SPDX-License-Identifier: BSD-3-Clause */
/* What OpenBLAS must be told from outside, for flexact_blas.f90; with another
 * BLAS, where the weak symbols are null, nothing of it is done.
 *
 * Threads: several calls at once, each with all threads, keep each other waiting
 * (8 of 150 columns: a hundred times as long as one after the other), and small
 * matrices gain nothing by threads. Setting them for the calling thread alone
 * (openblas_set_num_threads_local) sets them for all in its releases so far.
 *
 * Memory: OpenBLAS takes a buffer of 128 MB of address space for each thread when
 * it is first used, and where it gets none it asks for ever. So we ask first. */
#include <stddef.h>
#include <string.h>

#if defined(__unix__) || defined(__APPLE__)
#define HAS_LIMITS
#include <sys/mman.h>
#include <sys/resource.h>
#ifndef MAP_NORESERVE
#define MAP_NORESERVE 0
#endif
#endif

#if (defined(HAS_LIMITS) || defined(__MINGW32__)) && (defined(FLEXACT_WITH_OPENBLAS) || defined(__ELF__))
#include <pthread.h>

/* What the library's names begin with. */
#define JOIN(a, b) a##b
#define PREFIXED(prefix, name) JOIN(prefix, name)
#ifdef FLEXACT_BLAS_PREFIX
#define BLAS(name) PREFIXED(FLEXACT_BLAS_PREFIX, name)
#else
#define BLAS(name) name
#endif

/* A library that the build knows as OpenBLAS has it all. Another may be OpenBLAS once the
 * program runs (Debian's alternatives), which only ELF can find out, by weak symbols. */
#if defined(FLEXACT_WITH_OPENBLAS)
#define PERHAPS
#else
#define PERHAPS __attribute__((weak))
#endif
#define openblas_set_num_threads BLAS(openblas_set_num_threads)
#define openblas_get_num_threads BLAS(openblas_get_num_threads)
#define openblas_get_parallel BLAS(openblas_get_parallel)
#define dsyrk_ BLAS(dsyrk_)
extern void openblas_set_num_threads(int) PERHAPS;
extern int openblas_get_num_threads(void) PERHAPS;
extern int openblas_get_parallel(void) PERHAPS;
void dsyrk_(const char *, const char *, const int *, const int *, const double *, const double *, const int *,
            const double *, double *, const int *, size_t, size_t) PERHAPS;

#ifdef __ELF__
extern void omp_set_max_active_levels(int) __attribute__((weak));
extern int omp_get_max_active_levels(void) __attribute__((weak));
#endif

enum { openmp = 2 };
static const size_t buffer = (size_t)129 << 20;
/* With so much address space left nobody needs to be careful. */
static const size_t ample = (size_t)1 << 31;

/* Whether the address space has a limit, and only one thread is wanted; what was before, of
 * OpenBLAS with OpenMP and of OpenMP. */
typedef struct { int limited, alone, threads, levels; } work_t;

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t ended = PTHREAD_COND_INITIALIZER;
/* Calls at work, those that want one thread only, those of them that share, and the threads before. */
static int active, alone, shared, before;
/* Whether OpenBLAS is known to have a buffer for each of its threads. */
static int buffered;

static int has_threads(void)
{
#ifdef FLEXACT_WITH_OPENBLAS
    return 1;
#else
    return openblas_set_num_threads && openblas_get_num_threads && openblas_get_parallel && dsyrk_;
#endif
}

#ifdef HAS_LIMITS
static int has_room(size_t size)
{
    void *room = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (room == MAP_FAILED) return 0;
    munmap(room, size);
    return 1;
}

static int is_limited(void)
{
    struct rlimit limit;
    return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

#else
static int has_room(size_t size) { return size > 0; }
static int is_limited(void) { return 0; }
#endif

static int is_tight(size_t bytes) { return is_limited() && !has_room(ample + bytes); }

/* OpenMP, with which CHOLMOD may be built, ends the process where it gets no threads. */
static void forbid_openmp(work_t *work)
{
#ifdef __ELF__
    if (!omp_set_max_active_levels || !omp_get_max_active_levels) return;
    work->levels = omp_get_max_active_levels();
    omp_set_max_active_levels(0);
#else
    work->levels = 0;
#endif
}

static void allow_openmp(const work_t *work)
{
#ifdef __ELF__
    if (work->levels > 0) omp_set_max_active_levels(work->levels);
#else
    (void)work;
#endif
}

/* Let OpenBLAS take its buffers while there is room for them. All of its threads must be at
 * work: one that starts later would take that of the others, and keep it. */
static void take_buffers(void)
{
    enum { n = 64 };
    static double a[n * n], c[n * n];
    const int size = n;
    const double one = 1.0, zero = 0.0;
    dsyrk_("U", "N", &size, &size, &one, a, &size, &zero, c, &size, 1, 1);
}

static int find_buffers(void)
{
    if (!has_threads() || buffered || !is_tight(0)) return 1;
    if (!has_room(buffer * openblas_get_num_threads())) return 0;
    take_buffers();
    buffered = 1;
    return 1;
}

/* OpenMP counts threads for each thread that calls, others count for all. */
static void set_threads(void)
{
    if (active == 0 || (active == 1 && alone == 0)) {
        if (before > 0) openblas_set_num_threads(before);
        before = 0;
    } else if (before == 0) {
        before = openblas_get_num_threads();
        openblas_set_num_threads(1);
    }
}

#ifdef HAS_LIMITS
static void before_fork(void) { pthread_mutex_lock(&lock); }
static void after_fork(void) { pthread_mutex_unlock(&lock); }

/* Threads that are at work stay behind in the parent, and what they asked of OpenBLAS with them;
 * under a limit it waits for the first call, which looks for room before. */
static void in_child(void)
{
    static const pthread_cond_t nobody_waits = PTHREAD_COND_INITIALIZER;
    active = alone = shared = buffered = 0;
    /* Those who wait for it are left behind, too: it would wait for them. */
    ended = nobody_waits;
    if (has_threads() && !is_limited() && openblas_get_parallel() != openmp) set_threads();
    pthread_mutex_unlock(&lock);
}

/* The address space is taken when the library is loaded, before anyone asks what is left. */
__attribute__((constructor)) static void load(void)
{
    pthread_atfork(before_fork, after_fork, in_child);
    find_buffers();
}
#endif

/* 0, or -1 where OpenBLAS, or so many bytes for others, would find no room even when nothing
 * else is at work; work is what flexact_blas_end is to be given. */
int flexact_blas_begin(int is_small, double bytes, work_t *work)
{
    int found;
    memset(work, 0, sizeof *work);
    work->limited = is_limited();
    if (!has_threads()) return work->limited && !has_room((size_t)bytes) ? -1 : 0;
    work->alone = is_small;
    pthread_mutex_lock(&lock);
    /* One after the other, so that one buffer does and none takes what another has found. */
    while (active > 0 && is_tight((size_t)bytes)) pthread_cond_wait(&ended, &lock);
    if (is_tight((size_t)bytes)) {
        work->alone = 1;
        forbid_openmp(work);
    }
    found = find_buffers() && !(work->limited && !has_room((size_t)bytes));
    if (found) {
        active += 1;
        alone += work->alone;
        if (openblas_get_parallel() != openmp) set_threads();
    }
    pthread_mutex_unlock(&lock);
    if (!found) allow_openmp(work);
    if (found && work->alone && openblas_get_parallel() == openmp) {
        work->threads = openblas_get_num_threads();
        openblas_set_num_threads(1);
    }
    return found ? 0 : -1;
}

void flexact_blas_end(work_t *work)
{
    if (!has_threads()) return;
    if (work->threads > 0) openblas_set_num_threads(work->threads);
    allow_openmp(work);
    pthread_mutex_lock(&lock);
    active -= 1;
    alone -= work->alone;
    pthread_cond_broadcast(&ended);
    if (openblas_get_parallel() != openmp) set_threads();
    pthread_mutex_unlock(&lock);
}

/* Where threads are those of OpenMP, or a limit might be met, others are not to be started. */
int flexact_blas_threads(void)
{
    int threads;
    if (!has_threads() || is_limited() || openblas_get_parallel() == openmp) return 1;
    pthread_mutex_lock(&lock);
    threads = before > 0 && active - shared <= 1 ? before : openblas_get_num_threads();
    pthread_mutex_unlock(&lock);
    return threads;
}

/* Within a piece of work, and so nothing is waited for. */
static void share(int calls)
{
    if (!has_threads() || openblas_get_parallel() == openmp) return;
    pthread_mutex_lock(&lock);
    active += calls;
    alone += calls;
    shared += calls;
    set_threads();
    pthread_mutex_unlock(&lock);
}

void flexact_blas_share(void) { share(1); }
void flexact_blas_unshare(void) { share(-1); }

#else

typedef struct { int limited, alone, threads, levels; } work_t;

int flexact_blas_begin(int is_small, double bytes, work_t *work)
{
    work->limited = 0;
    work->alone = is_small && bytes > 0;
    return 0;
}

void flexact_blas_end(work_t *work) { (void)work; }

int flexact_blas_threads(void) { return 1; }

void flexact_blas_share(void) {}
void flexact_blas_unshare(void) {}

#endif
