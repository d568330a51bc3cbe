// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/application/command_line.h>

int
main(int argc, char **argv)
{
  return quoin::run_command_line(argc, argv);
}
