/* SPDX-License-Identifier: BSD-3-Clause */
/* Memory in large pages, for flexact_pages.f90: a system that hands memory out as it is first
 * touched does so two megabytes at a time, and not four kilobytes. */
#if defined(__linux__)
#define _DEFAULT_SOURCE
#include <sys/mman.h>
#include <unistd.h>
#endif
#include <stddef.h>
#include <stdint.h>

/* Below this it is no gain [bytes]. */
enum { worth_it = 1 << 22 };

void flexact_use_large_pages(void *memory, size_t bytes)
{
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    size_t page = (size_t)sysconf(_SC_PAGESIZE), before;
    if (bytes < worth_it) return;
    before = (page - (uintptr_t)memory % page) % page;
    /* Advice: where it is not taken, all is as before. */
    (void)madvise((char *)memory + before, (bytes - before) / page * page, MADV_HUGEPAGE);
#else
    (void)memory, (void)bytes;
#endif
}
