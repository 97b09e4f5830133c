/* SPDX-License-Identifier: BSD-3-Clause */
/* Tasks side by side, for flexact_threads.f90. Threads live for one call, so that a process
 * may fork between calls; where one cannot be had, the others do its work. */
#include <pthread.h>
#include <stddef.h>

typedef void work_t(int task, int worker, void *data);

typedef struct {
    pthread_mutex_t lock;
    int next, tasks;
    work_t *work;
    void *data;
} queue_t;

typedef struct {
    queue_t *queue;
    int worker;
} member_t;

enum { most_threads = 64 };

static int take(queue_t *queue)
{
    int task;
    pthread_mutex_lock(&queue->lock);
    task = queue->next < queue->tasks ? ++queue->next : 0;
    pthread_mutex_unlock(&queue->lock);
    return task;
}

static void *run(void *given)
{
    member_t *member = given;
    int task;
    while ((task = take(member->queue)) != 0) member->queue->work(task, member->worker, member->queue->data);
    return NULL;
}

/* work(task, worker, data) for tasks 1 to `tasks`, by at most so many workers, from 1. */
void flexact_run_tasks(int tasks, int workers, work_t *work, void *data)
{
    queue_t queue = {PTHREAD_MUTEX_INITIALIZER, 0, tasks, work, data};
    pthread_t thread[most_threads];
    member_t member[most_threads];
    int started = 1, i;
    if (workers > most_threads) workers = most_threads;
    for (i = 0; i < workers || i == 0; i++) {
        member[i].queue = &queue;
        member[i].worker = i + 1;
    }
    while (started < workers && started < tasks && pthread_create(&thread[started], NULL, run, &member[started]) == 0)
        started++;
    run(&member[0]);
    for (i = 1; i < started; i++) pthread_join(thread[i], NULL);
}
