/* SPDX-License-Identifier: MIT
 *
 * A folder of a test, and files in it.
 */
#ifndef TESTS_SCENE_WRITTEN_FILES_H
#define TESTS_SCENE_WRITTEN_FILES_H

#include <stddef.h>

/* A new folder, made on the first call, whose name lives as long as the program. */
const char *test_folder(void);
/* FOLDER/NAME; lives until the 64th call after it. */
const char *in_folder(const char *name);
/* Write a file there, and the folders before it. The name as in_folder has it. */
const char *write_file(const char *name, const void *bytes, size_t count);
const char *write_text(const char *name, const char *text);
/* All of a file with a zero byte behind it, to be freed; NULL if it is not there. */
char *read_file(const char *path, size_t *count);
/* How many entries a folder has; -1 if it is none. */
int count_entries(const char *path);
/* Remove a file or a folder with all in it. */
void remove_all(const char *path);

#endif
