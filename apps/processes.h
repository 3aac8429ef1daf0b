// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/parallel/ranks.h"

#include <functional>

namespace ogive::apps
{
enum ExitStatus
{
  done = 0,
  run_failed,
  bad_input
};

/// Runs this very command on so many processes by mpirun, as root too and with
/// more processes than cores, and waits for its end. Returns the exit status of
/// the command; what killed a process is told. Throws InputError without mpirun.
int start_ranks(int ranks, char *const argv[]);

/// Throws InputError where mpirun has started another number of processes than
/// -n asks for (0: does not ask).
void expect_ranks(const Ranks &, int wanted);

/// Throws InputError on several ranks: most commands are for one process.
void expect_alone(const Ranks &, const char *command);

/// Calls the command, which is part of all ranks' work, and turns what it throws
/// into a message on standard error, told once, and an exit status common to all
/// ranks. A rank that fails alone ends the others.
int finish(const Ranks &, const std::function<int()> &command);
} // namespace ogive::apps
