// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_number_table_h
#define quoin_base_number_table_h

#include <string>
#include <vector>

namespace quoin
{
  struct TableRow
  {
    unsigned int line; /**< line number in the file, from 1 */
    std::vector<double> values;
  };

  /**
   * Reads the rows of a text file, each of @p n_columns finite numbers
   * separated by commas or blanks. Text after a # is a comment; lines without a
   * number before the first row are a heading. @p row: what a row should be,
   * for messages. Throws an InputError, with the file and the line, if the file
   * cannot be read, a row is different, or there is none.
   */
  std::vector<TableRow> read_number_table(const std::string &file,
                                          unsigned int n_columns,
                                          const std::string &row);
} // namespace quoin

#endif
