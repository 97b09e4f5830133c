/* SPDX-License-Identifier: BSD-3-Clause */
/* A process that is forked while a call keeps OpenBLAS to one thread has all of them at once. */
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

extern int openblas_get_num_threads(void) __attribute__((weak));
extern void openblas_set_num_threads(int) __attribute__((weak));
extern int openblas_get_parallel(void) __attribute__((weak));
typedef struct { int limited, alone, threads, levels; } work_t;
int flexact_blas_begin(int is_small, double bytes, work_t *work);
void flexact_blas_end(work_t *work);

int main(void)
{
    work_t work;
    int how = 0, is_right;
    pid_t child;
    if (!openblas_get_parallel || openblas_get_parallel() != 1) return 77;
    openblas_set_num_threads(2);
    if (flexact_blas_begin(1, 0.0, &work) != 0 || work.limited) return 77;
    is_right = openblas_get_num_threads() == 1;
    child = fork();
    if (child == 0) _exit(openblas_get_num_threads() == 2 ? 0 : 1);
    waitpid(child, &how, 0);
    is_right = is_right && WIFEXITED(how) && WEXITSTATUS(how) == 0;
    flexact_blas_end(&work);
    is_right = is_right && openblas_get_num_threads() == 2;
    printf("%s\n", is_right ? "the threads are those of before" : "FAILED the threads of a child");
    return !is_right;
}
