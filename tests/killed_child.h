/* SPDX-License-Identifier: MIT
 *
 * Children that write steps into files until they are killed, in a folder where that is quick.
 */
#ifndef TESTS_KILLED_CHILD_H
#define TESTS_KILLED_CHILD_H

/* Writes steps from this one on, without end, and tells each through the pipe when it is kept: tell_step. */
typedef void (*endless_work)(int pipe_end, unsigned step);

/* The child ends itself if nobody listens. */
void tell_step(int pipe_end, unsigned step);

/* A child works from a step on. It is killed so many steps and microseconds later: the last step that it has told of. */
unsigned run_and_kill(endless_work work, unsigned first, unsigned steps, long microseconds);

/* How long may one wait after a step so that most kills fall into the next one: by four steps from 1 on, microseconds. */
long pause_within_step(endless_work work);

/* A new folder, in memory where that can be: what a kill leaves does not depend on the disk, and a commit takes its time
 * there. */
void make_quick_folder(char folder[40], const char *name);

#endif
