// SPDX-License-Identifier: MIT
//
// What a program promises of its temporary files when a signal ends it: what atomic_file.hpp keeps, without the image
// library that it reads.

#ifndef CUBEMAP_TOOLS_TEMPORARY_GUARD_HPP
#define CUBEMAP_TOOLS_TEMPORARY_GUARD_HPP

// From now on SIGINT, SIGTERM, SIGHUP and SIGPIPE remove the temporary files before they end the program
// (those of them that are ignored stay so), and a write beyond the limit on the size of files is an
// error, not a signal.
void guard_temporary_files();

// Puts off the ending signals while it lives, whichever thread they come to: the program ends with them after that.
class SignalsHeld
{
public:
    SignalsHeld();
    ~SignalsHeld();
    SignalsHeld(const SignalsHeld &) = delete;
    SignalsHeld &operator=(const SignalsHeld &) = delete;
};

// Failure if a signal is put off, so that what holds it ends soon. From any thread.
void check_held_signal();

#endif
