// SPDX-License-Identifier: MIT
//
// Outputs that are not complete lie beside the place where they will appear, as .cubemap-PROCESS-NUMBER and an extension. What
// a program that was killed has left is known by that name: its process is gone or is the one that asks, and nobody has it locked. Processes of another
// machine or container have numbers of their own, so what is locked is in use all the same.

#ifndef CUBEMAP_MODULES_IMAGE_TEMPORARY_NAME_HPP
#define CUBEMAP_MODULES_IMAGE_TEMPORARY_NAME_HPP

#include <string>

#include <sys/types.h>

// A name of this process.
std::string own_temporary_name(int number, const std::string &extension);

// Make a file or a folder that is locked as long as the descriptor is open; -1 with errno. The file has that mode less umask.
int make_temporary_file(const std::string &path, mode_t mode);
int make_temporary_folder(const std::string &path);

// Removes the files that programs which were killed have left in a folder.
void remove_left_over_files(const std::string &folder);
// The same of folders whose names have this extension, with all that is in them.
void remove_left_over_folders(const std::string &folder, const std::string &extension);

#endif
