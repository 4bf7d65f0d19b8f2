/* SPDX-License-Identifier: MIT
 *
 * A disk that fails when it is told to: a VFS of SQLite in front of the true one.
 */
#ifndef TESTS_SCENE_FAILING_DISK_H
#define TESTS_SCENE_FAILING_DISK_H

/* All files that SQLite opens from here on are on this disk. */
void use_failing_disk(void);

/* The call fails that is this number, the first 1, or 0 for none; if it lasts, all after it, too. Calls are counted anew. */
void let_disk_fail(unsigned long at, int lasts);

/* Calls since. */
unsigned long disk_calls(void);

#endif
