/* SPDX-License-Identifier: BSD-3-Clause */
/* SIGTERM while METIS is at work, and after calls that overlap, does what the program wants: at once,
 * once, in whatever thread it falls; and its handlers are those of before, with their flags. */
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

int flexact_metis_is_there(void);
int flexact_metis_order(int n, const int *start, const int *place, int *order);

enum { side = 32, vertices = side * side * side };
static int start[vertices + 1], place[3 * vertices];
static volatile sig_atomic_t caught;
static volatile int is_over, failures;

static void check(int is_true, const char *what)
{
    if (is_true) return;
    printf("FAILED %s\n", what);
    failures += 1;
}

/* The lower triangle of a cube of points, each joined with its next ones. */
static void make_cube(void)
{
    int j, used = 0;
    for (j = 0; j < vertices; j++) {
        start[j] = used;
        if (j % side < side - 1) place[used++] = j + 1;
        if (j / side % side < side - 1) place[used++] = j + side;
        if (j / (side * side) < side - 1) place[used++] = j + side * side;
    }
    start[vertices] = used;
}

static void *order(void *status)
{
    int *found = malloc(vertices * sizeof *found);
    *(int *)status = flexact_metis_order(vertices, start, place, found);
    free(found);
    return NULL;
}

static void catch(int number, siginfo_t *info, void *context)
{
    (void)info, (void)context;
    caught += number == SIGTERM;
}

static void handle(int number)
{
    struct sigaction ours;
    ours.sa_sigaction = catch;
    ours.sa_flags = SA_SIGINFO | SA_RESTART;
    sigemptyset(&ours.sa_mask);
    sigaction(number, &ours, NULL);
}

static int is_handled(int number)
{
    struct sigaction now;
    sigaction(number, NULL, &now);
    return now.sa_sigaction == catch && now.sa_flags & SA_SIGINFO && now.sa_flags & SA_RESTART;
}

static void rest(long nanoseconds)
{
    const struct timespec time = {0, nanoseconds};
    nanosleep(&time, NULL);
}

/* Until METIS is at work, and the moment has passed in which its own handlers stand. */
static void await_metis(void)
{
    int looks;
    for (looks = 0; looks < 200 && !is_over; looks++) {
        struct sigaction now;
        sigaction(SIGTERM, NULL, &now);
        if (now.sa_flags & SA_SIGINFO && now.sa_sigaction != catch) break;
        rest(1000000);
    }
}

/* To the process, as `kill` and services send it. */
static void *send(void *count)
{
    int k;
    await_metis();
    for (k = 0; k < *(int *)count; k++) {
        int looks = 0;
        rest(3000000);
        kill(getpid(), SIGTERM);
        /* Two that wait are one. */
        while (caught == k && looks++ < 1000) rest(10000000);
    }
    return NULL;
}

/* In this thread alone, or in another while this one waits. */
static void during(int is_apart)
{
    pthread_t sender, worker;
    int status = 1, count = 3;
    handle(SIGTERM);
    handle(SIGABRT);
    caught = is_over = 0;
    pthread_create(&sender, NULL, send, &count);
    if (is_apart) {
        pthread_create(&worker, NULL, order, &status);
        pthread_join(worker, NULL);
    } else {
        order(&status);
    }
    is_over = 1;
    pthread_join(sender, NULL);
    check(caught == count, "each signal is handled");
    check(status == 0, "there is an order");
    check(is_handled(SIGTERM) && is_handled(SIGABRT), "the handlers are those of before");
}

static void overlapping(void)
{
    pthread_t workers[3];
    int status[3], k, round;
    handle(SIGTERM);
    handle(SIGABRT);
    for (round = 0; round < 2; round++) {
        for (k = 0; k < 3; k++) {
            pthread_create(&workers[k], NULL, order, &status[k]);
            rest(4000000);
        }
        for (k = 0; k < 3; k++) pthread_join(workers[k], NULL);
        for (k = 0; k < 3; k++) check(status[k] == 0, "there is an order of each thread");
    }
    check(is_handled(SIGTERM) && is_handled(SIGABRT), "the handlers are those of before all");
    caught = 0;
    raise(SIGTERM);
    check(caught == 1, "a signal afterwards is handled");
}

/* Without a handler it ends the process, and not by a crash. */
static void *end(void *child)
{
    await_metis();
    kill(*(pid_t *)child, SIGTERM);
    return NULL;
}

static void unhandled(int is_apart)
{
    int how = 0, status;
    pid_t child = fork();
    if (child == 0) {
        pthread_t sender, worker;
        pid_t own = getpid();
        signal(SIGTERM, SIG_DFL);
        is_over = 0;
        pthread_create(&sender, NULL, end, &own);
        if (is_apart) {
            pthread_create(&worker, NULL, order, &status);
            pthread_join(worker, NULL);
        } else {
            order(&status);
        }
        is_over = 1;
        pthread_join(sender, NULL);
        rest(100000000);
        _exit(0);
    }
    waitpid(child, &how, 0);
    check(WIFSIGNALED(how) && WTERMSIG(how) == SIGTERM, "it ends by the signal");
}

/* One that is forked meanwhile has the program's handlers, and an order of its own. */
static void forked(void)
{
    pthread_t worker;
    int status = 1, how = 0;
    pid_t child;
    handle(SIGTERM);
    handle(SIGABRT);
    pthread_create(&worker, NULL, order, &status);
    rest(20000000);
    child = fork();
    if (child == 0) {
        int is_right = is_handled(SIGTERM) && is_handled(SIGABRT);
        order(&status);
        _exit(is_right && status == 0 ? 0 : 1);
    }
    waitpid(child, &how, 0);
    pthread_join(worker, NULL);
    check(WIFEXITED(how) && WEXITSTATUS(how) == 0, "a child that is forked meanwhile");
}

int main(void)
{
    if (!flexact_metis_is_there()) return 77;
    make_cube();
    during(0);
    during(1);
    overlapping();
    unhandled(0);
    unhandled(1);
    forked();
    if (!failures) printf("all signals did what they were to do\n");
    return failures != 0;
}
