// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_output_field_format_h
#define quoin_output_field_format_h

namespace quoin
{
  /** The files of fields. */
  enum class FieldFormat
  {
    vtu, /**< VTU files for each rank and time, and their list */
    xdmf /**< two for all ranks and times: XdmfWriter */
  };
} // namespace quoin

#endif
