/* SPDX-License-Identifier: BSD-3-Clause */
/* Memory that gives out once, on demand, for test_cholesky_memory.f90: linked with --wrap=malloc,
 * so that it stands between the core and the C library. */
#include <stddef.h>

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);

static int left; /* calls until one fails; 0: none will */

void flexact_fail_after(int calls) { left = calls; }

int flexact_calls_left(void) { return left; }

static int fails(void) { return left > 0 && --left == 0; }

void *__wrap_malloc(size_t size) { return fails() ? NULL : __real_malloc(size); }

void *__wrap_calloc(size_t count, size_t size) { return fails() ? NULL : __real_calloc(count, size); }

void *__wrap_realloc(void *old, size_t size) { return fails() ? NULL : __real_realloc(old, size); }
