/* getrusage for a program that calls ffsm_usage_by_tick: the linker takes this file for no other, and
   gives what stands in the program to its shared libraries too. */
#define _GNU_SOURCE
#include <stdbool.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

void ffsm_usage_by_tick(void) {}

/* The kernel counts a process's time when it asks for it; within a tick of its coarse clock, some
   milliseconds, the last answer that this thread has had is given again. */
int getrusage(__rusage_who_t who, struct rusage *usage) {
  static _Thread_local bool known;
  static _Thread_local struct timespec tick;
  static _Thread_local struct rusage last;
  struct timespec now;
  if (who != RUSAGE_SELF || clock_gettime(CLOCK_MONOTONIC_COARSE, &now) != 0)
    return (int)syscall(SYS_getrusage, who, usage);
  if (!known || now.tv_sec != tick.tv_sec || now.tv_nsec != tick.tv_nsec) {
    if (syscall(SYS_getrusage, who, &last) != 0)
      return -1;
    tick = now;
    known = true;
  }
  *usage = last;
  return 0;
}
